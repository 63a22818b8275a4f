//! # Torque saturation: at high current an ampere more gives less torque
//!
//! ```text
//! K_t → K_t/√(1 + 2·k·i²)
//! ```
//!
//! The flux of the current runs through the iron of the stator, which takes only so much of it. At small currents the share
//! of torque that is lost is k·i²; at large ones the torque comes near a limit, K_t/√(2·k), and never falls again, as iron
//! that is full stays full. The straight law K_t·(1 − k·i²) would turn the torque round at 1/√k. The magnets alone make the
//! back-EMF at no load, so K_v stays.
//!
//! symbol  code          unit  meaning
//! ------  ------------  ----  ------------------------------------------------------
//! k       `saturation`  1/A²  share of the torque that is lost, over the square of a small current
//! i       `current`     A     motor current
//!
//! Fails when: the teeth are full of the magnets' own flux already: then a current one way loses more than the other way.
//! How to measure it: hold a wheel with a spring balance on a lever and read the force at some currents, up to the largest;
//! the iron fills at once, so a second will do, before the winding warms up.
//! Source: Magnetisation curves by simple algebraic functions: Fischer, Moser, Archiv für Elektrotechnik 42, 1956; torque
//! of saturated motors: Hendershot, Miller, Design of Brushless Permanent-Magnet Machines, 2010; sizes: estimated, 2 to 20 %
//! at the largest current.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, Winding};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::Place;
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "torque_saturation",
    title: "Saturation of the torque",
    summary: "At high current the iron of a motor is full, and every ampere more gives less torque.",
    equation: "K_t → K_t/√(1 + 2·k·i²)",
    source: "magnetisation curves by simple algebraic functions: Fischer, Moser, Archiv für Elektrotechnik 42, 1956; torque of saturated motors: Hendershot, Miller, Design of Brushless Permanent-Magnet Machines, 2010; sizes: estimated, 2 to 20 % at the largest current",
    seams: &[Seam::Winding],
    scope: Scope::Wheels,
    params: &[Param {
        key: "saturation_per_A2",
        symbol: "k",
        unit: "1/A²",
        absent: 0.0,
        typical: 0.015,
        within: (0.0, 0.3),
        role: Role::Size,
    }],
    needs_current: true,
    shows: Shows {
        channels: &[Channel::YawRate, Channel::WheelSpeed],
        regime: Regime::Current,
        parity: Parity::Odd,
        order: None,
    },
    signature: "torque short in step with the square of the current, and right at small ones",
    look_alikes: &[LookAlike {
        with: "torque_constant",
        settled_by: "hold a wheel with a spring balance at a small and at a large current: a wrong constant is wrong by the same share at both, saturation only at the large one",
    }],
    code: 31,
    undone: Undone::By(
        "the current is raised to c/√(1 − 2·k·c²), c being the one that would do without saturation; to four times as much at the most",
    ),
    physics: Physics::PASSIVE,
};

/// What is left of the torque constant at a current [1], and by how much that changes with the current [1/A].
#[inline]
pub fn left<T: Real>(saturation: T, current: T) -> (T, T) {
    let one = T::one();
    let twice = saturation + saturation;
    let square = one + twice * current * current;
    // 1/√(1 + 2·k·i²),  its slope −2·k·i/(1 + 2·k·i²)^(3/2)
    let left = one / square.sqrt();
    (left, T::zero() - twice * current * left / square)
}

/// Saturation of the torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueSaturation<T> {
    /// k, share of the torque that is lost over the square of a small current [1/A²]
    pub saturation: T,
}

impl<T: Copy> Catalogued<T> for TorqueSaturation<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[saturation] = params else { return None };
        Some(Self { saturation })
    }
}

impl<T: Real> Hooks<T> for TorqueSaturation<T> {
    type State = ();
    const UNDONE_AT: Option<Place> = Some(Place::Winding);

    fn winding(&self, _: &(), _: &EffectContext<T>, x: &mut Winding<T>) {
        let (left, slope) = left(self.saturation, x.current);
        // ∂(K_t·left)/∂i
        x.torque_bend = x.torque_bend * left + x.torque_constant * slope;
        x.torque_constant *= left;
    }

    fn undo_winding(&self, current: T, ratio: &mut T) {
        // c = i/√(1 + 2·k·i²), turned round: i = c/√(1 − 2·k·c²)
        let room = T::one() - (self.saturation + self.saturation) * current * current;
        *ratio = *ratio / room.max(T::lit(1.0 / 16.0)).sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    fn wound<T: Real>(saturation: T, current: T) -> Winding<T> {
        let mut x =
            Winding { current, torque_constant: T::lit(0.1297), emf_constant: T::lit(0.1295), ..Winding::default() };
        TorqueSaturation { saturation }.winding(&(), &EffectContext::default(), &mut x);
        x
    }

    fn torque(saturation: f64, current: f64) -> f64 {
        wound(saturation, current).torque_constant * current
    }

    #[test]
    fn iron_that_never_fills_leaves_the_winding_bit_for_bit() {
        for current in [0.0, -0.0, 0.3, -12.0] {
            let x = wound(0.0, current);
            assert_eq!([x.torque_constant, x.emf_constant].map(f64::to_bits), [0.1297, 0.1295].map(f64::to_bits));
            assert_eq!(x.torque_bend.to_bits(), 0.0_f64.to_bits());
        }
    }

    #[test]
    fn at_small_current_the_share_lost_is_in_step_with_the_square() {
        for current in [0.05, -0.1, 0.2] {
            let lost = 1.0 - torque(0.015, current) / (0.1297 * current);
            // the next term: 3/2·k²·i⁴
            let next = 1.5 * (0.015 * current * current) * (0.015 * current * current);
            assert!((lost - 0.015 * current * current).abs() < 1.01 * next + 1e-15, "{lost}");
        }
    }

    #[test]
    fn the_torque_always_rises_and_comes_near_its_limit() {
        let limit = 0.1297 / Real::sqrt(2.0 * 0.3_f64);
        let mut last = 0.0;
        for k in 1..2000 {
            let here = torque(0.3, f64::from(k) * 0.05);
            assert!(here > last && here < limit);
            assert_eq!(here, -torque(0.3, f64::from(k) * -0.05));
            last = here;
        }
        assert!(last > 0.9998 * limit, "{last} of {limit}");
    }

    #[test]
    fn the_bend_is_the_change_of_the_torque_constant() {
        for current in [-9.0, -0.4, 0.0, 1.3, 20.0] {
            let h = 1e-6;
            let difference =
                (wound(0.05, current + h).torque_constant - wound(0.05, current - h).torque_constant) / (2.0 * h);
            assert!((wound(0.05, current).torque_bend - difference).abs() < 1e-9, "{current} A");
        }
    }

    #[test]
    fn from_nothing_on_the_loss_grows_with_the_square_of_the_current() {
        let x = wound(Dual::<1>::variable(0.0, 0), Dual::constant(2.0));
        // ∂K_t/∂k = −K_t·i²
        assert!((x.torque_constant.eps[0] + 0.1297 * 4.0).abs() < 1e-15, "{x:?}");
    }
}
