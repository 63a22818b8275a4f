//! Excitation: random simultaneous steps of all three axes, with rests and reversals.
//!
//! An effect that only shows when the robot turns while it drives, or just after a reversal, is not in a recording of
//! single-axis tests. A script here is a sequence of pieces: the voltages jump or ramp to a new combination of the
//! three axes, hold, now and then rest; each run begins and ends at rest.

use model_core::geometry::kinematics::Wheels;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What to ask of a robot.
#[derive(Clone, Copy, Debug)]
pub struct Excitation {
    /// Length of the run [s]
    pub duration: f64,
    /// Rows a second [1/s]
    pub rate: f64,
    /// Largest voltage on any motor [V]
    pub voltage: f64,
}

/// The voltages of a run, row by row [V].
pub fn excite<const N: usize>(wheels: &Wheels<N, f64>, plan: &Excitation, seed: u64) -> Vec<[f64; N]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let rows = (plan.duration * plan.rate).round() as usize;
    let mut script = Vec::with_capacity(rows);
    let mut from = [0.0; 3];
    let in_rows = |seconds: f64| ((seconds * plan.rate).round() as usize).max(1);
    script.resize(in_rows(0.3).min(rows), [0.0; N]);
    let last_rest = in_rows(0.5);
    let mut sign = 1.0;
    while script.len() + last_rest < rows {
        let to = match random.random_range(0..10) {
            0 => [0.0; 3],
            // a reversal of what was
            1 | 2 => from.map(|x: f64| -x),
            // one axis alone
            3 => {
                let axis = random.random_range(0..3);
                std::array::from_fn(|a| if a == axis { random.random_range(-1.0..1.0) } else { 0.0 })
            }
            _ => {
                sign = -sign;
                [sign * random.random_range(0.2..1.0), random.random_range(-1.0..1.0), random.random_range(-0.8..0.8)]
            }
        };
        let ramp = if random.random_bool(0.4) { in_rows(random.random_range(0.05..0.3)) } else { 1 };
        let hold = in_rows(random.random_range(0.08..0.5));
        for k in 0..ramp + hold {
            let share = ((k + 1) as f64 / ramp as f64).min(1.0);
            let axes: [f64; 3] = std::array::from_fn(|a| from[a] + share * (to[a] - from[a]));
            script.push(voltages(wheels, axes, plan.voltage));
        }
        from = to;
    }
    script.resize(rows, [0.0; N]);
    let rest = rows.saturating_sub(last_rest);
    script[rest..].fill([0.0; N]);
    script
}

/// The motor voltages of a wish on the three axes, each within ±1; scaled down together where one would pass the limit.
pub(super) fn voltages<const N: usize>(wheels: &Wheels<N, f64>, axes: [f64; 3], limit: f64) -> [f64; N] {
    let wish: [f64; N] = std::array::from_fn(|j| {
        let row = wheels.rows()[j];
        row[0] * axes[0] + row[1] * axes[1] + axes[2]
    });
    let most = wish.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    wish.map(|x| x / most * limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::geometry::kinematics::Wheel;

    #[test]
    fn a_script_starts_and_ends_at_rest_keeps_its_limit_and_its_seed() {
        let wheels = Wheels::new([150.0, 270.0, 30.0].map(|a| Wheel::from_degrees(a, 0.089, 0.0325)));
        let plan = Excitation { duration: 6.0, rate: 200.0, voltage: 8.0 };
        let script = excite(&wheels, &plan, 7);
        assert_eq!(script.len(), 1200);
        assert!(script[..60].iter().chain(&script[1100..]).all(|u| *u == [0.0; 3]));
        assert!(script.iter().flatten().all(|u| u.abs() <= 8.0 + 1e-12));
        assert_eq!(script, excite(&wheels, &plan, 7));
        assert_ne!(script, excite(&wheels, &plan, 8));
    }
}
