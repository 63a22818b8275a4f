//! The wheels as effects leave them that are counted into the geometry.

use core::array;

use super::Compensation;
use crate::effects::seams::Contact;
use crate::geometry::kinematics::{Wheel, Wheels};
use crate::number::scalar::Real;

impl<const N: usize, T: Real> Compensation<N, T> {
    /// The contacts of a robot whose model has these wheels.
    pub fn contacts(&self, nominal: &Wheels<N, T>) -> [Contact<T>; N] {
        array::from_fn(|j| {
            let Wheel { radius, .. } = nominal.wheels()[j];
            let position = nominal.wheels()[j].contact_point().into();
            let mut contact = Contact { row: nominal.rows()[j], position, radius, ..Contact::default() };
            self.on(j).for_each(|undo| undo.effect.fold_wheel(&mut contact));
            contact
        })
    }

    /// The wheels of a robot whose model has these.
    #[must_use]
    pub fn own_wheels(&self, nominal: &Wheels<N, T>) -> Wheels<N, T> {
        let contacts = self.contacts(nominal);
        Wheels::new(array::from_fn(|j| {
            let ([cos, sin, distance], wheel) = (contacts[j].row, nominal.wheels()[j]);
            let same = nominal.rows()[j] == contacts[j].row;
            let drive_angle = if same { wheel.drive_angle } else { sin.atan2(cos) };
            Wheel { drive_angle, distance, radius: contacts[j].radius }
        }))
    }
}
