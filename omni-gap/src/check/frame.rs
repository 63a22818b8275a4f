//! Guesses at the pose's frame and the wheels' order, and how well each makes wheels and pose agree.

use super::Fault;
use super::agree::Evidence;
use super::order::{self, Order};
use super::windows::{DELAYS_S, Window, windows};
use crate::log::{RobotFile, Run};
use std::f64::consts::TAU;

/// Below this rim speed [m/s, RMS] a run cannot tell, nor with fewer windows.
const SLOWEST_M_S: f64 = 0.04;
const FEWEST: usize = 8;
/// How much worse than the guess the log must be as given (squares), how much the guess may leave over, and how much the
/// log must.
const TIMES: f64 = 6.0;
const LEFT: f64 = 0.2;
const LEAST: f64 = 0.1;
/// The same, and what may remain, where the guess brings a run back to what remains in the others.
const LEAST_BACK: f64 = 0.04;
const BACK: f64 = 1.5;

/// What a guess says: the pose's frame is otherwise, or the wheels are.
#[derive(Clone)]
pub(super) enum What {
    Degrees,
    Frame { mirrored: bool, heading_negated: bool, offset: f64 },
    Wheels(Order),
}

#[derive(Clone)]
pub(super) struct Guess {
    what: What,
    better: f64,
}

/// What wheels and pose of some recordings say, for each delay of the camera.
#[derive(Clone)]
pub(super) struct Seen {
    rows: Vec<[f64; 3]>,
    late: Vec<Vec<Window>>,
}

impl Seen {
    pub fn new(run: &Run, robot: &RobotFile) -> Option<Seen> {
        let late = DELAYS_S.iter().map(|delay| windows(run, robot, *delay)).collect::<Option<Vec<_>>>()?;
        let rims: Vec<f64> = late[0].iter().flat_map(|w| &w.rims).copied().collect();
        let square: f64 = rims.iter().map(|v| v * v).sum();
        let enough = late[0].len() >= FEWEST && square > SLOWEST_M_S * SLOWEST_M_S * rims.len() as f64;
        enough.then(|| Seen { rows: robot.wheel.iter().map(|wheel| wheel.wheel().row()).collect(), late })
    }

    pub fn windows(&self) -> &[Window] {
        &self.late[0]
    }

    fn given(&self) -> What {
        What::Wheels(order::all(self.rows.len())[0].clone())
    }

    /// What remains with a guess, as a share of the rims' motion, the camera as late as fits best.
    fn rest(&self, what: &What) -> f64 {
        self.late.iter().map(|windows| self.moments(windows, what).rest(what)).fold(f64::INFINITY, f64::min)
    }

    fn moments(&self, windows: &[Window], what: &What) -> Moments {
        let twists: Vec<[f64; 3]> = match what {
            What::Wheels(_) => twists(windows, false, false, 0.0),
            What::Frame { mirrored, heading_negated, offset } => twists(windows, *mirrored, *heading_negated, *offset),
            What::Degrees => {
                let radians = in_radians(windows);
                twists(&radians, false, false, offset(&twists(&radians, false, false, 0.0), &radians))
            }
        };
        Moments::new(&self.rows, windows, &twists)
    }

    /// The guesses at the wheels, all made from the same sums.
    fn orders(&self) -> Vec<(What, usize, bool, f64)> {
        let moments: Vec<Moments> = self.late.iter().map(|windows| self.moments(windows, &self.given())).collect();
        let tried = |order: Order| {
            let rest = moments.iter().map(|m| m.rest_in(&order)).fold(f64::INFINITY, f64::min);
            let (changes, moved) = (order.changes(), order.moved());
            (What::Wheels(order), changes, moved, rest)
        };
        order::all(self.rows.len()).into_iter().map(tried).collect()
    }

    fn frames(&self) -> Vec<(What, usize, bool, f64)> {
        let mut tried = Vec::new();
        for (mirrored, heading_negated) in [(false, false), (true, false), (false, true)] {
            let middle = &self.late[DELAYS_S.len() / 2];
            for offset in [0.0, offset(&twists(middle, mirrored, heading_negated, 0.0), middle)] {
                let what = What::Frame { mirrored, heading_negated, offset };
                let changes = usize::from(mirrored) + usize::from(heading_negated) + usize::from(offset != 0.0);
                if changes > 0 {
                    let rest = self.rest(&what);
                    tried.push((what, changes, false, rest));
                }
            }
        }
        // values that a wrapped heading in radians cannot have
        if self.windows().iter().any(|w| w.heading.abs() > TAU + 1.0) {
            tried.push((What::Degrees, 1, true, self.rest(&What::Degrees)));
        }
        tried
    }
}

impl Evidence for Seen {
    type Guess = Guess;

    fn add(&mut self, other: &Seen) {
        self.late.iter_mut().zip(&other.late).for_each(|(mine, theirs)| mine.extend_from_slice(theirs));
    }

    fn best(&self, usual: Option<f64>) -> Option<Guess> {
        let mut tried = self.orders();
        tried.extend(self.frames());
        let (what, otherwise) = order::best(&tried, 0.005)?;
        let given = self.rest_as_given();
        let small = match &what {
            What::Wheels(order) => order.is_as_given(),
            What::Frame { mirrored: false, heading_negated: false, offset } => offset.abs() < 0.35,
            _ => false,
        };
        let back = usual.is_some_and(|usual| given > TIMES * usual && otherwise < BACK * usual);
        let told =
            !small && otherwise < LEFT && given > TIMES * otherwise && given > if back { LEAST_BACK } else { LEAST };
        told.then(|| Guess { what, better: (given / otherwise.max(1e-6)).sqrt() })
    }

    fn rests(&self, guess: &Guess) -> (f64, f64) {
        (self.rest_as_given(), self.rest(&guess.what))
    }

    fn rest_as_given(&self) -> f64 {
        self.rest(&self.given())
    }
}

pub(super) fn describe(run: &Run, guess: &Guess) -> Fault {
    let better = guess.better;
    let (code, signal, what, fix) = match &guess.what {
        What::Degrees => {
            let sentence =
                format!("Pose and wheel speeds agree {better:.0} times better if the heading is in degrees.");
            return degrees(run, sentence);
        }
        What::Wheels(order) => {
            let code = if order.moved() { "swapped_wheels" } else { "wrong_sign" };
            (code, "w", order.words("w"), "Put the wheels into order in the log, in columns.toml, or in robot.toml.")
        }
        What::Frame { mirrored: true, .. } => (
            "wrong_sign",
            "x_m, y_m",
            "the pose's frame is mirrored".to_string(),
            "Turn the sign of y_m (or x_m), or swap them, in columns.toml.",
        ),
        What::Frame { heading_negated: true, .. } => (
            "wrong_sign",
            "theta_rad",
            "the heading counts the wrong way round".to_string(),
            "Turn the sign of theta_rad; anticlockwise is positive.",
        ),
        What::Frame { offset, .. } => (
            "wrong_frame",
            "theta_rad",
            format!(
                "the heading is off by {:.0} degrees, or the wheels are numbered from another one",
                -offset.to_degrees()
            ),
            "Add the offset to theta_rad in columns.toml, or correct the drive angles.",
        ),
    };
    let sentence = format!("Pose and wheel speeds agree {better:.0} times better if {what}.");
    Fault::of(run, code, signal, true).says(sentence, fix)
}

pub(super) fn degrees(run: &Run, sentence: String) -> Fault {
    let fix = "Convert the heading to radians, or state unit = \"deg\" in columns.toml.";
    Fault::of(run, "wrong_unit", "theta_rad", true).says(format!("{sentence} It looks like degrees."), fix)
}

fn in_radians(windows: &[Window]) -> Vec<Window> {
    let radians = |w: &Window| Window { heading: w.heading.to_radians(), yaw: w.yaw.to_radians(), ..w.clone() };
    windows.iter().map(radians).collect()
}

/// How much further the heading must be taken (rad) for the pose's twists to lie along the wheels'.
fn offset(by_pose: &[[f64; 3]], windows: &[Window]) -> f64 {
    let along = |(p, w): (&[f64; 3], &Window)| {
        let w = w.twist;
        (p[0] * w[0] + p[1] * w[1], p[0] * w[1] - p[1] * w[0])
    };
    let turn = by_pose.iter().zip(windows).map(along).fold((0.0, 0.0), |s, a| (s.0 + a.0, s.1 + a.1));
    -turn.1.atan2(turn.0)
}

/// Body twists by the pose, the heading taken `offset` further (rad).
fn twists(windows: &[Window], mirrored: bool, heading_negated: bool, offset: f64) -> Vec<[f64; 3]> {
    let twist = |w: &Window| {
        let way = if heading_negated { -1.0 } else { 1.0 };
        let (sin, cos) = (way * w.heading + offset).sin_cos();
        let [x, y] = [w.world[0], if mirrored { -w.world[1] } else { w.world[1] }];
        [cos * x + sin * y, cos * y - sin * x, way * w.yaw]
    };
    windows.iter().map(twist).collect()
}

/// Sums of products of what the pose says each rim does, and what it does.
struct Moments {
    expected: f64,
    seen: f64,
    both: Vec<Vec<f64>>,
    given: Order,
}

impl Moments {
    fn new(rows: &[[f64; 3]], windows: &[Window], twists: &[[f64; 3]]) -> Moments {
        let n = rows.len();
        let given = order::all(n)[0].clone();
        let mut m = Moments { expected: 0.0, seen: 0.0, both: vec![vec![0.0; n]; n], given };
        for (window, twist) in windows.iter().zip(twists) {
            for (j, row) in rows.iter().enumerate() {
                let rim: f64 = row.iter().zip(twist).map(|(a, b)| a * b).sum();
                m.expected += rim * rim;
                m.seen += window.rims[j] * window.rims[j];
                for k in 0..n {
                    m.both[j][k] += rim * window.rims[k];
                }
            }
        }
        m
    }

    fn rest(&self, what: &What) -> f64 {
        self.rest_in(if let What::Wheels(order) = what { order } else { &self.given })
    }

    /// What remains with one common factor from 0.4 to 2.5, as a share.
    fn rest_in(&self, order: &Order) -> f64 {
        let both: f64 = (0..self.both.len()).map(|j| order.sign[j] * self.both[j][order.place[j]]).sum();
        let factor = if self.expected > 0.0 { (both / self.expected).clamp(0.4, 2.5) } else { 1.0 };
        (self.seen - 2.0 * factor * both + factor * factor * self.expected).max(0.0) / self.seen.max(1e-12)
    }
}
