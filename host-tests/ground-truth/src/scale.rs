//! What is typical of a robot of another size: the paper's numbers, times what they grow by.

use crate::robot::Robot;
use crate::robot_file::RobotFile;

/// How many times the paper's robot a robot is, in what the sizes of causes are counted in. Of the paper's, each is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Of forces on the body and of friction: that of its mass.
    pub force: f64,
    /// Of lengths: that of its wheels' radius.
    pub length: f64,
    /// Of voltages: that of its supply.
    pub voltage: f64,
    /// Of windings' resistance.
    pub resistance: f64,
}

impl Scale {
    /// Of a robot.
    pub fn of(robot: &Robot) -> Self {
        let paper = RobotFile::paper(0.0);
        let wheel = &robot.wheels[0];
        Self {
            force: robot.chassis.mass / paper.mass,
            length: wheel.radius / paper.wheels[0].2,
            voltage: robot.battery.nominal / paper.supply,
            resistance: wheel.motor.resistance / paper.resistance,
        }
    }

    /// Of currents: U/R.
    pub fn current(&self) -> f64 {
        self.voltage / self.resistance
    }

    /// Of power: U²/R.
    pub fn power(&self) -> f64 {
        self.voltage * self.current()
    }

    /// Of torques at a wheel: F·r.
    pub fn torque(&self) -> f64 {
        self.force * self.length
    }

    /// Of inertia at a wheel: m·r².
    pub fn inertia(&self) -> f64 {
        self.torque() * self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_robot_is_once_itself_and_a_robot_twice_as_long_has_eight_times_the_inertia() {
        let mut setup = RobotFile::paper(45.0).setup();
        let one = Scale { force: 1.0, length: 1.0, voltage: 1.0, resistance: 1.0 };
        assert_eq!(Scale::of(&setup.robot), one);
        setup.robot.wheels.iter_mut().for_each(|wheel| wheel.radius *= 2.0);
        setup.robot.chassis.mass *= 2.0;
        setup.robot.battery.nominal *= 3.0;
        let scale = Scale::of(&setup.robot);
        assert_eq!([scale.torque(), scale.inertia(), scale.current(), scale.power()], [4.0, 8.0, 3.0, 9.0]);
    }
}
