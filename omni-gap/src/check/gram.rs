//! Sums of products of a run's motor channels, and the fit of one wheel's volts to a speed and a current.

use super::body::{MOST_CHANNELS, row_of};
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
        let apart: Vec<usize> = (0..late.len()).filter(|&k| k == 0 || late[k] != late[k - 1]).collect();
        let mut rows = 0;
        let mut measured = Measured::default();
        let mut driven = vec![Driven::default(); late.len()];
        // every delay is tried on the same rows
        for row in longest..run.rows() {
            let Some(w) = row_of(speed, row) else { continue };
            let Some(i) = current.map_or(Some([0.0; WHEELS]), |group| row_of(group, row)) else { continue };
            let mut volts = [[0.0; WHEELS]; DELAYS_S.len()];
            let all = apart.iter().all(|&k| row_of(drive, row - late[k]).map(|u| volts[k] = u).is_some());
            if !all {
                continue;
            }
            rows += 1;
            measured.add(&w, &i);
            apart.iter().for_each(|&k| driven[k].add(&volts[k], &w, &i));
        }
        for k in 1..late.len() {
            if late[k] == late[k - 1] {
                driven[k] = driven[k - 1].clone();
            }
        }
        Gram { wheels, rows, sums: driven.iter().map(|driven| together(driven, &measured, wheels, size)).collect() }
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

/// One speed and one current coefficient for all wheels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shared {
    /// u ≈ a·w + b·i.
    pub a: f64,
    pub b: f64,
    /// Of u squared, the shares that each term makes, and what remains.
    pub by_speed: f64,
    pub by_current: f64,
    pub rest: f64,
}

impl Gram {
    /// The fit of all wheels' volts with one a and one b, wherever they lie, the drive as late as fits best.
    pub fn shared(&self, currents: bool) -> Option<Shared> {
        let n = self.wheels;
        let size = GROUPS * n;
        let fit = |sums: &Vec<f64>| {
            let of = |x: usize, y: usize| (0..n).map(|j| sums[(x * n + j) * size + y * n + j]).sum::<f64>();
            let (uu, ww, ii, uw, ui, wi) = (of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2));
            let determinant = ww * ii - wi * wi;
            let (a, b) = match currents && determinant > 1e-9 * ww * ii {
                true => ((uw * ii - ui * wi) / determinant, (ui * ww - uw * wi) / determinant),
                false => (uw / ww, 0.0),
            };
            let left = uu - 2.0 * (a * uw + b * ui) + a * a * ww + 2.0 * a * b * wi + b * b * ii;
            let rest = left.max(0.0) / uu;
            (uu > 0.0 && ww > 0.0).then_some(Shared {
                a,
                b,
                by_speed: a * a * ww / uu,
                by_current: b * b * ii / uu,
                rest,
            })
        };
        self.sums.iter().filter_map(fit).min_by(|x, y| x.rest.total_cmp(&y.rest))
    }
}

/// Room for the wheels of any robot.
const WHEELS: usize = MOST_CHANNELS;

/// Products of speeds and currents, which no delay of the drive changes.
#[derive(Clone, Default)]
struct Measured {
    ww: [f64; WHEELS],
    ii: [f64; WHEELS],
    wi: [[f64; WHEELS]; WHEELS],
}

impl Measured {
    fn add(&mut self, w: &[f64; WHEELS], i: &[f64; WHEELS]) {
        for j in 0..WHEELS {
            self.ww[j] += w[j] * w[j];
            self.ii[j] += i[j] * i[j];
            for (sum, i) in self.wi[j].iter_mut().zip(i) {
                *sum += w[j] * i;
            }
        }
    }
}

/// Products with the drive, for one delay of it.
#[derive(Clone, Default)]
struct Driven {
    uu: [f64; WHEELS],
    uw: [[f64; WHEELS]; WHEELS],
    ui: [[f64; WHEELS]; WHEELS],
}

impl Driven {
    fn add(&mut self, u: &[f64; WHEELS], w: &[f64; WHEELS], i: &[f64; WHEELS]) {
        for (j, u) in u.iter().enumerate() {
            self.uu[j] += u * u;
            for (sum, w) in self.uw[j].iter_mut().zip(w) {
                *sum += u * w;
            }
            for (sum, i) in self.ui[j].iter_mut().zip(i) {
                *sum += u * i;
            }
        }
    }
}

/// The sums as one square table: all that a relation of a volt, a speed and a current asks for.
fn together(driven: &Driven, measured: &Measured, wheels: usize, size: usize) -> Vec<f64> {
    let mut sums = vec![0.0; size * size];
    let mut put = |a: usize, b: usize, sum: f64| (sums[a * size + b], sums[b * size + a]) = (sum, sum);
    for j in 0..wheels {
        put(j, j, driven.uu[j]);
        put(wheels + j, wheels + j, measured.ww[j]);
        put(2 * wheels + j, 2 * wheels + j, measured.ii[j]);
        for k in 0..wheels {
            put(j, wheels + k, driven.uw[j][k]);
            put(j, 2 * wheels + k, driven.ui[j][k]);
            put(wheels + j, 2 * wheels + k, measured.wi[j][k]);
        }
    }
    sums
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
