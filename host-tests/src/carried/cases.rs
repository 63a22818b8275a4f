//! The robots, what their files have wrong, and what is found.

use std::path::Path;

use model_core::effects::card::{Param, Role};
use model_core::effects::shows::Order;
use omni_gap::api::{Identification, identify};
use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::{Change, EffectEntry, RobotFile, Session, corrected};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};

use crate::catalogue::sessions::{BenchmarkCase, HiddenCause, Staging, effects_on_both};

/// The seed of the first robot; the others count up from it. Nobody chose them by result.
const FIRST_SEED: u64 = 7000;

/// What a file's sizes are of the true ones' departure from absent [1].
pub const OFF: f64 = 0.7;

/// A robot with an effect that its file has too small.
#[derive(Clone, Debug)]
pub struct CarriedCase {
    /// The effect as it is.
    pub effect: EffectInstance,
    staged: BenchmarkCase,
}

/// Every effect of the catalogue on both robots.
pub fn cases() -> Vec<CarriedCase> {
    let staged = effects_on_both(FIRST_SEED, Staging::Short);
    let case = |staged: BenchmarkCase| match &staged.hidden {
        HiddenCause::Effect(effect) => Some(CarriedCase { effect: effect.clone(), staged }),
        HiddenCause::Nothing | HiddenCause::Parameter(_) => None,
    };
    staged.into_iter().filter_map(case).collect()
}

/// A robot file's text with an effect in it, its sizes at a share of their departure from absent.
fn with_effect(text: &str, effect: &EffectInstance, share: f64) -> Result<String> {
    let number = |(p, x): (&Param, &f64)| {
        let x = if p.role == Role::Size { p.absent + share * (x - p.absent) } else { *x };
        (p.key.to_owned(), x)
    };
    let params = effect.card().params.iter().zip(&effect.params).map(number).collect();
    corrected(text, &[Change::Effect(EffectEntry { id: effect.id.to_owned(), wheel: effect.wheel, params })])
}

impl CarriedCase {
    /// Wheels of its robot.
    pub fn wheels(&self) -> usize {
        self.staged.wheels
    }

    /// What is recorded: the effect stands in the files, none is hidden.
    fn plan(&self) -> Scenario {
        Scenario { hidden: Vec::new(), ..self.staged.plan() }
    }

    /// Its recordings, and its robot file with the effect too small.
    ///
    /// # Errors
    /// Where the example is not sound.
    pub fn session(&self) -> Result<Session> {
        let truth = with_effect(&self.staged.truth()?, &self.effect, 1.0)?;
        let mut session = synthesize(&truth, &self.plan(), &known_effects())?;
        session.robot_text = with_effect(&session.robot_text, &self.effect, OFF)?;
        session.robot = RobotFile::parse(&session.robot_text, Path::new("robot.toml"), &known_effects())?;
        Ok(session)
    }

    /// What `identify` makes of it.
    ///
    /// # Errors
    /// Where the example is not sound.
    pub fn identified(&self) -> Result<Identification> {
        identify(&self.session()?)
    }

    /// The same where nobody logged a gyro.
    ///
    /// # Errors
    /// Where the example is not sound.
    pub fn without_gyro(&self) -> Result<Identification> {
        let mut session = self.session()?;
        session.runs.iter_mut().for_each(|run| run.gyro = None);
        identify(&session)
    }

    /// The robot file that was found.
    ///
    /// # Errors
    /// Where it is not sound.
    pub fn written(&self, found: &Identification) -> Result<RobotFile> {
        RobotFile::parse(&found.robot_text, Path::new("robot.toml"), &known_effects())
    }

    /// By how much the phase of its ripple is uncertain at the end of a run [rad], since the angle is summed from the speeds
    /// that were measured; none where it has no ripple, or no speeds are read.
    pub fn phase_lost(&self, file: &RobotFile) -> Option<f64> {
        let per_turn = match self.effect.card().shows.order? {
            Order::Fixed(order) => f64::from(order),
            Order::OfWheel(order) => self.effect.params[order],
            Order::OfRotor(order) => self.effect.params[order] * file.motor.gear_ratio,
        };
        let Scenario { duration, rate, .. } = self.plan();
        // n·σ·Δt·√(T/Δt)
        Some(per_turn * file.sensors.wheel_speed_noise_rad_s * (duration / rate).sqrt())
    }

    /// True and absent value of a number, and whether it is a size.
    pub fn truth(&self, key: &str) -> Option<(f64, f64, bool)> {
        let card = self.effect.card();
        let p = card.param(key)?;
        Some((self.effect.params[p], card.params[p].absent, card.params[p].role == Role::Size))
    }
}
