//! What a model costs from starts that it is given, window by window.

use model_core::geometry::frames::{BodyTwist, Pose};
use rayon::prelude::*;

use super::shoot::{Piece, Shots, StartState, Starts, run_some_windows};
use super::whiten::Whitener;
use crate::simulate::{AlignedRun, FreeRun, Model};

/// By how many times a step starts are taken farther, in tries.
const FARTHER: [f64; 3] = [4.0, 16.0, 64.0];

/// The starts of all windows, run by run, and what a model costs from them.
#[derive(Clone, Debug)]
pub(super) struct Begun {
    pub starts: Vec<Starts>,
    /// Σ error² of each window [σ²]
    costs: Vec<Vec<f64>>,
}

impl Begun {
    pub fn of<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, starts: Vec<Starts>) -> Self {
        let costs = costs_of(model, shots, &starts);
        Self { starts, costs }
    }

    /// Σ error² of all windows [σ²]
    pub fn cost(&self) -> f64 {
        self.costs.iter().flatten().sum()
    }

    /// Each window from where it costs less: a robot that friction stops at once tells nothing of the speed with which it
    /// began, and a step that is linear all the way goes anywhere.
    #[must_use]
    pub fn or(mut self, other: Self) -> Self {
        let here = self.starts.iter_mut().flatten().zip(self.costs.iter_mut().flatten());
        let there = other.starts.into_iter().flatten().zip(other.costs.into_iter().flatten());
        for ((start, cost), (other, other_cost)) in here.zip(there) {
            // a cost that is no number is more than any
            if cost.is_nan() || *cost > other_cost {
                (*start, *cost) = (other, other_cost);
            }
        }
        self
    }

    /// Each window from farther the same way that a step brought it `from`, as long as that costs less: where a wheel lets
    /// go, its speed bends, and derivatives see a bend that comes too late in the few rows alone that it is late by.
    #[must_use]
    pub fn taken_farther<const N: usize>(self, model: &Model<N>, shots: Shots<'_, N>, from: &[Starts]) -> Self {
        let stepped = self.starts.clone();
        let mut best = self;
        for times in FARTHER {
            let before = best.cost();
            best = best.or(Self::of(model, shots, part_of_the_way(from, &stepped, |_, _| times)));
            if best.cost() >= before {
                break;
            }
        }
        best
    }
}

/// Starts on the way from one to another, each window, by its run and number, its own part of it.
pub(super) fn part_of_the_way(from: &[Starts], to: &[Starts], part: impl Fn(usize, usize) -> f64) -> Vec<Starts> {
    let of_run = |(run, (from, to)): (usize, (&Starts, &Starts))| {
        let window = |(k, (from, to)): (usize, (&StartState, &StartState))| {
            std::array::from_fn(|x| from[x] + part(run, k) * (to[x] - from[x]))
        };
        from.iter().zip(to).enumerate().map(window).collect()
    };
    from.iter().zip(to).enumerate().map(of_run).collect()
}

/// Σ error² of each window of a model and its starts, run by run [σ²].
fn costs_of<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, starts: &[Starts]) -> Vec<Vec<f64>> {
    let plant = model.plant();
    let count = AlignedRun::<N>::channels().count();
    let Shots { runs, windows } = shots;
    let pieces = shots.pieces(model);
    let of_piece = |Piece { run: k, windows: which }: &Piece| {
        let (run, starts) = (runs[*k], &starts[*k]);
        let start = |w: usize| {
            let [x, y, theta, v, vn, w] = starts[w];
            (Pose { x, y, theta }, BodyTwist { v, vn, w })
        };
        let mut white = Whitener::<1>::of(run);
        let (mut sums, mut last) = (vec![0.0; which.len()], usize::MAX);
        run_some_windows(
            FreeRun::new(&plant, run),
            &windows[*k],
            which.clone(),
            start,
            |_| {},
            |w, row, predicted| {
                if w != last {
                    white.enter();
                    last = w;
                }
                for c in (0..count).filter(|c| run.saw(row, *c)) {
                    let mut error = [run.error(row, c, predicted[c])];
                    white.whiten(c, run.t[row], &mut error);
                    sums[w - which.start] += error[0] * error[0];
                }
            },
        );
        sums
    };
    let mut costs = vec![Vec::new(); runs.len()];
    for (piece, sums) in pieces.iter().zip(pieces.par_iter().map(of_piece).collect::<Vec<_>>()) {
        costs[piece.run].extend(sums);
    }
    costs
}

#[cfg(test)]
mod tests {
    use super::super::settings::FitSettings;
    use super::super::shoot::Windows;
    use super::super::staged::{Staging, robot, staged};
    use super::super::starts::profile;
    use super::*;

    /// Two runs of a robot, its windows, and what the best starts are.
    fn known(test: impl Fn(&Model<4>, Shots<'_, 4>, &[Starts])) {
        let truth = Model::<4>::nominal(&robot(), 12.0);
        let runs = staged(&truth, &Staging { runs: 2, ..Staging::default() });
        let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
        let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
        let shots = Shots { runs: &runs, windows: &windows };
        test(&truth, shots, &profile(&truth, shots, None, &FitSettings::default()).0);
    }

    /// The same starts at another place x [m].
    fn shifted(starts: &[Starts], by: f64) -> Vec<Starts> {
        let mut starts = starts.to_vec();
        starts.iter_mut().flatten().for_each(|start| start[0] += by);
        starts
    }

    #[test]
    fn each_window_keeps_the_start_that_costs_less() {
        known(|model, shots, best| {
            let mut mixed = shifted(best, 0.1);
            mixed[1] = best[1].clone();
            mixed[0][2][3] = f64::NAN;
            let mut other = best.to_vec();
            other[1] = shifted(best, 0.1).remove(1);
            let of = |starts: &[Starts]| Begun::of(model, shots, starts.to_vec());
            let both = of(&mixed).or(of(&other));
            assert_eq!(both.starts, best);
            assert_eq!(both.cost().to_bits(), of(best).cost().to_bits());
        });
    }

    #[test]
    fn a_step_too_short_is_taken_farther_and_one_that_arrives_is_not() {
        known(|model, shots, best| {
            let from = shifted(best, 0.2);
            let after = |part: f64| {
                let to = part_of_the_way(&from, best, |_, _| part);
                Begun::of(model, shots, to).taken_farther(model, shots, &from).starts
            };
            // a fifth of the way is taken four times, and sixteen times are too many
            for (part, left_m) in [(0.2, 0.04), (1.0, 0.0)] {
                for (start, best) in after(part).iter().flatten().zip(best.iter().flatten()) {
                    assert!((start[0] - best[0] - left_m).abs() < 1e-12, "{} and {}", start[0], best[0]);
                }
            }
        });
    }
}
