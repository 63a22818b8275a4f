//! Which measured link of the chain u → i → w → pose the gap belongs to.
//!
//! A link's own measured output is put in the place of what the model says of it, so that an error before it cannot
//! come through: the measured current instead of the winding's, the measured wheel speeds instead of the drivetrain's
//! and body's, the measured motion of the robot over its wheels instead of the contact's. A link's share is what its
//! substitution takes off the free run's error, averaged over all orders in which the links can be substituted
//! (Shapley), so that the shares add up to the whole.

use model_core::plant::{Input, Plant};
use rayon::prelude::*;

use super::floor::{FLOOR_SEED, replayed};
use crate::simulate::{AlignedRun, Row, SignalGroup, free_run};

/// A link between two measured signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Voltage to current.
    Electrical,
    /// Current to wheel speed: drivetrain and body.
    Motion,
    /// Wheel speed to pose: contact, and the camera.
    Contact,
}

impl Link {
    /// All links in signal order.
    pub const ALL: [Link; 3] = [Link::Electrical, Link::Motion, Link::Contact];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Link::Electrical => "electrical",
            Link::Motion => "motion",
            Link::Contact => "contact",
        }
    }

    /// The signals by whose errors it shows.
    pub const fn end(self) -> SignalGroup {
        match self {
            Link::Electrical => SignalGroup::Current,
            Link::Motion => SignalGroup::WheelSpeed,
            Link::Contact => SignalGroup::Pose,
        }
    }
}

/// The share of each link that could be told apart; shares sum to one.
#[derive(Clone, Debug)]
pub struct Links {
    /// (link, share), in signal order; a link whose ends were not both measured is not listed.
    pub shares: Vec<(Link, f64)>,
}

/// Splits the error of free runs among the links, over what noise alone would leave: `right` is the model that explains
/// the runs best, and what it would leave of runs simulated from itself is nobody's share.
pub fn links<const N: usize>(
    plant: &Plant<N, f64>,
    right: &Plant<N, f64>,
    runs: &[&AlignedRun<N>],
    horizon: f64,
) -> Links {
    let seen = Link::ALL.map(|link| runs.iter().any(|run| run.has_group(link.end())));
    let players: Vec<usize> = (0..3).filter(|k| seen[*k]).collect();
    // mean square error per group of each subset of substituted links
    let quiet = replayed(right, runs, FLOOR_SEED);
    let parts: Vec<Subsets> = runs.par_iter().map(|run| subsets(plant, run, horizon)).collect();
    let floors: Vec<Subsets> = quiet.par_iter().map(|run| subsets(right, run, horizon)).collect();
    let worth = |subset: usize| mean_squares(&parts, subset) - mean_squares(&floors, subset);
    let mut shares = [0.0; 3];
    let orders = orders(&players);
    for order in &orders {
        let mut subset = 0;
        for player in order {
            let before = worth(subset);
            subset |= 1 << player;
            shares[*player] += (before - worth(subset)) / orders.len() as f64;
        }
    }
    let total: f64 = shares.iter().map(|s| s.max(0.0)).sum();
    let share = |k: usize| if total > 0.0 { shares[k].max(0.0) / total } else { 1.0 / players.len().max(1) as f64 };
    Links { shares: players.iter().map(|k| (Link::ALL[*k], share(*k))).collect() }
}

/// Σ error² and count per group, for every subset of substituted links (bit 0 electrical, 1 motion, 2 contact).
type Subsets = [[(f64, f64); 3]; 8];

fn mean_squares(parts: &[Subsets], subset: usize) -> f64 {
    (0..3)
        .map(|g| {
            let (sum, n) = parts.iter().fold((0.0, 0.0), |s, p| (s.0 + p[subset][g].0, s.1 + p[subset][g].1));
            if n > 0.0 { sum / n } else { 0.0 }
        })
        .sum()
}

fn orders(players: &[usize]) -> Vec<Vec<usize>> {
    if players.is_empty() {
        return vec![Vec::new()];
    }
    players
        .iter()
        .flat_map(|first| {
            let rest: Vec<usize> = players.iter().copied().filter(|p| p != first).collect();
            orders(&rest).into_iter().map(move |tail| [vec![*first], tail].concat())
        })
        .collect()
}

/// Rows of one free run: as predicted from the recorded input, from measured currents, and from measured wheel speeds.
struct Paths {
    plain: Vec<Row>,
    by_current: Vec<Row>,
    by_speed: Vec<Row>,
}

fn subsets<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, horizon: f64) -> Subsets {
    let paths = Paths {
        plain: rows(plant, run, horizon, |row| run.input(row)),
        by_current: rows(plant, run, horizon, |row| {
            measured(run, row, SignalGroup::Current).map_or(run.input(row), Input::Current)
        }),
        by_speed: by_speeds(plant, run, horizon),
    };
    let (motor, channels) = (&plant.robot().motor, AlignedRun::<N>::channels());
    let ends = 0..channels.of(SignalGroup::Pose).end;
    let mut sums = [[(0.0, 0.0); 3]; 8];
    for row in 0..run.rows() {
        let volts = match run.input::<f64>(row) {
            Input::Voltage(u) => Some(u),
            _ => None,
        };
        let speeds = measured(run, row, SignalGroup::WheelSpeed);
        for c in ends.clone().filter(|c| run.saw(row, *c)) {
            let group = channels.group(c);
            let error = |path: &[Row]| run.error(row, c, path[row][c]);
            let by_speed = error(&paths.by_speed);
            for (subset, sums) in sums.iter_mut().enumerate() {
                let (electrical, motion, contact) = (subset & 1 != 0, subset & 2 != 0, subset & 4 != 0);
                let e = if group == SignalGroup::Current {
                    match (electrical, motion, volts.zip(speeds)) {
                        (true, ..) => 0.0,
                        (false, true, Some((u, w))) => run.error(row, c, motor.current(u[c], w[c])),
                        _ => error(&paths.plain),
                    }
                } else if group == SignalGroup::WheelSpeed {
                    match (electrical, motion) {
                        (_, true) => 0.0,
                        (true, false) => error(&paths.by_current),
                        (false, false) => error(&paths.plain),
                    }
                } else {
                    let before = match (electrical, motion) {
                        (_, true) => by_speed,
                        (true, false) => error(&paths.by_current),
                        (false, false) => error(&paths.plain),
                    };
                    if contact { before - by_speed } else { before }
                };
                let sum = &mut sums[group as usize];
                *sum = (sum.0 + e * e, sum.1 + 1.0);
            }
        }
    }
    sums
}

/// What a model says of a run whose wheels turn as measured; where they were not, it is driven by the recorded input.
pub(super) fn by_speeds<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>, horizon: f64) -> Vec<Row> {
    let speeds = |row| measured(run, row, SignalGroup::WheelSpeed).map_or(run.input(row), Input::Speed);
    rows(plant, run, horizon, speeds)
}

/// The measured currents or wheel speeds of a row, if all are there.
fn measured<const N: usize>(run: &AlignedRun<N>, row: usize, group: SignalGroup) -> Option<[f64; N]> {
    let channels = AlignedRun::<N>::channels().of(group);
    let magnitudes = group == SignalGroup::Current && run.unsigned_current;
    let whole = channels.clone().all(|c| run.saw(row, c)) && !magnitudes;
    whole.then(|| std::array::from_fn(|j| run.measured[row][channels.start + j]))
}

/// The rows that a free run predicts from any input.
fn rows<const N: usize>(
    plant: &Plant<N, f64>,
    run: &AlignedRun<N>,
    horizon: f64,
    input: impl Fn(usize) -> Input<N, f64>,
) -> Vec<Row> {
    let mut rows = Vec::with_capacity(run.rows());
    free_run(plant, run, &run.restart_rows(horizon), input, |_, passed| rows.push(run.row_of(passed)));
    rows
}
