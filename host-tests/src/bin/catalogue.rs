use model_core::effects;
use omni_gap::{Diagnosis, Options, known_effects, simulate::*, stage::*};
fn go(truth: &str, n: usize, id: &str, wheel: Option<usize>, wrong: Vec<(&'static str, f64)>, seed: u64) {
    let known = known_effects();
    let hidden = effects::find::<f64>(id).map(|e| vec![Carried::typical(e.card(), wheel)]).unwrap_or_default();
    let session =
        stage(truth, &Stage { hidden: hidden.clone(), wrong: wrong.clone(), seed, ..Stage::default() }, &known)
            .unwrap();
    let t0 = std::time::Instant::now();
    let last = std::cell::RefCell::new((t0, String::new()));
    let times = std::cell::RefCell::new(String::new());
    let progress = |s: &str| {
        let mut l = last.borrow_mut();
        times.borrow_mut().push_str(&format!(
            "{} {:.2}s; ",
            l.1.chars().take(12).collect::<String>(),
            l.0.elapsed().as_secs_f64()
        ));
        *l = (std::time::Instant::now(), s.to_owned());
    };
    let d = Diagnosis::of(&session, &Options { progress: &progress, ..Options::default() });
    progress("end");
    let r = &d.report;
    println!(
        "== {n}w {id} {wheel:?} {wrong:?}: {:?} {:?} closed {:.3?} before {:.2?} after {:.2?} floor {:.2?} refit {:.2?} runner {:.2?} {:.1}s {}",
        r.verdict,
        r.causes,
        r.shrink.closed.unwrap_or(-1.),
        r.shrink.before.unwrap_or(-1.),
        r.shrink.after.unwrap_or(-1.),
        r.shrink.noise_floor.unwrap_or(-1.),
        r.shrink.closed_by_refit_alone.unwrap_or(-1.),
        r.shrink.closed_by_runner_up.unwrap_or(-1.),
        t0.elapsed().as_secs_f64(),
        times.borrow()
    );
    for w in r.which.iter().take(3) {
        println!(
            "     {} {:?} p={:.3} {:?} {:?} {:?}",
            w.cause,
            w.wheel,
            w.probability,
            w.parameters
                .iter()
                .map(|(k, e)| format!("{k}={:.4}±{:.4}", e.value, e.std.unwrap_or(-1.)))
                .collect::<Vec<_>>(),
            w.not_told_apart_from,
            w.settle_by
        );
    }
    for w in r.where_.iter().take(3) {
        println!(
            "     {:?} {:.2} {:?} {:?} {:?}",
            w.stage,
            w.share,
            w.wheel,
            w.axis,
            w.regime.as_ref().map(|r| &r.text)
        );
    }
    for f in r.faults.iter().take(3) {
        println!("     FAULT {} {:?} {}", f.code, f.file, f.what);
    }
    if !r.not_seen.is_empty() {
        println!("     not seen {:?}", r.not_seen);
    }
    for p in omni_gap::Report::unsound(r) {
        println!("     UNSOUND {p}");
    }
}
fn main() {
    let t4 = include_str!("../../../examples/feup-4w/robot.toml");
    let t3 = include_str!("../../../examples/feup-3w/robot.toml");
    let args: Vec<String> = std::env::args().collect();
    let only = args.get(1).cloned().unwrap_or_default();
    for e in effects::catalogue::<f64>() {
        let c = e.card();
        if !only.is_empty() && !c.id.contains(&only) {
            continue;
        }
        let w = (c.place == model_core::card::Place::OneWheel).then_some(1);
        go(t4, 4, c.id, w, vec![], 3);
        go(t3, 3, c.id, w, vec![], 4);
    }
    if only.is_empty() || only == "none" {
        for s in 0..5 {
            go(t4, 4, "none", None, vec![], 10 + s);
            go(t3, 3, "none", None, vec![], 20 + s);
        }
        for (k, f) in [("mass_kg", 1.15), ("resistance_ohm", 1.6), ("coulomb_v_N", 2.5)] {
            go(t4, 4, "none", None, vec![(k, f)], 30);
            go(t3, 3, "none", None, vec![(k, f)], 31);
        }
    }
}
