//! # Motion: the turn of the robot, a thousand times a second
//!
//! ```text
//!  parameters      offsets learned      command
//! ASLEEP ────► CALIBRATING ────► OPEN ◄────────► DRIVING ── any fault ──► FAULTED ── clear ──► OPEN
//!                                     open
//! ```
//!
//! A turn takes what the windings tell, has `model-core`'s controller decide, and asks the windings for currents and
//! voltages. It also watches what only shows over many periods: a silent command, a wheel that stands where it should
//! turn ([`crate::stall`]).
//!
//! Nothing but a fresh command closes the bridges. They open, and wait for one, when a fault is cleared, when a wheel that
//! was lost comes back, and when other parameters are of another machine; parameters that only retune the same one are
//! taken on the way.

use model_core::control::calibration::Calibration;
use model_core::control::drive::RobotDrive;
use model_core::control::observer;
use model_core::geometry::frames::BodyTwist;
use model_core::link::command::Reply;
use model_core::link::faults::{Fault, Faults};
use model_core::link::hello::{Commutation, Hello, OFFSET_PARTS};
use model_core::link::record::OperatingState;

use crate::codes::{PERIODS_PER_SECOND, PERIODS_PER_TURN};
use crate::inbox::Inbox;
use crate::listener::Accepted;
use crate::setup::{MAX_DUTY, Setup};
use crate::stall::Stalls;
use crate::windings::{Ask, Told};

/// Turns without a command after which the robot stops: 200 ms.
pub const SILENT_TURNS: u16 = 200;

/// Length of a turn [s].
pub(crate) const TURN: f32 = PERIODS_PER_TURN as f32 / PERIODS_PER_SECOND as f32;

/// What a turn decided.
#[derive(Clone, Copy, Debug, Default)]
pub struct Turn {
    /// For the windings
    pub ask: Ask,
    /// Faults seen in this turn, for the windings to latch
    pub faults: Faults,
    /// One bit a motor that is stalled, to be taken out of use
    pub stalled: u8,
    /// True: latched faults are to be forgotten
    pub clear: bool,
    /// What the robot is doing
    pub stage: OperatingState,
    /// The motion that is being followed
    pub reference: BodyTwist,
    /// Share of the wanted acceleration that the voltage had room for [1]
    pub headroom: f32,
    /// Other parameters, for the windings
    pub setup: Option<Setup>,
    /// An answer to a command
    pub reply: Option<Reply>,
    /// How to read the records; none without parameters
    pub hello: Option<Hello>,
    /// What happened: [`events`]
    pub events: u8,
}

/// Bits of [`Turn::events`].
pub mod events {
    /// Other parameters were taken: records read differently from here on
    pub const PARAMETERS: u8 = 1;
    /// The voltage or the current had no room for all that was wanted
    pub const SATURATED: u8 = 2;
    /// A wheel is out of use
    pub const WHEEL_LOST: u8 = 4;
    /// Latched faults were forgotten
    pub const CLEARED: u8 = 8;
}

/// The motion turn and its memory.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motion {
    mover: Option<RobotDrive>,
    hello: Option<Hello>,
    stage: OperatingState,
    commands: u32,
    silent: u16,
    stalls: Stalls,
    lost: u8,
}

impl Motion {
    /// Takes other parameters; true if they are of another machine than those before.
    #[inline(never)]
    fn swap(&mut self, accepted: &Accepted, turn: &mut Turn) -> bool {
        let parameters = &accepted.parameters;
        let setup = Setup::of(parameters);
        let mut mover = RobotDrive::new(parameters, MAX_DUTY, TURN);
        if let Some(old) = &self.mover {
            mover.take_over(old);
        }
        mover.exclude_motors(self.lost);
        self.mover = Some(mover);
        let hello = setup.hello(parameters, accepted.check);
        let same = self.hello.is_some_and(|before| machine(&before) == machine(&hello));
        self.hello = Some(hello);
        turn.setup = Some(setup);
        turn.events |= events::PARAMETERS;
        !same
    }

    /// One turn.
    pub fn turn(&mut self, told: &Told, inbox: &mut Inbox) -> Turn {
        let mut turn = Turn { reply: inbox.reply.take(), headroom: 1.0, ..Turn::default() };
        let mut opens = inbox.open;
        if let Some(accepted) = inbox.parameters.take() {
            opens |= self.swap(&accepted, &mut turn);
        }
        if core::mem::take(&mut inbox.bad_command) {
            turn.faults.add(Fault::BadCommand);
        }
        if core::mem::take(&mut inbox.bad_block) {
            turn.faults.add(Fault::BadBlock);
        }
        if core::mem::take(&mut inbox.clear) {
            turn.clear = true;
            turn.events |= events::CLEARED;
            opens |= self.lost != 0;
        }
        let fresh = inbox.commands != self.commands;
        self.commands = inbox.commands;
        self.silent = if fresh { 0 } else { self.silent.saturating_add(1) };
        if self.stage == OperatingState::Driving && self.silent >= SILENT_TURNS {
            turn.faults.add(Fault::CommandSilent);
        }
        self.hello = self.hello.map(|hello| with_offsets(hello, told));
        turn.hello = self.hello;

        let before = self.stage;
        let faulty = !told.faults.is_empty() || !turn.faults.is_empty();
        self.stage = match before {
            _ if faulty => OperatingState::Faulted,
            _ if self.mover.is_none() => OperatingState::Asleep,
            _ if !told.ready => OperatingState::Calibrating,
            OperatingState::Asleep | OperatingState::Calibrating | OperatingState::Faulted => OperatingState::Open,
            OperatingState::Open if fresh && !opens => OperatingState::Driving,
            OperatingState::Driving if opens => OperatingState::Open,
            stage => stage,
        };
        turn.stage = self.stage;
        let Some(mover) = &mut self.mover else { return turn };
        if told.lost != self.lost {
            self.lost = told.lost;
            mover.exclude_motors(self.lost);
        }
        if self.lost != 0 {
            turn.events |= events::WHEEL_LOST;
        }
        if self.stage != OperatingState::Driving {
            mover.reset();
            self.stalls = Stalls::default();
            return turn;
        }
        let wheels = core::array::from_fn(|j| observer::HallReading {
            edges: told.edges[j],
            since_edge: told.since_edge[j],
            speed: told.wheel_speed[j],
        });
        let moved = mover.tick(&wheels, told.bus, inbox.twist);
        turn.reference = moved.reference;
        turn.headroom = moved.headroom;
        if moved.headroom < 1.0 {
            turn.events |= events::SATURATED;
        }
        turn.ask = Ask {
            current: moved.current,
            voltage: moved.voltage,
            closed: mover.controls_current(),
            enabled: mover.motors() & !self.lost,
        };
        let edge = self.hello.map_or(0.0, |hello| hello.calibration.edge_angle(hello.gear_ratio));
        turn.stalled = self.stalls.turn(told, &moved, mover.current_limit(), edge);
        turn
    }
}

/// What must not change under a bridge that is closed.
fn machine(hello: &Hello) -> (u8, Commutation, Calibration, f32) {
    (hello.wheels, hello.commutation, hello.calibration, hello.gear_ratio)
}

/// The same with the converters' zeros as they are known now, in 1/16 counts.
fn with_offsets(hello: Hello, told: &Told) -> Hello {
    let offsets = told.offsets.map(|phases| phases.map(|zero| (zero * f32::from(OFFSET_PARTS)) as u16));
    Hello { offsets, ..hello }
}
