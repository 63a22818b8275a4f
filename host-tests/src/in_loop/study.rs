//! # Study: every scenario, on both robots, with many seeds in software and one in the emulator
//!
//! The same [`play`] runs on either brain. What the image leaves behind must be, bit for bit, what the library called on
//! the host leaves; only load and jitter, which take a clock, may differ.

use model_core::geometry::frames::Pose;
use model_core::link::block::Block;
use model_core::link::record::{OperatingState, TelemetryRecord};
use model_core::plant::robot::Robot;

use super::eight::{self, Path, Tracked};
use super::ramps::{self, Ramp};
use super::robots::{self, AnyBlock};
use super::saturation::{self, Aside};
use super::silence::{self, Silence};
use super::{Ride, Software, Taken};
use crate::emulator::{Brain, Trouble};
use crate::virtual_board::{Setup, VirtualBoard};

/// The seeds; the first one is played in the emulator too. Nobody chose them by result.
pub const SEEDS: [u64; 8] = [1, 2, 3, 4, 5, 6, 7, 8];

/// What is done with a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scenario {
    /// Ramps on one axis
    Ramps(usize),
    /// The figure-eight
    Eight,
    /// The same without the model's feedforward
    EightByFeedback,
    /// A diagonal acceleration that does not fit
    Saturation,
    /// Commands that end
    Silence,
}

impl Scenario {
    /// All of them, the longest first.
    pub const ALL: [Self; 7] = [
        Self::Ramps(0),
        Self::Ramps(1),
        Self::Ramps(2),
        Self::EightByFeedback,
        Self::Eight,
        Self::Silence,
        Self::Saturation,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ramps(0) => "ramps along v",
            Self::Ramps(1) => "ramps along vn",
            Self::Ramps(_) => "ramps about the vertical",
            Self::Eight => "figure-eight",
            Self::EightByFeedback => "figure-eight, feedback alone",
            Self::Saturation => "diagonal into saturation",
            Self::Silence => "commands end",
        }
    }
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Came {
    /// of ramps
    Ramps(Vec<Ramp>),
    /// of a figure-eight
    Eight(Tracked),
    /// of a saturation
    Saturation(Aside),
    /// of commands that end
    Silence(Silence),
}

/// A run.
#[derive(Clone, Debug)]
pub struct Run {
    /// What was measured
    pub came: Came,
    /// All that it left behind
    pub taken: Taken,
}

/// A robot of the paper as it is believed to be, in both precisions.
#[derive(Clone, Copy, Debug)]
pub struct Believed<const N: usize> {
    /// For the host
    pub host: Robot<N, f64>,
    /// For its block
    pub robot: Robot<N, f32>,
}

impl<const N: usize> Believed<N>
where
    Block<N>: AnyBlock,
{
    /// Its block.
    pub fn block(&self) -> Block<N> {
        robots::block(self.robot)
    }

    /// The board that a seed draws.
    pub fn board(&self, seed: u64) -> Setup<N> {
        robots::board(&self.host, seed)
    }

    /// Lets a program play a scenario.
    ///
    /// # Errors
    /// [`Trouble`] says what became of the program.
    pub fn play<B: Brain>(&self, brain: B, scenario: Scenario, seed: u64) -> Result<(Run, Ride<B, N>), Trouble> {
        let mut ride = Ride::new(brain, VirtualBoard::moving(self.board(seed), Pose::default(), Default::default()));
        let mut block = self.block();
        let came = match scenario {
            Scenario::Ramps(axis) => Came::Ramps(ramps::play(&mut ride, &block, axis)?),
            Scenario::Saturation => Came::Saturation(saturation::play(&mut ride, &block)?),
            Scenario::Eight | Scenario::EightByFeedback => {
                block.feedforward = scenario == Scenario::Eight;
                block.limits.acceleration = [eight::ACCELERATION, eight::ACCELERATION, 30.0];
                ride.send_block(&block.parameters());
                ride.wait(0.15)?;
                Came::Eight(Path::default().play(&mut ride)?)
            }
            Scenario::Silence => {
                ride.send_block(&block.parameters());
                ride.wait(0.15)?;
                Came::Silence(silence::play(&mut ride)?)
            }
        };
        Ok((Run { came, taken: ride.taken.clone() }, ride))
    }

    /// The same in software, which has no trouble.
    pub fn in_software(&self, scenario: Scenario, seed: u64) -> Run {
        self.play(Software::default(), scenario, seed).expect("software does not fail").0
    }
}

/// What differs first between two runs of the same, bit for bit; load and jitter apart, unless `clocked`.
pub fn difference(one: &Taken, other: &Taken, clocked: bool) -> Option<String> {
    let (n, m) = (one.records.len(), other.records.len());
    if n != m {
        return Some(format!("{n} records against {m}"));
    }
    let bits = |record: &TelemetryRecord| {
        let clock = if clocked { (record.load, record.jitter) } else { (0, 0) };
        TelemetryRecord { load: clock.0, jitter: clock.1, ..*record }.to_bytes()
    };
    for (a, b) in one.records.iter().zip(&other.records) {
        if bits(a) != bits(b) {
            return Some(format!("record {}: {a:?} against {b:?}", a.sequence));
        }
    }
    if one.moments != other.moments {
        return Some("the motion, though not the records".into());
    }
    (one.replies != other.replies).then(|| "the answers to commands".into())
}

/// Worst load [‰] and jitter [cycles] that a program told while it drove.
pub fn load(taken: &Taken) -> [u16; 2] {
    let driving = taken.records.iter().filter(|record| record.state == OperatingState::Driving);
    driving.fold([0; 2], |[load, jitter], record| [load.max(record.load), jitter.max(record.jitter)])
}
