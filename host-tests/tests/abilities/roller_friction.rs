//! Friction across the wheels, where the rollers turn: a robot that coasts slows down as the geometry says.

use model_core::plant::paper;
use model_core::plant::robot::{Friction, Robot};

use crate::effects::{Ability, Rollers, Turned, Way, frictionless};

/// Friction of each wheel's rollers [N]
const F: f64 = 0.3;

#[test]
fn along_an_axis_the_two_wheels_that_are_dragged_sideways_brake() {
    let mass = frictionless().mass;
    for start in [[0.5, 0.0, 0.0], [0.0, -0.4, 0.0], [0.3, 0.3, 0.0], [-0.3, 0.2, 0.0]] {
        let mut way = Way::begin(frictionless(), &[Ability::Rollers(Rollers(F, 0.0))], start);
        way.coast(300, 1e-3);
        for axis in 0..2 {
            // M·dv/dt = −2·F on each axis that moves
            let wanted: f64 =
                start[axis] - 2.0 * F / mass * 0.3 * f64::from(u8::from(start[axis] != 0.0)) * start[axis].signum();
            assert!((way.state.twist.to_array()[axis] - wanted).abs() < 1e-12, "{start:?}: {:?}", way.state.twist);
        }
        // v²/(2·a), and it stays
        way.coast(3000, 1e-3);
        let (x, y) = (way.state.pose.x, way.state.pose.y);
        for (way, start) in [(x, start[0]), (y, start[1])] {
            let wanted: f64 = start * start.abs() * mass / (4.0 * F);
            // the last step is spent as a whole: ½·a·Δt²
            assert!((way - wanted).abs() < 1e-6, "{way} against {wanted} m");
        }
        assert_eq!(way.state.twist.to_array(), [0.0; 3]);
    }
}

#[test]
fn on_the_spot_no_roller_turns() {
    let mut way = Way::begin(frictionless(), &[Ability::Rollers(Rollers(F, 0.5))], [0.0, 0.0, 3.0]);
    way.coast(500, 1e-3);
    assert!((way.state.twist.w - 3.0).abs() < 1e-12, "{:?}", way.state.twist);
}

#[test]
fn on_three_wheels_the_force_is_the_sum_of_the_axles_shares() {
    let robot: Robot<3, f64> = Robot { friction: Friction::default(), ..paper::three_wheels() };
    for heading in [5.0, 25.0, 70.0, 100.0, 200.0_f64] {
        let (sin, cos) = heading.to_radians().sin_cos();
        let mut way = Way::begin(robot, &[Ability::Rollers(Rollers(F, 0.0))], [cos, sin, 0.0]);
        way.coast(1, 1e-4);
        // −F·sign(a_j·v)·a_j, axles a_j at 60°, 180° and −60°: drive angles less a right angle
        let mut force = [0.0; 2];
        for axle in [60.0, 180.0, -60.0_f64] {
            let (ay, ax) = axle.to_radians().sin_cos();
            let sign = (ax * cos + ay * sin).signum();
            force[0] -= F * sign * ax;
            force[1] -= F * sign * ay;
        }
        let [v, vn, _] = way.state.twist.to_array();
        let found = [(v - cos) / 1e-4 * robot.mass, (vn - sin) / 1e-4 * robot.mass];
        for axis in 0..2 {
            assert!((found[axis] - force[axis]).abs() < 1e-9, "{heading}°: {found:?} against {force:?} N");
        }
    }
}

#[test]
fn with_viscous_rollers_the_speed_falls_exponentially() {
    let mass = frictionless().mass;
    let mut way = Way::begin(frictionless(), &[Ability::Rollers(Rollers(0.0, 0.8))], [0.5, 0.0, 0.0]);
    way.coast(1000, 1e-3);
    // M·dv/dt = −2·b·v, by the midpoint rule: ((1 − ½bΔt)/(1 + ½bΔt)) a step
    let wanted = 0.5 * (-2.0 * 0.8 / mass * 1.0_f64).exp();
    assert!((way.state.twist.v - wanted).abs() < 1e-7, "{} against {wanted}", way.state.twist.v);
}

#[test]
fn the_rollers_of_wheels_mounted_turned_turn_on_the_spot_too() {
    let tilt = 0.1_f64;
    let abilities = [Ability::Turned(Turned(tilt)), Ability::Rollers(Rollers(F, 0.0))];
    let mut way = Way::begin(frictionless(), &abilities, [0.0, 0.0, 3.0]);
    way.coast(200, 1e-3);
    let robot = frictionless();
    // each axle passes the centre at d·sin ε: J·dω/dt = −n·F·d·sin ε
    let rate = 4.0 * F * robot.wheels.wheels()[0].distance * tilt.sin() / robot.inertia;
    assert!((way.state.twist.w - (3.0 - 0.2 * rate)).abs() < 1e-10, "{:?}", way.state.twist);
}
