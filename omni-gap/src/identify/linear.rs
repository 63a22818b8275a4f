//! Errors and exact derivatives of every window, and the normal equations with the starts eliminated.
//!
//! ```text
//! e ≈ J_z·Δz + J_p·Δp        z: the window's start, p: the free parameters
//! H_zz = J_zᵀJ_z, …          per window, then Σ over windows of H_pp − H_pz·H_zz⁻¹·H_zp
//! ```

use model_core::dual::Dual;
use model_core::frames::{BodyTwist, Pose};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::shoot::{Shots, Starts, Windows, run_windows};
use crate::simulate::{Model, Recorded, Slot};

/// Parameters of a window's start: x, y, θ, v, vn, ω.
pub const START: usize = 6;

/// Of those, the ones that need the plant to differentiate; moving or turning the whole path is geometry.
const TWIST: usize = 3;

/// Keeps a start regular that nothing in its window measures: 1/σ² of (m, m, rad, m/s, m/s, rad/s), much looser than
/// any sensor, as damping only.
const LOOSE: [f64; START] = [1.0, 1.0, 1.0, 1.0, 1.0, 0.1];

/// One window: its errors and derivatives, in units of sigma.
#[derive(Clone, Debug)]
pub struct WindowLinear {
    /// (row, channel) of each measured number.
    pub places: Vec<(u32, u8)>,
    /// Measured minus predicted [σ]
    pub error: DVector<f64>,
    /// d predicted / d (start, parameters) [σ]
    pub jacobian: DMatrix<f64>,
}

/// Everything that a step of the fit needs of one window.
#[derive(Clone, Debug)]
struct Block {
    hess: DMatrix<f64>,
    grad: DVector<f64>,
    cost: f64,
    count: usize,
}

/// The windows of all runs, linearised.
#[derive(Clone, Debug)]
pub struct Linearised {
    blocks: Vec<Vec<Block>>,
    /// The windows themselves, where they were asked to be kept: run by run.
    pub windows: Vec<Vec<WindowLinear>>,
    free: usize,
}

/// The reduced equations: S·Δp = g, and what brings the starts along.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// Σ H_pp − H_pz·H_zz⁻¹·H_zp
    pub hess: DMatrix<f64>,
    /// Σ g_p − H_pz·H_zz⁻¹·g_z
    pub grad: DVector<f64>,
    /// Σ over windows of (its reduced gradient)·(the same)ᵀ
    pub meat: DMatrix<f64>,
}

impl Reduced {
    /// The same with the data weighted down: errors count by √φ less.
    pub fn tempered(mut self, temper: f64) -> Self {
        self.hess /= temper;
        self.grad /= temper;
        self.meat /= temper * temper;
        self
    }
}

/// Linearises a model on runs. `keep` keeps the windows' own matrices, which a screening of effects needs.
pub fn linearise<const N: usize>(
    model: &Model<N>,
    shots: Shots<'_, N>,
    starts: &[Starts],
    free: &[Slot],
    keep: bool,
) -> Linearised {
    let Shots { runs, windows } = shots;
    let done: Vec<(Vec<Block>, Vec<WindowLinear>)> = (0..runs.len())
        .into_par_iter()
        .map(|k| {
            let linear = linearise_run(model, runs[k], &windows[k], &starts[k], free);
            let blocks = linear.iter().map(Block::new).collect();
            (blocks, if keep { linear } else { Vec::new() })
        })
        .collect();
    let (blocks, kept) = done.into_iter().unzip();
    Linearised { blocks, windows: kept, free: free.len() }
}

fn linearise_run<const N: usize>(
    model: &Model<N>,
    run: &Recorded<N>,
    windows: &Windows,
    starts: &Starts,
    free: &[Slot],
) -> Vec<WindowLinear> {
    let count = Recorded::<N>::channels().count();
    let mut linear: Vec<WindowLinear> = (0..windows.len())
        .map(|k| {
            let places: Vec<(u32, u8)> = windows
                .rows(k)
                .flat_map(|row| (0..count).filter(move |c| run.saw(row, *c)).map(move |c| (row as u32, c as u8)))
                .collect();
            let rows = places.len();
            WindowLinear { places, error: DVector::zeros(rows), jacobian: DMatrix::zeros(rows, START + free.len()) }
        })
        .collect();
    // as few derivatives a pass as two passes allow
    let lanes = TWIST + free.len();
    if lanes <= 16 {
        passes::<N, 8>(model, run, windows, starts, free, &mut linear);
    } else {
        passes::<N, 10>(model, run, windows, starts, free, &mut linear);
    }
    linear
}

fn passes<const N: usize, const LANES: usize>(
    model: &Model<N>,
    run: &Recorded<N>,
    windows: &Windows,
    starts: &Starts,
    free: &[Slot],
    linear: &mut [WindowLinear],
) {
    for first in (0..TWIST + free.len()).step_by(LANES) {
        pass::<N, LANES>(model, run, windows, starts, free, first, linear);
    }
}

/// One pass: the plant in dual numbers whose lanes are the derivatives `first..first + LANES` of (v, vn, ω, free…).
fn pass<const N: usize, const LANES: usize>(
    model: &Model<N>,
    run: &Recorded<N>,
    windows: &Windows,
    starts: &Starts,
    free: &[Slot],
    first: usize,
    linear: &mut [WindowLinear],
) {
    let lane = |index: usize, x: f64| match index.checked_sub(first) {
        Some(lane) if lane < LANES => Dual::<LANES>::variable(x, lane),
        _ => Dual::<LANES>::constant(x),
    };
    let plant = model.plant_with::<Dual<LANES>>(|slot, x| match free.iter().position(|f| *f == slot) {
        Some(at) => lane(TWIST + at, x),
        None => Dual::<LANES>::constant(x),
    });
    let own = TWIST.saturating_sub(first);
    let lanes = LANES.min(TWIST + free.len() - first);
    let start = |k: usize| {
        let [x, y, theta, v, vn, w] = starts[k];
        let pose = Pose {
            x: Dual::<LANES>::constant(x),
            y: Dual::<LANES>::constant(y),
            theta: Dual::<LANES>::constant(theta),
        };
        (pose, BodyTwist { v: lane(0, v), vn: lane(1, vn), w: lane(2, w) })
    };
    // what the memory holds does not depend on the start of this window
    let enter = |memory: &mut [Dual<LANES>]| memory.iter_mut().for_each(|m| m.eps[..own.min(LANES)].fill(0.0));
    let count = Recorded::<N>::channels().count();
    let mut at = 0;
    let mut last = usize::MAX;
    run_windows(&plant, run, windows, start, enter, |k, row, predicted| {
        if k != last {
            (at, last) = (0, k);
        }
        let window = &mut linear[k];
        for c in (0..count).filter(|c| run.saw(row, *c)) {
            let per_sigma = 1.0 / run.sigma[c];
            for lane in 0..lanes {
                window.jacobian[(at, TWIST + first + lane)] = predicted[c].eps[lane] * per_sigma;
            }
            if first == 0 {
                window.error[at] = run.error(row, c, predicted[c].re);
                // moving and turning the start moves and turns the path
                let turned = match c - (2 * N).min(c) {
                    _ if c < 2 * N => None,
                    0 => Some((0, -(predicted[2 * N + 1].re - starts[k][1]))),
                    1 => Some((1, predicted[2 * N].re - starts[k][0])),
                    _ => Some((2, 1.0)),
                };
                if let Some((axis, by_heading)) = turned {
                    window.jacobian[(at, axis)] = per_sigma;
                    window.jacobian[(at, 2)] = by_heading * per_sigma;
                }
            }
            at += 1;
        }
    });
}

impl Block {
    fn new(window: &WindowLinear) -> Self {
        Self {
            hess: window.jacobian.tr_mul(&window.jacobian),
            grad: window.jacobian.tr_mul(&window.error),
            cost: window.error.norm_squared(),
            count: window.error.len(),
        }
    }

    /// H_zz⁻¹·[H_zp, g_z], by Cholesky.
    fn eliminate(&self) -> (DMatrix<f64>, DVector<f64>) {
        let mut hzz = self.hess.view((0, 0), (START, START)).into_owned();
        for k in 0..START {
            hzz[(k, k)] += LOOSE[k];
        }
        let free = self.hess.ncols() - START;
        match hzz.cholesky() {
            Some(c) => (c.solve(&self.hess.view((0, START), (START, free))), c.solve(&self.grad.rows(0, START))),
            None => (DMatrix::zeros(START, free), DVector::zeros(START)),
        }
    }
}

impl Linearised {
    /// Σ error² [σ²] and how many numbers were compared.
    pub fn cost(&self) -> (f64, usize) {
        self.blocks.iter().flatten().fold((0.0, 0), |(cost, n), b| (cost + b.cost, n + b.count))
    }

    /// Cost and count of each window, run by run.
    pub fn cost_by_window(&self) -> Vec<Vec<(f64, usize)>> {
        self.blocks.iter().map(|run| run.iter().map(|b| (b.cost, b.count)).collect()).collect()
    }

    /// The equations of the parameters alone.
    pub fn reduced(&self) -> Reduced {
        let n = self.free;
        let mut sum = Reduced { hess: DMatrix::zeros(n, n), grad: DVector::zeros(n), meat: DMatrix::zeros(n, n) };
        for block in self.blocks.iter().flatten() {
            let (x, z) = block.eliminate();
            let hpz = block.hess.view((START, 0), (n, START));
            sum.hess += block.hess.view((START, START), (n, n)) - hpz * x;
            let grad = block.grad.rows(START, n) - hpz * z;
            sum.meat += &grad * grad.transpose();
            sum.grad += grad;
        }
        sum
    }

    /// How the starts move when the parameters move by `step`: Δz = H_zz⁻¹·(g_z − H_zp·Δp).
    pub fn starts_after(&self, starts: &[Starts], step: &DVector<f64>) -> Vec<Starts> {
        self.blocks
            .iter()
            .zip(starts)
            .map(|(blocks, starts)| {
                blocks
                    .iter()
                    .zip(starts)
                    .map(|(block, start)| {
                        let (x, z) = block.eliminate();
                        let moved = z - x * step;
                        std::array::from_fn(|k| start[k] + moved[k])
                    })
                    .collect()
            })
            .collect()
    }

    /// A candidate's signature against all this: (what it explains, its own size, its overlap with the parameters),
    /// the starts eliminated. `signature` is per run and window, in sigma.
    pub fn project(&self, signature: &[Vec<DVector<f64>>]) -> (f64, f64, DVector<f64>) {
        let mut sums = (0.0, 0.0, DVector::zeros(self.free));
        for ((blocks, windows), signs) in self.blocks.iter().zip(&self.windows).zip(signature) {
            for ((block, window), s) in blocks.iter().zip(windows).zip(signs) {
                let b = window.jacobian.tr_mul(s);
                let (x, z) = block.eliminate();
                let bz = b.rows(0, START);
                let mut hzz = block.hess.view((0, 0), (START, START)).into_owned();
                for k in 0..START {
                    hzz[(k, k)] += LOOSE[k];
                }
                let own = hzz.cholesky().map_or_else(|| DVector::zeros(START), |c| c.solve(&bz));
                sums.0 += s.dot(&window.error) - bz.dot(&z);
                sums.1 += s.norm_squared() - bz.dot(&own);
                sums.2 += b.rows(START, self.free) - x.transpose() * bz;
            }
        }
        sums
    }
}
