//! # Fit case: what the fit is timed with
//!
//! Seven numbers of the four-wheel robot and the starts of all windows, from starting values that are off by what the robot
//! file states of them.

use model_core::plant::robot::Nominal;
use omni_gap::identify::{Fit, FitOptions, Free, Prior, Shots, WINDOW_S, Windows, fit};
use omni_gap::log::Session;
use omni_gap::simulate::{AlignedRun, Model, Slot};
use omni_gap::synthesize::Scenario;

/// Steps of the fit at the most.
const ROUNDS: usize = 10;

/// How far from the truth a fitted number may be, in its own sigma.
const SIGMAS: f64 = 4.0;

/// What the fit's step of 2 ms adds to that, as a share of the number: the staged robot takes a tenth of it.
const STEP: f64 = 0.01;

/// How many numbers are free.
pub const COUNT: usize = 7;

/// What is wrong in the robot file and free in the fit: (key, factor, true value over the file's); each is off by one
/// stated sigma, up or down.
pub const WRONG: [(&str, Nominal, f64); COUNT] = [
    ("resistance_ohm", Nominal::Resistance, 1.1),
    ("inertia_kg_m2", Nominal::Inertia, 0.9),
    ("viscous_v_N_s_per_m", Nominal::ViscousV, 1.2),
    ("viscous_vn_N_s_per_m", Nominal::ViscousVn, 0.8),
    ("viscous_w_Nm_s", Nominal::ViscousW, 1.2),
    ("coulomb_w_Nm", Nominal::CoulombW, 0.8),
    ("coulomb_v_N", Nominal::CoulombV, 1.2),
];

/// The lowest and the highest factor that the fit may end at.
pub const WITHIN: (f64, f64) = (0.1, 4.0);

/// A robot file with [`WRONG`] in it, and ten runs of 6 s at 500 rows a second of the robot that it is wrong about.
pub fn scenario() -> Scenario {
    Scenario {
        uncertain: false,
        wrong: WRONG.iter().map(|(key, _, ratio)| (*key, *ratio)).collect(),
        ..Scenario::default()
    }
}

/// Recordings laid out, and all that a fit of them starts from.
#[derive(Clone, Debug)]
pub struct FitCase {
    /// The recordings.
    pub runs: Vec<AlignedRun<4>>,
    /// The model that the fit starts from.
    pub nominal: Model<4>,
    /// What the robot file states.
    pub prior: Prior,
    windows: Vec<Windows>,
    free: Vec<Free>,
}

impl FitCase {
    /// Lays a session out that [`scenario`] made.
    pub fn of(session: &Session) -> Self {
        let laid = |run| AlignedRun::new(run, &session.robot).expect("voltages drive the model");
        let runs: Vec<AlignedRun<4>> = session.runs.iter().map(laid).collect();
        Self {
            windows: runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect(),
            nominal: Model::nominal(&session.robot, scenario().voltage),
            prior: Prior::stated(&session.robot),
            free: WRONG.iter().map(|(_, p, _)| Free { slot: Slot::Nominal(*p), within: WITHIN }).collect(),
            runs,
        }
    }

    /// The fit.
    pub fn fit(&self) -> Fit<4> {
        let runs: Vec<&AlignedRun<4>> = self.runs.iter().collect();
        let shots = Shots { runs: &runs, windows: &self.windows };
        let options =
            FitOptions { free: &self.free, prior: &self.prior, dispersion: 1.0, rounds: ROUNDS, by_window: 0.0 };
        fit(self.nominal.clone(), shots, None, options)
    }
}

/// The factors that a fit found, in the order of [`WRONG`].
pub fn found(fitted: &Fit<4>) -> [f64; COUNT] {
    WRONG.map(|(_, p, _)| fitted.model.get(Slot::Nominal(p)))
}

/// Each of these factors that is further from the truth than this fit's own sigma allows, said in a line.
pub fn astray(factors: &[f64; COUNT], fitted: &Fit<4>) -> Vec<String> {
    let mut said = Vec::new();
    for ((key, p, truth), found) in WRONG.iter().zip(factors) {
        let sigma = fitted.std(Slot::Nominal(*p)).expect("it was free");
        if (found - truth).abs() >= SIGMAS * sigma + STEP * truth {
            said.push(format!("{key} ended at {found} ± {sigma}, true is {truth}"));
        }
    }
    said
}
