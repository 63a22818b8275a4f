//! What a model leaves of a recording, row by row, beside what the model says of each.

use std::ops::Range;

use model_core::plant::Plant;
use nalgebra::DVector;

use super::basis::Responses;
use super::features::{At, Features, Part};
use super::moments::Moments;
use super::settings::FlexibleSettings;
use super::teacher::Teacher;
use crate::localise::own::OwnRun;
use crate::simulate::{AlignedRun, Prediction};

/// An error that is learned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Current,
    Speed,
    Ahead,
    Left,
    Heading,
}

impl Quantity {
    pub const OF_WHEELS: [Self; 2] = [Self::Current, Self::Speed];
    pub const OF_BODY: [Self; 3] = [Self::Ahead, Self::Left, Self::Heading];
}

/// A recording and what a model says of it.
pub(super) struct OneRun<'a, const N: usize> {
    pub run: &'a AlignedRun<N>,
    pub told: Prediction,
    own: OwnRun<'a, N>,
}

impl<'a, const N: usize> OneRun<'a, N> {
    pub fn of(plant: &'a Plant<N, f64>, run: &'a AlignedRun<N>, horizon_s: f64) -> Self {
        let own = OwnRun::of(plant, run, horizon_s);
        Self { run, told: own.predict(run), own }
    }

    fn at(&self, window: &Range<usize>, row: usize) -> At<'_, N> {
        At { plant: self.own.plant, run: self.run, told: &self.told, window: (window.start, window.end), row }
    }

    /// What a part does on each row, and what a robot has made of it since its window began.
    pub fn each_row(&self, part: Part, teacher: &Teacher<'_>, mut each: impl FnMut(usize, &[f64])) {
        let mut responses = Responses::new(teacher.basis(part), teacher.settings.lag_s);
        for window in self.told.windows() {
            responses.restart();
            for row in window.clone() {
                let before_s = if row > window.start { self.run.t[row] - self.run.t[row - 1] } else { 0.0 };
                each(row, responses.at(&self.at(&window, row).features(part), before_s));
            }
        }
    }

    /// What the model leaves of a quantity on a row, over what starts alone leave [σ]; nothing where it was not measured.
    fn error(&self, quantity: Quantity, part: Part, row: usize) -> Option<f64> {
        let channels = AlignedRun::<N>::channels();
        let [x, y, heading] = channels.pose();
        let of =
            |channel: usize| self.run.saw(row, channel).then(|| self.own.less(self.run, &self.told, (row, channel)));
        let (sin, cos) = self.told.rows[row][heading].sin_cos();
        match (quantity, part) {
            (Quantity::Current, Part::Wheel(j)) => of(channels.current(j)),
            (Quantity::Speed, Part::Wheel(j)) => of(channels.wheel_speed(j)),
            (Quantity::Ahead, Part::Body) => Some(cos * of(x)? + sin * of(y)?),
            (Quantity::Left, Part::Body) => Some(cos * of(y)? - sin * of(x)?),
            (Quantity::Heading, Part::Body) => of(heading),
            _ => None,
        }
    }

    /// Whether a row is learned from: evenly many of each window, but in step with no clock of the log.
    fn is_taken(&self, row: usize, settings: &FlexibleSettings) -> bool {
        let rows_a_window = self.run.rows() as f64 / self.told.restarts.len().max(1) as f64;
        (row as f64 * GOLDEN).fract() < settings.samples_a_window as f64 / rows_a_window
    }

    /// What parts do on the rows that are learned from.
    pub fn features(&self, parts: &[Part], settings: &FlexibleSettings) -> Vec<Features> {
        let mut features = Vec::new();
        for window in self.told.windows() {
            for row in window.clone().filter(|row| self.is_taken(*row, settings)) {
                features.extend(parts.iter().map(|part| self.at(&window, row).features(*part)));
            }
        }
        features
    }

    /// The sums of a quantity's samples, fold by fold.
    pub fn moments(
        &self,
        (quantity, part): (Quantity, Part),
        teacher: &Teacher<'_>,
        fold: impl Fn(f64) -> usize,
        sums: &mut [Moments],
    ) {
        let folds = sums.len();
        let mut columns = DVector::zeros(Responses::count(teacher.basis(part)));
        self.each_row(part, teacher, |row, made| {
            if !self.is_taken(row, teacher.settings) {
                return;
            }
            if let Some(error) = self.error(quantity, part, row) {
                columns.copy_from_slice(made);
                sums[fold(self.run.t[row]) % folds].add(&columns, error);
            }
        });
    }
}

/// The share of a turn that fills a circle most evenly, however many steps are taken.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
