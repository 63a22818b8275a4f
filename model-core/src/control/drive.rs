//! # Drive: the motion of a robot with three wheels or with four
//!
//! The controller knows its number of wheels when it is compiled; here the parameter block chooses between the two, and
//! the numbers of the three or four motors come and go in arrays for all that a board has bridges for.
//!
//! What the controller gets for the wheels' speeds is what their [`observer`](crate::control::observer) makes of hall
//! edges and reference, less what a gyro finds that the body's turning is behind ([`heading`](crate::control::heading)). While the reference rests, what the integral holds fades: it was friction, and that turns
//! round.

use crate::control::braking::BrakingBand;
use crate::control::calibration::Calibration;
use crate::control::compensation::Compensation;
use crate::control::halls::REST;
use crate::control::heading::HeadingHold;
use crate::control::motion_controller::{Controller, Measurement, Memory, Settings};
use crate::control::observer::{HallReading, SpeedObserver, WheelEstimate};
use crate::control::thermal::{Heat, ThermalLimit};
use crate::geometry::frames::BodyTwist;
use crate::geometry::kinematics::Wheels;
use crate::link::block::{Block, ControlMode, Parameters};
use crate::link::record::MOTORS;
use crate::number::scalar::Real;

/// What a turn decides, for all motors of the board.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DriveOutput {
    /// DC-equivalent currents [A]
    pub current: [f32; MOTORS],
    /// DC-equivalent voltages [V]: all of it, or what goes ahead of controlled currents (the back-EMF)
    pub voltage: [f32; MOTORS],
    /// Wanted speed of each wheel's shaft; zero for a lost wheel [rad/s]
    pub wheel_speed: [f32; MOTORS],
    /// The motion that is followed
    pub reference: BodyTwist,
    /// Share of the wanted acceleration that there was room for [1]
    pub headroom: f32,
}

/// A robot's motion.
// There is one of them, and it lies in fixed memory.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug)]
pub enum RobotDrive {
    /// With three wheels
    Three(WheeledDrive<3>),
    /// With four wheels
    Four(WheeledDrive<4>),
}

/// The motion of a robot with `N` wheels.
#[derive(Clone, Copy, Debug)]
pub struct WheeledDrive<const N: usize> {
    settings: Settings<N, f32>,
    controller: Controller<N, f32>,
    memory: Memory<f32>,
    controls_current: bool,
    most_speed: f32,
    /// Largest accelerations of the block, and those that it stops with [m/s², m/s², rad/s²]
    accelerations: [[f32; 3]; 2],
    observer: SpeedObserver,
    wheels: [WheelEstimate; N],
    /// Wanted speeds of the wheels in the turn before [rad/s]
    wanted: [f32; N],
    thermal: ThermalLimit,
    heat: [Heat; N],
    over_voltage: f32,
    /// n of four wheels; zeros of three
    parity: [f32; N],
    /// The wheels as they are, the effects of their geometry counted in
    own_wheels: Wheels<N>,
    heading: HeadingHold,
}

/// Acceleration that a robot stops with where nobody commands it, if its block allows less [m/s²]: at rest from 1 m/s after
/// 0.4 s. A quarter of the weight, which every floor for robots holds.
pub const STOP_ACCELERATION: f32 = 2.5;

/// Share of a wheel in the parity of four below which the other three hardly tell its speed [1].
const LEAST_PARITY: f32 = 0.1;

/// Share of the integral that is left after a turn at rest [1]: half of it fades in 35 ms.
const INTEGRAL_DECAY: f32 = 0.98;

impl RobotDrive {
    /// A robot at rest with these parameters; `max_duty` is the largest part of the bus voltage that a motor may get [1],
    /// `dt` the length of a turn [s].
    #[inline(never)]
    pub fn new(parameters: &Parameters, max_duty: f32, dt: f32) -> Self {
        match parameters {
            Parameters::Three(block) => RobotDrive::Three(WheeledDrive::new(block, max_duty, dt)),
            Parameters::Four(block) => {
                let drive = WheeledDrive::new(block, max_duty, dt);
                RobotDrive::Four(WheeledDrive { parity: drive.own_wheels.parity_vector(), ..drive })
            }
        }
    }

    /// Goes on with the motion that another one was following, and with the heat in its motors, where it has as many wheels;
    /// their speeds begin anew.
    pub fn take_over(&mut self, old: &RobotDrive) {
        match (self, old) {
            (RobotDrive::Three(new), RobotDrive::Three(old)) => new.take_over(old),
            (RobotDrive::Four(new), RobotDrive::Four(old)) => new.take_over(old),
            _ => {}
        }
    }

    /// Drives without these motors (one bit each), at reduced limits.
    #[inline(never)]
    pub fn exclude_motors(&mut self, lost: u8) {
        match self {
            RobotDrive::Three(drive) => drive.exclude_motors(lost),
            RobotDrive::Four(drive) => drive.exclude_motors(lost),
        }
    }

    /// From now on changes its motion as hard as it may to stop ([`STOP_ACCELERATION`]), or as its block allows.
    #[inline(never)]
    pub fn stop_hard(&mut self, stops: bool) {
        match self {
            RobotDrive::Three(drive) => drive.stop_hard(stops),
            RobotDrive::Four(drive) => drive.stop_hard(stops),
        }
    }

    /// Forgets the motion that was followed.
    pub fn reset(&mut self) {
        match self {
            RobotDrive::Three(drive) => drive.reset(),
            RobotDrive::Four(drive) => drive.reset(),
        }
    }

    /// One turn towards a wanted motion; wheels and supply [V] as measured.
    #[inline]
    pub fn tick(&mut self, halls: &[HallReading; MOTORS], bus: f32, want: BodyTwist) -> DriveOutput {
        self.observe(halls);
        match self {
            RobotDrive::Three(drive) => drive.tick(bus, want),
            RobotDrive::Four(drive) => drive.tick(bus, want),
        }
    }

    /// Takes in what the halls tell.
    #[inline]
    fn observe(&mut self, halls: &[HallReading; MOTORS]) {
        match self {
            RobotDrive::Three(drive) => drive.observe(halls),
            RobotDrive::Four(drive) => drive.observe(halls),
        }
    }

    /// A turn of the gyro, before that of the motion: its code, and for how many periods each wheel has passed no edge.
    #[inline(never)]
    pub fn observe_yaw(&mut self, code: Option<i16>, since_edge: &[u16; MOTORS]) {
        match self {
            RobotDrive::Three(drive) => drive.observe_yaw(code, since_edge),
            RobotDrive::Four(drive) => drive.observe_yaw(code, since_edge),
        }
    }

    /// What is known of the heading.
    pub fn heading(&self) -> &HeadingHold {
        match self {
            RobotDrive::Three(drive) => &drive.heading,
            RobotDrive::Four(drive) => &drive.heading,
        }
    }

    /// True if the currents are to be controlled.
    pub fn controls_current(&self) -> bool {
        match self {
            RobotDrive::Three(drive) => drive.controls_current,
            RobotDrive::Four(drive) => drive.controls_current,
        }
    }

    /// Largest current of a motor [A].
    pub fn current_limit(&self) -> f32 {
        match self {
            RobotDrive::Three(drive) => drive.settings.current_limit,
            RobotDrive::Four(drive) => drive.settings.current_limit,
        }
    }

    /// A turn in which the motors' currents were these [A]: each one's largest current follows from how warm it is. True if
    /// one of them is folded back.
    #[inline]
    pub fn heat(&mut self, current: &[f32; MOTORS]) -> bool {
        match self {
            RobotDrive::Three(drive) => drive.heat(current),
            RobotDrive::Four(drive) => drive.heat(current),
        }
    }

    /// How fast each wheel turns by what the others do [rad/s], all as measured: of four wheels what a rigid motion of the
    /// body makes of the other three, with sign; of three, or of those that are left, the fastest of the others.
    #[inline]
    pub fn told_by_others(&self, measured: &[f32; MOTORS]) -> [f32; MOTORS] {
        match self {
            RobotDrive::Three(drive) => drive.told_by_others(measured),
            RobotDrive::Four(drive) => drive.told_by_others(measured),
        }
    }

    /// The bus voltage at rest, before anything was driven [V].
    pub fn set_bus_at_rest(&mut self, bus: f32) {
        match self {
            RobotDrive::Three(drive) => drive.set_bus_at_rest(bus),
            RobotDrive::Four(drive) => drive.set_bus_at_rest(bus),
        }
    }

    /// One bit a motor that the robot has.
    pub fn motors(&self) -> u8 {
        match self {
            RobotDrive::Three(_) => 0b0111,
            RobotDrive::Four(_) => 0b1111,
        }
    }
}

impl<const N: usize> WheeledDrive<N> {
    fn new(block: &Block<N>, max_duty: f32, dt: f32) -> Self {
        let mut compensation = Compensation::none();
        for effect in block.effects.iter() {
            // the block was checked for effects that can be undone
            let _refused = effect.effect().map(|undo| compensation.add(undo, effect.wheel().map(usize::from)));
        }
        let settings = Settings {
            robot: block.robot,
            compensation,
            acceleration: block.limits.acceleration,
            current_limit: block.limits.current,
            braking: BrakingBand::new(block.limits.over_voltage, block.robot.supply),
            max_duty,
            feedback: block.feedback,
            feedback_integral: block.feedback_integral,
            feedforward: block.feedforward,
            working: [true; N],
            dt,
        };
        let calibration = Calibration::of_board(block.pole_pairs);
        Self {
            settings,
            controller: Controller::new(&settings),
            memory: Memory::default(),
            controls_current: block.mode == ControlMode::Current,
            most_speed: block.limits.speed,
            accelerations: [block.limits.acceleration, stop_acceleration(block)],
            observer: SpeedObserver::new(calibration.edge_angle(block.robot.motor.gear_ratio), dt, calibration.period),
            wheels: [WheelEstimate::default(); N],
            wanted: [0.0; N],
            thermal: ThermalLimit::new(block.limits.current, block.continuous_current, block.heating_time, dt),
            heat: [Heat::default(); N],
            over_voltage: block.limits.over_voltage,
            parity: [0.0; N],
            own_wheels: compensation.own_wheels(&block.robot.wheels),
            heading: HeadingHold::new(&block.sensors, dt),
        }
    }

    fn take_over(&mut self, old: &Self) {
        (self.memory, self.heat) = (old.memory, old.heat);
        self.heading.take_over(&old.heading);
    }

    fn observe_yaw(&mut self, code: Option<i16>, since_edge: &[u16; MOTORS]) {
        let stands = since_edge.iter().take(N).all(|periods| *periods >= REST);
        let reference = self.memory.reference;
        self.heading.turn(code, reference.w, stands && reference == BodyTwist::default());
    }

    fn observe(&mut self, halls: &[HallReading; MOTORS]) {
        let wanted = self.own_wheels.wheel_speeds(self.memory.reference);
        for j in 0..N {
            self.observer.update(&mut self.wheels[j], halls[j], wanted[j] - self.wanted[j], wanted[j]);
        }
        self.wanted = wanted;
    }

    fn exclude_motors(&mut self, lost: u8) {
        let working = core::array::from_fn(|j| lost >> j & 1 == 0);
        if working != self.settings.working {
            self.settings.working = working;
            self.controller = Controller::new(&self.settings);
        }
    }

    fn heat(&mut self, current: &[f32; MOTORS]) -> bool {
        let limits: [f32; N] = core::array::from_fn(|j| self.thermal.turn(&mut self.heat[j], current[j]));
        self.controller.limit_currents(limits);
        limits.iter().any(|limit| self.thermal.folds_back(*limit))
    }

    fn told_by_others(&self, measured: &[f32; MOTORS]) -> [f32; MOTORS] {
        let wheels = self.own_wheels.wheels();
        let working = &self.settings.working;
        // n·v
        let parity = (0..N).fold(0.0, |sum, j| sum + self.parity[j] * wheels[j].radius * measured[j]);
        let mut told = [0.0; MOTORS];
        for j in 0..N {
            told[j] = if working.iter().all(|works| *works) && self.parity[j].abs() > LEAST_PARITY {
                // n·v = 0 for ω_j′ = ω_j − n·v/(n_j·r_j)
                measured[j] - parity / (self.parity[j] * wheels[j].radius)
            } else {
                let others = (0..N).filter(|k| *k != j && working[*k]);
                others.fold(0.0, |fastest: f32, k| fastest.max(measured[k].abs()))
            };
        }
        told
    }

    fn set_bus_at_rest(&mut self, bus: f32) {
        self.settings.braking = BrakingBand::new(self.over_voltage, bus);
        self.controller.set_braking(self.settings.braking);
    }

    fn stop_hard(&mut self, stops: bool) {
        let acceleration = self.accelerations[usize::from(stops)];
        if acceleration != self.settings.acceleration {
            self.settings.acceleration = acceleration;
            self.controller.set_acceleration(acceleration);
        }
    }

    /// The wanted motion, slowed down to the largest speed of the body with its direction kept.
    fn limit_speed(&self, want: BodyTwist) -> BodyTwist {
        let square = want.v * want.v + want.vn * want.vn;
        if square <= self.most_speed * self.most_speed {
            return want;
        }
        let share = self.most_speed * Real::inverse_sqrt(square);
        BodyTwist { v: share * want.v, vn: share * want.vn, w: want.w }
    }

    /// Forgets the motion, not the direction that the robot faces.
    fn reset(&mut self) {
        self.memory = Memory { heading: self.memory.heading, ..Memory::default() };
        self.wheels = [WheelEstimate::default(); N];
        self.wanted = [0.0; N];
        self.heading.forget();
    }

    /// Speeds of the wheels for the motion controller [rad/s].
    #[inline]
    fn measured(&self) -> [f32; N] {
        let mut speeds = self.wheels.map(|wheel| wheel.speed);
        if self.heading.has_gyro() {
            // ω̂_j ← ω̂_j − G_j·(0, 0, Δω)/r_j
            let turning = self.own_wheels.wheel_speeds(BodyTwist { v: 0.0, vn: 0.0, w: self.heading.correction() });
            for j in 0..N {
                speeds[j] -= turning[j];
            }
        }
        speeds
    }

    #[inline]
    fn tick(&mut self, bus: f32, want: BodyTwist) -> DriveOutput {
        let measured = Measurement { wheel_speed: self.measured(), bus };
        let want = self.limit_speed(want);
        let reference = self.memory.reference;
        let motors = self.controller.tick(&mut self.memory, &measured, want);
        if self.memory.reference == BodyTwist::default() {
            self.memory.integral = self.memory.integral.map(|force| INTEGRAL_DECAY * force);
        }
        let mut output = DriveOutput { reference, headroom: motors.headroom, ..DriveOutput::default() };
        for j in 0..N {
            output.current[j] = motors.current[j];
            output.wheel_speed[j] = self.wanted[j];
            // the current loop finds R·i by itself, and would overshoot if it were given
            let ahead =
                if self.controls_current { self.settings.robot.motor.resistance * motors.current[j] } else { 0.0 };
            output.voltage[j] = motors.voltage[j] - ahead;
        }
        output
    }
}

/// The largest accelerations of a robot that stops [m/s², m/s², rad/s²]: about the vertical, that of the outermost wheel.
fn stop_acceleration<const N: usize>(block: &Block<N>) -> [f32; 3] {
    let outermost = block.robot.wheels.wheels().iter().fold(0.0_f32, |most, wheel| most.max(wheel.distance));
    // α = a/d
    let stop = [STOP_ACCELERATION, STOP_ACCELERATION, STOP_ACCELERATION / outermost];
    core::array::from_fn(|k| stop[k].max(block.limits.acceleration[k]))
}

#[cfg(test)]
#[path = "drive_tests.rs"]
mod tests;
