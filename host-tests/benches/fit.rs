//! How long one fit takes: 7 parameters and the starts of all windows, 10 runs of 6 s at 500 rows a second on four wheels
//! with a camera of 60 frames a second, from starting values that are off by what the robot file states of them.
//!
//! What is timed is the fit alone, from recordings that are laid out. That it arrives at the truth is asserted outside.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use host_tests::catalogue::sessions::truth;
use host_tests::fit_case::{FitCase, WRONG, astray, found, scenario};
use omni_gap::known_effects;
use omni_gap::simulate::Slot;
use omni_gap::synthesize::synthesize;

fn bench(c: &mut Criterion) {
    let case = FitCase::of(&synthesize(truth(4), &scenario(), &known_effects()).expect("the example is sound"));
    let fitted = case.fit();
    let factors = found(&fitted);
    for ((key, p, truth), found) in WRONG.iter().zip(factors) {
        let sigma = fitted.std(Slot::Nominal(*p)).expect("it was free");
        println!("{key}: {found:.4} ± {sigma:.4}, true {truth}");
    }
    assert_eq!(astray(&factors, &fitted), Vec::<String>::new());
    let error = fitted.cost / fitted.samples as f64;
    println!("error {error:.4} σ² a number");
    assert!((0.98..1.02).contains(&error), "{error} σ² a number is left");

    let mut group = c.benchmark_group("fit");
    group.sample_size(20).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(8));
    group.throughput(Throughput::Elements(case.runs.iter().map(|run| run.rows() as u64).sum()));
    group.bench_function("7 parameters, 60 s", |b| b.iter(|| black_box(&case).fit()));
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
