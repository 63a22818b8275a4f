//! A wheel whose axle sits beside its middle.

use crate::uneven::Uneven;

#[test]
fn an_eccentric_wheel_rolls_as_far_as_its_rim_is_long_and_keeps_its_motors_work() {
    let parts = [0.012, -0.016];
    Uneven { id: "wheel_eccentricity", params: &parts, parts, order: 1.0 }.is_held_to_its_laws();
}
