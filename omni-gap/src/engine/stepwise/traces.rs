//! The signals of one held-out run: measured, by the nominal and by the corrected model.

use model_core::plant::Plant;

use crate::engine::findings::{SignalTrace, Traces};
use crate::engine::knobs::MeasureKnobs;
use crate::localise::validation::Signal;
use crate::simulate::{AlignedRun, predict};

/// The first stretch of a run, its measured signals alone.
pub(super) fn traces<const N: usize>(
    nominal: &Plant<N, f64>,
    corrected: &Plant<N, f64>,
    run: &AlignedRun<N>,
    knobs: &MeasureKnobs,
) -> Traces {
    let MeasureKnobs { shown_s, horizon_s, .. } = *knobs;
    let rows = run.t.partition_point(|t| *t <= shown_s);
    let [nominal, corrected] = [nominal, corrected].map(|plant| predict(plant, run, horizon_s));
    let seen = (0..AlignedRun::<N>::channels().count()).filter(|c| (0..rows).any(|row| run.saw(row, *c)));
    let signals = seen.map(|c| SignalTrace {
        signal: Signal::of_channel(c, N),
        measured: (0..rows).map(|row| run.saw(row, c).then(|| run.measured[row][c])).collect(),
        nominal: nominal.rows[..rows].iter().map(|row| row[c]).collect(),
        corrected: corrected.rows[..rows].iter().map(|row| row[c]).collect(),
    });
    Traces {
        run: run.name.clone(),
        shown_s,
        horizon_s,
        restarts_s: nominal.restarts.iter().filter(|r| **r < rows).map(|r| run.t[*r]).collect(),
        t_s: run.t[..rows].to_vec(),
        signals: signals.collect(),
    }
}
