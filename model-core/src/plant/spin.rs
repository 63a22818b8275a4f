//! Spin: a wheel with inertia that creeps or slips, over a step.
//!
//! ```text
//! J·dω/dt = g(ω) = τ(ω) − r·f(r·ω − v_j)
//!
//! J·(ω₁ − ω₀)/Δt = γ·g(ω₁)                               γ = 1 − ½·√2
//! J·(ω₂ − ω₀)/Δt = (1 − γ)·g(ω₁) + γ·g(ω₂)
//! f̄ = (1 − γ)·f(ω₁) + γ·f(ω₂)
//! ```
//!
//! The implicit rule of two stages by R. Alexander (SIAM Journal on Numerical Analysis 14, 1977, page 1006): second order
//! in Δt; a wheel that hardly weighs anything ends where one without inertia would be at once. Each stage is a crossing
//! (`traction.rs`) over γ·Δt, the second of a wheel that was at ω₀ + (1 + √2)·(ω₁ − ω₀).
//!
//! The floor passes by at v_j throughout. That the body gains speed meanwhile is accounted for afterwards: in the force by
//! its rate, as everywhere (`body.rs`), in the wheel's speed by how it follows the rim's.

use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use super::state::State;
use super::traction::{Crossing, Floor, Line, cross};
use crate::effects::seams::Contact;
use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;

/// γ, the share of the step that each stage is implicit over.
const STAGE: f64 = 1.0 - FRAC_1_SQRT_2;
/// 1/γ
const PER_STAGE: f64 = 2.0 + SQRT_2;
/// (1 − γ)/γ, how far the second stage begins along the way of the first
const ONWARD: f64 = 1.0 + SQRT_2;

/// A wheel's step.
pub(super) struct Spun<T> {
    /// Mean force and its rate; the speed is that at the step's end
    pub met: Crossing<T>,
    /// ∂ω₂/∂v_j, by how much the wheel's speed at the step's end follows the speed of its rim [rad/m]
    pub follows: T,
}

/// Takes the step; the line has J/Δt for its inertia, which is not zero.
#[inline]
pub(super) fn spin<T: Real>(line: &Line<&T>, floor: &Floor<T>) -> Spun<T> {
    let [stage, onward] = [STAGE, ONWARD].map(T::lit);
    let inertia = *line.inertia * T::lit(PER_STAGE);
    let part = Line { inertia: &inertia, ..*line };
    let first = cross(&part, floor);
    let before = *line.before + (first.speed - *line.before) * onward;
    let second = cross(&Line { before: &before, ..part }, floor);

    // of a stage: k = −∂f/∂v = f′·a/(a + r²·f′),  ∂ω/∂v = r·k/a,  ∂f/∂ω₀ = (J/γΔt)·∂ω/∂v,  ∂ω/∂ω₀ = (J/γΔt)·(1 − r·∂ω/∂v)/a
    let per_fall = T::one() / (*line.fall + inertia);
    let by_rim = |met: &Crossing<T>| *line.radius * met.rate * per_fall;
    let begins = by_rim(&first) * onward;
    let own = by_rim(&second);
    let mean = |first: T, second: T| first + (second - first) * stage;
    Spun {
        met: Crossing {
            force: mean(first.force, second.force),
            rate: mean(first.rate, second.rate - inertia * own * begins),
            speed: second.speed,
        },
        follows: own + inertia * per_fall * (T::one() - *line.radius * own) * begins,
    }
}

/// A wheel without inertia: it turns at once as fast as it then goes on to, and follows its rim's speed all the way.
///
/// ```text
/// ∂ω/∂v = r·k/a,  without a motor that gives way 1/r          k = −∂f/∂v,  a = −∂τ/∂ω
/// ```
///
/// What it follows by is told as of one that follows half the way, as [`follow`] takes it.
#[inline]
pub(super) fn at_once<T: Real>(line: &Line<&T>, floor: &Floor<T>) -> Spun<T> {
    let met = cross(line, floor);
    let by_rim = if *line.fall > T::zero() { *line.radius * met.rate / *line.fall } else { T::one() / *line.radius };
    Spun { met, follows: T::lit(2.0) * by_rim }
}

/// Has the speeds of wheels that slip at the step's end follow the body, which goes on to the twist `next`, and counts what they
/// slip by there.
pub(super) fn follow<const N: usize, T: Real>(
    state: &mut State<N, T>,
    contact: &[Contact<T>; N],
    follows: &[T; N],
    next: BodyTwist<T>,
) {
    for (j, (c, follows)) in contact.iter().zip(follows).enumerate() {
        if !follows.is_nothing() {
            let rim_speed = c.rim_speed(next);
            // the floor gains speed evenly over the step
            state.wheel_speed[j] += T::lit(0.5) * *follows * (rim_speed - c.rim_speed(state.twist));
            state.slip[j] = state.wheel_speed[j] - rim_speed * c.per_radius;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wheel of 30 mm whose motor drives with 0.2 N·m at rest, in a step.
    #[derive(Clone, Copy)]
    struct Case {
        /// By how much the torque falls with the speed [N·m·s]
        fall: f64,
        /// J/Δt [N·m·s]
        inertia: f64,
        before: f64,
        rim_speed: f64,
    }

    const RADIUS: f64 = 0.03;
    const TORQUE: f64 = 0.2;
    const FALL: f64 = 0.002;
    /// J [kg·m²]
    const INERTIA: f64 = 7e-5;

    impl Case {
        fn over(dt: f64) -> Self {
            Self { fall: FALL, inertia: INERTIA / dt, before: 40.0, rim_speed: 0.7 }
        }

        fn line(&self) -> Line<&f64> {
            let Self { fall, inertia, before, rim_speed } = self;
            Line { torque: &TORQUE, speed: &0.0, fall, inertia, before, radius: &RADIUS, rim_speed }
        }
    }

    /// The speed after so many steps, and the mean force.
    fn after(floor: &Floor<f64>, time: f64, steps: u32) -> (f64, f64) {
        let mut now = Case::over(time / f64::from(steps));
        let mut force = 0.0;
        for _ in 0..steps {
            let Spun { met, .. } = spin(&now.line(), floor);
            now.before = met.speed;
            force += met.force / f64::from(steps);
        }
        (now.before, force)
    }

    fn creep() -> Floor<f64> {
        Floor::of(&Contact { creep: 0.02, shape: 1.0, ..Contact::default() })
    }

    fn slip(shape: f64) -> Floor<f64> {
        Floor::of(&Contact { grip: 0.4, load: 9.0, stiffness: 20.0, shape, ..Contact::default() })
    }

    #[test]
    fn the_error_falls_with_the_square_of_the_step() {
        for floor in [creep(), slip(1.0), slip(1.3)] {
            let (speed, force) = after(&floor, 4e-3, 4096);
            let errors = [8, 16, 32].map(|steps| {
                let (found, mean) = after(&floor, 4e-3, steps);
                [(found - speed).abs(), (mean - force).abs()]
            });
            for pair in errors.windows(2) {
                for (coarse, fine) in pair[0].into_iter().zip(pair[1]) {
                    let ratio = coarse / fine;
                    assert!((2.8..6.0).contains(&ratio), "{floor:?}: {errors:?}");
                }
            }
        }
    }

    #[test]
    fn a_wheel_that_creeps_goes_to_its_speed_as_an_exponential() {
        // J·dω/dt = τ₀ − a·ω − r·(r·ω − v)/c
        let time = 2e-3;
        let case = Case::over(time);
        let fall = FALL + RADIUS * RADIUS / 0.02;
        let settles = (TORQUE + RADIUS * case.rim_speed / 0.02) / fall;
        let exact = settles + (case.before - settles) * libm::exp(-time * fall / INERTIA);
        let (found, _) = after(&creep(), time, 1000);
        assert!((found - exact).abs() < 1e-4, "{found} {exact}");
    }

    #[test]
    fn what_the_wheel_gains_is_what_motor_and_floor_leave_it() {
        // J·(ω₂ − ω₀) = Δt·(τ̄ − r·f̄); the motor here gives the same at any speed
        let dt = 1e-3;
        let case = Case { fall: 0.0, ..Case::over(dt) };
        let Spun { met, .. } = spin(&case.line(), &slip(1.0));
        let (gained, left) = (INERTIA * (met.speed - case.before), dt * (TORQUE - RADIUS * met.force));
        assert!((gained - left).abs() < 1e-9 * left.abs(), "{gained} {left}");
    }

    #[test]
    fn a_wheel_that_hardly_weighs_anything_ends_where_one_without_inertia_does() {
        let floor = slip(1.0);
        let weighs = |inertia: f64| Case { inertia, ..Case::over(1e-3) };
        let Spun { met, .. } = spin(&weighs(1e-9).line(), &floor);
        let at_once = cross(&weighs(0.0).line(), &floor);
        for (a, b) in [(met.force, at_once.force), (met.rate, at_once.rate), (met.speed, at_once.speed)] {
            assert!((a - b).abs() < 1e-5 * b.abs(), "{a} {b}");
        }
    }

    #[test]
    fn a_wheel_without_inertia_follows_its_rim_by_the_difference_over_its_speed() {
        let gives_way = [creep(), slip(1.0), slip(1.3)].map(|floor| (FALL, floor));
        // a motor of any speed holds its torque: the wheel keeps its slip
        for (fall, floor) in gives_way.into_iter().chain([(0.0, creep())]) {
            let at =
                |rim_speed: f64| at_once(&Case { fall, inertia: 0.0, rim_speed, ..Case::over(1e-3) }.line(), &floor);
            let (low, here, high) = (at(0.7 - 1e-5), at(0.7), at(0.7 + 1e-5));
            // of what it follows by half is taken
            let follows = 2.0 * (high.met.speed - low.met.speed) / 2e-5;
            assert!((here.follows - follows).abs() < 1e-4 * follows.abs(), "{floor:?}: {} {follows}", here.follows);
        }
    }

    #[test]
    fn rate_and_following_are_the_differences_over_the_speed_of_the_rim() {
        for floor in [creep(), slip(1.0), slip(1.3)] {
            for before in [20.0, 24.0, 40.0] {
                let at = |rim_speed: f64| spin(&Case { before, rim_speed, ..Case::over(1e-3) }.line(), &floor);
                let (low, here, high) = (at(0.7 - 1e-5), at(0.7), at(0.7 + 1e-5));
                let rate = (low.met.force - high.met.force) / 2e-5;
                let follows = (high.met.speed - low.met.speed) / 2e-5;
                assert!((here.met.rate - rate).abs() < 1e-2 * rate.abs().max(1.0), "{} {rate}", here.met.rate);
                assert!((here.follows - follows).abs() < 1e-2 * follows.abs().max(1.0), "{} {follows}", here.follows);
            }
        }
    }
}
