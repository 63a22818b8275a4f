//! How long one fit takes: 7 parameters and the starts of all windows, 10 runs of 6 s at 500 rows a second on four wheels
//! with a camera of 60 frames a second, from starting values that are off by what the robot file states of them.
//!
//! What is timed is the fit alone, from recordings that are laid out. That it arrives at the truth is asserted outside.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use host_tests::catalogue::sessions::truth;
use model_core::plant::robot::Nominal;
use omni_gap::identify::{FitOptions, Free, Prior, Shots, WINDOW_S, Windows, fit};
use omni_gap::known_effects;
use omni_gap::simulate::{AlignedRun, Model, Slot};
use omni_gap::synthesize::{Scenario, synthesize};

/// Steps of the fit at the most.
const ROUNDS: usize = 10;
/// How far from the truth a fitted number may be, in its own sigma.
const SIGMAS: f64 = 4.0;

/// What the fit's step of 2 ms adds to that, as a share of the number: the staged robot takes a tenth of it.
const STEP: f64 = 0.01;

/// What is wrong in the robot file and free in the fit: (key, factor, true value over the file's); each is off by one
/// stated sigma, up or down.
const WRONG: [(&str, Nominal, f64); 7] = [
    ("resistance_ohm", Nominal::Resistance, 1.1),
    ("inertia_kg_m2", Nominal::Inertia, 0.9),
    ("viscous_v_N_s_per_m", Nominal::ViscousV, 1.2),
    ("viscous_vn_N_s_per_m", Nominal::ViscousVn, 0.8),
    ("viscous_w_Nm_s", Nominal::ViscousW, 1.2),
    ("coulomb_w_Nm", Nominal::CoulombW, 0.8),
    ("coulomb_v_N", Nominal::CoulombV, 1.2),
];

fn bench(c: &mut Criterion) {
    let plan = Scenario {
        uncertain: false,
        wrong: WRONG.iter().map(|(key, _, ratio)| (*key, *ratio)).collect(),
        ..Scenario::default()
    };
    let session = synthesize(truth(4), &plan, &known_effects()).expect("the example is sound");
    let laid: Vec<AlignedRun<4>> = session
        .runs
        .iter()
        .map(|run| AlignedRun::new(run, &session.robot).expect("voltages drive the model"))
        .collect();
    let windows: Vec<Windows> = laid.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
    let runs: Vec<&AlignedRun<4>> = laid.iter().collect();
    let shots = Shots { runs: &runs, windows: &windows };
    let nominal = Model::<4>::nominal(&session.robot, plan.voltage);
    let prior = Prior::stated(&session.robot);
    let free: Vec<Free> = WRONG.iter().map(|(_, p, _)| Free { slot: Slot::Nominal(*p), within: (0.1, 4.0) }).collect();

    let options = FitOptions { free: &free, prior: &prior, dispersion: 1.0, rounds: ROUNDS, by_window: false };
    let fitted = fit(nominal.clone(), shots, None, options);
    for (key, p, truth) in WRONG {
        let slot = Slot::Nominal(p);
        let (found, sigma) = (fitted.model.get(slot), fitted.std(slot).expect("it was free"));
        println!("{key}: {found:.4} ± {sigma:.4}, true {truth}");
        let allowed = SIGMAS * sigma + STEP * truth;
        assert!((found - truth).abs() < allowed, "{key} ended at {found} ± {sigma}, true is {truth}");
    }
    let error = fitted.cost / fitted.samples as f64;
    println!("error {error:.4} σ² a number");
    assert!((0.98..1.02).contains(&error), "{error} σ² a number is left");

    let mut group = c.benchmark_group("fit");
    group.sample_size(20).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(8));
    group.throughput(Throughput::Elements(laid.iter().map(|run| run.rows() as u64).sum()));
    group.bench_function("7 parameters, 60 s", |b| {
        b.iter(|| fit(black_box(nominal.clone()), shots, None, options));
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
