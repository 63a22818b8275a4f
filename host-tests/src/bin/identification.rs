//! The study of the identification.
use host_tests::identification::page::look;
use host_tests::identification::study::{Case, studied};
use omni_gap::simulate::Sensing;

fn main() {
    let seeds = std::env::args().nth(1).and_then(|s| s.parse().ok()).unwrap_or(40);
    let only = std::env::args().nth(2);
    for sensing in Sensing::ALL {
        if only.as_ref().is_some_and(|w| w != sensing.word()) {
            continue;
        }
        for wheels in [3, 4] {
            let t = std::time::Instant::now();
            let s = studied(Case {
                wheels,
                sensing,
                camera_correlation: 0.0,
                seeds: if sensing == Sensing::Paper { seeds } else { seeds.div_ceil(4) },
            });
            println!("{:.1} s\n{}", t.elapsed().as_secs_f64(), look(&s));
        }
    }
}
