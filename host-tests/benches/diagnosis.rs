//! How long a diagnosis takes: 10 runs of 6 s at 500 rows a second on four wheels with each effect hidden in turn; and
//! that its time is linear in rows: the same with a half and a quarter of each run.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use host_tests::catalogue::sessions::truth;
use model_core::effects::EffectKind;
use model_core::effects::card::Scope;
use omni_gap::log::Session;
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Options, diagnose, known_effects};

/// Lengths of a run [s]; the first is what the promise speaks of.
const DURATIONS: [f64; 3] = [6.0, 3.0, 1.5];

fn session(hidden: EffectKind, duration: f64) -> Session {
    let card = hidden.card();
    let wheel = (card.scope == Scope::OneWheel).then_some(1);
    let plan = Scenario { hidden: vec![EffectInstance::typical(card, wheel)], duration, ..Scenario::default() };
    synthesize(truth(4), &plan, &known_effects()).expect("the example is sound")
}

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("diagnosis");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(10));
    for duration in DURATIONS {
        let session = session(EffectKind::DeadTime, duration);
        let rows: usize = session.runs.iter().map(|run| run.rows()).sum();
        group.throughput(Throughput::Elements(rows as u64));
        group.bench_with_input(BenchmarkId::new("rows", rows), &session, |b, session| {
            b.iter(|| diagnose(black_box(session), &Options::default()));
        });
    }
    for effect in EffectKind::ALL {
        let session = session(effect, DURATIONS[0]);
        group.bench_with_input(BenchmarkId::new("hidden", effect.card().id), &session, |b, session| {
            b.iter(|| diagnose(black_box(session), &Options::default()));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
