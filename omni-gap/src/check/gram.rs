//! Sums of products of a run's motor channels, and the fit of one wheel's volts to a speed and a current.

use super::body::row_of;
use crate::log::{Group, Run, Sampled};

/// Delays of a drive that are tried (s): it may act late without being miswired.
const DELAYS_S: [f64; 6] = [0.0, 0.005, 0.01, 0.02, 0.035, 0.05];
/// Channels: volts (or set speeds), speeds, currents.
pub(super) const GROUPS: usize = 3;

/// Sums of products of every two channels over the rows in which all are there, for each delay of the drive.
#[derive(Clone)]
pub(super) struct Gram {
    pub wheels: usize,
    pub rows: usize,
    sums: Vec<Vec<f64>>,
}

/// One channel in a relation: its place among volts, speeds and currents, and what it is multiplied by.
#[derive(Clone, Copy)]
pub(super) struct Term {
    pub channel: usize,
    pub times: f64,
}

/// From where to where a coefficient may lie.
pub(super) type Within = (f64, f64);

impl Gram {
    pub fn new(run: &Run, drive: &Group, speed: &Group, current: Option<&Group>) -> Gram {
        let wheels = drive.channels.len();
        let size = GROUPS * wheels;
        let step = run.median_step_s();
        let before = usize::from(current.is_some() && run.currents_sampled == Sampled::Before);
        let late: Vec<usize> = DELAYS_S.iter().map(|s| (s / step).round() as usize + before).collect();
        let longest = late.iter().copied().max().unwrap_or(0);
        let mut gram = Gram { wheels, rows: 0, sums: vec![vec![0.0; size * size]; late.len()] };
        let mut z = vec![0.0; size];
        // every delay is tried on the same rows
        for row in longest..run.rows() {
            let Some(w) = row_of(speed, row) else { continue };
            let Some(i) = current.map_or_else(|| Some(vec![0.0; wheels]), |group| row_of(group, row)) else { continue };
            let volts: Option<Vec<Vec<f64>>> = late.iter().map(|late| row_of(drive, row - late)).collect();
            let Some(volts) = volts else { continue };
            z[wheels..2 * wheels].copy_from_slice(&w);
            z[2 * wheels..].copy_from_slice(&i);
            gram.rows += 1;
            for (k, u) in volts.iter().enumerate().filter(|(k, _)| *k == 0 || late[*k] != late[k - 1]) {
                z[..wheels].copy_from_slice(u);
                for a in 0..size {
                    for b in 0..size {
                        gram.sums[k][a * size + b] += z[a] * z[b];
                    }
                }
            }
        }
        for k in 1..late.len() {
            if late[k] == late[k - 1] {
                gram.sums[k] = gram.sums[k - 1].clone();
            }
        }
        gram
    }

    pub fn add(&mut self, other: &Gram) {
        self.rows += other.rows;
        let (mine, theirs) = (self.sums.iter_mut().flatten(), other.sums.iter().flatten());
        mine.zip(theirs).for_each(|(a, b)| *a += b);
    }

    /// The square of a channel over the rows, the drive undelayed.
    pub fn square(&self, channel: usize) -> f64 {
        self.sums[0][channel * GROUPS * self.wheels + channel]
    }

    /// The squares that remain of u ≈ a·w + b·i as a share of u's, the drive as late as fits best.
    pub fn rest(&self, u: Term, w: Term, i: Term, a: Within, b: Within) -> f64 {
        let size = GROUPS * self.wheels;
        let share = |sums: &Vec<f64>| {
            let of = |x: Term, y: Term| x.times * y.times * sums[x.channel * size + y.channel];
            let (uu, ww, ii, uw, ui, wi) = (of(u, u), of(w, w), of(i, i), of(u, w), of(u, i), of(w, i));
            if uu <= 0.0 {
                return 0.0;
            }
            let rest = |a: f64, b: f64| uu - 2.0 * (a * uw + b * ui) + a * a * ww + 2.0 * a * b * wi + b * b * ii;
            least(rest, (ww, ii, wi), (uw, ui), a, b).max(0.0) / uu
        };
        self.sums.iter().map(share).fold(f64::INFINITY, f64::min)
    }
}

/// The least of a parabola over a box: inside it, or on its edges.
fn least(
    rest: impl Fn(f64, f64) -> f64,
    (ww, ii, wi): (f64, f64, f64),
    (uw, ui): (f64, f64),
    a: Within,
    b: Within,
) -> f64 {
    let determinant = ww * ii - wi * wi;
    if determinant > 1e-9 * ww * ii {
        let (x, y) = ((uw * ii - ui * wi) / determinant, (ui * ww - uw * wi) / determinant);
        if (a.0..=a.1).contains(&x) && (b.0..=b.1).contains(&y) {
            return rest(x, y);
        }
    }
    let along_b = |x: f64| if ii > 0.0 { ((ui - x * wi) / ii).clamp(b.0, b.1) } else { b.0 };
    let along_a = |y: f64| if ww > 0.0 { ((uw - y * wi) / ww).clamp(a.0, a.1) } else { a.0 };
    let edges = [(a.0, along_b(a.0)), (a.1, along_b(a.1)), (along_a(b.0), b.0), (along_a(b.1), b.1)];
    edges.into_iter().map(|(x, y)| rest(x, y)).fold(f64::INFINITY, f64::min)
}
