//! The signatures of causes on a set of recordings.

use std::collections::BTreeMap;

use model_core::plant::robot::Nominal;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::left::{Held, Imitated, Left};
use super::suspects::Column;
use super::view::{Seen, View};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::predictions::predictions;
use crate::identify::{
    Free, Linearised, Overlap, Prior, SeenWindow, Shots, Starts, WindowLinear, Windows, first_starts, held_by,
    linearise, nominal_free, slopes_of, stepped,
};
use crate::log::RobotFile;
use crate::simulate::{AlignedRun, MAX_CHANNELS, Model, Slot};

/// Recordings, and all that a signature is compared with on them.
pub(in crate::engine) struct Laid<'a, const N: usize> {
    pub model: Model<N>,
    runs: Vec<LaidRun<'a, N>>,
    free: Vec<Free>,
    prior: Prior,
    wrong: f64,
    look_twice: f64,
}

/// What signatures have in common on recordings, and what the numbers of the robot move there: sums, so that those of other
/// recordings may be added.
#[derive(Clone)]
pub(in crate::engine) struct Look {
    overlap: Overlap,
    seen: Seen,
}

/// A model whose numbers are moved so that it imitates a signature.
struct Imitation<const N: usize> {
    /// The column of the signature.
    column: usize,
    model: Model<N>,
    /// By how much its numbers are moved.
    step: DVector<f64>,
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
        Self {
            runs: runs.par_iter().map(laid).collect(),
            free,
            prior: Prior::stated(file),
            wrong: knobs.wrong,
            look_twice: knobs.look_twice,
            model,
        }
    }

    /// In how many telegrams a loss would show, for all wheels or for one alone.
    pub fn telegrams_told(&self, wheel: Option<usize>) -> usize {
        self.runs.iter().map(|run| run.run[0].losses.told(wheel)).sum()
    }

    /// The recordings by the channels of a bit mask.
    pub fn view(&self, mask: u16) -> View {
        let windows = self.runs.iter().map(|run| run.linear.windows[0].as_slice());
        View::new(windows, mask, self.free.len())
    }

    /// What is left of the signatures of these columns in each view. What numbers imitate in large part is looked at twice:
    /// the second time they are moved to where a straight line says that they imitate it best.
    pub fn left(&self, columns: &[Column], views: &[View]) -> Vec<Left> {
        let nothing = Imitated::nothing(columns.len(), self.free.len(), self.prior.rows.len());
        let first = self.overlaps(columns, views, &views.iter().map(|_| Vec::new()).collect::<Vec<_>>());
        let first: Vec<Left> = first
            .iter()
            .zip(views)
            .map(|(sum, view)| Left::new(sum, &nothing, &self.held(&view.seen, &self.prior)))
            .collect();
        let imitations: Vec<Vec<Imitation<N>>> = first.iter().map(|left| self.imitations(columns, left)).collect();
        if imitations.iter().all(Vec::is_empty) {
            return first;
        }
        let second = self.overlaps(columns, views, &imitations);
        let left = |(((sum, view), first), imitations): (((&Overlap, &View), &Left), &Vec<Imitation<N>>)| {
            let mut before = nothing.clone();
            before.whole = Some(first.whole().clone());
            for Imitation { column, model, step } in imitations {
                before.moved.set_column(*column, step);
                before.violated.set_column(*column, &DVector::from_vec(self.prior.violations(model)));
            }
            Left::new(sum, &before, &self.held(&view.seen, &self.prior))
        };
        second.iter().zip(views).zip(&first).zip(&imitations).map(left).collect()
    }

    /// What is stated of the numbers of the robot.
    pub fn stated(&self) -> &Prior {
        &self.prior
    }

    /// A look at signatures along a straight line, by the channels of a bit mask.
    pub fn look(&self, columns: &[Column], mask: u16) -> Look {
        let view = self.view(mask);
        let overlap = self.overlaps(columns, std::slice::from_ref(&view), &[Vec::new()]).remove(0);
        Look { overlap, seen: view.seen }
    }

    /// What is left of the signatures of a look, with the numbers held by what is stated.
    pub fn left_of(&self, look: &Look, stated: &Prior) -> Left {
        let signatures = look.overlap.signatures();
        let nothing = Imitated::nothing(signatures, self.free.len(), stated.rows.len());
        Left::new(&look.overlap, &nothing, &self.held(&look.seen, stated))
    }

    /// The equations of the numbers.
    fn held<'v>(&self, seen: &'v Seen, stated: &Prior) -> Held<'v> {
        Held {
            seen,
            equations: held_by(seen.products(), &self.model, &self.free, stated),
            slopes: slopes_of(stated, &self.model, &self.free),
        }
    }

    /// The products of signatures in each view, each signature without what its imitation makes of it.
    fn overlaps(&self, columns: &[Column], views: &[View], imitations: &[Vec<Imitation<N>>]) -> Vec<Overlap> {
        let none = || vec![Overlap::nothing(columns.len(), self.free.len()); views.len()];
        let add = |sums: Vec<Overlap>, run: Vec<Overlap>| sums.into_iter().zip(&run).map(|(a, b)| a.and(b)).collect();
        let of_run = |(k, run): (usize, &LaidRun<'_, N>)| {
            let signatures: Vec<_> = columns.par_iter().map(|column| run.signature(self, column)).collect();
            let of_view = |(view, imitations): (&View, &Vec<Imitation<N>>)| {
                run.overlap(&view.runs[k], &signatures, imitations, self.free.len())
            };
            views.par_iter().zip(imitations).map(of_view).collect()
        };
        self.runs.iter().enumerate().map(of_run).fold(none(), add)
    }

    /// The numbers moved to where they imitate a signature best, for each that they imitate in large part.
    fn imitations(&self, columns: &[Column], left: &Left) -> Vec<Imitation<N>> {
        // what wrong numbers do is a straight line here
        let of_effect = |(_, column): &(usize, &Column)| matches!(column, Column::Effect(_));
        let twice = |(column, _): &(usize, &Column)| left.share_taken(*column) >= self.look_twice;
        let imitation = |(column, _): (usize, &Column)| {
            let (model, step) = stepped(&self.model, &self.free, &left.moved(column));
            Imitation { column, model, step }
        };
        columns.iter().enumerate().filter(of_effect).filter(twice).map(imitation).collect()
    }

    /// The place of a factor among the free numbers.
    fn place(&self, factor: Nominal) -> Option<usize> {
        self.free.iter().position(|free| free.slot == Slot::Nominal(factor))
    }
}

impl Look {
    /// Of so many times as many samples like these, channel by channel.
    #[must_use]
    pub fn times(self, times: &[f64; MAX_CHANNELS]) -> Self {
        Self { overlap: self.overlap.times(times), seen: self.seen.times(times) }
    }

    /// With a look at other recordings.
    #[must_use]
    pub fn and(self, other: &Self) -> Self {
        Self { overlap: self.overlap.and(&other.overlap), seen: self.seen.and(&other.seen.channels) }
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

    /// The products of signatures on what is seen of the run, each without what moved numbers make of it.
    fn overlap(
        &self,
        seen: &[SeenWindow],
        signatures: &[Vec<DVector<f64>>],
        imitations: &[Imitation<N>],
        numbers: usize,
    ) -> Overlap {
        let beyond = |by: &Imitation<N>| (by.column, self.beyond(by, &signatures[by.column], seen));
        let beyond: BTreeMap<usize, Vec<DVector<f64>>> = imitations.par_iter().map(beyond).collect();
        let mut sum = Overlap::nothing(signatures.len(), numbers);
        for (w, window) in seen.iter().enumerate() {
            let column = |(k, signature)| beyond.get(&k).unwrap_or(signature)[w].select_rows(&window.rows);
            let columns: Vec<DVector<f64>> = signatures.iter().enumerate().map(column).collect();
            sum.add(window, &DMatrix::from_columns(&columns));
        }
        sum
    }

    /// A signature without what moved numbers, and starts that move with them, make of it.
    fn beyond(&self, by: &Imitation<N>, signature: &[DVector<f64>], seen: &[SeenWindow]) -> Vec<DVector<f64>> {
        let moved = self.starts[0].iter().zip(seen).zip(signature).map(|((start, window), signature)| {
            let step = window.start_moved(&signature.select_rows(&window.rows), &by.step);
            std::array::from_fn(|k| start[k] + step[k])
        });
        let shots = Shots { runs: &self.run, windows: &self.windows };
        let imitated = predictions(&by.model.plant(), shots, &[moved.collect()], &self.linear);
        let there = imitated.into_iter().flatten().zip(&self.plain);
        signature.iter().zip(there).map(|(signature, (there, here))| signature - (there - here)).collect()
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
