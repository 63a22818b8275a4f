//! The signatures of causes on a set of recordings.

use model_core::plant::robot::Nominal;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::left::Left;
use super::suspects::Column;
use crate::engine::knobs::SelftestKnobs;
use crate::engine::predictions::predictions;
use crate::identify::{
    Free, Linearised, Overlap, Prior, Shots, Starts, WindowLinear, Windows, first_starts, linearise, nominal_free,
};
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, Model, Slot};

/// Recordings, and all that a signature is compared with on them.
pub(super) struct Laid<'a, const N: usize> {
    pub model: Model<N>,
    runs: Vec<LaidRun<'a, N>>,
    free: Vec<Free>,
    prior: Prior,
    wrong: f64,
}

/// One run, linearised at the nominal model.
struct LaidRun<'a, const N: usize> {
    run: [&'a AlignedRun<N>; 1],
    windows: [Windows; 1],
    starts: [Starts; 1],
    linear: Linearised,
    /// What the nominal model predicts, window by window [σ]
    plain: Vec<DVector<f64>>,
}

impl<'a, const N: usize> Laid<'a, N> {
    pub fn new(file: &RobotFile, model: Model<N>, runs: &'a [AlignedRun<N>], knobs: &SelftestKnobs) -> Self {
        let free = nominal_free(&knobs.engine.fit);
        let laid = |run| LaidRun::new(&model, run, &free, knobs.engine.layout.window_s);
        Self { runs: runs.par_iter().map(laid).collect(), free, prior: Prior::stated(file), wrong: knobs.wrong, model }
    }

    /// What is left of the signatures of these columns, by the channels of each bit mask.
    pub fn left(&self, columns: &[Column], channels: &[u16]) -> Vec<Left> {
        let none = || vec![Overlap::nothing(columns.len(), self.free.len()); channels.len()];
        let add = |sums: Vec<Overlap>, run: Vec<Overlap>| sums.into_iter().zip(run).map(|(a, b)| a.and(b)).collect();
        let sums = self.runs.iter().map(|run| run.overlaps(self, columns, channels)).fold(none(), add);
        sums.into_iter()
            .map(|sum| Left::new(sum.taken_by_parameters(&self.model, &self.free, &self.prior), sum))
            .collect()
    }

    /// The place of a factor among the free numbers.
    fn place(&self, factor: Nominal) -> Option<usize> {
        self.free.iter().position(|free| free.slot == Slot::Nominal(factor))
    }
}

impl<'a, const N: usize> LaidRun<'a, N> {
    fn new(model: &Model<N>, run: &'a AlignedRun<N>, free: &[Free], window_s: f64) -> Self {
        let (run, windows) = ([run], [Windows::new(run, window_s)]);
        let shots = Shots { runs: &run, windows: &windows };
        let starts = [first_starts(&model.plant(), run[0], &windows[0])];
        let slots: Vec<Slot> = free.iter().map(|free| free.slot).collect();
        let linear = linearise(model, shots, &starts, &slots, true);
        let plain = predictions(&model.plant(), shots, &starts, &linear).into_iter().flatten().collect();
        Self { run, windows, starts, linear, plain }
    }

    fn overlaps(&self, of: &Laid<'_, N>, columns: &[Column], channels: &[u16]) -> Vec<Overlap> {
        let signatures: Vec<_> = columns.par_iter().map(|column| self.signature(of, column)).collect();
        let summed = |channels: &u16| {
            let mut sum = Overlap::nothing(columns.len(), of.free.len());
            for (w, window) in self.linear.windows[0].iter().enumerate() {
                let columns: Vec<_> = signatures.iter().map(|signature| signature[w].clone()).collect();
                sum.add(window, &DMatrix::from_columns(&columns), *channels);
            }
            sum
        };
        channels.par_iter().map(summed).collect()
    }

    /// By how much a cause moves every number, window by window [σ].
    fn signature(&self, of: &Laid<'_, N>, column: &Column) -> Vec<DVector<f64>> {
        match column {
            Column::Effect(effect) => {
                let mut model = of.model.clone();
                model.add_effect(effect.clone());
                let shots = Shots { runs: &self.run, windows: &self.windows };
                let with = predictions(&model.plant(), shots, &self.starts, &self.linear);
                with.into_iter().flatten().zip(&self.plain).map(|(with, without)| with - without).collect()
            }
            Column::Factors(factors) => {
                let of_window = |window: &WindowLinear| {
                    let first = window.jacobian.ncols() - of.free.len();
                    let moved = factors.iter().filter_map(|factor| of.place(*factor));
                    let still = DVector::zeros(window.error.len());
                    moved.fold(still, |sum, at| sum + of.wrong * window.jacobian.column(first + at))
                };
                self.linear.windows[0].iter().map(of_window).collect()
            }
        }
    }
}
