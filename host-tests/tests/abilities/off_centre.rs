//! A body whose centre of mass is off the centre, spinning freely: that centre goes straight on, and the body turns evenly
//! about it.

use crate::effects::{Ability, OffCentre, Way, frictionless};

const OFFSET: [f64; 2] = [0.03, -0.02];
const INERTIA: f64 = 0.02;
const START: [f64; 3] = [0.8, -0.3, 4.0];

fn spun(steps: usize, dt: f64) -> Way<4> {
    let off = Ability::OffCentre(OffCentre { offset: OFFSET, inertia: INERTIA });
    let mut way = Way::begin(frictionless(), &[off], START);
    way.coast(steps, dt);
    way
}

/// How far the pose after 1 s is from the closed form [m].
fn off_the_closed_form(dt: f64) -> f64 {
    let way = spun((1.0 / dt).round() as usize, dt);
    let [v, vn, w] = START;
    let [cx, cy] = OFFSET;
    // the centre of mass begins at c with (v − ω·c_y, vn + ω·c_x); the reference point is −R(θ)·c from it
    let (sin, cos) = w.sin_cos();
    let x = cx + (v - w * cy) - (cos * cx - sin * cy);
    let y = cy + (vn + w * cx) - (sin * cx + cos * cy);
    let theta = way.state.pose.theta - w;
    (way.state.pose.x - x).hypot(way.state.pose.y - y).max(theta.abs())
}

#[test]
fn its_centre_of_mass_goes_straight_and_it_turns_evenly() {
    let (coarse, fine) = (off_the_closed_form(2e-3), off_the_closed_form(1e-3));
    // second order in Δt, and small
    assert!(fine < 2e-5, "{fine:e} m");
    assert!((3.7..4.3).contains(&(coarse / fine)), "{coarse:e} and {fine:e} m");
}

#[test]
fn without_an_offset_it_is_a_body_whose_velocity_keeps_its_direction_in_the_world() {
    let even = Ability::OffCentre(OffCentre { offset: [0.0; 2], inertia: frictionless().inertia });
    let mut way = Way::begin(frictionless(), &[even], START);
    way.coast(1000, 1e-3);
    let [v, vn, w] = START;
    let straight = (way.state.pose.x - v).hypot(way.state.pose.y - vn).max((way.state.pose.theta - w).abs());
    assert!(straight < 1e-5, "{straight:e}");
}

#[test]
fn it_keeps_its_energy() {
    let mass = frictionless().mass;
    let energy = |[v, vn, w]: [f64; 3]| {
        let (a, b) = (v - w * OFFSET[1], vn + w * OFFSET[0]);
        0.5 * mass * (a * a + b * b) + 0.5 * INERTIA * w * w
    };
    let end = spun(1000, 1e-3).state.twist.to_array();
    assert!((energy(end) / energy(START) - 1.0).abs() < 1e-5, "{} of {}", energy(end), energy(START));
}
