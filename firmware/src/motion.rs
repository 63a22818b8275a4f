//! # Motion: the turn of the robot, a thousand times a second
//!
//! ```text
//!  parameters      offsets learned      command
//! ASLEEP ────► CALIBRATING ────► OPEN ◄────────► DRIVING ── any fault ──► FAULTED ── clear ──► OPEN
//!                                     open
//!
//! OPEN ── probe ──► PROBING ── open, a command, other parameters, 200 ms without a probe ──► OPEN
//! ```
//!
//! A turn takes what the windings tell, has `model-core`'s controller decide, and asks the windings for currents and
//! voltages. It also watches what only shows over many periods: commands that end, for which the robot brakes
//! ([`crate::silence`]), a wheel that stands where it should turn ([`crate::stall`]), and a phase that carries nothing
//! ([`crate::open_phase`]).
//!
//! Nothing but a fresh command or probe ([`crate::probe`]) closes the bridges. They open, and wait for one, when the robot has
//! come to rest because none came, when a fault is cleared, when a wheel that was lost comes back, and when other parameters are
//! of another machine; parameters that only retune the same one are taken on the way.

use model_core::control::calibration::Calibration;
use model_core::control::drive::RobotDrive;
use model_core::control::interpolator::Interpolator;
use model_core::control::observer;
use model_core::geometry::frames::BodyTwist;
use model_core::link::command::{CommandError, Reply};
use model_core::link::events::{Event, Events};
use model_core::link::faults::{Fault, Faults};
use model_core::link::framing::FrameKind;
use model_core::link::hello::{Commutation, Hello, OFFSET_PARTS};
use model_core::link::probe::Probe;
use model_core::link::record::OperatingState;

use crate::codes::TICK_SECONDS;
use crate::configured_robot::ConfiguredRobot;
use crate::drivers::sensors::FittedSensors;
use crate::inbox::Inbox;
use crate::open_phase::OpenPhaseDetector;
use crate::probe::{ProbeVector, Prober};
use crate::silence::Silence;
use crate::stall::{StallDetector, StallLimits};
use crate::winding_config::WindingConfig;
use crate::winding_signals::{MotorSetpoints, WindingFeedback};

/// What a turn decided.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotionOutput {
    /// For the windings
    pub setpoints: MotorSetpoints,
    /// The voltage of a probe, for the windings
    pub probe: Option<ProbeVector>,
    /// Faults seen in this turn, for the windings to latch
    pub faults: Faults,
    /// One bit a motor that is stalled, to be taken out of use
    pub stalled: u8,
    /// One bit a motor of which a phase is open, to be taken out of use
    pub open_phase: u8,
    /// True: latched faults are to be forgotten
    pub clear: bool,
    /// What the robot is doing
    pub state: OperatingState,
    /// The motion that is being followed
    pub reference: BodyTwist,
    /// Share of the wanted acceleration that the voltage had room for [1]
    pub headroom: f32,
    /// Other parameters, for the windings
    pub config: Option<WindingConfig>,
    /// An answer to a command
    pub reply: Option<Reply>,
    /// How to read the records; none without parameters
    pub hello: Option<Hello>,
    /// What happened
    pub events: Events,
}

impl MotionOutput {
    /// What is latched in the windings, and what this turn found.
    pub fn all_faults(&self, feedback: &WindingFeedback) -> Faults {
        Faults::from_bits(feedback.faults.bits() | feedback.motor_faults.bits() | self.faults.bits())
    }
}

/// The motion turn and its memory.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motion {
    drive: Option<RobotDrive>,
    hello: Option<Hello>,
    state: OperatingState,
    commands: u32,
    silence: Silence,
    stall_detector: StallDetector,
    open_phase_detector: OpenPhaseDetector,
    prober: Prober,
    disabled: u8,
    /// Bus voltage when the robot was ready for the first time [V]
    bus_at_rest: Option<f32>,
}

/// What was heard since the last turn, but for what has been taken already.
#[derive(Clone, Copy, Debug)]
struct Heard {
    /// A command came
    fresh: bool,
    /// The bridges are to open
    opens: bool,
    /// Other parameters came
    parameters: bool,
    probe: Option<Probe>,
    /// The motor of the probe is there and may be used
    can_probe: bool,
}

impl Motion {
    /// Which gyro and encoders the robot has; none without parameters.
    pub fn fitted(&self) -> FittedSensors {
        self.hello.map_or(FittedSensors::default(), |hello| FittedSensors::of(&hello.sensors, hello.wheels))
    }

    /// One turn.
    pub fn tick(&mut self, feedback: &WindingFeedback, inbox: &mut Inbox) -> MotionOutput {
        let mut output = MotionOutput { reply: inbox.reply.take(), headroom: 1.0, ..MotionOutput::default() };
        let mut heard = self.hear(feedback, inbox, &mut output);
        self.listen_to_silence(feedback, &mut heard, &mut output);
        self.state = self.next_state(feedback, &heard, !output.faults.is_empty());
        self.probe(&heard, &mut output);
        output.state = self.state;
        self.watch_motors(feedback, &mut output);
        if let Some(drive) = self.drive.as_mut().filter(|drive| drive.heading().has_gyro()) {
            drive.observe_yaw(feedback.sensors.yaw(), &feedback.since_edge);
        }
        if self.state == OperatingState::Driving {
            self.follow(feedback, &mut inbox.wanted, &mut output);
        } else {
            self.stall_detector = StallDetector::default();
            self.open_phase_detector = OpenPhaseDetector::default();
            if let Some(drive) = &mut self.drive {
                drive.reset();
            }
        }
        output
    }

    /// Takes what the link has brought.
    fn hear(&mut self, feedback: &WindingFeedback, inbox: &mut Inbox, output: &mut MotionOutput) -> Heard {
        let mut opens = inbox.open;
        let parameters = inbox.parameters.is_some();
        if let Some(robot) = &inbox.parameters {
            opens |= self.set_parameters(robot, output);
            inbox.parameters = None;
        }
        if core::mem::take(&mut inbox.bad_command) {
            output.faults.add(Fault::BadCommand);
        }
        if core::mem::take(&mut inbox.bad_block) {
            output.faults.add(Fault::BadBlock);
        }
        if core::mem::take(&mut inbox.clear) {
            output.clear = true;
            output.events.add(Event::Cleared);
            opens |= self.disabled != 0;
        }
        if inbox.unsaved {
            output.events.add(Event::Unsaved);
        }
        if !feedback.silent_sensors.is_empty() {
            output.events.add(Event::SensorSilent);
        }
        let fresh = inbox.commands != self.commands;
        self.commands = inbox.commands;
        self.hello = self.hello.map(|hello| with_offsets(hello, feedback));
        output.hello = self.hello;
        let probe = inbox.probe.take();
        let can_probe = probe.is_some_and(|probe| self.can_probe(probe, feedback));
        Heard { fresh, opens, parameters, probe, can_probe }
    }

    /// Takes other parameters; true if they are of another machine than those before. All that takes long was made of them
    /// before, by whoever received them.
    #[inline(never)]
    fn set_parameters(&mut self, robot: &ConfiguredRobot, output: &mut MotionOutput) -> bool {
        let mut drive = robot.drive;
        if let Some(old) = &self.drive {
            drive.take_over(old);
        }
        drive.exclude_motors(self.disabled);
        if let Some(bus) = self.bus_at_rest {
            drive.set_bus_at_rest(bus);
        }
        self.drive = Some(drive);
        let same = self.hello.is_some_and(|before| machine(&before) == machine(&robot.hello));
        self.hello = Some(robot.hello);
        output.config = Some(robot.windings);
        output.events.add(Event::Parameters);
        !same
    }

    /// Counts the turns without a command; the bridges are to open once a robot that heard none has come to rest.
    fn listen_to_silence(&mut self, feedback: &WindingFeedback, heard: &mut Heard, output: &mut MotionOutput) {
        self.silence.tick(heard.fresh, self.state == OperatingState::Driving);
        if !feedback.faults.is_empty() || !output.faults.is_empty() || heard.opens {
            self.silence = Silence::default();
        }
        heard.opens |= self.silence.is_over();
        if self.silence.lasts() {
            output.events.add(Event::Silent);
        }
    }

    /// What the robot does in this turn.
    fn next_state(&self, feedback: &WindingFeedback, heard: &Heard, new_fault: bool) -> OperatingState {
        let Heard { fresh, opens, parameters, can_probe, .. } = *heard;
        match self.state {
            _ if new_fault || !feedback.faults.is_empty() => OperatingState::Faulted,
            _ if self.drive.is_none() => OperatingState::Asleep,
            _ if !feedback.ready => OperatingState::Calibrating,
            OperatingState::Asleep | OperatingState::Calibrating | OperatingState::Faulted => OperatingState::Open,
            OperatingState::Open if fresh && !opens => OperatingState::Driving,
            OperatingState::Open if can_probe && !opens => OperatingState::Probing,
            OperatingState::Driving if opens => OperatingState::Open,
            OperatingState::Probing if opens || fresh || parameters => OperatingState::Open,
            state => state,
        }
    }

    /// Which motors are in use, how warm they are, and the bus before anything was driven.
    fn watch_motors(&mut self, feedback: &WindingFeedback, output: &mut MotionOutput) {
        let Some(drive) = &mut self.drive else { return };
        if feedback.disabled != self.disabled {
            self.disabled = feedback.disabled;
            drive.exclude_motors(self.disabled);
        }
        if self.disabled != 0 {
            output.events.add(Event::WheelLost);
        }
        if drive.heat(&feedback.current) {
            output.events.add(Event::FoldBack);
        }
        if self.state == OperatingState::Open && self.bus_at_rest.is_none() {
            self.bus_at_rest = Some(feedback.bus);
            drive.set_bus_at_rest(feedback.bus);
        }
    }

    /// Follows a wanted motion, or brakes where nobody commands one.
    fn follow(&mut self, feedback: &WindingFeedback, wanted: &mut Interpolator, output: &mut MotionOutput) {
        let Some(drive) = &mut self.drive else { return };
        let wheels = core::array::from_fn(|j| observer::HallReading {
            edges: feedback.edges[j],
            since_edge: feedback.since_edge[j],
            speed: feedback.wheel_speed[j],
        });
        drive.stop_hard(self.silence.lasts());
        let want = if self.silence.lasts() { BodyTwist::default() } else { wanted.tick(TICK_SECONDS) };
        let drive_output = drive.tick(&wheels, feedback.bus, want);
        self.silence.followed(drive_output.reference);
        output.reference = drive_output.reference;
        output.headroom = drive_output.headroom;
        if drive_output.headroom < 1.0 {
            output.events.add(Event::Saturated);
        }
        output.setpoints = MotorSetpoints {
            current: drive_output.current,
            voltage: drive_output.voltage,
            closed: drive.controls_current(),
            enabled: drive.motors() & !self.disabled,
        };
        let Some(Hello { calibration, gear_ratio, .. }) = self.hello else { return };
        output.open_phase = self.open_phase_detector.tick(feedback, calibration.amps_per_count, drive.current_limit());
        let edge = calibration.edge_angle(gear_ratio);
        let others = drive.told_by_others(&feedback.wheel_speed);
        let limits = StallLimits { others, current: drive.current_limit(), edge };
        output.stalled = self.stall_detector.tick(feedback, &drive_output, &limits);
    }

    /// True for a motor that the robot has and that may be used.
    fn can_probe(&self, probe: Probe, feedback: &WindingFeedback) -> bool {
        let motors = self.drive.as_ref().map_or(0, RobotDrive::motors);
        (motors & !feedback.disabled) >> (probe.motor & 7) & 1 != 0
    }

    /// A turn of the probe, where one is on; one that is asked for in vain is refused.
    fn probe(&mut self, heard: &Heard, output: &mut MotionOutput) {
        let (asked, possible) = (heard.probe, heard.can_probe);
        if self.state != OperatingState::Probing {
            self.prober.end();
            let is_open = self.state == OperatingState::Open;
            let error = if is_open && !possible { CommandError::NoSuchProbe } else { CommandError::NotOpen };
            let refused = Reply { to: FrameKind::Probe.code(), taken: false, reason: error.code() };
            output.reply = output.reply.or(asked.map(|_| refused));
            return;
        }
        if let Some(probe) = asked.filter(|_| possible) {
            self.prober.take(probe);
        }
        output.probe = self.prober.tick();
        if output.probe.is_none() {
            self.state = OperatingState::Open;
        }
    }
}

/// What must not change under a bridge that is closed.
fn machine(hello: &Hello) -> (u8, Commutation, Calibration, f32) {
    (hello.wheels, hello.commutation, hello.calibration, hello.gear_ratio)
}

/// The same with the converters' zeros as they are known now, in 1/16 counts.
fn with_offsets(hello: Hello, feedback: &WindingFeedback) -> Hello {
    let offsets = feedback.offsets.map(|phases| phases.map(|zero| (zero * f32::from(OFFSET_PARTS)) as u16));
    Hello { offsets, ..hello }
}
