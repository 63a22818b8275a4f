//! Robots of a kind, recorded and diagnosed one by one.

use std::path::Path;

use model_core::effects::nominal;
use omni_gap::engine::Knobs;
use omni_gap::log::{RobotFile, corrected};
use omni_gap::pooling::SessionEvidence;
use omni_gap::simulate::{EffectInstance, NominalKey};
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Diagnosis, Error, Options, Session, known_effects};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

/// How much of each robot is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Runs.
    pub runs: usize,
    /// How long each takes [s]
    pub duration: f64,
    /// Rows a second [Hz]
    pub rate: f64,
}

impl Length {
    /// Shorter than the benchmark's: 600 rows.
    pub const SHORT: Self = Self { runs: 3, duration: 2.0, rate: 100.0 };

    /// As the demonstration records: 30,000 rows.
    pub const FULL: Self = Self { runs: 10, duration: 6.0, rate: 500.0 };

    /// All rows.
    pub fn rows(self) -> usize {
        self.runs * (self.duration * self.rate).round() as usize
    }
}

/// Robots of a kind.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Their robot file.
    pub file: &'static str,
    /// How many.
    pub robots: usize,
    /// What all of them have.
    pub hidden: Vec<EffectInstance>,
    /// The share of the stated uncertainty's variance that is common to all \[1\]
    pub in_common: f64,
    /// How much of each is recorded.
    pub length: Length,
    /// Everything random.
    pub seed: u64,
}

impl Kind {
    /// A session of each.
    ///
    /// # Errors
    /// Where the file is no robot file.
    pub fn sessions(&self) -> Result<Vec<Session>, Error> {
        (0..self.robots).map(|robot| self.session(robot)).collect()
    }

    /// That of one robot.
    ///
    /// # Errors
    /// Where the file is no robot file.
    pub fn session(&self, robot: usize) -> Result<Session, Error> {
        let Length { runs, duration, rate } = self.length;
        let file = RobotFile::parse(self.file, Path::new("robot.toml"), &known_effects())?;
        let truth = self.truth(&file, robot)?;
        let seed = self.seed.wrapping_mul(7919).wrapping_add(robot as u64);
        let plan = Scenario {
            hidden: self.hidden.clone(),
            uncertain: false,
            runs,
            duration,
            rate,
            seed,
            ..Scenario::default()
        };
        let recorded = synthesize(&truth, &plan, &known_effects())?;
        Ok(Session { robot: file, robot_text: self.file.to_owned(), ..recorded })
    }

    /// The file with the robot's true numbers: off by √ρ times what is common, and √(1 − ρ) times its own.
    fn truth(&self, file: &RobotFile, robot: usize) -> Result<String, Error> {
        let mut of_kind = ChaCha8Rng::seed_from_u64(self.seed);
        let mut of_robot = ChaCha8Rng::seed_from_u64(self.seed.wrapping_mul(1_000_003).wrapping_add(1 + robot as u64));
        let mut changes = Vec::new();
        for number in nominal::numbers() {
            let (common, own): (f64, f64) = (StandardNormal.sample(&mut of_kind), StandardNormal.sample(&mut of_robot));
            let sigma = file.relative_uncertainty(number.key).unwrap_or(0.0);
            let off = (sigma * (self.in_common.sqrt() * common + (1.0 - self.in_common).sqrt() * own)).exp();
            changes.extend(NominalKey::of(number.key).into_iter().flat_map(|key| key.scaled(file, off)));
        }
        corrected(self.file, &changes)
    }

    /// What each robot's session says.
    ///
    /// # Errors
    /// Where the file is no robot file.
    pub fn evidence(&self, knobs: &Knobs) -> Result<Vec<SessionEvidence>, Error> {
        let sessions = self.sessions()?;
        Ok(sessions.par_iter().enumerate().map(|(robot, session)| evidence(robot, session, knobs)).collect())
    }
}

fn evidence(robot: usize, session: &Session, knobs: &Knobs) -> SessionEvidence {
    let found =
        Diagnosis::of(session, &Options { knobs: Knobs { equations: true, ..knobs.clone() }, ..Options::default() })
            .findings;
    SessionEvidence {
        session: format!("r{robot:02}"),
        robot: format!("r{robot:02}"),
        date: "2026-11-03".to_owned(),
        named: found.causes,
        equations: found.equations,
        ..SessionEvidence::default()
    }
}
