//! # Friction that warms up: a cold robot turns harder
//!
//! ```text
//! τ_C → τ_C · (1 + k · exp(−t / T))
//! ```
//!
//! Grease is stiff when it is cold, and seals are hard. Friction warms it, works it out of the way of the balls, and falls:
//! a robot that has been switched on needs more current in its first minute than in its second. The excess is counted on
//! each wheel's share of the body's Coulomb friction, adds to the friction budget, and fades with the time since the start
//! of the run. Every run is taken to begin cold.
//!
//! symbol  code             unit  meaning
//! ------  ---------------  ----  ----------------------------------------------
//! k       `cold_excess`    1     friction at the start over that later, minus one
//! T       `time_constant`  s     time after which 1/e of the excess is left
//! t       `time`           s     time since the start of the run
//! τ_C     `coulomb_share`  N·m   this wheel's share of the Coulomb friction
//!
//! A run much shorter than T shows the excess and not how it fades: there it is Coulomb friction and k and T cannot be told
//! apart. The clock starts with every run: one that begins warm, after a short break, has no excess, and the law gives it one.
//!
//! Fails when: the room warms or cools the robot; when the speed changes much, for the work of friction is what warms it.
//! How to measure it: let the robot stand for an hour, then drive the same slow circle for ten minutes and look at how the
//! current falls.
//! Source: Friction of a robot joint that falls as it warms up: Bittencourt, Gunnarsson, Static friction in a robot joint:
//! modeling and identification of load and temperature effects, Journal of Dynamic Systems, Measurement, and Control 134,
//! 2012; one exponential for it and the sizes: estimated, 10 to 50 % over half a minute to some minutes for small greased
//! gears.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Gear};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "friction_warmup",
    title: "Friction that warms up",
    summary: "A cold robot turns harder, and its friction falls over the first minutes.",
    equation: "τ_C → τ_C · (1 + k · exp(−t / T))",
    source: "friction of a robot joint that falls as it warms up: Bittencourt, Gunnarsson, Static friction in a robot joint: modeling and identification of load and temperature effects, Journal of Dynamic Systems, Measurement, and Control 134, 2012; one exponential for it and the sizes: estimated, 10 to 50 % over half a minute to some minutes for small greased gears",
    seams: &[Seam::Gear],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "cold_excess",
            symbol: "k",
            unit: "1",
            absent: 0.0,
            typical: 0.3,
            within: (0.0, 3.0),
            role: Role::Size,
        },
        Param {
            key: "time_constant_s",
            symbol: "T",
            unit: "s",
            absent: 60.0,
            typical: 60.0,
            within: (5.0, 1000.0),
            role: Role::Shape,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Motion,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque short at the start of a run and less so later",
    look_alikes: &[LookAlike {
        with: "coulomb_friction",
        settled_by: "drive the same slow circle for ten minutes: friction of the body stays, what warms up falls",
    }],
    code: 36,
    undone: Undone::No("the robot's turn does not know how long ago it was cold"),
    physics: Physics { ages: true, ..Physics::DRY_AT_WHEELS },
};

/// The share of the cold excess that is left after a time [s].
#[inline]
pub fn left<T: Real>(time_constant: T, time: T) -> T {
    // exp(−t / T)
    (-(time / time_constant)).exp()
}

/// Friction that warms up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionWarmup<T> {
    /// k, friction at the start over that later, minus one [1]
    pub cold_excess: T,
    /// T, time after which 1/e of the excess is left [s]
    pub time_constant: T,
}

impl<T: Copy> Catalogued<T> for FrictionWarmup<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[cold_excess, time_constant] = params else { return None };
        Some(Self { cold_excess, time_constant })
    }
}

impl<T: Real> Hooks<T> for FrictionWarmup<T> {
    type State = ();

    fn gear(&self, _: &(), at: &EffectContext<T>, x: &mut Gear<T>) {
        // the middle of the step stands for the whole of it
        let time = at.time + T::lit(0.5) * at.dt;
        x.budget += x.coulomb_share * self.cold_excess * left(self.time_constant, time);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget(cold_excess: f64, time_constant: f64, time: f64) -> f64 {
        let at = EffectContext { time, ..EffectContext::default() };
        let mut x = Gear { coulomb_share: 0.02, budget: 0.013, ..Gear::default() };
        FrictionWarmup { cold_excess, time_constant }.gear(&(), &at, &mut x);
        x.budget
    }

    #[test]
    fn without_excess_the_budget_is_left_bit_for_bit() {
        for time in [0.0, 3.0, 1e6] {
            for time_constant in [5.0, 60.0, 1000.0] {
                assert_eq!(budget(0.0, time_constant, time).to_bits(), 0.013_f64.to_bits());
            }
        }
    }

    #[test]
    fn the_whole_excess_at_the_start_and_none_in_the_end() {
        assert!((budget(0.3, 60.0, 0.0) - 0.019).abs() < 1e-15);
        assert_eq!(budget(0.3, 60.0, 1e6), 0.013);
        // 1/e of it after a time constant
        assert!((budget(0.3, 60.0, 60.0) - 0.013 - 0.006 * libm::exp(-1.0)).abs() < 1e-15);
    }

    #[test]
    fn it_falls_all_the_time_and_is_always_friction() {
        let mut last = f64::MAX;
        for k in 0..200 {
            let now = budget(0.5, 20.0, f64::from(k));
            assert!(now < last && now >= 0.013);
            last = now;
        }
    }

    #[test]
    fn a_step_has_the_excess_of_its_middle() {
        let at = EffectContext { time: 7.0, dt: 2.0, ..EffectContext::default() };
        let mut x = Gear { coulomb_share: 1.0, ..Gear::default() };
        FrictionWarmup { cold_excess: 1.0, time_constant: 20.0 }.gear(&(), &at, &mut x);
        assert_eq!(x.budget, left(20.0, 8.0));
    }
}
