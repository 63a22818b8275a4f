//! A robot that is driven: one small step after another, all forces of a step found together.

use nalgebra::{Vector2, Vector3};

use crate::chassis::{SeenFrom, twist_at};
use crate::contact::floor_row;
use crate::holds::constraints_of;
use crate::impulse::{Constraint, Velocities};
use crate::robot::{Grip, Robot, Shaft, Wheel};
use crate::rotated::rotated;
use crate::state::State;

/// Times that bus voltage and currents are found of each other when they are read.
const READINGS: usize = 12;

/// A robot, where it is, and how it goes on.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(crate) robot: Robot,
    /// The point that is followed, from the robot's centre [m]
    pub(crate) point: Vector2<f64>,
    /// [s]
    pub(crate) step: f64,
    pub(crate) chassis: SeenFrom,
    /// Contacts, from the centre of mass [m]
    pub(crate) feet: Vec<Vector2<f64>>,
    pub(crate) state: State,
    pub(crate) velocities: Velocities,
    pub(crate) constraints: Vec<Constraint>,
    pub(crate) impulses: Vec<f64>,
    /// Of the middle of the step that is taken.
    pub(crate) middle: Middle,
}

/// What was last thought of the middle of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Middle {
    pub(crate) twist: Vector3<f64>,
    pub(crate) shafts: Vec<f64>,
    pub(crate) currents: Vec<f64>,
    pub(crate) loads: Vec<f64>,
}

impl Simulation {
    /// At rest in the origin; a step lasts `step` [s].
    pub fn new(robot: Robot, step: f64) -> Self {
        Self::following(robot, step, Vector2::zeros())
    }

    /// The same, with the motion of another point calculated than that of the robot's centre, from which it is `point`
    /// [m]: where nothing is left out of nature, the robot moves alike.
    pub fn following(robot: Robot, step: f64, point: Vector2<f64>) -> Self {
        let wheels = robot.wheels.len();
        let contacts = robot.wheels.iter().map(|wheel| wheel.contact);
        let feet: Vec<Vector2<f64>> = contacts.map(|contact| contact - robot.chassis.centre_of_mass).collect();
        let mut state = State::at_rest(wheels);
        state.position = point;
        let constraints = constraints_of(&robot, point);
        Self {
            point,
            step,
            chassis: SeenFrom::new(&robot.chassis, point),
            middle: Middle {
                twist: Vector3::zeros(),
                shafts: state.shafts.clone(),
                currents: state.currents.clone(),
                loads: vec![0.0; wheels],
            },
            velocities: Velocities {
                shafts: vec![0.0; 2 * wheels],
                shaft_mobility: vec![0.0; 2 * wheels],
                ..Velocities::default()
            },
            impulses: vec![0.0; constraints.len()],
            constraints,
            feet,
            state,
            robot,
        }
    }

    /// Time since the beginning [s]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Sets the robot's centre in motion with a twist (v, vn, ω) [m/s, m/s, rad/s], its wheels rolling.
    pub fn set_moving(&mut self, twist: Vector3<f64>) {
        // the twist of the point that is followed
        self.state.twist = twist_at(self.point) * twist;
        let wheels = self.robot.wheels.len();
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let speed = floor_row(wheel.contact, wheel.heading).dot(&twist) / wheel.radius;
            (self.state.shafts[j], self.state.shafts[wheels + j]) = (speed, speed);
        }
    }

    /// Sets a wheel alone turning [rad/s], whatever it stands on.
    pub fn set_wheel_turning(&mut self, wheel: usize, speed: f64) {
        self.state.shafts[wheel] = speed;
    }

    /// Goes on for `steps` steps with the voltages u held [V].
    pub fn hold(&mut self, u: &[f64], steps: usize) {
        for _ in 0..steps {
            self.advance(u);
        }
    }

    /// x, y, θ of the robot's centre [m, m, rad], θ not wrapped
    pub fn pose(&self) -> [f64; 3] {
        let centre = self.state.position - rotated(self.state.heading, self.point);
        [centre.x, centre.y, self.state.heading]
    }

    /// v, vn, ω of the robot's centre [m/s, m/s, rad/s]
    pub fn twist(&self) -> [f64; 3] {
        (self.chassis.centre * self.state.twist).into()
    }

    /// Speeds of the wheels [rad/s]
    pub fn wheel_speeds(&self) -> &[f64] {
        &self.state.shafts[..self.robot.wheels.len()]
    }

    /// Currents [A] just after the voltages u [V] have been applied.
    pub fn currents(&self, u: &[f64]) -> Vec<f64> {
        let mut currents = self.state.currents.clone();
        for _ in 0..READINGS {
            let bus = self.bus(u, &currents);
            for (j, wheel) in self.robot.wheels.iter().enumerate() {
                let motor = &wheel.motor;
                if motor.inductance == 0.0 {
                    let induced = motor.emf_constant * wheel.gear_ratio * self.state.shafts[self.rotor(j)];
                    // i = (u − Kv·l·ω)/R
                    currents[j] = (self.fed(u[j], bus) - induced) / motor.resistance;
                }
            }
        }
        currents
    }

    /// What the wheels press on the floor with [N], over the last step
    pub fn loads(&self) -> &[f64] {
        &self.middle.loads
    }

    /// What moves and what is strained [J]
    ///
    /// ```text
    /// ½·Vᵀ·M·V + Σ ½·J·ω² + Σ ½·k·z² + Σ ½·f²/k + Σ ½·L·i²
    /// ```
    pub fn energy(&self) -> f64 {
        let state = &self.state;
        let body = 0.5 * state.twist.dot(&(self.chassis.inertia * state.twist));
        let of_wheel = |(j, wheel): (usize, &Wheel)| {
            let rotor = state.shafts[self.rotor(j)];
            let turning = wheel.inertia * state.shafts[j].powi(2) + wheel.reflected_inertia() * rotor.powi(2);
            let twisted = match wheel.shaft {
                Shaft::Rigid => 0.0,
                Shaft::Elastic { stiffness, .. } => stiffness * state.windup[j].powi(2),
            };
            let patch = match wheel.grip {
                Grip::Rolls => 0.0,
                Grip::Slips(slip) => state.strained[j].powi(2) / slip.stiffness,
            };
            0.5 * (turning + twisted + patch + wheel.motor.inductance * state.currents[j].powi(2))
        };
        body + self.robot.wheels.iter().enumerate().map(of_wheel).sum::<f64>()
    }

    /// The shaft that the motor of wheel j turns.
    pub(crate) fn rotor(&self, j: usize) -> usize {
        if self.robot.wheels[j].shaft == Shaft::Rigid { j } else { self.robot.wheels.len() + j }
    }

    /// The voltage of the battery under these commands [V] and currents [A].
    pub(crate) fn bus(&self, u: &[f64], currents: &[f64]) -> f64 {
        let battery = &self.robot.battery;
        let drawn: f64 = u.iter().zip(currents).map(|(u, i)| u / battery.nominal * i).sum();
        battery.voltage(drawn, self.state.polarisation)
    }

    /// What a bridge makes of a command [V].
    pub(crate) fn fed(&self, u: f64, bus: f64) -> f64 {
        u * (bus / self.robot.battery.nominal)
    }
}
