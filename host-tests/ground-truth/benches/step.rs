//! What a second of a robot costs.

#[path = "../tests/support/rich.rs"]
mod rich;

use criterion::{Criterion, criterion_group, criterion_main};
use ground_truth::paper::four_wheels;
use ground_truth::simulation::Simulation;

/// A step [s]
const STEP: f64 = 1e-4;
/// Steps of a run.
const STEPS: usize = 10_000;

fn steps(c: &mut Criterion) {
    for (name, robot) in
        [("10,000 steps of the paper's robot", four_wheels()), ("10,000 steps of all there is", rich::all_there_is())]
    {
        c.bench_function(name, |b| {
            b.iter(|| {
                let mut moving = Simulation::new(robot.clone(), STEP);
                for k in 0..STEPS / 100 {
                    let u = if (k / 30).is_multiple_of(2) { 6.0 } else { -5.0 };
                    moving.hold(&[u, 0.5 * u, -u, 2.0], 100);
                }
                moving.pose()
            });
        });
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
