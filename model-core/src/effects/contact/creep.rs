//! # Creep: a loaded contact gives way a little
//!
//! ```text
//! r·ω = cos α·v + sin α·vn + d·ω + c·f
//! ```
//!
//! Rubber stretches on its way through the contact patch, and carpet leans over. A wheel that pushes therefore turns a
//! little faster than it rolls, and one that brakes a little slower, in proportion to the force: from the smallest
//! forces on, long before anything slips.
//!
//! symbol  code        unit      meaning
//! ------  ----------  --------  -------------------------------
//! c       `creep`     (m/s)/N   slip speed over traction
//! f       `traction`  N         force of the wheel on the floor
//!
//! Fails when: the force nears the limit of grip; on real rubber creep also grows with speed.
//! How to measure it: pull the robot with a weight over a pulley at steady speed, and compare wheels with camera.
//! Source: Brush model at small slip: Pacejka, Tire and Vehicle Dynamics, 2012, ch. 3; sizes: estimated for rubber
//! rollers, 0.005 to 0.05 (m/s)/N.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::Place;
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "creep",
    title: "Creep of the contact",
    summary: "A wheel that pushes turns a little faster than it rolls, in proportion to the force.",
    equation: "r·ω = cos α·v + sin α·vn + d·ω + c·f",
    source: "brush model at small slip: Pacejka, Tire and Vehicle Dynamics, 2012, ch. 3; sizes: estimated for rubber rollers, 0.005 to 0.05 (m/s)/N",
    seams: &[Seam::Contact],
    scope: Scope::Wheels,
    params: &[Param {
        key: "creep_m_s_per_N",
        symbol: "c",
        unit: "(m/s)/N",
        absent: 0.0,
        typical: 0.02,
        within: (0.0, 0.2),
        role: Role::Size,
    }],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Current, parity: Parity::Odd, order: None },
    signature: "wheels lead the body while they drive it and trail it while they brake it, in proportion to the force",
    look_alikes: &[LookAlike {
        with: "wheel_slip",
        settled_by: "drive gently: creep stays at small forces, slip does not",
    }],
    code: 9,
    undone: Undone::By("the wheel turns faster than the floor passes by, by c·f/r"),
    physics: Physics { corner_at_absent: true, ..Physics::PASSIVE },
};

/// Speed of the rim over the floor [m/s].
#[inline]
pub fn slip<T: Real>(creep: T, traction: T) -> T {
    // s = c·f
    creep * traction
}

/// Creep of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creep<T> {
    /// c, slip speed over traction [(m/s)/N]
    pub creep: T,
}

impl<T: Copy> Catalogued<T> for Creep<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[creep] = params else { return None };
        Some(Self { creep })
    }
}

impl<T: Real> Hooks<T> for Creep<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;
    const UNDONE_AT: Option<Place> = Some(Place::Contact);

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        let Self { creep } = *self;
        x.creep += creep;
    }

    fn undo_contact(&self, traction: T, lead: &mut T) {
        *lead += slip(self.creep, traction);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::contact::wheel_slip::{CurveShape, traction};

    fn touched(creep: f64, already: f64) -> f64 {
        let mut x = Contact {
            row: [0.0, 1.0, 0.089],
            radius: 0.0325,
            per_radius: 1.0 / 0.0325,
            load: 5.7,
            creep: already,
            shape: 1.0,
            ..Contact::default()
        };
        Creep { creep }.contact(&(), &EffectContext::default(), &mut x);
        x.creep
    }

    #[test]
    fn without_creep_the_contact_is_left_bit_for_bit() {
        assert_eq!(touched(0.0, 0.0).to_bits(), 0.0_f64.to_bits());
        assert_eq!(touched(0.0, 0.013).to_bits(), 0.013_f64.to_bits());
    }

    #[test]
    fn two_contacts_in_series_give_way_by_the_sum() {
        assert!((slip(touched(0.02, 0.01), 1.5) - (slip(0.02, 1.5) + slip(0.01, 1.5))).abs() < 1e-15);
    }

    #[test]
    fn it_is_the_beginning_of_a_slip_curve_of_the_same_slope() {
        let (limit, stiffness, force) = (2.0, 30.0, 1e-4);
        let s = slip(1.0 / (limit * stiffness), force);
        // the curve bends away by the part ½·(f/μN)²
        let bend = 0.5 * (force / limit) * (force / limit);
        let form = CurveShape { stiffness, shape: 1.0, curvature: 0.0 };
        let short = 1.0 - traction(limit, &form, s).0 / force;
        assert!((short - bend).abs() < 1e-3 * bend);
    }

    #[test]
    fn it_takes_power_both_ways() {
        for k in -10..=10 {
            let force = f64::from(k);
            assert!(slip(0.02, force) * force >= 0.0);
        }
    }
}
