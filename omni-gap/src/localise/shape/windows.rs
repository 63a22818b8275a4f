//! Recordings in windows: what three models leave of each, and under which circumstances.
//!
//! A window starts from a smoothed measurement, which is wrong where a speed bends. How wrong is told by the same windows of a
//! recording that the corrected model makes of itself, without noise: what it leaves there is nobody's residual and is taken off.

use model_core::plant::Plant;
use rayon::prelude::*;

use super::beats::Rows;
use super::circumstances::Circumstances;
use super::model::Quantity;
use super::order::Beats;
use super::residual::Residuals;
use super::settings::ShapeSettings;
use super::window::{MODELS, Window};
use crate::localise::floor::quiet;
use crate::localise::links::by_speeds;
use crate::simulate::{AlignedRun, Chain, FreeRun, Prediction, Row, SignalGroup, predict};

/// The models whose residuals are laid over features.
#[derive(Clone, Copy, Debug)]
pub struct Models<'a, const N: usize> {
    /// The model whose residual has to have a shape: what is left before a cause is taken up.
    pub before: &'a Plant<N, f64>,
    /// What the robot file says.
    pub nominal: &'a Plant<N, f64>,
    /// What the findings stand by.
    pub corrected: &'a Plant<N, f64>,
}

impl<'a, const N: usize> Models<'a, N> {
    /// All, in the order of [`Window::residuals`].
    fn all(&self) -> [&'a Plant<N, f64>; MODELS] {
        [self.before, self.nominal, self.corrected]
    }
}

/// A run in windows.
#[derive(Clone, Debug, Default)]
pub(super) struct Windowed {
    /// Short ones: levels and forces.
    pub short: Vec<Window>,
    /// Long ones: the pose.
    pub long: Vec<Window>,
    /// Residuals of each wheel's rows, of those that turn.
    pub beats: Vec<Beats>,
}

/// All runs in windows.
pub(super) fn windows<const N: usize>(
    models: &Models<'_, N>,
    runs: &[&AlignedRun<N>],
    horizon_s: f64,
    settings: &ShapeSettings,
) -> Windowed {
    let parts: Vec<Windowed> = runs
        .par_iter()
        .enumerate()
        .map(|(at, run)| OneRun::of(models, run, horizon_s).windowed(at * CLUSTERS_OF_A_RUN, settings))
        .collect();
    let mut all = Windowed::default();
    for part in parts {
        all.short.extend(part.short);
        all.long.extend(part.long);
        for beats in part.beats {
            let same = |other: &&mut Beats| (other.quantity, other.wheel) == (beats.quantity, beats.wheel);
            match all.beats.iter_mut().find(same) {
                Some(there) => there.beats.extend(beats.beats),
                None => all.beats.push(beats),
            }
        }
    }
    all
}

/// More clusters than any run has.
const CLUSTERS_OF_A_RUN: usize = 1 << 32;

/// A run and what is said of it.
struct OneRun<'a, const N: usize> {
    models: &'a Models<'a, N>,
    run: &'a AlignedRun<N>,
    horizon_s: f64,
    /// What tells the circumstances.
    told: Prediction,
    /// The run as the corrected model makes it, without noise.
    quiet: AlignedRun<N>,
}

impl<'a, const N: usize> OneRun<'a, N> {
    fn of(models: &'a Models<'a, N>, run: &'a AlignedRun<N>, horizon_s: f64) -> Self {
        let told = predict(models.corrected, run, horizon_s);
        Self { models, run, horizon_s, told, quiet: quiet(FreeRun::new(models.corrected, run)) }
    }

    fn windowed(&self, first_cluster: usize, settings: &ShapeSettings) -> Windowed {
        let cluster = |row: usize| first_cluster + (self.run.t[row] / settings.independent_s) as usize;
        let (short, beats) = self.short(settings, cluster);
        Windowed { short, long: self.long(cluster), beats }
    }

    fn short(&self, settings: &ShapeSettings, cluster: impl Fn(usize) -> usize) -> (Vec<Window>, Vec<Beats>) {
        let Self { models, run, told, quiet, .. } = self;
        if ![SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Gyro, SignalGroup::Battery]
            .into_iter()
            .any(|group| run.has_group(group))
        {
            return (Vec::new(), Vec::new());
        }
        let length = settings.window_s.max(settings.window_rows as f64 * median(&run.dt));
        let said = models.all().map(|plant| predict(plant, run, length));
        let method = predict(models.corrected, quiet, length);
        let mut beats: Vec<Beats> = [Quantity::Current, Quantity::WheelSpeed]
            .into_iter()
            .flat_map(|quantity| (0..N).map(move |wheel| Beats { quantity, wheel, beats: Vec::new() }))
            .collect();
        let mut windows = Vec::new();
        let mut restart = 0;
        for rows in said[0].windows() {
            while told.restarts.get(restart + 1).is_some_and(|next| *next <= rows.start) {
                restart += 1;
            }
            let settled = run.t[rows.start] - run.t[told.restarts[restart]] >= settings.settled_s - 1e-9;
            if !settled || rows.len() + 1 < settings.window_rows {
                continue;
            }
            let own = Residuals::of(models.nominal, quiet, &method.rows, rows.clone());
            let of = |said: &Prediction| Residuals::of(models.nominal, run, &said.rows, rows.clone()).less(&own);
            let when = Circumstances::of(models.nominal, run, told, rows.clone());
            windows.push(Window { cluster: cluster(rows.start), when, residuals: said.each_ref().map(of) });
            let of_rows = Rows { run, said: said.each_ref().map(|said| said.rows.as_slice()), rows };
            for Beats { quantity, wheel, beats } in &mut beats {
                of_rows.beats(*quantity, *wheel, when.wheels[*wheel].speed, beats);
            }
        }
        (windows, beats)
    }

    /// Windows of the horizon's length in which the wheels turn as measured: what is left is the contact's and the camera's.
    fn long(&self, cluster: impl Fn(usize) -> usize) -> Vec<Window> {
        let Self { models, run, told, quiet, .. } = self;
        let speeds = run.has_group(SignalGroup::WheelSpeed) || run.chain == Chain::WheelSpeed;
        if !run.has_group(SignalGroup::Pose) || !speeds {
            return Vec::new();
        }
        let said = models.all().map(|plant| by_speeds(plant, run, self.horizon_s));
        let method = by_speeds(models.corrected, quiet, self.horizon_s);
        told.windows()
            .map(|rows| {
                let own = Residuals::of_pose(quiet, &method, rows.clone());
                let of = |said: &[Row]| Residuals::of_pose(run, said, rows.clone()).less(&own);
                Window {
                    cluster: cluster(rows.start),
                    when: Circumstances::of(models.nominal, run, told, rows.clone()),
                    residuals: said.each_ref().map(|said| of(said)),
                }
            })
            .collect()
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
