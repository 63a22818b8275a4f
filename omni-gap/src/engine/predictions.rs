//! What a plant predicts for every number that was measured.

use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Plant;
use nalgebra::DVector;

use crate::identify::{Linearised, Shots, Starts, Whitener, run_windows};
use crate::simulate::AlignedRun;

/// All of it, in sigma and whitened, run by run and window by window.
pub(super) fn predictions<const N: usize>(
    plant: &Plant<N, f64>,
    shots: Shots<'_, N>,
    starts: &[Starts],
    linear: &Linearised,
) -> Vec<Vec<DVector<f64>>> {
    let count = AlignedRun::<N>::channels().count();
    let Shots { runs, windows } = shots;
    (0..runs.len())
        .map(|k| {
            let run = runs[k];
            let mut out: Vec<DVector<f64>> = linear.windows[k].iter().map(|w| DVector::zeros(w.error.len())).collect();
            let start = |w: usize| {
                let [x, y, theta, v, vn, w] = starts[k][w];
                (Pose { x, y, theta }, BodyTwist { v, vn, w })
            };
            let mut white = Whitener::<1>::of(run);
            let (mut at, mut last) = (0, usize::MAX);
            run_windows(
                plant,
                run,
                &windows[k],
                start,
                |_| {},
                |w, row, predicted| {
                    if w != last {
                        (at, last) = (0, w);
                        white.enter();
                    }
                    for c in (0..count).filter(|c| run.saw(row, *c)) {
                        let mut number = [predicted[c] / run.sigma[c]];
                        white.whiten(c, run.t[row], &mut number);
                        out[w][at] = number[0];
                        at += 1;
                    }
                },
            );
            out
        })
        .collect()
}
