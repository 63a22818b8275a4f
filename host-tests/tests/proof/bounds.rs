//! Every effect with any parameters within its bounds: nothing panics, everything stays finite, and single precision goes
//! the same way as double.

use host_tests::excitation::{SeededRng, voltages};
use model_core::effects::card::{Card, Param};
use model_core::effects::{EffectKind, Numbers};
use model_core::number::scalar::Real;
use model_core::plant::Plant;
use model_core::plant::robot::Robot;

use crate::fixture::{Run, beside, four, gap, placements, three, typical, usual_placement};

/// Parameters drawn from within a card's bounds, every third at one of them.
fn drawn(card: &Card, rng: &mut SeededRng) -> Vec<f64> {
    let one = |p: &Param| match rng.below(6) {
        0 => p.within.0,
        1 => p.within.1,
        _ => rng.between(p.within.0, p.within.1),
    };
    card.params.iter().map(one).collect()
}

/// A quarter of a second of random voltages; false once a number is not finite.
pub fn stays_finite<const N: usize, T: Real>(plant: Plant<N, T>, seed: u64) -> bool {
    let mut run = Run::from(plant, [0.1, -0.2, 0.3], [0.4, -0.3, 2.0]);
    for hold in voltages::<N>(seed, 3, 9.0) {
        for _ in 0..hold.milliseconds.min(80) {
            let read = run.drive(hold.u, 1e-3);
            let pose = [read.pose.x, read.pose.y, read.pose.theta, read.gyro];
            let all = pose.into_iter().chain(read.current).chain(read.wheel_speed).chain(run.state.twist.to_array());
            if !all.into_iter().all(Real::is_finite) {
                return false;
            }
        }
    }
    let mut finite = true;
    for mut state in run.memory.iter().copied() {
        state.for_each_mut(|number| finite &= number.is_finite());
    }
    finite
}

#[test]
fn any_parameters_within_bounds_leave_everything_finite() {
    fn check<const N: usize, T: Real>(robot: Robot<N, T>) {
        for (k, effect) in EffectKind::ALL.iter().enumerate() {
            let card = effect.card();
            let mut rng = SeededRng::new(k as u64);
            for draw in 0..24 {
                let params = drawn(card, &mut rng);
                let all = placements(card, N);
                let placement = all[rng.below(all.len() as u32) as usize];
                let plant = beside(robot, *effect, Some((placement, &params)));
                assert!(stays_finite(plant, draw), "{} on {placement:?} with {params:?}", card.id);
            }
        }
    }
    check(three::<f64>());
    check(four::<f64>());
    check(four::<f32>());
}

#[test]
fn single_precision_goes_the_same_way_as_double() {
    fn twist<T: Real + Into<f64>>(effect: EffectKind) -> Vec<[f64; 3]> {
        let card = effect.card();
        let plant = beside(four::<T>(), effect, Some((usual_placement(card), &typical(card))));
        let mut run = Run::from(plant, [0.1, -0.2, 0.3], [0.4, -0.3, 2.0]);
        let mut all = Vec::new();
        for hold in voltages::<4>(9, 4, 9.0) {
            for _ in 0..hold.milliseconds.min(60) {
                run.drive(hold.u, 1e-3);
                all.push(run.twist());
            }
        }
        all
    }
    for effect in EffectKind::ALL {
        let (single, double) = (twist::<f32>(effect), twist::<f64>(effect));
        let worst = single.iter().zip(&double).map(|(a, b)| gap(*a, *b)).fold(0.0, f64::max);
        // 2⁻²⁴ of 40 rad/s is 2 µrad/s a step, of which some hundred steps add up; a friction's corner makes it more
        assert!(worst < 5e-3, "{}: {worst:e}", effect.card().id);
    }
}
