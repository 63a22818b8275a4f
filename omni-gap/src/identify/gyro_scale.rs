//! # Gyro scale: what a count is worth, from turns by hand
//!
//! A person turns the robot a whole number of turns, from a mark back to it, and lets it stand before and after.
//!
//! ```text
//! b(t)  line through the means of ψ̇ over the two rests
//! ψ     = ∫ (ψ̇ − b) dt                                  what the gyro tells, from rest to rest
//! s′    = s · 2πn/ψ
//! σ_s/s = √(σ_m² + (σ_b·T)² + σ_w²·Δt·T)/(2π|n|)
//! ```
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | ψ̇ | rad/s | what the run says that the gyro said, with the scale s |
//! | s, s′ | rad/s | what one count is worth, by the robot file and by the turns |
//! | n | 1 | turns, left is positive |
//! | T, Δt | s | from rest to rest; from sample to sample |
//! | σ_m | rad | how well the robot came back to its mark |
//! | σ_b | rad/s | of the mean bias: from the windows of the rests, and from what it changed between them |
//! | σ_w | rad/s | of one sample at rest |
//!
//! Neglects: that the gyro's axis is not the vertical; 2.5° off are 0.1 %. Fails when: turns were counted wrong, which is more than
//! [`MOST_CHANGE`] and is refused.

use std::f64::consts::TAU;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::error::{Error, InputKind, Result};
use crate::log::Run;

/// Length of a window at rest [s]
const WINDOW_S: f64 = 0.25;

/// Windows of a rest, at least: a second.
const LEAST_WINDOWS: usize = 4;

/// Most by which samples of a window at rest differ [rad/s], as on the robot.
const MOST_SPREAD: f64 = 0.055;

/// Largest bias [rad/s], as on the robot.
const MOST_BIAS: f64 = 0.053;

/// Most standard errors of its mean that a window at rest is off the ones before [1]
const MOST_SIGMAS: f64 = 5.0;

/// Longest time without a sample while the robot turns [s]
const LONGEST_GAP_S: f64 = 0.05;

/// Most by which the scale is another [1]: ±1 % out of the box (BMI088, BST-BMI088-DS001 revision 1.4), and as much again.
const MOST_CHANGE: f64 = 0.02;

/// Turns, at most: one that was counted wrong is then 4 %, twice of what is believed of a scale.
pub const MOST_TURNS: i32 = 25;

/// Least sure that a scale may be [1]: 1° in a turn.
const MOST_STD: f64 = 0.003;

/// Most of a count that a sample is apart from a whole number of them [1]: single precision and rounded files.
const WHOLE: f64 = 0.05;

/// What a person did.
#[derive(Clone, Copy, Debug)]
pub struct HandTurned {
    /// Whole turns, left is positive
    pub turns: i32,
    /// How well the robot came back to its mark [rad]
    pub within: f64,
}

/// What a count of the gyro is worth.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct GyroScale {
    /// Turns that the gyro told, with the scale of the robot file.
    pub turns_told: f64,
    /// What it told of the robot at rest [rad/s], before the turns and after.
    pub bias_rad_s: [f64; 2],
    /// Standard error of the mean of the two.
    pub bias_std_rad_s: f64,
    /// Yaw rate of one count.
    pub gyro_rad_s_per_count: f64,
    /// Its standard error.
    pub std_rad_s_per_count: f64,
    /// By how much it is another than that of the robot file [1].
    pub change: f64,
    /// Whether it is another by more than two standard errors.
    pub differs: bool,
}

/// A sample of the gyro: when [s], and what it said [rad/s].
type Sample = (f64, f64);

/// A rest of the robot.
struct Rest {
    windows: usize,
    /// Mean and its standard error [rad/s]
    bias: f64,
    std: f64,
    /// The middle of it [s]
    at: f64,
    /// Variance of one sample [rad²/s²]
    variance: f64,
}

/// The scale of the gyro of a robot that was turned by hand in a run, recorded while it drove with the scale `before`
/// [rad/s per count].
///
/// # Errors
/// Where the run does not tell it: without a gyro, recorded with another scale, without a rest before or after, with a hole while it
/// turned, turned the other way or another number of turns, or too uncertain.
pub fn gyro_scale(run: &Run, before: f64, did: HandTurned) -> Result<GyroScale> {
    let place = run.place();
    let samples: Vec<Sample> =
        run.gyro.iter().flat_map(|gyro| gyro.present()).map(|(row, rate)| (run.t_s[row], rate)).collect();
    look_at_counts(place, &samples, before)?;
    let windows: Vec<&[Sample]> = windows(&samples);
    let [first, last] = [rest(windows.iter().copied()), rest(windows.iter().rev().copied())];
    let (first, last) = match (first, last) {
        (Some(first), Some(last)) if first.windows + last.windows < windows.len() => (first, last),
        (Some(_), Some(_)) => {
            return Err(too_little(place, "the robot stands all the time", "Turn it while it is recorded"));
        }
        (None, _) => {
            return Err(too_little(place, "the robot does not stand for a second at the beginning", LET_STAND));
        }
        (_, None) => return Err(too_little(place, "the robot does not stand for a second at the end", LET_STAND)),
    };
    let turned: Vec<Sample> = windows[first.windows - 1..=windows.len() - last.windows].concat();
    if let Some(gap) = turned.windows(2).find(|pair| pair[1].0 - pair[0].0 > LONGEST_GAP_S) {
        let problem = format!("the gyro says nothing for {:.2} s at {:.2} s", gap[1].0 - gap[0].0, gap[0].0);
        return Err(too_little(place, problem, "Record it again"));
    }
    let bias = |t: f64| first.bias + (last.bias - first.bias) * (t - first.at) / (last.at - first.at);
    let rates: Vec<Sample> = turned.iter().map(|(t, rate)| (*t, rate - bias(*t))).collect();
    let angle: f64 = rates.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum();
    let lasted = turned.last().map_or(0.0, |last| last.0) - turned.first().map_or(0.0, |first| first.0);
    let drift = (last.bias - first.bias).powi(2) / 12.0;
    let bias_std = ((first.std.powi(2) + last.std.powi(2)) / 4.0 + drift).sqrt();
    let white = 0.5 * (first.variance + last.variance) * lasted / (turned.len().max(2) - 1) as f64 * lasted;
    let stated = TAU * f64::from(did.turns);
    let relative = (did.within.powi(2) + (bias_std * lasted).powi(2) + white).sqrt() / stated.abs();
    let told = angle / TAU;
    let change = stated / angle - 1.0;
    look_at_turns(place, told, did.turns, change)?;
    if relative > MOST_STD {
        let problem = format!("the scale is known to {:.2} % only", 100.0 * relative);
        return Err(too_little(place, problem, "Turn the robot more often, faster, and closer back to its mark"));
    }
    Ok(GyroScale {
        turns_told: told,
        bias_rad_s: [first.bias, last.bias],
        bias_std_rad_s: bias_std,
        gyro_rad_s_per_count: before * (1.0 + change),
        std_rad_s_per_count: before.abs() * relative,
        change,
        differs: change.abs() > 2.0 * relative,
    })
}

const LET_STAND: &str = "Let it stand for two seconds before it is turned and after, on its mark";

fn too_little(place: &Path, problem: impl Into<String>, fix: &str) -> Error {
    Error::input(place, problem, fix).of_kind(InputKind::TooLittle)
}

/// The samples are whole counts of this scale.
fn look_at_counts(place: &Path, samples: &[Sample], scale: f64) -> Result<()> {
    if samples.is_empty() {
        let fix = "Send the robot its file with `gyro_rad_s_per_count`, then record it";
        return Err(Error::input(place, "the run has no gyro", fix).of_kind(InputKind::Missing));
    }
    let apart = samples.iter().map(|(_, rate)| rate / scale).filter(|counts| (counts - counts.round()).abs() > WHOLE);
    if apart.count() * 100 > samples.len() {
        let problem = format!("what the gyro said is not in counts of {scale} rad/s, as the robot file has it");
        return Err(Error::input(place, problem, "Name the file that the robot had when it was recorded")
            .of_kind(InputKind::Conflict));
    }
    Ok(())
}

/// The gyro told these turns, give or take its scale.
fn look_at_turns(place: &Path, told: f64, turns: i32, change: f64) -> Result<()> {
    if change.abs() <= MOST_CHANGE {
        return Ok(());
    }
    let problem = format!("the gyro tells {told:.2} turns, --turns {turns}; left is positive");
    let fix = if told * f64::from(turns) < 0.0 {
        "Say which way it was turned; of a gyro that is mounted upside down `gyro_rad_s_per_count` is below zero"
    } else {
        "Count the turns again; a gyro's scale is not that far off"
    };
    Err(Error::input(place, problem, fix).of_kind(InputKind::Conflict))
}

/// The samples, cut where a window is over.
fn windows(samples: &[Sample]) -> Vec<&[Sample]> {
    let start = samples.first().map_or(0.0, |first| first.0);
    let of = |sample: &Sample| ((sample.0 - start) / WINDOW_S) as usize;
    samples.chunk_by(|a, b| of(a) == of(b)).collect()
}

/// The rest with which these windows begin; none where it is too short. It ends where a window is not still, or tells more than
/// noise of another rate than those before: a turn may begin slowly. Its last window is not counted.
fn rest<'a>(windows: impl Iterator<Item = &'a [Sample]>) -> Option<Rest> {
    let mut still: Vec<&[Sample]> = Vec::new();
    let mut means: Vec<f64> = Vec::new();
    for window in windows.take_while(|window| is_still(window)) {
        let is = mean(window);
        let before = means.iter().sum::<f64>() / means.len().max(1) as f64;
        let noise = (variance(window, is) / window.len() as f64).sqrt();
        if !means.is_empty() && (is - before).abs() > MOST_SIGMAS * noise {
            break;
        }
        still.push(window);
        means.push(is);
    }
    still.pop();
    means.pop();
    let count = still.len();
    if count < LEAST_WINDOWS {
        return None;
    }
    let bias = means.iter().sum::<f64>() / count as f64;
    let of_means = means.iter().map(|mean| (mean - bias).powi(2)).sum::<f64>() / (count - 1) as f64;
    let variance = still.iter().map(|window| variance(window, bias)).sum::<f64>() / count as f64;
    let at = still.iter().map(|window| window[0].0).sum::<f64>() / count as f64 + 0.5 * WINDOW_S;
    Some(Rest { windows: count, bias, std: (of_means / count as f64).sqrt(), at, variance })
}

fn variance(window: &[Sample], about: f64) -> f64 {
    window.iter().map(|sample| (sample.1 - about).powi(2)).sum::<f64>() / window.len() as f64
}

fn mean(window: &[Sample]) -> f64 {
    window.iter().map(|sample| sample.1).sum::<f64>() / window.len() as f64
}

fn is_still(window: &[Sample]) -> bool {
    let (least, most) = window.iter().fold((f64::MAX, f64::MIN), |(l, m), (_, rate)| (l.min(*rate), m.max(*rate)));
    most - least <= MOST_SPREAD && mean(window).abs() <= MOST_BIAS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Channel;

    /// rad/s, as in a robot file
    const COUNT: f64 = 0.001065;

    /// A run of a robot that stands for 2 s, is turned with up to 3 rad/s, stands again: `turns` left, told by a gyro whose counts
    /// are worth `scale` [1] of what they are believed to be, with this bias [rad/s].
    fn turned(turns: i32, scale: f64, bias: f64) -> Run {
        let angle = TAU * f64::from(turns);
        // a raised cosine has half of its height in the mean
        let takes = angle.abs() / 1.5;
        let rate = |t: f64| {
            let at = (t - 2.0) / takes;
            if (0.0..1.0).contains(&at) { angle / takes * (1.0 - (TAU * at).cos()) } else { 0.0 }
        };
        let t_s: Vec<f64> = (0..((takes + 4.0) * 1000.0) as u32).map(|k| f64::from(k) * 1e-3).collect();
        // ten counts, evenly, in the place of noise
        let noise = |k: usize| 10.0 * (k as f64 * 0.618_034).fract() - 5.0;
        let told = |(k, t): (usize, &f64)| (((rate(*t) + bias) / (COUNT * scale)) + noise(k)).round() * COUNT;
        let gyro = Channel::from_values(t_s.iter().enumerate().map(told));
        Run { name: "turned".into(), t_s, gyro: Some(gyro), ..Run::default() }
    }

    fn found(run: &Run, turns: i32) -> Result<GyroScale> {
        gyro_scale(run, COUNT, HandTurned { turns, within: 1.0_f64.to_radians() })
    }

    #[test]
    fn a_scale_is_found_within_its_uncertainty_and_so_is_the_bias() {
        for (turns, scale) in [(10, 1.01), (-10, 0.99), (5, 0.995)] {
            let is = found(&turned(turns, scale, 0.02), turns).unwrap();
            let error = is.gyro_rad_s_per_count - COUNT * scale;
            assert!(error.abs() < is.std_rad_s_per_count && is.differs, "{is:?}");
            assert!(is.bias_rad_s.iter().all(|bias| (bias - 0.02 / scale).abs() < 2e-4), "{is:?}");
            assert!((is.turns_told * scale - f64::from(turns)).abs() < 0.005, "{is:?}");
        }
    }

    #[test]
    fn a_sound_scale_is_left_and_its_uncertainty_is_that_of_the_mark() {
        let is = found(&turned(10, 1.0, -0.015), 10).unwrap();
        assert!(!is.differs && is.change.abs() < 1e-4, "{is:?}");
        let mark = 1.0 / 3600.0;
        let relative = is.std_rad_s_per_count / COUNT;
        assert!(relative >= mark && relative < 1.1 * mark, "{is:?}");
    }

    #[test]
    fn a_bias_that_wanders_is_counted_as_doubt() {
        let mut run = turned(10, 1.0, 0.0);
        let end = *run.t_s.last().unwrap();
        let t_s = run.t_s.clone();
        run.gyro = run.gyro.map(|gyro| gyro.map(|row, rate| rate + (0.005 * t_s[row] / end / COUNT).round() * COUNT));
        let is = found(&run, 10).unwrap();
        assert!(is.std_rad_s_per_count / COUNT > 0.0008 && is.change.abs() < is.std_rad_s_per_count / COUNT, "{is:?}");
    }

    #[test]
    fn what_does_not_tell_the_scale_is_refused_with_one_message() {
        let refused = |run: &Run, turns: i32| found(run, turns).unwrap_err().to_string();
        let run = turned(10, 1.0, 0.0);
        assert!(refused(&run, 11).contains("tells 10.00 turns, --turns 11"));
        assert!(refused(&run, -10).contains("which way it was turned"));
        let other = gyro_scale(&run, 0.00107, HandTurned { turns: 10, within: 0.01 }).unwrap_err().to_string();
        assert!(other.contains("not in counts of 0.00107 rad/s"), "{other}");
        assert!(refused(&Run { gyro: None, ..run.clone() }, 10).contains("has no gyro"));
        let part = |rows: std::ops::Range<usize>| Run {
            t_s: run.t_s[rows.clone()].to_vec(),
            gyro: Some(rows.map(|row| run.gyro.as_ref().unwrap().get(row)).collect()),
            ..Run::default()
        };
        assert!(refused(&part(0..1900), 10).contains("stands all the time"));
        assert!(refused(&part(1500..run.t_s.len()), 10).contains("at the beginning"));
        assert!(refused(&part(0..run.t_s.len() - 1500), 10).contains("at the end"));
        let mut holed = run.clone();
        let lost = |row: usize, rate| if (9000..9060).contains(&row) { Err(crate::log::Missing::Lost) } else { rate };
        holed.gyro = run.gyro.as_ref().map(|gyro| gyro.iter().enumerate().map(|(row, rate)| lost(row, rate)).collect());
        assert!(refused(&holed, 10).contains("says nothing for 0.06 s at 9.00 s"));
        let loose = HandTurned { turns: 10, within: 15.0_f64.to_radians() };
        assert!(gyro_scale(&run, COUNT, loose).unwrap_err().to_string().contains("to 0.42 % only"));
    }
}
