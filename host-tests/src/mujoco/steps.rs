//! Steps a second of the plant's cases and of MuJoCo, turn by turn.

use std::hint::black_box;
use std::time::Instant;

use serde_json::json;

use super::median::median;
use super::motion::drive;
use super::worker::{Worker, number};
use crate::plant_cases::{
    LANES, PLANT_CASES, PlantCase, STEPS, command, model, run, run_side_by_side, side_by_side, with_derivatives,
};

/// Turns that the two sides take.
pub const TURNS: usize = 21;

/// How long a turn of MuJoCo's lasts [s]
const MUJOCO_S: f64 = 0.1;

/// How long a turn of each case lasts [s]
const CASE_S: f64 = 0.05;

/// What is asked of each of [`PLANT_CASES`], as a multiple of MuJoCo's steps a second.
const ASKED: [f64; PLANT_CASES.len()] = [80.0, 45.0, 25.0, 10.0];

/// What is asked of plain robots side by side.
const ASKED_SIDE_BY_SIDE: f64 = 150.0;

/// The slowest effect on its own, of which nothing is asked.
const SLIP: PlantCase = PlantCase { name: "wheel_slip alone", effects: &["wheel_slip"] };

/// MuJoCo's options, as its side calls them: those that it has by default, and those that are fastest for this robot.
pub const OPTIONS: [&str; 2] = ["default", "fastest"];

/// One case, timed.
#[derive(Clone, Copy, Debug)]
pub struct Rate {
    /// Which.
    pub name: &'static str,
    /// Steps a second, median of all turns [1/s]
    pub per_s: f64,
    /// Times as many as MuJoCo in the same turn, median of all turns, with each of its [`OPTIONS`].
    pub ratios: [f64; 2],
    /// What was asked of the ratio.
    pub asked: Option<f64>,
}

/// All cases, timed.
#[derive(Clone, Debug)]
pub struct Steps {
    /// MuJoCo's steps a second with each of its [`OPTIONS`], median of all turns [1/s]
    pub mujoco: [f64; 2],
    /// The same with a Python loop around it [1/s]
    pub looped: f64,
    /// The plant's cases.
    pub rates: Vec<Rate>,
    /// How many plain steps one with eight derivatives takes as long as, median of all turns.
    pub derivatives: f64,
}

/// Something of this side that takes turns.
struct Contestant {
    name: &'static str,
    asked: Option<f64>,
    /// Takes some steps, and says how many.
    runs: Box<dyn FnMut() -> usize>,
    per_s: Vec<f64>,
}

impl Contestant {
    fn new(name: &'static str, asked: Option<f64>, runs: impl FnMut() -> usize + 'static) -> Self {
        Self { name, asked, runs: Box::new(runs), per_s: Vec::new() }
    }

    fn of(case: PlantCase, asked: Option<f64>) -> Self {
        let plant = model(case.effects).plant();
        let mut memory: Vec<_> = plant.memory().collect();
        Self::new(case.name, asked, move || {
            black_box(run(black_box(&plant), &mut memory));
            STEPS
        })
    }

    fn take_turn(&mut self) {
        let (begun, mut steps) = (Instant::now(), 0);
        while begun.elapsed().as_secs_f64() < CASE_S {
            steps += (self.runs)();
        }
        self.per_s.push(steps as f64 / begun.elapsed().as_secs_f64());
    }
}

/// This side's contestants: the plain plant first, the one with derivatives last. Robots side by side count the steps of each.
fn contestants() -> Vec<Contestant> {
    let mut all: Vec<Contestant> =
        PLANT_CASES.into_iter().zip(ASKED).map(|(case, asked)| Contestant::of(case, Some(asked))).collect();
    all.push(Contestant::of(SLIP, None));
    let batch = side_by_side();
    all.push(Contestant::new("plain, four robots side by side", Some(ASKED_SIDE_BY_SIDE), move || {
        black_box(run_side_by_side(black_box(&batch)));
        STEPS * LANES
    }));
    let plant = with_derivatives();
    all.push(Contestant::new("plain, eight derivatives", None, move || {
        black_box(run(black_box(&plant), &mut []));
        STEPS
    }));
    all
}

/// Takes all turns.
///
/// # Errors
/// Where MuJoCo's side does not answer.
pub fn measured(worker: &mut Worker) -> Result<Steps, String> {
    let volts: Vec<[f64; 4]> = (0..STEPS).map(command).collect();
    let driven = worker.ask(&drive(&model(&[]), &volts))?;
    let mut all = contestants();
    let mut mujoco = OPTIONS.map(|_| Vec::with_capacity(TURNS));
    for _ in 0..TURNS {
        for (options, per_s) in OPTIONS.iter().zip(&mut mujoco) {
            let request = json!({"ask": "steps", "options": options, "seconds": MUJOCO_S});
            per_s.push(number(&worker.ask(&request)?, "per_s")?);
        }
        all.iter_mut().for_each(Contestant::take_turn);
    }
    let ratios = |a: &[f64], b: &[f64]| median(a.iter().zip(b).map(|(a, b)| a / b).collect());
    let rates = all.iter().map(|one| Rate {
        name: one.name,
        per_s: median(one.per_s.clone()),
        ratios: [&mujoco[0], &mujoco[1]].map(|mujoco| ratios(&one.per_s, mujoco)),
        asked: one.asked,
    });
    Ok(Steps {
        rates: rates.collect(),
        derivatives: ratios(&all[0].per_s, &all[all.len() - 1].per_s),
        looped: number(&driven, "looped_per_s")?,
        mujoco: mujoco.map(median),
    })
}
