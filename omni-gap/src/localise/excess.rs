//! Excess: what a model leaves of recordings over what the starts of its free runs leave, beside what noise alone would.
//!
//! A free run starts from a straight line through noisy samples, which is wrong where the motion bends. That error stands in every
//! gap and in every floor, often larger than the noise, and hides what a model lacks. The same windows of a recording that the
//! model makes of itself without noise show it alone; here it is taken off:
//!
//! ```text
//! r² = mean over windows of Σ(e − e₀)² / (E Σ(f − e₀)² + κ²·Σ e₀²)   e: errors on the recording,
//!                                                                    e₀, f: on the model's own without and with noise
//! ```
//!
//! It is one where the model is the truth and the noise that of the sensors; less, where starts are so wrong that what is not known
//! of their error is larger than the noise.

use model_core::plant::Plant;
use rayon::prelude::*;

use super::floor::{FLOOR_DRAWS, FLOOR_SEED, noisy};
use super::gap::{Measured, measured};
use super::own::OwnRun;
use crate::simulate::{AlignedRun, PerGroup, SignalGroup};

/// The part of a start's error by which that of the model's own recording may differ [1]: its motion is another's.
const START_UNKNOWN: f64 = 0.1;

/// The excess of each group [1]; `None` where it was not measured.
pub fn excess<const N: usize>(plant: &Plant<N, f64>, runs: &[&AlignedRun<N>], horizon: f64) -> PerGroup<Option<f64>> {
    // a run at a time: a long recording is not held twice
    let of_run = |(at, run): (usize, &&AlignedRun<N>)| {
        let own = OwnRun::of(plant, run, horizon);
        let drawn = |draw: u64| {
            let seed = FLOOR_SEED.wrapping_add(draw * runs.len() as u64 + at as u64);
            Measured { windows: less(&own, &noisy(own.run.clone(), seed)) }
        };
        let noise = (0..FLOOR_DRAWS).map(drawn).reduce(Measured::and).unwrap_or_default();
        let starts = measured(&own.run, &own.told.restarts, |row, c| own.error(row, c));
        less(&own, run).into_iter().zip(noise.windows).zip(starts).map(|((left, noise), starts)| Window {
            left,
            noise,
            starts,
        })
    };
    let windows: Vec<Window> = runs.par_iter().enumerate().flat_map_iter(of_run).collect();
    SignalGroup::ALL.map(|group| over(&windows, group))
}

/// Sums of squares of a model's errors on a run, less those on its own.
fn less<const N: usize>(own: &OwnRun<'_, N>, run: &AlignedRun<N>) -> Vec<PerGroup<(f64, f64)>> {
    let told = own.predict(run);
    measured(run, &told.restarts, |row, c| own.less(run, &told, (row, c)))
}

/// Sums of squares of a window, and their counts.
struct Window {
    /// What the model leaves, less the error of its start.
    left: PerGroup<(f64, f64)>,
    /// What noise alone would.
    noise: PerGroup<(f64, f64)>,
    /// The error of its start.
    starts: PerGroup<(f64, f64)>,
}

/// The excess of a group.
fn over(windows: &[Window], group: SignalGroup) -> Option<f64> {
    let of = |window: &Window| {
        let mean = |sums: &PerGroup<(f64, f64)>| {
            let (sum, count) = sums[group as usize];
            (count > 0.0).then(|| sum / count)
        };
        let expected = mean(&window.noise)? + START_UNKNOWN.powi(2) * mean(&window.starts)?;
        (expected > 0.0).then_some(mean(&window.left)? / expected)
    };
    let ratios: Vec<f64> = windows.iter().filter_map(of).collect();
    (!ratios.is_empty()).then(|| (ratios.iter().sum::<f64>() / ratios.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;
    use model_core::plant::Input;

    use super::*;
    use crate::localise::{floor, measure};
    use crate::log::{Catalogue, RobotFile};
    use crate::simulate::{EffectInstance, Model, SensorSetup, record};

    const HORIZON_S: f64 = 0.5;

    /// A drive with voltages of some hertz, whose speeds no straight line follows.
    fn driven(truth: &Model<4>, robot: &RobotFile) -> AlignedRun<4> {
        let t: Vec<f64> = (0..2000).map(|row| f64::from(row) / 100.0).collect();
        let wave = |t: f64, j: f64| 7.0 * (t * (9.0 + j)).sin();
        let input: Vec<_> = t.iter().map(|t| Input::Voltage([0.0, 1.0, 2.0, 3.0].map(|j| wave(*t, j)))).collect();
        let setup = SensorSetup { sensors: robot.sensors, steps_a_row: 2, ..SensorSetup::default() };
        AlignedRun::new(&record(&truth.plant(), "run", &t, &input, &setup, 3), robot).unwrap()
    }

    #[test]
    fn what_hides_under_the_error_of_the_starts_is_seen() {
        let text = include_str!("../../robots/feup-4w/robot.toml");
        let robot = RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let plain = Model::<4>::nominal(&robot, 12.0);
        let mut lossy = plain.clone();
        let mut little = EffectInstance::typical(EffectKind::DeadTime.card(), None);
        little.params[0] *= 0.3;
        lossy.add_effect(little);
        let run = driven(&lossy, &robot);
        let largest = |model: &Model<4>| {
            let of = excess(&model.plant(), &[&run], HORIZON_S);
            of.into_iter().flatten().fold(0.0, f64::max)
        };
        let over_floor = |model: &Model<4>| {
            let plant = model.plant();
            measure(&plant, &[&run], HORIZON_S).total() / floor(&plant, &[&run], HORIZON_S).total()
        };
        assert!((largest(&lossy) - 1.0).abs() < 0.05, "{}", largest(&lossy));
        assert!(largest(&plain) > 1.4 && over_floor(&plain) < 1.15, "{} {}", largest(&plain), over_floor(&plain));
    }
}
