//! What signatures have in common beyond what the windows' starts can imitate.
//!
//! ```text
//! s' = s − J_z·(H_zz⁻¹·J_zᵀ·s),  J' = J_p − J_z·(H_zz⁻¹·J_zᵀ·J_p)      Σ s'ᵀs',  Σ J'ᵀs',  Σ J'ᵀJ'
//! ```
//!
//! s: by how much a cause moves every number, in sigma, whitened; J_z, J_p: d predicted / d (start, numbers).

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::block::Block;
use super::window::{START, WindowLinear};
use crate::simulate::MAX_CHANNELS;

/// A linearised window by some of its channels alone.
#[derive(Debug)]
pub struct SeenWindow {
    /// Which of the window's numbers are seen, channel by channel.
    pub rows: Vec<usize>,
    /// Where each channel stands in these.
    channels: [Range<usize>; MAX_CHANNELS],
    /// J_z [σ]
    starts: DMatrix<f64>,
    /// J' [σ]
    numbers: DMatrix<f64>,
    /// The products of J_z and J_p.
    block: Block,
}

impl SeenWindow {
    /// By the channels of a bit mask.
    pub fn new(window: &WindowLinear, mask: u16) -> Self {
        let mut rows = Vec::new();
        let channels = std::array::from_fn(|channel| {
            let first = rows.len();
            if mask >> channel & 1 == 1 {
                let here = window.places.iter().enumerate().filter(|(_, (_, c))| usize::from(*c) == channel);
                rows.extend(here.map(|(k, _)| k));
            }
            first..rows.len()
        });
        let jacobian = window.jacobian.select_rows(&rows);
        let block = Block::of_equations(&jacobian, &DVector::zeros(rows.len()));
        let (by_numbers, _) = block.eliminate();
        let starts = jacobian.columns(0, START).into_owned();
        let numbers = jacobian.columns(START, by_numbers.ncols()) - &starts * by_numbers;
        Self { rows, channels, starts, numbers, block }
    }

    /// Of each channel, the products of J' and how many numbers are seen.
    pub fn by_channel(&self) -> [(DMatrix<f64>, usize); MAX_CHANNELS] {
        self.channels.clone().map(|rows| {
            let numbers = self.numbers.rows(rows.start, rows.len());
            (numbers.tr_mul(&numbers), rows.len())
        })
    }

    /// How the start moves to imitate signatures, the numbers as they are.
    fn imitated(&self, signatures: &DMatrix<f64>) -> DMatrix<f64> {
        let of_starts = self.starts.tr_mul(signatures);
        let equations = self.block.start().cholesky();
        equations.map_or_else(|| DMatrix::zeros(START, signatures.ncols()), |c| c.solve(&of_starts))
    }

    /// How the start moves to imitate a signature while the numbers move by a step.
    pub fn start_moved(&self, signature: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        let alone = self.imitated(&DMatrix::from_columns(std::slice::from_ref(signature)));
        let (by_numbers, _) = self.block.eliminate();
        alone.column(0) - by_numbers * step
    }
}

/// Sums of products over the numbers of one channel.
#[derive(Clone, Debug)]
pub struct Products {
    /// Signatures with signatures [σ²]
    pub signatures: DMatrix<f64>,
    /// J' with signatures, one row a number of the robot.
    pub shared: DMatrix<f64>,
}

/// The products of all windows, channel by channel.
#[derive(Clone, Debug)]
pub struct Overlap {
    channels: [Products; MAX_CHANNELS],
}

impl Overlap {
    /// Of so many signatures and numbers, over no window yet.
    pub fn nothing(signatures: usize, numbers: usize) -> Self {
        let products = |_| Products {
            signatures: DMatrix::zeros(signatures, signatures),
            shared: DMatrix::zeros(numbers, signatures),
        };
        Self { channels: std::array::from_fn(products) }
    }

    /// Adds a window. `signatures` has a row for each number that is seen of it.
    pub fn add(&mut self, window: &SeenWindow, signatures: &DMatrix<f64>) {
        let left = signatures - &window.starts * window.imitated(signatures);
        for (products, rows) in self.channels.iter_mut().zip(&window.channels) {
            let (s, j) = (left.rows(rows.start, rows.len()), window.numbers.rows(rows.start, rows.len()));
            products.signatures += s.tr_mul(&s);
            products.shared += j.tr_mul(&s);
        }
    }

    /// Of so many times as many samples like these, channel by channel.
    #[must_use]
    pub fn times(mut self, times: &[f64; MAX_CHANNELS]) -> Self {
        for (sum, times) in self.channels.iter_mut().zip(times) {
            sum.signatures *= *times;
            sum.shared *= *times;
        }
        self
    }

    /// How many signatures.
    pub fn signatures(&self) -> usize {
        self.channels[0].signatures.ncols()
    }

    /// Of the windows of both.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        for (sum, more) in self.channels.iter_mut().zip(&other.channels) {
            sum.signatures += &more.signatures;
            sum.shared += &more.shared;
        }
        self
    }

    /// Over the numbers of each channel.
    pub fn channels(&self) -> &[Products; MAX_CHANNELS] {
        &self.channels
    }

    /// Over all numbers.
    pub fn sum(&self) -> Products {
        let [first, others @ ..] = &self.channels;
        let add = |sum: Products, more: &Products| Products {
            signatures: sum.signatures + &more.signatures,
            shared: sum.shared + &more.shared,
        };
        others.iter().fold(first.clone(), add)
    }
}
