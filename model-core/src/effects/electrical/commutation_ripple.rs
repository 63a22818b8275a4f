//! # Commutation ripple: the torque of an ampere changes as the rotor turns
//!
//! ```text
//! K_t → K_t·(1 + a_c·cos(n·θ_r) + a_s·sin(n·θ_r))        θ_r = l·θ
//! ```
//!
//! A brushless drive that switches its phases in six steps lets the current stand still while the rotor turns on by 60° of
//! the electrical angle. The torque falls towards both ends of each step: six times in an electrical turn. Of sinusoidal
//! back-EMF the first harmonic is 2/35 of the mean. A brushed motor does the same with its commutator's segments.
//!
//! symbol  code           unit  meaning
//! ------  -------------  ----  --------------------------------------------------------
//! a_c     `cosine_part`  1     ripple over the mean torque, in phase with the angle at the run's start
//! a_s     `sine_part`    1     the same, a quarter of a period later
//! n       `order`        1     ripples in a turn of the rotor: six times the pole pairs; 42 of seven
//! θ       `rotor_angle`  rad   angle of the rotor at the wheel shaft since the start of the run
//! l       `gear_ratio`   1     motor speed over wheel speed
//!
//! Every rotor starts at another angle, so the effect sits on one wheel, with two parts instead of size and phase. Over a
//! step the speed is taken as even and the mean of the ripple taken, which is less by sin(h)/h, h = ½·n·l·ω·Δt: a step that
//! is longer than a ripple sees none of it.
//!
//! Neglects: the same ripple of the back-EMF and what it does to the current, a_c·K_v·ω/R at the most; the current of this
//! model is a mean over ripples.
//! Fails when: the drive shapes its currents after the angle; when a run is so long that the angle is no longer known to a
//! hundredth of a turn of the rotor. It is seen at slow turns and in logs as fast as the ripple, and averages out else.
//! How to measure it: turn a wheel slowly at a constant current against a force gauge, and count the ripples in a turn.
//! Source: Jahns, Soong, Pulsating torque minimization techniques for permanent magnet AC motor drives, IEEE Transactions
//! on Industrial Electronics 43, 1996; sizes: Fourier series of a six-pulse wave, 2/35; estimated, 2 to 10 %.

use crate::effects::card::{Card, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::ripple::mean_wave;
use crate::effects::seams::{EffectContext, Winding};
use crate::effects::shows::{Channel, Order, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "commutation_ripple",
    title: "Ripple of the commutation",
    summary: "As its rotor turns, a motor gives now more and now less torque for the same current.",
    equation: "K_t → K_t·(1 + a_c·cos(n·l·θ) + a_s·sin(n·l·θ))",
    source: "Jahns, Soong, Pulsating torque minimization techniques for permanent magnet AC motor drives, IEEE Transactions on Industrial Electronics 43, 1996; sizes: Fourier series of a six-pulse wave, 2/35; estimated, 2 to 10 %",
    seams: &[Seam::Winding],
    scope: Scope::OneWheel,
    params: &[
        Param {
            key: "cosine_part",
            symbol: "a_c",
            unit: "1",
            absent: 0.0,
            typical: 0.04,
            within: (-0.3, 0.3),
            role: Role::Size,
        },
        Param {
            key: "sine_part",
            symbol: "a_s",
            unit: "1",
            absent: 0.0,
            typical: 0.03,
            within: (-0.3, 0.3),
            role: Role::Size,
        },
        Param {
            key: "order",
            symbol: "n",
            unit: "1",
            absent: 42.0,
            typical: 42.0,
            within: (1.0, 200.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Current,
        parity: Parity::Neither,
        order: Some(Order::OfRotor(2)),
    },
    signature: "torque of one wheel too large and too small in turn",
    look_alikes: &[],
    code: 32,
    undone: Undone::No("the controller does not follow the rotors' angles, and the ripple is faster than its turns"),
    // the angle counts the other way in a mirror
    physics: Physics { mirrored: &[1], ..Physics::PASSIVE },
};

/// Torque per current over its mean, itself the mean over a step [1].
#[inline]
pub fn rippled<T: Real>(of: &CommutationRipple<T>, at: &EffectContext<T>) -> T {
    let (from, turned) = (at.gear_ratio * at.rotor_angle, at.gear_ratio * at.rotor_speed * at.dt);
    // 1 + a_c·cos(n·θ_r) + a_s·sin(n·θ_r)
    T::one() + mean_wave([of.cosine_part, of.sine_part], of.order, from, turned)
}

/// Ripple of the commutation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommutationRipple<T> {
    /// a_c, in phase with the angle at the run's start [1]
    pub cosine_part: T,
    /// a_s, a quarter of a period later [1]
    pub sine_part: T,
    /// n, ripples in a turn of the rotor [1]
    pub order: T,
}

impl<T: Copy> Catalogued<T> for CommutationRipple<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[cosine_part, sine_part, order] = params else { return None };
        Some(Self { cosine_part, sine_part, order })
    }
}

impl<T: Real> Hooks<T> for CommutationRipple<T> {
    type State = ();
    const NEEDS: Needs = Needs { angle: true, ..Needs::NOTHING };

    fn winding(&self, _: &(), at: &EffectContext<T>, x: &mut Winding<T>) {
        let ripple = rippled(self, at);
        x.torque_constant *= ripple;
        x.torque_bend *= ripple;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    const TYPICAL: CommutationRipple<f64> = CommutationRipple { cosine_part: 0.04, sine_part: 0.03, order: 42.0 };

    fn at(rotor_angle: f64, rotor_speed: f64, dt: f64) -> EffectContext<f64> {
        EffectContext { rotor_angle, rotor_speed, dt, gear_ratio: 5.0, ..EffectContext::default() }
    }

    #[test]
    fn without_ripple_the_winding_is_left_bit_for_bit() {
        for (angle, speed) in [(0.0, 0.0), (-0.0, -3.0), (117.3, 40.0)] {
            let mut x = Winding { torque_constant: 0.1297, emf_constant: 0.1295, ..Winding::default() };
            let none = CommutationRipple { cosine_part: 0.0, sine_part: 0.0, ..TYPICAL };
            none.winding(&(), &at(angle, speed, 1e-3), &mut x);
            assert_eq!([x.torque_constant, x.emf_constant].map(f64::to_bits), [0.1297, 0.1295].map(f64::to_bits));
        }
    }

    #[test]
    fn at_standstill_it_is_largest_where_tan_is_one_part_over_the_other() {
        let angle = Real::atan2(0.03_f64, 0.04) / 210.0;
        assert!((rippled(&TYPICAL, &at(angle, 0.0, 1e-3)) - 1.05).abs() < 1e-15);
        assert!((rippled(&TYPICAL, &at(angle + PI / 210.0, 0.0, 1e-3)) - 0.95).abs() < 1e-14);
        assert_eq!(rippled(&TYPICAL, &at(0.0, 0.0, 1e-3)), 1.04);
    }

    #[test]
    fn over_a_turn_of_the_rotor_it_averages_out() {
        let n = 1000;
        let mean = (0..n).map(|k| rippled(&TYPICAL, &at(2.0 * PI / 5.0 * f64::from(k) / f64::from(n), 0.0, 1e-3)));
        assert!((mean.sum::<f64>() / f64::from(n) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn of_a_step_it_is_the_mean_however_long_the_step() {
        for (speed, dt) in [(0.1, 1e-3), (3.0, 1e-3), (40.0, 1e-3), (-17.0, 0.02), (1e-6, 1e-3)] {
            let n = 20_000;
            let instant = |k: i32| at(0.37 + speed * dt * (f64::from(k) + 0.5) / f64::from(n), 0.0, 0.0);
            let mean = (0..n).map(|k| rippled(&TYPICAL, &instant(k))).sum::<f64>() / f64::from(n);
            // the midpoint rule: 0.05·h²/6 with up to 71 rad in 20,000 parts
            assert!((rippled(&TYPICAL, &at(0.37, speed, dt)) - mean).abs() < 1e-7, "{speed} rad/s, {dt} s");
        }
    }

    #[test]
    fn within_its_bounds_it_never_turns_the_torque_round() {
        let most = CommutationRipple { cosine_part: 0.3, sine_part: -0.3, order: 42.0 };
        assert!((0..1000).all(|k| rippled(&most, &at(f64::from(k) * 1e-4, 0.0, 1e-3)) > 0.5));
    }
}
