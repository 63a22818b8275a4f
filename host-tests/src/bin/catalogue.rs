use model_core::effects;
use omni_gap::{identify::*, known::known_effects, rank::*, simulate::*, stage::*};
fn go<const N: usize>(truth: &str, id: &str, wheel: Option<usize>, wrong: Vec<(&'static str, f64)>, seed: u64) {
    let known = known_effects();
    let hidden = effects::find::<f64>(id).map(|e| vec![Carried::typical(e.card(), wheel)]).unwrap_or_default();
    let t0 = std::time::Instant::now();
    let session = stage(truth, &Stage { hidden: hidden.clone(), wrong, seed, ..Stage::default() }, &known).unwrap();
    let t1 = t0.elapsed();
    let t0 = std::time::Instant::now();
    let rec: Vec<Recorded<N>> = session.runs.iter().map(|r| Recorded::new(r, &session.robot).unwrap()).collect();
    let fitr: Vec<&Recorded<N>> = rec.iter().enumerate().filter(|(k, _)| k % 3 != 2).map(|x| x.1).collect();
    let held: Vec<&Recorded<N>> = rec.iter().enumerate().filter(|(k, _)| k % 3 == 2).map(|x| x.1).collect();
    let prior = Prior::stated(&session.robot);
    let data = Data {
        fit_windows: fitr.iter().map(|r| Windows::new(r, 0.5)).collect(),
        held_windows: held.iter().map(|r| Windows::new(r, 0.5)).collect(),
        fit: fitr,
        held,
        prior: prior.clone(),
    };
    let base = data.judge(Model::nominal(&session.robot, 8.0), None, &prior, 0);
    let tb = t0.elapsed();
    let r = explain(&data, base, &prior);
    println!(
        "== {id} {wheel:?} N={N} stage {:.2}s base {:.2}s all {:.2}s  base score {:.1} held {:.0}/{:.0} stated {:.1} scale {:.2}",
        t1.as_secs_f64(),
        tb.as_secs_f64(),
        t0.elapsed().as_secs_f64(),
        r.base.score(r.scale),
        r.base.held(),
        r.base.freedom,
        r.base.stated,
        r.scale
    );
    for x in r.ranked.iter().take(5) {
        let last = x.scored.fit.model.effects.iter().map(|e| format!("{:?}", e.params)).collect::<String>();
        println!(
            "     {:22} {:?} score {:.1} chi2/n {:.3} stated {:.1} {last} {:?}",
            x.cause.id(),
            x.cause.wheel(),
            x.scored.score(r.scale),
            x.scored.held() / x.scored.freedom,
            x.scored.stated,
            x.scored.fit.model.factor.map(|f| (f * 100.).round() / 100.)
        );
    }
    let s: Vec<String> = r
        .screened
        .iter()
        .take(6)
        .map(|s| format!("{}{:?} {:.0}", s.candidate.card.id, s.candidate.wheel, s.gain))
        .collect();
    println!("     screen: {}", s.join(", "));
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
        go::<4>(t4, c.id, w, vec![], 3);
        go::<3>(t3, c.id, w, vec![], 4);
    }
    if only.is_empty() || only == "none" {
        for s in 0..3 {
            go::<4>(t4, "none", None, vec![], 10 + s);
            go::<3>(t3, "none", None, vec![], 20 + s);
        }
        for (k, f) in [("mass_kg", 1.15), ("resistance_ohm", 1.4), ("coulomb_v_N", 2.0)] {
            println!("wrong {k}");
            go::<4>(t4, "none", None, vec![(k, f)], 10);
            go::<3>(t3, "none", None, vec![(k, f)], 20);
        }
    }
}
