//! # What wheels and pose say of each other: which wheel is which, signs, units, and how the pose's frame lies
//!
//! Over windows of a quarter of a second the pose gives the body's velocity (v', vn', ω), in its own length and from its
//! own zero of the heading, and each column c of the wheels is fitted alone:
//!
//! ```text
//! c = α v' + β vn' + γ ω          by least squares
//! ```
//!
//! A wheel that rolls along the angle a, at the distance d, with the radius r, has (Oliveira et al. 2008, equations 2 and 6)
//!
//! ```text
//! α + iβ = ± κ λ/r · exp(i(a + φ))          γ = ± κ d/r
//! ```
//!
//! with κ the column's numbers in a rad/s, λ the pose's lengths in a metre⁻¹, and φ what the heading lacks. So the sign of γ
//! is the column's sign, its size gives κ, the ratio of both gives λ, and the angles tell the wheels apart, but for a turn of
//! the whole robot into itself. A mirrored frame, a heading that counts the other way or in degrees fit badly: each is tried.

use super::series::Way;
use crate::log::Channel;
use nalgebra::{Matrix3, Vector3};

/// The length of a window (s), and from one to the next.
const WINDOW_S: f64 = 0.25;
const APART_S: f64 = 0.1;
/// How late a camera may be (s).
const DELAYS_S: [f64; 5] = [0.0, 0.03, 0.06, 0.09, 0.12];
/// Fewer windows tell nothing.
const FEWEST: usize = 12;

/// How a pose is to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub degrees: bool,
    /// Its y axis points the other way.
    pub mirrored: bool,
    /// Its heading counts clockwise.
    pub clockwise: bool,
}

impl Frame {
    /// How many things are otherwise than a pose has them.
    pub fn changes(self) -> usize {
        usize::from(self.mirrored) + usize::from(self.clockwise)
    }

    /// All that are tried, of headings in either unit or in the one that is known.
    fn all(degrees: Option<bool>) -> Vec<Frame> {
        let units = degrees.map_or(vec![false, true], |degrees| vec![degrees]);
        let ways = [(false, false), (true, false), (false, true), (true, true)];
        let frame = |degrees| ways.map(|(mirrored, clockwise)| Frame { degrees, mirrored, clockwise });
        units.into_iter().flat_map(frame).collect()
    }
}

/// A pose over time, as it was logged.
#[derive(Debug, Clone)]
pub(super) struct Poses {
    /// Instant (s), x, y, heading.
    rows: Vec<[f64; 4]>,
}

impl Poses {
    pub fn new(t_s: &[f64], [x, y, heading]: [&Channel; 3]) -> Poses {
        let row = |row: usize| Some([t_s[row], x.get(row).ok()?, y.get(row).ok()?, heading.get(row).ok()?]);
        Poses { rows: (0..t_s.len()).filter_map(row).collect() }
    }

    /// The same, so many seconds later.
    pub fn later(mut self, by_s: f64) -> Poses {
        self.rows.iter_mut().for_each(|row| row[0] += by_s);
        self
    }

    pub fn span(&self) -> Option<(f64, f64)> {
        Some((self.rows.first()?[0], self.rows.last()?[0]))
    }

    /// The largest size of its headings.
    pub fn largest_heading(&self) -> f64 {
        self.rows.iter().map(|row| row[3].abs()).fold(0.0, f64::max)
    }

    /// Windows of motion: from (s), to (s), and the body's velocity (v', vn', ω) in between.
    fn windows(&self, frame: Frame) -> Vec<(f64, f64, Vector3<f64>)> {
        let to_rad = if frame.degrees { std::f64::consts::PI / 180.0 } else { 1.0 };
        let way = if frame.clockwise { -to_rad } else { to_rad };
        let headings = Channel::from_values(self.rows.iter().map(|row| way * row[3])).unwrapped();
        let heading = |k: usize| headings.get(k).unwrap_or_default();
        let mut all = Vec::new();
        let mut next = f64::MIN;
        let mut end = 0;
        for start in 0..self.rows.len() {
            let from = self.rows[start];
            if from[0] < next {
                continue;
            }
            end = end.max(start);
            while end < self.rows.len() && self.rows[end][0] - from[0] < WINDOW_S {
                end += 1;
            }
            let Some(to) = self.rows.get(end) else { break };
            let length_s = to[0] - from[0];
            next = from[0] + APART_S;
            if length_s > 2.0 * WINDOW_S {
                continue;
            }
            let (sin, cos) = (0.5 * (heading(start) + heading(end))).sin_cos();
            let mirror = if frame.mirrored { -1.0 } else { 1.0 };
            let (dx, dy) = ((to[1] - from[1]) / length_s, mirror * (to[2] - from[2]) / length_s);
            let turn = (heading(end) - heading(start)) / length_s;
            all.push((from[0], to[0], Vector3::new(cos * dx + sin * dy, cos * dy - sin * dx, turn)));
        }
        all
    }
}

/// What a column of the wheels is made of, by one reading of the pose.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fitted {
    /// (α, β, γ).
    pub of: Vector3<f64>,
    /// Standard error of γ over γ.
    pub unsure_turn: f64,
    /// What turning makes of the column, as a share of its motion.
    pub by_turning: f64,
    /// What is left of the column, as a share of its motion.
    pub rest: f64,
}

/// The best reading of a pose, and what each column is made of by it.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    pub frame: Frame,
    pub columns: Vec<Fitted>,
    /// What is left of all columns, as a share of their motion.
    pub rest: f64,
    /// The same by the best reading that is not as good.
    pub next_best: f64,
}

/// Reads runs of wheels and poses together: the readings that are as good as the best, those first that change least; none
/// where they move too little.
pub(super) fn read(runs: &[(Vec<Way>, Poses)], degrees: Option<bool>) -> Vec<Reading> {
    let mut all: Vec<Reading> = Vec::new();
    for frame in Frame::all(degrees) {
        let by_delay = DELAYS_S.iter().filter_map(|late_s| fit(runs, frame, *late_s));
        all.extend(by_delay.min_by(|a, b| a.rest.total_cmp(&b.rest)));
    }
    let least = all.iter().map(|reading| reading.rest).fold(f64::INFINITY, f64::min);
    let (mut good, other): (Vec<Reading>, Vec<Reading>) =
        all.into_iter().partition(|reading| reading.rest <= 1.2 * least + 1e-6);
    let next_best = other.iter().map(|reading| reading.rest).fold(1.0, f64::min);
    good.iter_mut().for_each(|reading| reading.next_best = next_best);
    // a frame that is mirrored and counts clockwise is the same motion seen from below: as good, and more is changed
    good.sort_by_key(|reading| reading.frame.changes());
    good
}

/// Each column by least squares over the windows of all runs.
fn fit(runs: &[(Vec<Way>, Poses)], frame: Frame, late_s: f64) -> Option<Reading> {
    let columns = runs.first()?.0.len();
    let mut normal = Matrix3::zeros();
    let mut sums = vec![(Vector3::zeros(), 0.0); columns];
    let mut windows = 0;
    for (ways, poses) in runs {
        for (from_s, to_s, body) in poses.windows(frame) {
            let rate = |way: &Way| way.rate(from_s - late_s, to_s - late_s);
            let Some(rates) = ways.iter().map(rate).collect::<Option<Vec<f64>>>() else { continue };
            normal += body * body.transpose();
            for ((both, square), rate) in sums.iter_mut().zip(rates) {
                *both += body * rate;
                *square += rate * rate;
            }
            windows += 1;
        }
    }
    let inverse = normal.try_inverse().filter(|_| windows >= FEWEST)?;
    let fitted = |(both, square): &(Vector3<f64>, f64)| {
        let of = inverse * both;
        let left = (square - of.dot(both)).max(0.0);
        let turn_std = (left / windows as f64 * inverse[(2, 2)]).sqrt();
        let square = square.max(f64::MIN_POSITIVE);
        let by_turning = of[2] * of[2] * normal[(2, 2)] / square;
        Fitted { of, unsure_turn: turn_std / of[2].abs(), by_turning, rest: left / square }
    };
    let columns: Vec<Fitted> = sums.iter().map(fitted).collect();
    let rest = columns.iter().map(|column| column.rest).sum::<f64>() / columns.len().max(1) as f64;
    Some(Reading { frame, columns, rest, next_best: 1.0 })
}
