//! A wheel that rolls from roller to roller.

use crate::uneven::Uneven;

#[test]
fn a_wheel_of_rollers_rolls_as_far_as_its_rim_is_long_and_keeps_its_motors_work() {
    let parts = [0.004, -0.003];
    let params = [parts[0], parts[1], 15.0];
    Uneven { id: "roller_ripple", params: &params, parts, order: 15.0 }.is_held_to_its_laws();
}
