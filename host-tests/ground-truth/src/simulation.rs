//! A robot that is driven: where it is, and what is read of it.

use nalgebra::{Vector2, Vector3};

use crate::bridge::Loss;
use crate::chassis::SeenFrom;
use crate::commands::Commands;
use crate::contact::{Grip, floor_row};
use crate::holds::constraints_of;
use crate::impulse::{Constraint, Velocities};
use crate::motor::{Fed, Winding};
use crate::robot::{Robot, Wheel};
use crate::rotated::rotated;
use crate::shaft::Shaft;
use crate::state::State;
use crate::twist_at::twist_at;

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
    /// How far from the robot's centre the wheels stand, in the mean [m]
    pub(crate) arm: f64,
    pub(crate) state: State,
    pub(crate) commands: Commands,
    pub(crate) velocities: Velocities,
    pub(crate) constraints: Vec<Constraint>,
    pub(crate) impulses: Vec<f64>,
    pub(crate) middle: Middle,
    /// Which way each constraint slid in the last step.
    pub(crate) slides: Vec<i8>,
    pub(crate) before: Before,
    /// Whether the robot has oddities.
    pub(crate) odd: bool,
}

/// Where a step began.
#[derive(Clone, Debug, Default)]
pub(crate) struct Before {
    pub(crate) state: State,
    pub(crate) impulses: Vec<f64>,
}

/// What was last thought of the middle of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Middle {
    pub(crate) twist: Vector3<f64>,
    pub(crate) shafts: Vec<Vector2<f64>>,
    pub(crate) currents: Vec<f64>,
    /// Of the motors, at the wheels [N·m]
    pub(crate) torques: Vec<f64>,
    pub(crate) loads: Vec<f64>,
    /// What the bridges hear [V]
    pub(crate) heard: Vec<f64>,
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
        let arm = contacts.clone().map(|contact| contact.norm()).sum::<f64>() / wheels as f64;
        let state = State { position: point, ..State::at_rest(wheels) };
        let constraints = constraints_of(&robot, point);
        let none = || vec![0.0; wheels];
        Self {
            point,
            step,
            arm,
            chassis: SeenFrom::new(&robot.chassis, point),
            feet: contacts.map(|contact| contact - robot.chassis.centre_of_mass).collect(),
            middle: Middle {
                twist: Vector3::zeros(),
                shafts: state.shafts.clone(),
                currents: none(),
                torques: none(),
                loads: none(),
                heard: none(),
            },
            velocities: Velocities::at_rest(wheels),
            impulses: vec![0.0; constraints.len()],
            slides: vec![0; constraints.len()],
            before: Before::default(),
            commands: Commands::default(),
            odd: robot.oddities.any(),
            constraints,
            state,
            robot,
        }
    }

    /// Time since the beginning [s]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Sets the robot's centre at a place x, y and a heading θ [m, m, rad].
    pub fn set_at(&mut self, [x, y, heading]: [f64; 3]) {
        self.state.position = Vector2::new(x, y) + rotated(heading, self.point);
        self.state.heading = heading;
    }

    /// Sets the robot's centre in motion with a twist (v, vn, ω) [m/s, m/s, rad/s], its wheels rolling; a load
    /// that swings stays behind.
    pub fn set_moving(&mut self, twist: Vector3<f64>) {
        self.state.twist = twist_at(self.point) * twist;
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let speed = floor_row(wheel.contact, wheel.heading).dot(&twist) / wheel.radius_at(self.state.turned[j].x);
            self.state.shafts[j] = Vector2::repeat(speed);
        }
    }

    /// Sets a wheel alone turning [rad/s], whatever it stands on.
    pub fn set_wheel_turning(&mut self, wheel: usize, speed: f64) {
        self.state.shafts[wheel].x = speed;
    }

    /// Goes on for `steps` steps with the voltages u held [V], or the speeds [rad/s] where a drive controls these.
    pub fn hold(&mut self, u: &[f64], steps: usize) {
        self.commands.send(self.state.time, u, self.delay());
        for _ in 0..steps {
            self.advance();
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

    /// Of the robot's centre over the last step, along (v, vn) [m/s²]
    pub fn acceleration(&self) -> Vector2<f64> {
        let [v, vn, w] = self.twist();
        let rate = self.chassis.centre * self.state.twist_rate;
        Vector2::new(rate.x - w * vn, rate.y + w * v)
    }

    /// Speeds of the wheels [rad/s]
    pub fn wheel_speeds(&self) -> Vec<f64> {
        self.state.shafts.iter().map(|shafts| shafts.x).collect()
    }

    /// How far the wheels have turned [rad]
    pub fn wheel_angles(&self) -> Vec<f64> {
        self.state.turned.iter().map(|turned| turned.x).collect()
    }

    /// Speed of one wheel [rad/s]
    pub fn wheel_speed(&self, wheel: usize) -> f64 {
        self.state.shafts[wheel].x
    }

    /// What a log has of commands u [V, or rad/s]: what a drive demands now, where that goes to them along a line.
    pub fn demanded(&self, u: &[f64]) -> Vec<f64> {
        let tells = self.robot.drive.is_some_and(|drive| drive.line > 0.0);
        if tells { self.state.driving.demands.clone() } else { u.to_vec() }
    }

    /// How long a command is on its way until it changes anything [s]
    pub(crate) fn delay(&self) -> f64 {
        self.robot.command_delay + self.robot.drive.map_or(0.0, |drive| drive.dead_time)
    }

    /// Currents [A] just after the voltages u [V] have been sent; of a drive that controls speed, as it last looked.
    pub fn currents(&self, u: &[f64]) -> Vec<f64> {
        let mut heard = self.state.driving.volts.clone();
        if self.robot.drive.is_none() {
            let (mut commands, delay) = (self.commands.clone(), self.delay());
            commands.send(self.state.time, u, delay);
            commands.at(self.state.time - delay, &mut heard);
        }
        self.robot.oddities.hear(&self.state.memory, &mut heard);
        let mut currents = self.state.currents.clone();
        for _ in 0..READINGS {
            let bus = self.bus(&heard, &currents);
            for (j, wheel) in self.robot.wheels.iter().enumerate() {
                if wheel.motor.inductance == 0.0 {
                    let speed = wheel.gear_ratio * self.state.shafts[j][self.rotor(j)];
                    currents[j] = self.winding(j, heard[j], (bus, currents[j], speed)).current(speed);
                }
            }
        }
        currents
    }

    /// Currents over the last step [A]
    pub fn driving_currents(&self) -> &[f64] {
        &self.middle.currents
    }

    /// What moves and what is strained [J]
    ///
    /// ```text
    /// ½·Vᵀ·M·V + Σ ½·J·ω² + Σ ½·k·z² + Σ ½·f²/k + Σ ½·L·i² + what oddities hold
    /// ```
    pub fn energy(&self) -> f64 {
        let state = &self.state;
        let body = 0.5 * state.twist.dot(&(self.chassis.inertia * state.twist));
        let of_wheel = |(j, wheel): (usize, &Wheel)| {
            let rotor = state.shafts[j][self.rotor(j)];
            let turning = wheel.inertia * state.shafts[j].x.powi(2) + wheel.reflected_inertia() * rotor.powi(2);
            let patch = match wheel.grip {
                Grip::Rolls | Grip::Creeps(_) => 0.0,
                Grip::Slips(slip) => state.strained[j].powi(2) / slip.stiffness,
            };
            let apart = state.turned[j].x - state.turned[j].y - self.robot.oddities.slipped(j, &state.memory);
            let twisted = wheel.shaft.energy(apart);
            0.5 * (turning + patch + wheel.motor.inductance * state.currents[j].powi(2)) + twisted
        };
        body + self.robot.wheels.iter().enumerate().map(of_wheel).sum::<f64>() + self.odd_energy()
    }

    /// The shaft that the motor of wheel j turns: 0, the wheel's own, or 1.
    pub(crate) fn rotor(&self, j: usize) -> usize {
        usize::from(self.robot.wheels[j].shaft != Shaft::Rigid)
    }

    /// The voltage of the battery under what the bridges hear [V] and currents [A].
    pub(crate) fn bus(&self, heard: &[f64], currents: &[f64]) -> f64 {
        let supplied = self.robot.oddities.supplied(self.drawn(heard, currents), &self.state.memory);
        self.robot.battery.voltage(supplied, self.state.polarisation) + self.state.memory.converting.voltage
    }

    /// What the bridges draw from the battery [A]: a current times the part of the time for which it is passed on.
    pub(crate) fn drawn(&self, heard: &[f64], currents: &[f64]) -> f64 {
        heard.iter().zip(currents).map(|(u, i)| u / self.robot.battery.nominal * i).sum()
    }

    /// The winding of motor j for a step under what its bridge hears [V], at about a bus voltage [V], a current [A] and a
    /// speed of the motor [rad/s] in its middle.
    pub(crate) fn winding(&self, j: usize, heard: f64, (bus, near, speed): (f64, f64, f64)) -> Winding {
        let (wheel, left) = (&self.robot.wheels[j], self.leaves(j, heard));
        if left == 0.0 {
            return Winding { stalled: 0.0, per_speed: 0.0 };
        }
        let loss = wheel.bridge.loss(near, wheel.motor.emf_constant * speed);
        let fed = Fed {
            voltage: left * wheel.bridge.applied(heard * (bus / self.robot.battery.nominal)),
            loss: Loss { at_none: left * loss.at_none, ..loss },
            temperatures: self.state.temperatures[j],
        };
        let winding = wheel.motor.winding(&fed, self.state.currents[j], near, self.step);
        Winding { per_speed: left * winding.per_speed, ..winding }.limited(speed, wheel.bridge.current_limit)
    }
}
