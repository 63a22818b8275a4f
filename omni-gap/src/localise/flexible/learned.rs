//! What a model leaves of recordings, learned as functions of what the model itself says.

use model_core::plant::Plant;
use nalgebra::DVector;
use rayon::prelude::*;

use super::basis::{Basis, Responses};
use super::errors::{OneRun, Quantity};
use super::features::{Features, Part};
use super::moments::{Boosting, Moments, boosted, together};
use super::settings::FlexibleSettings;
use super::teacher::Teacher;
use crate::simulate::{AlignedRun, MAX_CHANNELS, Prediction, Row};

/// Functions of what a model says that foretell its errors.
pub(super) struct Learned<'a> {
    teacher: Teacher<'a>,
    /// Weights of each quantity and part.
    weights: Vec<(Quantity, Part, DVector<f64>)>,
}

impl<'a> Learned<'a> {
    /// From what a model leaves of runs.
    pub fn from<const N: usize>(
        plant: &Plant<N, f64>,
        runs: &[&AlignedRun<N>],
        horizon_s: f64,
        settings: &'a FlexibleSettings,
    ) -> Self {
        let mut seconds = 0.0;
        let enough = |run: &&&AlignedRun<N>| {
            let before = seconds;
            seconds += run.t.last().copied().unwrap_or_default();
            before < settings.most_s
        };
        let runs: Vec<&AlignedRun<N>> = runs.iter().take_while(enough).copied().collect();
        let runs: Vec<OneRun<'_, N>> = runs.par_iter().map(|run| OneRun::of(plant, run, horizon_s)).collect();
        let over = |parts: &[Part]| {
            let seen: Vec<Features> = runs.iter().flat_map(|run| run.features(parts, settings)).collect();
            Basis::over(&seen, settings.knots)
        };
        let wheels: Vec<Part> = (0..N).map(Part::Wheel).collect();
        let teacher = Teacher { settings, horizon_s, wheel: over(&wheels), body: over(&[Part::Body]) };
        let all = Quantity::OF_WHEELS.map(|quantity| (quantity, wheels.clone())).into_iter();
        let all: Vec<(Quantity, Vec<Part>)> = all.chain(Quantity::OF_BODY.map(|q| (q, vec![Part::Body]))).collect();
        let weights = all
            .par_iter()
            .flat_map_iter(|(quantity, parts)| {
                let folds = |part: &Part| {
                    let mut sums = vec![Moments::none(Responses::count(teacher.basis(*part))); settings.folds.max(2)];
                    for (at, run) in runs.iter().enumerate() {
                        // what is foretold later are whole runs
                        let fold = |t: f64| if runs.len() > 2 { at } else { (t / settings.stretch_s) as usize };
                        run.moments((*quantity, *part), &teacher, fold, &mut sums);
                    }
                    sums
                };
                of_parts(*quantity, parts, &parts.iter().map(folds).collect::<Vec<_>>(), &teacher)
            })
            .collect();
        Self { teacher, weights }
    }

    /// What is foretold of the errors that a model leaves of a run [σ].
    pub fn foretold<const N: usize>(&self, plant: &Plant<N, f64>, run: &AlignedRun<N>) -> (Prediction, Vec<Row>) {
        let channels = AlignedRun::<N>::channels();
        let [x, y, heading] = channels.pose();
        let run = OneRun::of(plant, run, self.teacher.horizon_s);
        let mut foretold = vec![[0.0; MAX_CHANNELS]; run.run.rows()];
        for part in (0..N).map(Part::Wheel).chain([Part::Body]) {
            let weights: Vec<_> = self.weights.iter().filter(|w| w.1 == part && w.2.amax() > 0.0).collect();
            if weights.is_empty() {
                continue;
            }
            run.each_row(part, &self.teacher, |row, made| {
                let (sin, cos) = run.told.rows[row][heading].sin_cos();
                for (quantity, _, weights) in &weights {
                    let error: f64 = weights.iter().zip(made).map(|(weight, made)| weight * made).sum();
                    let row = &mut foretold[row];
                    match (quantity, part) {
                        (Quantity::Current, Part::Wheel(j)) => row[channels.current(j)] += error,
                        (Quantity::Speed, Part::Wheel(j)) => row[channels.wheel_speed(j)] += error,
                        (Quantity::Ahead, _) => (row[x], row[y]) = (row[x] + cos * error, row[y] + sin * error),
                        (Quantity::Left, _) => (row[x], row[y]) = (row[x] - sin * error, row[y] + cos * error),
                        _ => row[heading] += error,
                    }
                }
            });
        }
        (run.told, foretold)
    }
}

/// What is the same for all parts, and what each has beside it.
fn of_parts(
    quantity: Quantity,
    parts: &[Part],
    folds: &[Vec<Moments>],
    teacher: &Teacher<'_>,
) -> Vec<(Quantity, Part, DVector<f64>)> {
    let FlexibleSettings { rate, ridge, least_gain, steps, .. } = *teacher.settings;
    let boosting = Boosting { rate, ridge, least_gain, steps };
    let features = parts.first().map_or_else(Vec::new, |part| Responses::of_features(teacher.basis(*part)));
    let same = boosted(&together(folds), &features, &boosting);
    let own = |folds: &Vec<Moments>| {
        let left: Vec<Moments> = folds.iter().map(|fold| fold.after(&same)).collect();
        boosted(&left, &features, &boosting)
    };
    let alone = parts.len() == 1;
    let of = |(part, folds): (&Part, &Vec<Moments>)| {
        let weights = if alone { same.clone() } else { &same + own(folds) };
        (quantity, *part, weights)
    };
    parts.iter().zip(folds).map(of).collect()
}
