//! One wheel of a robot without friction, by hand: how the robot answers to a force at that rim.

use host_tests::paper::PaperRobot;

/// A wheel: where it drives, and what the body weighs.
#[derive(Clone, Copy, Debug)]
pub struct OneWheel {
    /// (cos α, sin α, d)
    row: [f64; 3],
    /// (1/M, 1/M, 1/J)
    per_mass: [f64; 3],
}

impl OneWheel {
    /// The wheel that drives along this angle [°].
    pub fn new(robot: &PaperRobot, heading: f64) -> Self {
        let (sin, cos) = heading.to_radians().sin_cos();
        Self { row: [cos, sin, robot.d], per_mass: [1.0 / robot.mass, 1.0 / robot.mass, 1.0 / robot.inertia] }
    }

    /// Speed of its rim at a twist [m/s].
    pub fn speed(&self, twist: [f64; 3]) -> f64 {
        (0..3).map(|k| self.row[k] * twist[k]).sum()
    }

    /// The twist after an impulse at its rim [N·s].
    pub fn pushed(&self, twist: [f64; 3], impulse: f64) -> [f64; 3] {
        std::array::from_fn(|k| twist[k] + self.per_mass[k] * self.row[k] * impulse)
    }

    /// Speed that its rim gains for an impulse at it: 1/M + d²/J [1/kg].
    pub fn mobility(&self) -> f64 {
        self.speed(self.pushed([0.0; 3], 1.0))
    }
}
