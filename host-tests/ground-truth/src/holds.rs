//! What holds a robot: its constraints, where they stand, and along which row each acts.

use nalgebra::Vector2;

use crate::chassis::SeenFrom;
use crate::contact::floor_row;
use crate::impulse::{Constraint, Row};
use crate::robot::{Robot, Wheel};

/// Constraints of the body: friction along v, vn and about the centre.
const OF_BODY: usize = 3;

/// Constraints of each wheel: floor, rollers, bearing.
const OF_WHEEL: usize = 3;

/// Where the constraints of wheel j stand: floor, rollers, bearing.
pub fn of_wheel(j: usize) -> [usize; OF_WHEEL] {
    std::array::from_fn(|k| OF_BODY + OF_WHEEL * j + k)
}

/// All constraints of a robot, followed at a point; their limits are those of rigid joints where there is no law.
pub fn constraints_of(robot: &Robot, point: Vector2<f64>) -> Vec<Constraint> {
    let centre = SeenFrom::new(&robot.chassis, point).centre;
    let mut all: Vec<Constraint> = (0..OF_BODY)
        .map(|axis| Constraint::dry(Row { body: centre.row(axis).transpose(), ..Row::default() }, 0.0))
        .collect();
    for (j, wheel) in robot.wheels.iter().enumerate() {
        all.extend(constraints_of_wheel(wheel, j, point));
    }
    all
}

fn constraints_of_wheel(wheel: &Wheel, j: usize, point: Vector2<f64>) -> [Constraint; OF_WHEEL] {
    let across = wheel.heading + core::f64::consts::FRAC_PI_2;
    let along = |direction| Row { body: floor_row(wheel.contact - point, direction), ..Row::default() };
    let floor = Row { wheel: Some((j, -wheel.radius)), ..along(wheel.heading) };
    let bearing = Row { wheel: Some((j, 1.0)), ..Row::default() };
    [Constraint::dry(floor, f64::INFINITY), Constraint::dry(along(across), 0.0), Constraint::dry(bearing, 0.0)]
}
