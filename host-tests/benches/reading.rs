//! How fast a log is read and checked: 60,000 rows of 16 columns, which is a minute of four wheels at 1,000 rows a second.

use std::fmt::Write;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use omni_gap::check::check_run;
use omni_gap::known_effects;
use omni_gap::log::{RobotFile, Run, write_whole};

const ROWS: usize = 60_000;
const HEADER: &str =
    "t_s,u0_V,u1_V,u2_V,u3_V,i0_A,i1_A,i2_A,i3_A,w0_rad_s,w1_rad_s,w2_rad_s,w3_rad_s,x_m,y_m,theta_rad";

/// A log with numbers as long as a logger writes them, and a pose on every 16th row.
fn log() -> String {
    let mut text = format!("{HEADER}\n");
    for row in 0..ROWS {
        let t = row as f64 * 1e-3;
        let _ = write!(text, "{t:.4}");
        for column in 0..12 {
            let _ = write!(text, ",{:.5}", 8.0 * (3.0 * t + f64::from(column)).sin());
        }
        if row % 16 == 0 {
            let _ = writeln!(text, ",{:.5},{:.5},{:.5}", t.sin(), t.cos(), 0.5 * t.sin());
        } else {
            text.push_str(",,,\n");
        }
    }
    text
}

fn bench(c: &mut Criterion) {
    let folder = std::env::temp_dir();
    let path = folder.join(format!("omni-gap-reading-{}.csv", std::process::id()));
    write_whole(&path, log().as_bytes()).expect("a folder for temporary files");
    let mut group = c.benchmark_group("reading");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(5));
    group.throughput(Throughput::Elements(ROWS as u64));
    group.bench_function("60,000 rows of 16 columns", |b| {
        b.iter(|| Run::load(&path, 4, None).expect("the log is sound"));
    });
    let robot = include_str!("../../examples/feup-4w/robot.toml");
    let robot = RobotFile::parse(robot, Path::new("robot.toml"), &known_effects()).expect("the example is sound");
    let (run, _) = Run::load(&path, 4, None).expect("the log is sound");
    group.bench_function("their check", |b| b.iter(|| check_run(&run, &robot)));
    group.finish();
    let _ = std::fs::remove_file(&path);
}

criterion_group!(benches, bench);
criterion_main!(benches);
