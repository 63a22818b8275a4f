//! # Load transfer: who accelerates presses on some wheels more
//!
//! ```text
//! N_j → N_j·(1 + h·a·q_j)        q_j = −S⁻¹·(p_j − p̄)/(g·s_j),  S = Σ (p_j − p̄)·(p_j − p̄)ᵀ
//! ```
//!
//! The floor pushes at the wheels' feet and the mass sits above them. A robot that gains speed leans back: the wheels behind
//! carry more, those in front less, and what a wheel carries is what it can push with. The law follows from the balance of
//! moments, Σ ΔN_j·p_j = −M·h·a with Σ ΔN_j = 0; among all loads that balance it is the one of least squares, which is that
//! of wheels on equal springs. Of n wheels at equal angles and distances d, q_j = −2·p_j/(g·d²).
//!
//! symbol  code            unit          meaning
//! ------  --------------  ------------  ------------------------------------------------------------------
//! h       `height`        m             height of the centre of mass over the floor
//! N_j     `load`          N             what wheel j carries at rest, M·g·s_j
//! s_j     –               1             its share of the weight
//! a       `acceleration`  m/s²          acceleration of the robot's centre, along its axes
//! p_j     `position`      m             where wheel j touches the floor; p̄ is the mean of all
//! q_j     `load_shift`    1/(m·m/s²)    by how much its load grows, over itself
//!
//! It needs a floor that holds only so much: beside [`wheel_slip`](super::wheel_slip) alone does a load matter. The
//! acceleration is that of the last step. A wheel never pulls at the floor: one that is lifted carries nothing, and the one
//! behind no more than twice its share.
//!
//! Fails when: a wheel lifts off, as the others then carry it; when the chassis bends.
//! How to measure it: hang the robot at two points and mark the plumb lines: where they cross is the centre of mass.
//! Source: Balance of moments: Gillespie, Fundamentals of Vehicle Dynamics, 1992, ch. 1; sizes: estimated, a third of the
//! height of robots of 10 to 25 cm.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "load_transfer",
    title: "Load transfer",
    summary: "A robot that accelerates presses more on the wheels behind, so that those in front slip first.",
    equation: "N_j → N_j·(1 + h·a·q_j),  q_j = −S⁻¹·(p_j − p̄)/(g·s_j),  S = Σ (p_j − p̄)·(p_j − p̄)ᵀ",
    source: "balance of moments: Gillespie, Fundamentals of Vehicle Dynamics, 1992, ch. 1; sizes: estimated, a third of the height of robots of 10 to 25 cm",
    seams: &[Seam::Contact],
    scope: Scope::Robot,
    params: &[Param {
        key: "height_m",
        symbol: "h",
        unit: "m",
        absent: 0.0,
        typical: 0.05,
        within: (0.0, 0.3),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Acceleration, parity: Parity::Even, order: None },
    signature: "slip begins at the wheels in front while the robot gains speed and at those behind while it brakes",
    look_alikes: &[LookAlike {
        with: "uneven_load",
        settled_by: "drive with the same acceleration forwards and backwards: an uneven wheel slips both times, a load that is shifted makes others slip",
    }],
    code: 51,
    undone: Undone::No("no current makes the floor hold more; lower the largest acceleration"),
    physics: Physics { shows_beside: Some("wheel_slip"), ..Physics::PASSIVE },
};

/// What a wheel whose load shifts by so much [1/(m·m/s²)] carries more at an acceleration (v, vn) [m/s²], over what it carries
/// at rest [1].
#[inline]
pub fn shifted<T: Real>(height: T, acceleration: [T; 2], load_shift: [T; 2]) -> T {
    // h·a·q_j, and no more than all: there the robot begins to tip over
    let more = height * (acceleration[0] * load_shift[0] + acceleration[1] * load_shift[1]);
    more.clamp(-T::one(), T::one())
}

/// Load transfer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadTransfer<T> {
    /// h, height of the centre of mass over the floor [m]
    pub height: T,
}

impl<T: Copy> Catalogued<T> for LoadTransfer<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[height] = params else { return None };
        Some(Self { height })
    }
}

impl<T: Real> Hooks<T> for LoadTransfer<T> {
    type State = ();
    const NEEDS: Needs = Needs { acceleration: true, ..Needs::NOTHING };

    fn contact(&self, _: &(), at: &EffectContext<T>, x: &mut Contact<T>) {
        let [along, across, _] = at.acceleration;
        let more = shifted(self.height, [along, across], x.load_shift);
        x.load += x.load * more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::seams::STANDARD_GRAVITY;

    const REACH: f64 = 0.09;

    fn load(height: f64, acceleration: [f64; 3], angle: f64) -> f64 {
        let at = EffectContext { acceleration, ..EffectContext::default() };
        let (sin, cos) = angle.sin_cos();
        // −2·p_j/(g·d²)
        let load_shift = [cos, sin].map(|x| -2.0 * x / (STANDARD_GRAVITY * REACH));
        let mut x = Contact { load: 5.7, load_shift, ..Contact::default() };
        LoadTransfer { height }.contact(&(), &at, &mut x);
        x.load
    }

    #[test]
    fn at_no_height_and_at_no_acceleration_the_load_is_left_bit_for_bit() {
        assert_eq!(load(0.0, [3.0, -8.0, 40.0], 1.0).to_bits(), 5.7_f64.to_bits());
        assert_eq!(load(0.05, [0.0, 0.0, 40.0], 1.0).to_bits(), 5.7_f64.to_bits());
    }

    #[test]
    fn moments_balance_and_the_weight_stays() {
        for wheels in [3, 4] {
            let angles = (0..wheels).map(|j| 0.4 + core::f64::consts::TAU * f64::from(j) / f64::from(wheels));
            let (mass, [a, b], height) = (5.7 * f64::from(wheels) / STANDARD_GRAVITY, [1.5, -2.5], 0.04);
            let (mut weight, mut moment) = (0.0, [0.0; 2]);
            for angle in angles {
                let (sin, cos) = angle.sin_cos();
                let carried = load(height, [a, b, 0.0], angle);
                weight += carried;
                moment = [moment[0] + carried * REACH * cos, moment[1] + carried * REACH * sin];
            }
            assert!((weight - 5.7 * f64::from(wheels)).abs() < 1e-12);
            // Σ N_j·p_j = −M·h·a
            assert!((moment[0] + mass * height * a).abs() < 1e-12, "{moment:?}");
            assert!((moment[1] + mass * height * b).abs() < 1e-12, "{moment:?}");
        }
    }

    #[test]
    fn a_wheel_that_is_lifted_carries_nothing() {
        assert_eq!(load(0.3, [20.0, 0.0, 0.0], 0.0), 0.0);
        assert_eq!(load(0.3, [-20.0, 0.0, 0.0], 0.0), 2.0 * 5.7);
    }
}
