//! # Cogging: the magnets hold on to the teeth
//!
//! ```text
//! τ = τ_c·cos(N·l·θ) + τ_s·sin(N·l·θ)
//! ```
//!
//! The magnets of a rotor pull at the iron teeth of the stator, most where a tooth is just before them. So a motor without
//! any current snaps from one place to the next, and one that turns feels a ripple. No current makes the torque and none
//! shows it; it does no work from one place to the next one like it.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  --------------------------------------------------------------------------
//! τ_c     `cosine`       N·m   torque at the wheel shaft where the rotor stood at the start of the run
//! τ_s     `sine`         N·m   the same, a quarter of a period later
//! N       `order`        1     periods in a turn of the rotor: the least common multiple of slots and poles
//! l       `gear_ratio`   1     motor speed over wheel speed
//! θ       `rotor_angle`  rad   angle of the rotor since the start of the run, counted at the wheel shaft
//!
//! It acts on the rotor, before the gear and any shaft that yields, and through its angle. Its size is counted at the wheel
//! shaft as that of all friction: l times the torque that one reads at the motor. τ_c and τ_s say how far from a detent the
//! rotor stood at the start: they hold for one run, and for another only if the rotor starts at the same angle.
//!
//! A step takes the mean of the torque over the way that the rotor goes in it. So a step gives no more than the work between
//! its two angles, and at speeds where a tooth passes within a step the ripple evens out as it does in the motor.
//!
//! Fails when: several harmonics matter, as with skewed or uneven magnets; when the iron's hysteresis holds too, which is
//! dry friction of the wheel.
//! How to measure it: bridge open and robot lifted, turn the wheel slowly with a torque wrench or a lever and a spring
//! scale, and count the detents in a turn.
//! Source: Cogging torque and its order, the least common multiple of slots and poles: Zhu, Howe, Influence of design
//! parameters on cogging torque in permanent magnet machines, IEEE Transactions on Energy Conversion 15, 2000; sizes:
//! estimated, 1 to 10 % of the rated torque of small brushless motors with slots.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::ripple::mean_wave;
use crate::effects::seams::{EffectContext, Winding};
use crate::effects::shows::{Channel, Order, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "cogging",
    title: "Cogging of one motor",
    summary: "The magnets of one motor hold on to the teeth of its iron, so that it turns from detent to detent.",
    equation: "τ = τ_c·cos(N·l·θ) + τ_s·sin(N·l·θ)",
    source: "cogging torque and its order, the least common multiple of slots and poles: Zhu, Howe, Influence of design parameters on cogging torque in permanent magnet machines, IEEE Transactions on Energy Conversion 15, 2000; sizes: estimated, 1 to 10 % of the rated torque of small brushless motors with slots",
    seams: &[Seam::Winding],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "cosine_Nm",
            symbol: "τ_c",
            unit: "N·m",
            absent: 0.0,
            typical: 0.008,
            within: (-1.0, 1.0),
            role: Role::Size,
        },
        Param {
            key: "sine_Nm",
            symbol: "τ_s",
            unit: "N·m",
            absent: 0.0,
            typical: 0.006,
            within: (-1.0, 1.0),
            role: Role::Size,
        },
        Param {
            key: "order",
            symbol: "N",
            unit: "1",
            absent: 84.0,
            typical: 84.0,
            within: (2.0, 400.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Creeping,
        parity: Parity::Neither,
        order: Some(Order::OfRotor(2)),
    },
    signature: "one wheel ripples many times in a turn, and stops in detents; a fast turn evens the ripple out",
    look_alikes: &[LookAlike {
        with: "roller_ripple",
        settled_by: "turn the wheel slowly by hand with the robot lifted: cogging is felt there too, rollers are not",
    }],
    code: 37,
    undone: Undone::No("the robot does not know at which angle of the rotor it was switched on"),
    physics: Physics {
        // it lends energy between two detents: a rotor that rests on top of one falls into the next
        passive: false,
        mirrored: &[0],
        ..Physics::PASSIVE
    },
};

/// Mean torque over a way of the rotor that begins at an angle [rad] and is `turned` long [rad], both at the motor [N·m].
#[inline]
pub fn mean_torque<T: Real>(parts: [T; 2], order: T, from: T, turned: T) -> T {
    // τ = τ_c·cos(N·θ_m) + τ_s·sin(N·θ_m), θ_m = l·θ
    mean_wave(parts, order, from, turned)
}

/// Cogging of one motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cogging<T> {
    /// τ_c, torque at the wheel shaft where the rotor stood at the start [N·m]
    pub cosine: T,
    /// τ_s, the same, a quarter of a period later [N·m]
    pub sine: T,
    /// N, periods in a turn of the rotor [1]
    pub order: T,
}

impl<T: Copy> Catalogued<T> for Cogging<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[cosine, sine, order] = params else { return None };
        Some(Self { cosine, sine, order })
    }
}

impl<T: Real> Hooks<T> for Cogging<T> {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn winding(&self, _: &(), at: &EffectContext<T>, x: &mut Winding<T>) {
        let (from, turned) = (at.gear_ratio * at.rotor_angle, at.gear_ratio * at.rotor_speed * at.dt);
        // 0 − a, taken away: a torque that is absent then keeps even the sign of a zero
        x.torque -= T::zero() - mean_torque([self.cosine, self.sine], self.order, from, turned);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    fn at(rotor_angle: f64, rotor_speed: f64) -> EffectContext<f64> {
        EffectContext { dt: 1e-3, rotor_angle, rotor_speed, gear_ratio: 5.0, ..EffectContext::default() }
    }

    fn torque(params: [f64; 3], at: EffectContext<f64>, already: f64) -> f64 {
        let mut x = Winding { torque: already, ..Winding::default() };
        Cogging::of(&params).expect("as many as on the card").winding(&(), &at, &mut x);
        x.torque
    }

    #[test]
    fn without_it_the_torque_is_left_bit_for_bit() {
        for already in [0.0, -0.0, 0.01] {
            for [cosine, sine] in [[0.0, 0.0], [-0.0, 0.0]] {
                for order in [2.0, 84.0] {
                    assert_eq!(torque([cosine, sine, order], at(0.31, 2.0), already).to_bits(), already.to_bits());
                }
            }
        }
    }

    #[test]
    fn at_rest_it_is_what_the_angle_says() {
        assert_eq!(torque([0.008, 0.006, 84.0], at(0.0, 0.0), 0.0), 0.008);
        // a quarter of a period at the motor is a fifth of that at the wheel
        let quarter = TAU / (4.0 * 84.0 * 5.0);
        assert!((torque([0.008, 0.006, 84.0], at(quarter, 0.0), 0.0) - 0.006).abs() < 1e-15);
        assert!((torque([0.008, 0.006, 84.0], at(2.0 * quarter, 0.0), 0.0) + 0.008).abs() < 1e-15);
    }

    #[test]
    fn the_work_of_a_step_is_the_difference_of_its_potential() {
        // V = −(τ_c·sin(N·l·θ) − τ_s·cos(N·l·θ))/(N·l)
        let potential = |angle: f64| {
            let (sin, cos) = libm::sincos(84.0 * 5.0 * angle);
            -(0.008 * sin - 0.006 * cos) / (84.0 * 5.0)
        };
        for rotor_speed in [1e-9, 0.4, -3.0, 40.0, -170.0] {
            let at = at(0.31, rotor_speed);
            let way = rotor_speed * at.dt;
            let work = torque([0.008, 0.006, 84.0], at, 0.0) * way;
            let fallen = potential(at.rotor_angle) - potential(at.rotor_angle + way);
            // a rounding of angles of 130 rad, times 2e-5 J
            assert!((work - fallen).abs() < 1e-18, "{rotor_speed}: {work:e} against {fallen:e}");
        }
    }

    #[test]
    fn a_round_trip_gives_nothing() {
        let mut work = 0.0;
        let (mut angle, steps) = (0.0, 977);
        for k in 0..2 * steps {
            let rotor_speed = if k < steps { 7.0 } else { -7.0 };
            let at = at(angle, rotor_speed);
            work += torque([0.008, 0.006, 84.0], at, 0.0) * rotor_speed * at.dt;
            angle += rotor_speed * at.dt;
        }
        // 2000 roundings of 6e-5 J
        assert!(work.abs() < 1e-15, "{work:e}");
    }

    #[test]
    fn teeth_that_pass_within_a_step_even_out() {
        // 20 periods and more in a step: sin x/x is below 1/(20·π)
        let speed = 1.01 * 20.0 * TAU / (84.0 * 5.0) / 1e-3;
        assert!(torque([0.008, 0.006, 84.0], at(0.31, speed), 0.0).abs() < 0.01 / 60.0);
    }
}
