//! # Roller friction: a wheel drags as it slides sideways over its rollers
//!
//! ```text
//! f = F·sign(u) + b·u        u = sin α·v − cos α·vn + …·ω
//! ```
//!
//! An omnidirectional wheel is free across its rolling direction because rollers turn there, and their bearings rub: small
//! plain ones on thin pins, often with dirt in them. The force is along the wheel's axle, against the motion of the contact
//! that way. So the robot drags most where many wheels slide at once: on three wheels by 2·F straight along an axle's
//! direction and by √3·F across it, while it turns on the spot freely.
//!
//! symbol  code        unit   meaning
//! ------  ----------  -----  ---------------------------------------------------
//! F       `friction`  N      dry friction of one wheel's rollers, at the floor
//! b       `damping`   N·s/m  viscous friction of one wheel's rollers, at the floor
//! u       `speed`     m/s    how fast the contact moves along the wheel's axle
//!
//! On four wheels that drive along the body's axes it cannot be told from the body's own friction: it is 2·F of C_v and of
//! C_vn, and 2·b of B_v and of B_vn. At other angles the dry part can; the viscous part is held in a diagnosis, for on all
//! wheels of a regular layout it looks like the body's at any angle.
//!
//! Fails when: the load moves from wheel to wheel: dry friction of plain bearings goes along with it.
//! How to measure it: lift the robot, wind a thread around a roller and pull it off with a spring scale; or, motors open,
//! drag the robot slowly with a spring scale along an axle and across it.
//! Source: Friction of an omnidirectional wheel across its rolling direction: Williams, Carter, Gallina, Rosati, Dynamic
//! model with slip for wheeled omnidirectional robots, IEEE Transactions on Robotics and Automation 18, 2002; sizes:
//! estimated from μ·N·(pin radius / roller radius), 0.05 to 0.5 N.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::undoing::{Place, way};
use crate::effects::{Catalogued, Hooks};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "roller_friction",
    title: "Friction of the rollers",
    summary: "A wheel drags when it slides sideways, because the bearings of its rollers rub.",
    equation: "f = F·sign(u) + b·u",
    source: "friction of an omnidirectional wheel across its rolling direction: Williams, Carter, Gallina, Rosati, Dynamic model with slip for wheeled omnidirectional robots, IEEE Transactions on Robotics and Automation 18, 2002; sizes: estimated from μ·N·(pin radius / roller radius), 0.05 to 0.5 N",
    seams: &[Seam::Contact],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "friction_N",
            symbol: "F",
            unit: "N",
            absent: 0.0,
            typical: 0.15,
            within: (0.0, 20.0),
            role: Role::Size,
        },
        Param {
            key: "damping_N_s_per_m",
            symbol: "b",
            unit: "N·s/m",
            absent: 0.0,
            typical: 0.0,
            within: (0.0, 5.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Motion, parity: Parity::Odd, order: None },
    signature: "force short by a constant that depends on the direction of travel, none while turning on the spot",
    look_alikes: &[LookAlike {
        with: "coulomb_friction",
        settled_by: "lift the robot and pull a thread off one roller with a spring scale: that is friction of the rollers alone",
    }],
    code: 17,
    undone: Undone::By("what each wheel's rollers take along its axle at the velocity of the reference is given"),
    physics: Physics::DRY_AT_WHEELS,
};

/// Friction of the rollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollerFriction<T> {
    /// F, dry friction of one wheel's rollers, at the floor [N]
    pub friction: T,
    /// b, viscous friction of one wheel's rollers, at the floor [N·s/m]
    pub damping: T,
}

impl<T: Copy> Catalogued<T> for RollerFriction<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[friction, damping] = params else { return None };
        Some(Self { friction, damping })
    }
}

/// Dry [N] and viscous [N·s/m] friction along the axle of a wheel that may have some already.
#[inline]
pub fn rubbing<T: Real>(friction: T, damping: T, x: Contact<T>) -> Contact<T> {
    // f = F·sign(u) + b·u: the plant spends it along the axle
    Contact { roller_friction: x.roller_friction + friction, roller_damping: x.roller_damping + damping, ..x }
}

impl<T: Real> Hooks<T> for RollerFriction<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;
    const UNDONE_AT: Option<Place> = Some(Place::Rollers);

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        let Self { friction, damping } = *self;
        *x = rubbing(friction, damping, *x);
    }

    fn undo_rollers(&self, speed: T, force: &mut T) {
        // f = F·sign(u) + b·u
        *force += self.friction * way(speed) + self.damping * speed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact whose rollers have some friction already.
    fn touched(p: [f64; 2], already: [f64; 2]) -> Contact<f64> {
        let [roller_friction, roller_damping] = already;
        let mut x = Contact {
            row: [0.6, 0.8, 0.089],
            position: [0.0712, -0.0534],
            radius: 0.0325,
            per_radius: 1.0 / 0.0325,
            load: 5.7,
            shape: 1.0,
            roller_friction,
            roller_damping,
            ..Contact::default()
        };
        RollerFriction::of(&p).expect("as many as on the card").contact(&(), &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn without_friction_the_contact_is_left_bit_for_bit() {
        for already in [[0.0, 0.0], [0.13, 0.04]] {
            let x = touched([0.0, 0.0], already);
            assert_eq!([x.roller_friction, x.roller_damping].map(f64::to_bits), already.map(f64::to_bits));
            assert_eq!(x.rollers_drag(), already != [0.0, 0.0]);
        }
    }

    #[test]
    fn it_drags_along_the_axle_alone_and_adds_up() {
        let x = touched([0.15, 0.1], [0.05, 0.02]);
        assert!((x.roller_friction - 0.2).abs() < 1e-15 && (x.roller_damping - 0.12).abs() < 1e-15);
        let [along_v, along_vn, about] = x.axle_row();
        // across the rolling direction, and with no arm about the centre
        assert!((along_v * 0.6 + along_vn * 0.8).abs() < 1e-15 && about.abs() < 1e-15);
    }

    #[test]
    fn either_part_alone_drags() {
        assert!(touched([0.15, 0.0], [0.0, 0.0]).rollers_drag());
        assert!(touched([0.0, 0.1], [0.0, 0.0]).rollers_drag());
    }
}
