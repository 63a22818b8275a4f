use super::super::fit::{FitOptions, fit};
use super::super::prior::Prior;
use super::super::shoot::Windows;
use super::super::staged::{Staging, robot, staged};
use super::*;
use crate::simulate::{MAX_CHANNELS, Model};

/// The channels of the pose alone.
const POSE: u16 = 0b111_0000_0000;

/// The noise of runs of the true model, in windows of this length [s].
fn found(how: &Staging, window: f64) -> Noise {
    let model = Model::<4>::nominal(&robot(), 12.0);
    let runs = staged(&model, how);
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, window)).collect();
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    let shots = Shots { runs: &runs, windows: &windows };
    let fitted = fit(
        model,
        shots,
        None,
        FitOptions { free: &[], prior: &Prior::stated(&robot()), dispersion: 1.0, rounds: 5, by_window: 0.0 },
    );
    noise_of(&fitted, shots)
}

#[test]
fn noise_is_taken_from_where_a_model_that_lacks_something_does_not_show_it() {
    let model = Model::<4>::nominal(&robot(), 12.0);
    let mut runs = staged(&model, &Staging { runs: 6, ..Staging::default() });
    // half of every run has a wave in the wheel speeds that no model knows
    for run in &mut runs {
        let (half, step) = (run.rows() / 2, 0.2);
        for row in 0..half {
            for wheel in 0..4 {
                let channel = AlignedRun::<4>::channels().wheel_speed(wheel);
                run.measured[row][channel] += 20.0 * run.sigma[channel] * (step * row as f64).sin();
            }
        }
    }
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    let shots = Shots { runs: &runs, windows: &windows };
    let options = FitOptions { free: &[], prior: &Prior::stated(&robot()), dispersion: 1.0, rounds: 5, by_window: 0.0 };
    let fitted = fit(model, shots, None, options);
    let left = LeftOver::of(&fitted, shots);
    let [everywhere, quiet] = [left.noise(), left.noise_where_quiet(0.3)].map(|noise| noise.scale[1]);
    assert!(everywhere > 5.0 && (quiet - 1.0).abs() < 0.15, "everywhere {everywhere}, where it is quiet {quiet}");
}

/// Channels of a group with one value, all others with another.
fn only(which: usize, inside: f64, outside: f64) -> [f64; MAX_CHANNELS] {
    std::array::from_fn(|c| if group(4, c) == which { inside } else { outside })
}

/// The groups that the staging measures: all but gyro and battery.
const STAGED: usize = 4;

/// How many numbers a group of the default staging has, near enough for a standard error.
fn numbers(how: &Staging, group: usize) -> f64 {
    let rate = if group < 2 { how.rate } else { 0.95 * how.camera_rate };
    how.runs as f64 * 6.0 * rate * [4.0, 4.0, 2.0, 1.0][group]
}

#[test]
fn white_noise_of_one_sigma_is_found_as_such() {
    let how = Staging::default();
    let noise = found(&how, 0.5);
    assert_eq!(noise.scale[STAGED..], [1.0; SENSORS - STAGED], "nothing was measured there");
    for g in 0..STAGED {
        assert_eq!(noise.correlation_time[g], 0.0, "group {g}: {noise:?}");
        // four standard errors of a standard deviation, 1/√(2n)
        let tolerance = 4.0 / (2.0 * numbers(&how, g)).sqrt();
        assert!((noise.scale[g] - 1.0).abs() < tolerance, "group {g}: {noise:?}, tolerance {tolerance}");
    }
}

#[test]
fn a_sensor_that_is_worse_than_stated_is_found_and_the_others_are_not_blamed() {
    for g in 0..STAGED {
        let how = Staging { scale: only(g, 3.0, 1.0), ..Staging::default() };
        let noise = found(&how, 0.5);
        for h in 0..STAGED {
            let truth = if h == g { 3.0 } else { 1.0 };
            let tolerance = 4.0 / (2.0 * numbers(&how, h)).sqrt();
            assert!((noise.scale[h] / truth - 1.0).abs() < tolerance, "{h} with {g} worse: {noise:?}");
        }
    }
}

#[test]
fn the_correlation_time_of_a_slow_pose_is_found_within_30_percent() {
    const TAU: f64 = 0.15;
    for channels in [u16::MAX, POSE] {
        let correlation_time = std::array::from_fn(|c| if group(4, c) >= 2 { TAU } else { 0.0 });
        let how = Staging { runs: 10, camera_rate: 25.0, correlation_time, channels, ..Staging::default() };
        let noise = found(&how, 1.0);
        for g in 2..STAGED {
            assert!((noise.correlation_time[g] / TAU - 1.0).abs() < 0.3, "group {g} of {channels:b}: {noise:?}");
            // three standard errors of the heading's 60 s/2τ = 200 independent numbers
            assert!((noise.scale[g] - 1.0).abs() < 0.15, "group {g} of {channels:b}: {noise:?}");
        }
        assert_eq!(noise.correlation_time[..2], [0.0, 0.0], "{noise:?}");
    }
}

#[test]
fn noise_that_is_applied_is_the_runs_own() {
    let run = &staged(&Model::<4>::nominal(&robot(), 12.0), &Staging { runs: 1, ..Staging::default() })[0];
    let noise = Noise { scale: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], correlation_time: [0.0, 0.1, 0.2, 0.3, 0.4, 0.5] };
    let applied = noise.applied(run);
    for (c, g) in [(0, 0), (3, 0), (4, 1), (7, 1), (8, 2), (9, 2), (10, 3), (11, 4), (12, 5)] {
        assert_eq!(applied.sigma[c], run.sigma[c] * noise.scale[g]);
        assert_eq!(applied.correlation_time[c], noise.correlation_time[g]);
    }
}
