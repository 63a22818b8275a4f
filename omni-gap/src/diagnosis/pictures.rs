//! The signals of one held-out run: measured, by the nominal and by the corrected model.

use model_core::plant::Plant;

use crate::report::{MEASURED, Panel, Pictures, Series};
use crate::simulate::{Prediction, Recorded, predict};

/// What is shown of a run [s]
const SHOWN_S: f64 = 4.0;

pub(super) fn pictures<const N: usize>(
    nominal: &Plant<N, f64>,
    corrected: &Plant<N, f64>,
    run: &Recorded<N>,
    horizon: f64,
) -> Pictures {
    let rows = run.t.partition_point(|t| *t <= SHOWN_S);
    let models = [("nominal", predict(nominal, run, horizon)), ("corrected", predict(corrected, run, horizon))];
    let restarts_s = models[0].1.restarts.iter().filter(|r| **r < rows).map(|r| run.t[*r]).collect();
    let panels = (0..2 * N + 3)
        .filter(|c| (0..rows).any(|row| run.saw(row, *c)))
        .map(|c| {
            let (title, unit) = title(c, N);
            Panel { title, unit: unit.to_owned(), t_s: run.t[..rows].to_vec(), series: series(run, &models, c, rows) }
        })
        .collect();
    let caption = format!(
        "Held-out run {}, its first {SHOWN_S} s. Both models run freely and restart every {horizon} s from the smoothed measurement.",
        run.name
    );
    Pictures { caption, restarts_s, panels }
}

fn title(channel: usize, wheels: usize) -> (String, &'static str) {
    match channel {
        c if c < wheels => (format!("current {c}"), "A"),
        c if c < 2 * wheels => (format!("wheel speed {}", c - wheels), "rad/s"),
        c if c == 2 * wheels => ("x".to_owned(), "m"),
        c if c == 2 * wheels + 1 => ("y".to_owned(), "m"),
        _ => ("heading".to_owned(), "rad"),
    }
}

fn series<const N: usize>(
    run: &Recorded<N>,
    models: &[(&str, Prediction); 2],
    channel: usize,
    rows: usize,
) -> Vec<Series> {
    let measured = Series {
        name: MEASURED.to_owned(),
        values: (0..rows).map(|row| run.saw(row, channel).then(|| run.measured[row][channel])).collect(),
    };
    let predicted = models.iter().map(|(name, prediction)| Series {
        name: (*name).to_owned(),
        values: prediction.rows[..rows].iter().map(|row| Some(row[channel])).collect(),
    });
    std::iter::once(measured).chain(predicted).collect()
}
