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
//! ([`crate::silence`]), and a wheel that stands where it should turn ([`crate::stall`]).
//!
//! Nothing but a fresh command or probe ([`crate::probe`]) closes the bridges. They open, and wait for one, when the robot has
//! come to rest because none came, when a fault is cleared, when a wheel that was lost comes back, and when other parameters are
//! of another machine; parameters that only retune the same one are taken on the way.

use model_core::control::calibration::Calibration;
use model_core::control::drive::RobotDrive;
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
use crate::command_receiver::AcceptedParameters;
use crate::inbox::Inbox;
use crate::probe::{ProbeVector, Prober};
use crate::silence::Silence;
use crate::stall::{StallDetector, StallLimits};
use crate::winding_config::{MAX_DUTY, WindingConfig};
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

/// The motion turn and its memory.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motion {
    drive: Option<RobotDrive>,
    hello: Option<Hello>,
    state: OperatingState,
    commands: u32,
    silence: Silence,
    stall_detector: StallDetector,
    prober: Prober,
    disabled: u8,
    /// Bus voltage when the robot was ready for the first time [V]
    bus_at_rest: Option<f32>,
}

impl Motion {
    /// Takes other parameters; true if they are of another machine than those before.
    #[inline(never)]
    fn set_parameters(&mut self, accepted: &AcceptedParameters, output: &mut MotionOutput) -> bool {
        let parameters = &accepted.parameters;
        let config = WindingConfig::of(parameters);
        let mut drive = RobotDrive::new(parameters, MAX_DUTY, TICK_SECONDS);
        if let Some(old) = &self.drive {
            drive.take_over(old);
        }
        drive.exclude_motors(self.disabled);
        if let Some(bus) = self.bus_at_rest {
            drive.set_bus_at_rest(bus);
        }
        self.drive = Some(drive);
        let hello = config.hello(parameters, accepted.check);
        let same = self.hello.is_some_and(|before| machine(&before) == machine(&hello));
        self.hello = Some(hello);
        output.config = Some(config);
        output.events.add(Event::Parameters);
        !same
    }

    /// One turn.
    pub fn tick(&mut self, feedback: &WindingFeedback, inbox: &mut Inbox) -> MotionOutput {
        let mut output = MotionOutput { reply: inbox.reply.take(), headroom: 1.0, ..MotionOutput::default() };
        let mut opens = inbox.open;
        if let Some(accepted) = inbox.parameters.take() {
            opens |= self.set_parameters(&accepted, &mut output);
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
        let fresh = inbox.commands != self.commands;
        self.commands = inbox.commands;
        self.hello = self.hello.map(|hello| with_offsets(hello, feedback));
        output.hello = self.hello;

        let asked = inbox.probe.take();
        let possible = asked.is_some_and(|probe| self.can_probe(probe, feedback));
        let before = self.state;
        let faulty = !feedback.faults.is_empty() || !output.faults.is_empty();
        self.silence.tick(fresh, before == OperatingState::Driving);
        if faulty || opens {
            self.silence = Silence::default();
        }
        opens |= self.silence.is_over();
        self.state = match before {
            _ if faulty => OperatingState::Faulted,
            _ if self.drive.is_none() => OperatingState::Asleep,
            _ if !feedback.ready => OperatingState::Calibrating,
            OperatingState::Asleep | OperatingState::Calibrating | OperatingState::Faulted => OperatingState::Open,
            OperatingState::Open if fresh && !opens => OperatingState::Driving,
            OperatingState::Open if possible && !opens => OperatingState::Probing,
            OperatingState::Driving if opens => OperatingState::Open,
            OperatingState::Probing if opens || fresh || output.config.is_some() => OperatingState::Open,
            stage => stage,
        };
        self.probe(asked, possible, &mut output);
        output.state = self.state;
        if self.silence.lasts() {
            output.events.add(Event::Silent);
        }
        let Some(drive) = &mut self.drive else { return output };
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
        if self.state != OperatingState::Driving {
            drive.reset();
            self.stall_detector = StallDetector::default();
            return output;
        }
        let wheels = core::array::from_fn(|j| observer::HallReading {
            edges: feedback.edges[j],
            since_edge: feedback.since_edge[j],
            speed: feedback.wheel_speed[j],
        });
        drive.stop_hard(self.silence.lasts());
        let want = if self.silence.lasts() { BodyTwist::default() } else { inbox.twist };
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
        let edge = self.hello.map_or(0.0, |hello| hello.calibration.edge_angle(hello.gear_ratio));
        let others = drive.told_by_others(&feedback.wheel_speed);
        let limits = StallLimits { others, current: drive.current_limit(), edge };
        output.stalled = self.stall_detector.tick(feedback, &drive_output, &limits);
        output
    }
}

impl Motion {
    /// True for a motor that the robot has and that may be used.
    fn can_probe(&self, probe: Probe, feedback: &WindingFeedback) -> bool {
        let motors = self.drive.as_ref().map_or(0, RobotDrive::motors);
        (motors & !feedback.disabled) >> (probe.motor & 7) & 1 != 0
    }

    /// A turn of the probe, where one is on; one that is asked for in vain is refused.
    fn probe(&mut self, asked: Option<Probe>, possible: bool, output: &mut MotionOutput) {
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
