//! # Modern: a robot as they are built today, with what robots really have
//!
//! `examples/ssl-24v` is believed. The robot that is driven is off by the draws of [`robots`](mod@robots), and has besides what no block
//! undoes, every number of a seed drawn evenly between two ends:
//!
//! | what | drawn |
//! |---|---|
//! | floor that holds so much of the weight (`wheel_slip`) | μ 0.9 to 1.1, which 4 m/s² take |
//! | rollers (`roller_ripple`), each wheel with a phase of its own | 15 of them, 0 to 0.5 % of the radius |
//! | play of the gear (`backlash`) | 0.005 to 0.015 rad at the wheel |
//! | rotors and wheels (`rotor_inertia`), which the block knows | off by up to 10 % |
//! | battery (`supply_sag`) | 0.1 Ω |
//! | hall switches | up to 5° (electrical) off their places, and undecided within 0.5° of an edge: several edges around a slow switching |
//! | link | commands up to 5 ms late, each by another time |
//!
//! Fifteen rollers: Robotics Erlangen, robotics-erlangen.de/small-size-league/mechanics; the sizes of play and ripple are those of
//! their cards; the floor, the battery and the chatter are estimates.
//!
//! Three laws drive it: the firmware's, the same without the model's feedforward, and wheel speeds by [`WheelPi`] with gains that
//! [`tuned`] found on other seeds.

pub mod page;

use std::f64::consts::TAU;
use std::path::Path;

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::geometry::frames::Pose;
use model_core::link::block::{Block, Parameters};
use model_core::plant::robot::Robot;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::robot_of;
use omni_gap::wire::block::export;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::figure_eight::{Commands, FigureEight, TrackingError};
use super::ramps::{self, Ramp};
use super::robots::{self, HALL_SPREAD, ToParameters};
use super::saturation::{self, DirectionError};
use super::wheel_pi::WheelPi;
use super::{ClosedLoopRun, HostProgram};
use crate::emulator::{BoardProgram, RunError};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// The robot file.
const FILE: &str = include_str!("../../../examples/ssl-24v/robot.toml");

/// Half the length [m] and the speed [m/s] of its figure-eight, which takes 3.4 m/s².
pub const EIGHT: [f64; 2] = [2.0, 1.5];

/// Largest current in the ride that it binds [A].
pub const BOUND_CURRENT: f32 = 1.0;

/// How late commands are at the most [s].
const JITTER: f64 = 5e-3;

/// How far from its edge a hall switch is undecided [°, electrical]: noise of a hundredth of the magnet's field.
pub const CHATTER: f64 = 0.5;

/// Internal resistance of the battery [Ω].
const SAG: f64 = 0.1;

/// k_p [A·s/rad] that are tried for the wheels' own controllers.
const PROPORTIONAL: [f32; 5] = [0.1, 0.2, 0.4, 0.8, 1.6];

/// k_i over k_p [1/s] that are tried with them.
const RATES: [f32; 4] = [0.3, 1.0, 3.0, 10.0];

/// Seeds that they are tuned on; none of them is judged.
pub const TUNING: [u64; 3] = [1001, 1002, 1003];

/// What decides of the motors' currents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// The firmware's, with the model ahead
    Model,
    /// The firmware's, by feedback alone
    FeedbackAlone,
    /// Wheel speeds, k_p [A·s/rad] and k_i [A/rad]
    WheelPi([f32; 2]),
}

/// What is done with the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ride {
    /// Ramps on one axis
    Ramps(usize),
    /// The figure-eight
    FigureEight,
    /// A diagonal acceleration for which the motors' currents are not enough
    Bound,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// of ramps
    Ramps(Vec<Ramp>),
    /// of the figure-eight
    FigureEight(TrackingError),
    /// of currents that are bound
    Bound(DirectionError),
}

/// The robot as it is believed to be.
#[derive(Clone, Copy, Debug)]
pub struct ModernRobot {
    host: Robot<4, f64>,
    block: Block<4>,
    /// How far from its edge a hall switch is undecided [°, electrical]
    pub chatter: f64,
}

impl Default for ModernRobot {
    /// As its file says.
    ///
    /// # Panics
    /// Where the file is not one of a robot with four wheels.
    fn default() -> Self {
        let path = Path::new("examples/ssl-24v/robot.toml");
        let file = RobotFile::parse(FILE, path, &known_effects()).expect("a robot file");
        let exported = export(&file, path).expect("a robot file that can be exported");
        let Ok(Parameters::Four(block)) = Parameters::decode(&exported.bytes) else { panic!("a block of four wheels") };
        Self { host: robot_of(&file, 0.0), block, chatter: CHATTER }
    }
}

impl ModernRobot {
    /// The board that a seed draws.
    pub fn board(&self, seed: u64) -> BoardSetup<4> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0x0da_7a5);
        let mut effects = Effects::default();
        let mut add = |id: &str, wheel: Option<usize>, params: &[f64]| {
            let kind = EffectKind::find(id).expect("an effect's id");
            effects.add(kind, wheel, params).expect("parameters of its card");
        };
        add("supply_sag", None, &[SAG, 0.0]);
        add("wheel_slip", None, &[rng.random_range(0.9..1.1), 30.0, 1.0, 0.0, 0.0]);
        for wheel in 0..4 {
            let (size, phase) = (rng.random_range(0.0..0.005), rng.random_range(0.0..TAU));
            add("roller_ripple", Some(wheel), &[size * phase.cos(), size * phase.sin(), 15.0]);
        }
        let known = self.block.effects.iter().find(|effect| effect.id() == "rotor_inertia");
        let inertia = known.map_or(0.0, |effect| f64::from(effect.params()[0])) * rng.random_range(0.9..1.1);
        add("rotor_inertia", None, &[inertia]);
        add("backlash", None, &[rng.random_range(0.005..0.015), 200.0, 2e-4, inertia]);
        BoardSetup {
            hall_spread: HALL_SPREAD,
            hall_chatter: self.chatter.to_radians(),
            inductance: f64::from(self.block.inductance),
            pole_pairs: self.block.pole_pairs,
            ..BoardSetup::new(robots::perturbed(&self.host, seed), effects, seed)
        }
    }

    /// True radius and true distance of a seed's wheels over what is believed of them [1].
    pub fn geometry(&self, seed: u64) -> [f64; 2] {
        robots::geometry(&self.host, &robots::perturbed(&self.host, seed))
    }

    /// Lets a program take a ride by a law that it has itself.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn run<B: BoardProgram>(
        &self,
        program: B,
        ride: Ride,
        law: Law,
        seed: u64,
    ) -> Result<(Outcome, ClosedLoopRun<B, 4>), RunError> {
        let board = VirtualBoard::moving(self.board(seed), Pose::default(), Default::default());
        let mut run = ClosedLoopRun::new(program, board);
        run.make_late(JITTER, seed);
        let mut block = self.block;
        block.feedforward = law == Law::Model;
        if let Law::WheelPi(_) = law {
            (block.feedback, block.feedback_integral) = (0.0, 0.0);
        }
        let outcome = match ride {
            Ride::Ramps(axis) => Outcome::Ramps(ramps::measure(&mut run, &block, axis)?),
            Ride::FigureEight => {
                run.send_block(&block.parameters());
                run.wait(0.15)?;
                let [radius, _] = self.geometry(seed);
                Outcome::FigureEight(FigureEight::new(EIGHT).track(&mut run, Commands::Ramp, radius)?)
            }
            Ride::Bound => {
                block.limits.current = BOUND_CURRENT;
                block.continuous_current = BOUND_CURRENT;
                Outcome::Bound(saturation::measure(&mut run, &block)?)
            }
        };
        Ok((outcome, run))
    }

    /// The same in software.
    pub fn on_host(&self, ride: Ride, law: Law, seed: u64) -> Outcome {
        let program = match law {
            Law::WheelPi(gains) => {
                let most = if ride == Ride::Bound { BOUND_CURRENT } else { self.block.limits.current };
                HostProgram::with_wheel_pi(WheelPi::new(self.block.robot.wheels, gains, most))
            }
            _ => HostProgram::default(),
        };
        self.run(program, ride, law, seed).expect("software does not fail").0
    }
}

/// The gains of the wheels' own controllers that follow the figure-eight best on [`TUNING`]: least velocity error, root mean
/// square over the seeds.
pub fn tuned(robot: &ModernRobot) -> [f32; 2] {
    let grid: Vec<[f32; 2]> = PROPORTIONAL.iter().flat_map(|p| RATES.map(|rate| [*p, rate * p])).collect();
    let error = |gains: &[f32; 2]| {
        let of = |seed: &u64| match robot.on_host(Ride::FigureEight, Law::WheelPi(*gains), *seed) {
            Outcome::FigureEight(error) => error.velocity.powi(2),
            _ => f64::INFINITY,
        };
        TUNING.iter().map(of).sum::<f64>()
    };
    let errors: Vec<(f64, [f32; 2])> = grid.par_iter().map(|gains| (error(gains), *gains)).collect();
    errors.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or([0.0; 2], |(_, gains)| gains)
}
