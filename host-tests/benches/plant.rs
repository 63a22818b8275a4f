//! Plant steps a second, on one core: the plain four-wheel model at 1 kHz, each effect alone, and three together.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use model_core::effects::{EffectKind, EffectState};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;
use model_core::number::scalar::Real;
use model_core::plant::{Input, Plant};
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{EffectInstance, Model};
use std::hint::black_box;
use std::path::Path;

const STEPS: usize = 10_000;

fn model(effects: &[&str]) -> Model<4> {
    let text = include_str!("../../examples/feup-4w/robot.toml");
    let file = RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).expect("the example is sound");
    let mut model = Model::nominal(&file, 12.0);
    for id in effects {
        let card = EffectKind::find(id).expect("an id of the catalogue").card();
        let wheel = (card.scope == model_core::effects::card::Scope::OneWheel).then_some(2);
        model.add_effect(EffectInstance::typical(card, wheel));
    }
    model
}

/// A run with steps and reversals, as a diagnosis would simulate it.
fn run<T: Real>(plant: &Plant<4, T>, memory: &mut [EffectState<T>]) -> T {
    let mut state = plant.start(T::zero(), Pose::default(), BodyTwist::default());
    let mut sum = T::zero();
    for k in 0..STEPS {
        let u = if (k / 300) % 2 == 0 { 6.0 } else { -5.0 };
        let input = Input::Voltage([u, 0.5 * u, -u, 2.0].map(T::lit));
        sum += plant.step(&mut state, memory, &input, T::lit(1e-3)).current[0];
    }
    sum
}

fn bench(c: &mut Criterion) {
    let mut group = c.benchmark_group("plant");
    group.throughput(Throughput::Elements(STEPS as u64));
    let mut one = |name: &str, effects: &[&str]| {
        let plant = model(effects).plant();
        let mut memory = plant.memory().collect::<Vec<_>>();
        group.bench_function(name, |b| b.iter(|| black_box(run(black_box(&plant), &mut memory))));
    };
    one("plain", &[]);
    one(
        "three light: coriolis, floor_tilt, current_sensor_offset",
        &["coriolis", "floor_tilt", "current_sensor_offset"],
    );
    one(
        "three of the chain: motor_mismatch, gear_efficiency, coriolis",
        &["motor_mismatch", "gear_efficiency", "coriolis"],
    );
    one("three heavy: dead_time, stribeck, wheel_slip", &["dead_time", "stribeck", "wheel_slip"]);
    for effect in &EffectKind::ALL {
        one(effect.card().id, &[effect.card().id]);
    }
    let plant = model(&[]).plant_with(|_, x| Dual::<8>::variable(x, 0));
    group.bench_function("plain, eight derivatives", |b| b.iter(|| black_box(run(black_box(&plant), &mut []))));
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
