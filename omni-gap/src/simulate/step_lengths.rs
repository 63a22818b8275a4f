//! How finely the plant goes through the rows of a recording: as the robot needs it, and decided by what was measured.
//!
//! The plant's step is second order in its length, so a step may be a part of the shortest time in which the robot's motion
//! decays. Where a wheel passes through low speeds, friction that depends on the speed changes within a few millimetres a
//! second, and effects that hold it are first order: there steps are short. Which rows these are depends on the recording
//! alone, not on the model that is tried, so that a fit's error is a smooth function of its numbers.

use model_core::plant::robot::Robot;

/// The longest step at all, where a wheel passes through low speeds, and of the quickest robot [s]
const LONGEST_S: f64 = 0.0126;
const LONGEST_AT_LOW_SPEED_S: f64 = 0.0051;
pub(super) const LONGEST_OF_THE_QUICKEST_S: f64 = 0.0026;

/// The largest part of the shortest time constant that a step may be: the trapezoidal rule is then at most
/// (1/12)²/(12·e) = 0.02 % of a change of speed off.
const PART_OF_TIME_CONSTANT: f64 = 1.0 / 12.0;

/// The most steps through one row: beyond half a minute without a row there is nothing to be told, and work must end.
const MOST_STEPS: f64 = 10_000.0;

/// Below this a rim's speed is low [m/s]: three times the usual Stribeck speed.
const LOW_SPEED: f64 = 0.15;

/// A wheel passes through low speeds, and does not just stand, where its rim changes its speed by more than this [m/s] and
/// by more than noise does [σ].
const CHANGE: f64 = 0.05;
const CHANGE_OVER_NOISE: f64 = 6.0;

/// The time over which that is looked at, on either side of a row [s]
const AROUND_S: f64 = 0.02;

/// The longest step through a smooth motion of a robot [s]
fn longest_step<const N: usize>(robot: &Robot<N, f64>) -> f64 {
    let shortest = robot.time_constants().into_iter().fold(f64::INFINITY, f64::min);
    (PART_OF_TIME_CONSTANT * shortest).clamp(LONGEST_OF_THE_QUICKEST_S, LONGEST_S)
}

/// In how many equal steps no longer than `longest` the plant takes a time [s].
fn steps(time: f64, longest: f64) -> u16 {
    (time / longest).ceil().clamp(1.0, MOST_STEPS) as u16
}

/// In how many equal steps the plant takes each row of a recording; its rows begin at the times `t` and last `dt` [s].
pub(super) fn steps_of_rows<const N: usize>(
    robot: &Robot<N, f64>,
    rims: &[RimSpeed],
    t: &[f64],
    dt: &[f64],
) -> Vec<u16> {
    let longest = longest_step(robot);
    // where no speeds are measured, any may be low
    let mut low = vec![rims.is_empty(); t.len()];
    let longest_at_low_speed = longest.min(LONGEST_AT_LOW_SPEED_S);
    if dt.iter().any(|dt| *dt > longest_at_low_speed) {
        rims.iter().for_each(|rim| rim.mark_low(t, &mut low));
    }
    dt.iter().zip(low).map(|(dt, low)| steps(*dt, if low { longest_at_low_speed } else { longest })).collect()
}

/// One wheel's rim speed as measured, row by row.
pub(super) struct RimSpeed {
    /// Missing values are those of the row before, zero before the first [m/s]
    pub values: Vec<f64>,
    /// One sigma [m/s]
    pub noise: f64,
}

impl RimSpeed {
    /// Marks the rows around which it passes through low speeds; rows begin at the times `t` [s].
    pub fn mark_low(&self, t: &[f64], low: &mut [bool]) {
        let least_change = CHANGE.max(CHANGE_OVER_NOISE * self.noise);
        let (mut first, mut end) = (0, 0);
        for (row, low) in low.iter_mut().enumerate() {
            while t[first] < t[row] - AROUND_S {
                first += 1;
            }
            while end < t.len() && t[end] <= t[row] + AROUND_S {
                end += 1;
            }
            let around = &self.values[first..end];
            let (least, most) = around
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), v| (least.min(*v), most.max(*v)));
            let slowest = if least < 0.0 && most > 0.0 { 0.0 } else { least.abs().min(most.abs()) };
            *low |= most - least > least_change && slowest < LOW_SPEED;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::plant::paper;

    /// Rows of 10 ms.
    fn low(noise: f64, speed: impl Fn(f64) -> f64) -> Vec<usize> {
        let t: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        let mut low = vec![false; t.len()];
        RimSpeed { values: t.iter().map(|t| speed(*t)).collect(), noise }.mark_low(&t, &mut low);
        (0..t.len()).filter(|row| low[*row]).collect()
    }

    #[test]
    fn a_reversal_and_a_start_are_low_speeds_and_what_stands_or_runs_is_not() {
        // through zero at 1 s with 2 m/s²: 0.15 m/s and 20 ms on either side are 9 or 10 rows
        let reversal = low(0.0, |t| 2.0 * (t - 1.0));
        assert!(
            (90..=92).contains(&reversal[0]) && (108..=110).contains(&reversal[reversal.len() - 1]),
            "{reversal:?}"
        );
        let start = low(0.0, |t| 2.0 * (t - 1.0).max(0.0));
        assert!((99..=101).contains(&start[0]) && start[start.len() - 1] <= 110, "{start:?}");
        assert!(low(0.0, |_| 0.0).is_empty() && low(0.0, |t| 0.5 + 0.3 * t).is_empty());
    }

    #[test]
    fn noise_of_a_wheel_that_stands_is_no_motion() {
        let noise = |t: f64| 0.03 * (t * 700.0).sin();
        assert!(!low(0.0, noise).is_empty());
        assert!(low(0.03, noise).is_empty());
    }

    #[test]
    fn a_quick_robot_is_taken_in_shorter_steps() {
        let slow = paper::four_wheels::<f64>();
        let quick = Robot { mass: 0.1 * slow.mass, inertia: 0.1 * slow.inertia, ..slow };
        assert_eq!(longest_step(&slow), LONGEST_S);
        assert!(longest_step(&quick) < 0.003);
        assert_eq!(steps(0.0, LONGEST_S), 1);
        assert_eq!([0.01, 0.0125, 0.02].map(|time| steps(time, LONGEST_S)), [1, 1, 2]);
        assert_eq!(steps(1e9, LONGEST_S), 10_000);
    }
}
