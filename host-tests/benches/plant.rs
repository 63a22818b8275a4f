//! Plant steps a second, on one core: the plain four-wheel model at 1 kHz, each effect alone, three and ten together.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use host_tests::plant_cases::{PLANT_CASES, STEPS, TEN, model, run, with_derivatives};
use model_core::effects::EffectKind;
use std::hint::black_box;

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("plant");
    group.throughput(Throughput::Elements(STEPS as u64));
    let mut one = |name: &str, effects: &[&str]| {
        let plant = model(effects).plant();
        let mut memory = plant.memory().collect::<Vec<_>>();
        group.bench_function(name, |b| b.iter(|| black_box(run(black_box(&plant), &mut memory))));
    };
    for case in PLANT_CASES.into_iter().chain([TEN]) {
        one(case.name, case.effects);
    }
    for effect in &EffectKind::ALL {
        one(effect.card().id, &[effect.card().id]);
    }
    let plant = with_derivatives();
    group.bench_function("plain, eight derivatives", |b| b.iter(|| black_box(run(black_box(&plant), &mut []))));
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
