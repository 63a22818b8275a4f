//! Errors and exact derivatives of every window, and the normal equations with the starts eliminated.
//!
//! ```text
//! e ≈ J_z·Δz + J_p·Δp        z: the window's start, p: the free parameters
//! H_zz = J_zᵀJ_z, …          per window, then Σ over windows of H_pp − H_pz·H_zz⁻¹·H_zp
//! ```

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::block::{Block, Sums};
use super::misfit::Misfit;
use super::pass::{Course, TWIST, pass};
use super::shoot::{Piece, Shots, Starts};
use super::window::{START, WindowLinear};
use crate::simulate::{AlignedRun, Model, SignalGroup, Slot};

/// The most derivatives that one pass takes; more than these are taken in passes of [`KEPT`].
const MOST: usize = 20;

/// As many as all nominal values and two numbers of an effect take, with a twist.
const USUAL: usize = 18;

/// Derivatives of a pass with few parameters, and of each pass whose windows are kept.
const KEPT: usize = 10;

/// As many as a fit of all runs together takes: nine numbers and a twist.
const JOINT: usize = 12;

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
    /// Σ g_zᵀ·H_zz⁻¹·g_z: the drop of Σ error² that the starts alone promise [σ²]
    pub by_starts: f64,
}

impl Reduced {
    /// Those of some parameters alone, the others held.
    pub fn of(&self, parameters: &[usize]) -> Self {
        let square = |matrix: &DMatrix<f64>| matrix.select_rows(parameters).select_columns(parameters);
        let grad = self.grad.select_rows(parameters);
        Self { hess: square(&self.hess), grad, meat: square(&self.meat), by_starts: self.by_starts }
    }

    /// The same with the data weighted down: errors count by √φ less.
    pub fn with_dispersion(mut self, dispersion: f64) -> Self {
        self.hess /= dispersion;
        self.grad /= dispersion;
        self.meat /= dispersion * dispersion;
        self.by_starts /= dispersion;
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
    let lanes = TWIST + free.len();
    let pieces = shots.pieces(model);
    let done: Vec<(Vec<Block>, Vec<WindowLinear>)> = pieces
        .par_iter()
        .map(|piece| {
            let k = piece.run;
            let course = Course { model, run: runs[k], windows: &windows[k], starts: &starts[k], free };
            if keep || lanes > MOST {
                let linear = kept(course, piece);
                let blocks = linear.iter().map(Block::of).collect();
                return (blocks, if keep { linear } else { Vec::new() });
            }
            // a pass costs what its lanes cost: no more of them than are needed, in a few sizes
            let blocks = if lanes <= TWIST {
                summed::<N, TWIST>(course, piece)
            } else if lanes <= KEPT {
                summed::<N, KEPT>(course, piece)
            } else if lanes <= JOINT {
                summed::<N, JOINT>(course, piece)
            } else if lanes <= USUAL {
                summed::<N, USUAL>(course, piece)
            } else {
                summed::<N, MOST>(course, piece)
            };
            (blocks, Vec::new())
        })
        .collect();
    let mut linear =
        Linearised { blocks: vec![Vec::new(); runs.len()], windows: vec![Vec::new(); runs.len()], free: free.len() };
    for (piece, (blocks, windows)) in pieces.iter().zip(done) {
        linear.blocks[piece.run].extend(blocks);
        linear.windows[piece.run].extend(windows);
    }
    linear
}

/// The normal equations of the windows of a piece.
fn summed<const N: usize, const LANES: usize>(course: Course<'_, N>, piece: &Piece) -> Vec<Block> {
    let lanes = TWIST + course.free.len();
    let mut sums = vec![Sums::<LANES>::NOTHING; piece.windows.len()];
    let pose = AlignedRun::<N>::channels().of(SignalGroup::Pose);
    pass::<N, LANES>(course, piece.windows.clone(), 0, |k, _, seen| sums[k - piece.windows.start].add(seen, &pose));
    sums.iter().map(|sums| sums.block(lanes)).collect()
}

/// The windows of a piece, whole.
fn kept<const N: usize>(course: Course<'_, N>, piece: &Piece) -> Vec<WindowLinear> {
    let Course { run, windows, free, .. } = course;
    let count = AlignedRun::<N>::channels().count();
    let mut linear: Vec<WindowLinear> = piece
        .windows
        .clone()
        .map(|k| {
            let places: Vec<(u32, u8)> = windows
                .rows(k)
                .flat_map(|row| (0..count).filter(move |c| run.saw(row, *c)).map(move |c| (row as u32, c as u8)))
                .collect();
            let rows = places.len();
            WindowLinear { places, error: DVector::zeros(rows), jacobian: DMatrix::zeros(rows, START + free.len()) }
        })
        .collect();
    for first in (0..TWIST + free.len()).step_by(KEPT) {
        let lanes = KEPT.min(TWIST + free.len() - first);
        let (mut at, mut last) = (0, usize::MAX);
        pass::<N, KEPT>(course, piece.windows.clone(), first, |k, _, seen| {
            if k != last {
                (at, last) = (0, k);
            }
            let window = &mut linear[k - piece.windows.start];
            for seen in seen {
                for (lane, slope) in seen.lanes[..lanes].iter().enumerate() {
                    window.jacobian[(at, START - TWIST + first + lane)] = *slope;
                }
                if first == 0 {
                    window.error[at] = seen.error;
                    for (axis, slope) in seen.moved.iter().enumerate() {
                        window.jacobian[(at, axis)] = *slope;
                    }
                }
                at += 1;
            }
        });
    }
    linear
}

impl Linearised {
    /// How far all numbers are missed.
    pub fn misfit(&self) -> Misfit {
        self.blocks.iter().flatten().fold(Misfit::default(), |sum, block| sum.and(block.misfit))
    }

    /// How far those of each window are missed, run by run.
    pub fn misfits(&self) -> Vec<Vec<Misfit>> {
        self.blocks.iter().map(|run| run.iter().map(|block| block.misfit).collect()).collect()
    }

    /// The equations of the parameters alone.
    pub fn reduced(&self) -> Reduced {
        let n = self.free;
        let mut sum =
            Reduced { hess: DMatrix::zeros(n, n), grad: DVector::zeros(n), meat: DMatrix::zeros(n, n), by_starts: 0.0 };
        for block in self.blocks.iter().flatten() {
            let (x, z) = block.eliminate();
            let hpz = block.hess.view((START, 0), (n, START));
            sum.hess += block.hess.view((START, START), (n, n)) - hpz * x;
            sum.by_starts += block.grad.rows(0, START).dot(&z);
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
    /// the starts eliminated. `signature` is per run and window, in sigma, whitened.
    pub fn project(&self, signature: &[Vec<DVector<f64>>]) -> (f64, f64, DVector<f64>) {
        let mut sums = (0.0, 0.0, DVector::zeros(self.free));
        for ((blocks, windows), signs) in self.blocks.iter().zip(&self.windows).zip(signature) {
            for ((block, window), s) in blocks.iter().zip(windows).zip(signs) {
                let b = window.jacobian.tr_mul(s);
                let (x, z) = block.eliminate();
                let bz = b.rows(0, START);
                let own = block.start().cholesky().map_or_else(|| DVector::zeros(START), |c| c.solve(&bz));
                sums.0 += s.dot(&window.error) - bz.dot(&z);
                sums.1 += s.norm_squared() - bz.dot(&own);
                sums.2 += b.rows(START, self.free) - x.transpose() * bz;
            }
        }
        sums
    }
}
