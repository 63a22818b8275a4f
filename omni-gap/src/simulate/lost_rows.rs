//! Lost rows: where a log lacks some, nobody knows what drove the robot meanwhile, and a free run begins anew.
//!
//! A command holds until the next row. Where that row was lost, the log says that it held for twice as long; had it changed in
//! between, a model that follows the log misses by what the other command would have done meanwhile:
//!
//! ```text
//! Δω ≈ ω_full·(|Δu|/u_max)·(1 − e^(−δ/τ))      δ: how long the command is not known; τ: how fast wheels follow, 0.05 to 0.5 s
//! ```
//!
//! One lost row of a log of 50 rows a second that hides a step of half the voltage is 2 to 16 % of full speed: more than most
//! effects of the catalogue make, and it is in the data of a robot that lacks nothing. Only a log with a clock of its own has
//! lost rows: one that writes a row whenever the command changes says all.

use std::ops::Range;

use crate::log::median_step;

/// A row is late by more than any jitter: this many rows after the one before [1].
const LATE: f64 = 1.6;

/// Up to here a row's command may have held as the log says [1], of a step.
const EARLY: f64 = 0.7;

/// The share of the rows that are in time where a log has a clock [1].
const IN_TIME: f64 = 0.9;

/// What an unknown command is worth, (|Δu|/u_max)·δ, from which a free run begins anew [s]: wheels that follow within 0.05 s
/// would be off by 0.4 % of full speed.
const UNKNOWN_S: f64 = 2e-4;

/// So many lost rows in sequence hide a command that came and went [rows].
const LONG: f64 = 5.0;

/// A stretch between two holes that has fewer rows, or is shorter [s], tells nothing of its own.
const FEWEST: usize = 5;
const SHORTEST_S: f64 = 0.1;

/// What lost rows leave of a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LostRows {
    /// Rows at which the driving signal is known again.
    pub resumes: Vec<usize>,
    /// Rows on which nothing can be compared: since it was last known, something else drove the robot.
    pub unknown: Vec<Range<usize>>,
}

impl LostRows {
    /// Of rows at times `t` [s], those in `driving` with a command, `input` held from row to row.
    pub fn of<const N: usize>(t: &[f64], driving: &[usize], input: &[[f64; N]]) -> Self {
        let Some(step) = clock(t, driving) else { return Self::default() };
        let largest = input.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        let hides = |[before, after]: [usize; 2]| {
            let lost_s = t[after] - t[before] - step;
            let change = (0..N).map(|j| (input[after][j] - input[before][j]).abs()).fold(0.0, f64::max);
            lost_s > (LATE - 1.0) * step && (change * lost_s > UNKNOWN_S * largest || lost_s > LONG * step)
        };
        let mut stretches = Vec::new();
        let mut known_since = 0;
        for [before, after] in driving.windows(2).map(|pair| [pair[0], pair[1]]).filter(|pair| hides(*pair)) {
            let in_time = t.partition_point(|row| *row <= t[before] + EARLY * step).max(before + 1);
            stretches.push(known_since..in_time);
            known_since = after;
        }
        stretches.push(known_since..t.len());
        stretches.retain(|rows| tells_enough(t, rows));
        let ends = stretches.iter().map(|rows| rows.end);
        let begins = stretches.iter().map(|rows| rows.start);
        let unknown = std::iter::once(0).chain(ends).zip(begins.clone().chain([t.len()])).map(|(from, to)| from..to);
        match stretches.is_empty() {
            true => Self::default(),
            false => Self {
                resumes: begins.filter(|row| *row > 0).collect(),
                unknown: unknown.filter(|rows| !rows.is_empty()).collect(),
            },
        }
    }
}

/// Whether rows in sequence can be compared on their own.
fn tells_enough(t: &[f64], rows: &Range<usize>) -> bool {
    rows.len() >= FEWEST && t[rows.end - 1] - t[rows.start] >= SHORTEST_S
}

/// The step of the clock that rows come by [s]; none where they come as they like.
fn clock(t: &[f64], driving: &[usize]) -> Option<f64> {
    let middle = median_step(driving.iter().map(|row| t[*row]))?;
    let steps = driving.windows(2).map(|pair| t[pair[1]] - t[pair[0]]);
    let in_time = steps.filter(|step| (step - middle).abs() < (LATE - 1.0) * middle).count();
    (in_time as f64 >= IN_TIME * (driving.len() - 1) as f64).then_some(middle)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use model_core::plant::Input;
    use proptest::prelude::*;

    use super::super::aligned_run::AlignedRun;
    use super::super::model::Model;
    use super::super::predict::predict;
    use super::super::record::{SensorSetup, record};
    use super::*;
    use crate::log::{Catalogue, Missing, RobotFile, Run};

    /// A second of a log of 50 rows a second without some rows, its command by time.
    fn lost(rows: &[usize], command: impl Fn(f64) -> f64) -> LostRows {
        of(&kept(50, 0.02, rows), command)
    }

    /// Times of rows [s], without some.
    fn kept(count: usize, step: f64, without: &[usize]) -> Vec<f64> {
        (0..count).filter(|row| !without.contains(row)).map(|row| row as f64 * step).collect()
    }

    fn of(t: &[f64], command: impl Fn(f64) -> f64) -> LostRows {
        let driving: Vec<usize> = (0..t.len()).collect();
        LostRows::of(t, &driving, &t.iter().map(|t| [command(*t), 6.0]).collect::<Vec<_>>())
    }

    /// What is left where one stretch tells nothing.
    fn without(resumes: &[usize], unknown: Range<usize>) -> LostRows {
        LostRows { resumes: resumes.to_vec(), unknown: std::iter::once(unknown).collect() }
    }

    /// A command that steps at a time [s].
    fn step_at(time: f64) -> impl Fn(f64) -> f64 {
        move |t| if t < time - 1e-9 { 2.0 } else { 8.0 }
    }

    #[test]
    fn a_run_begins_anew_where_a_command_changed_while_no_row_came() {
        let nothing = LostRows::default();
        assert_eq!(lost(&[20], step_at(0.4)), LostRows { resumes: vec![20], ..LostRows::default() });
        assert_eq!(lost(&[20, 21], step_at(0.42)), LostRows { resumes: vec![20], ..LostRows::default() });
        assert_eq!(lost(&[20], step_at(0.3)), nothing, "what held before and after held in between");
        assert_eq!(lost(&[], step_at(0.4)), nothing);
        assert_eq!(lost(&[20, 21, 22, 23, 24, 25], |_| 2.0).resumes, [20], "a command may have come and gone");
    }

    #[test]
    fn the_faster_a_log_the_larger_the_step_that_matters() {
        let at = |rate: usize, change: f64| {
            let t = kept(rate, 1.0 / rate as f64, &[rate / 2]);
            !of(&t, |t| if t < 0.5 - 1e-9 { 8.0 } else { 8.0 - change }).resumes.is_empty()
        };
        assert!(at(50, 0.2) && !at(200, 0.2) && at(200, 0.5) && !at(1000, 0.5) && at(1000, 2.0));
    }

    #[test]
    fn a_log_that_writes_what_changes_when_it_changes_lacks_nothing() {
        let t = [0.0, 0.1, 0.15, 0.6, 0.61, 0.9, 1.4, 1.42, 1.8, 2.5];
        assert_eq!(of(&t, |t| (7.0 * t).sin()), LostRows::default());
    }

    #[test]
    fn what_was_measured_meanwhile_is_not_compared() {
        // rows of another clock, three to each command
        let t: Vec<f64> = (0..150).map(|k| f64::from(k) * 0.02 / 3.0).collect();
        let driving: Vec<usize> = (0..150).step_by(3).filter(|row| *row != 60).collect();
        let input: Vec<[f64; 1]> = (0..150).map(|row| [if row < 63 { 2.0 } else { 8.0 }]).collect();
        // two rows after the command of row 57 may have been measured before the lost one
        assert_eq!(LostRows::of(&t, &driving, &input), without(&[63], 60..63));
    }

    #[test]
    fn a_stretch_that_is_too_short_to_tell_anything_is_left_out() {
        let stairs = |t: f64| (t / 0.02).round();
        assert_eq!(lost(&[20, 23], stairs), without(&[22], 20..22));
        assert_eq!(lost(&[3], stairs), without(&[3], 0..3));
        assert_eq!(lost(&[47], stairs), without(&[], 47..49));
    }

    proptest! {
        #[test]
        fn every_row_is_known_or_not_and_begins_in_order(
            without in proptest::collection::btree_set(1_usize..299, 0..25),
            steps in proptest::collection::vec(-12.0..12.0_f64, 300),
        ) {
            let t = kept(300, 0.02, &without.iter().copied().collect::<Vec<_>>());
            let LostRows { resumes, unknown } = of(&t, |t| steps[(t / 0.02).round() as usize]);
            prop_assert!(resumes.windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!(resumes.iter().all(|row| (1..t.len()).contains(row)));
            prop_assert!(unknown.windows(2).all(|pair| pair[0].end < pair[1].start));
            // a stretch that is compared begins where it is known again, and lacks no row
            for row in (1..t.len()).filter(|row| t[*row] - t[row - 1] > 0.03) {
                let begins = resumes.contains(&row) || unknown.iter().any(|rows| rows.contains(&row));
                let same = (steps[(t[row] / 0.02).round() as usize] - steps[(t[row - 1] / 0.02).round() as usize]).abs();
                prop_assert!(begins || same < 0.12, "row {}", row);
            }
        }
    }

    /// A run as it was, but for some rows.
    fn without_rows(run: &Run, lost: &[usize]) -> Run {
        let kept = || (0..run.rows()).filter(|row| !lost.contains(row));
        let mut without = run.with_channels(|_, channel| Some(kept().map(|row| channel.get(row)).collect()));
        without.t_s = kept().map(|row| run.t_s[row]).collect();
        without
    }

    /// Σ error² over numbers of a model on a run [σ²].
    fn missed(model: &Model<4>, run: &AlignedRun<4>) -> f64 {
        let sums = predict(&model.plant(), run, 0.5).squares(run);
        sums.iter().map(|sum| sum.0).sum::<f64>() / sums.iter().map(|sum| sum.1).sum::<f64>()
    }

    #[test]
    fn a_robot_that_lacks_nothing_lacks_nothing_where_rows_are_lost() {
        let text = include_str!("../../robots/feup-4w/robot.toml");
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let model = Model::nominal(&robot, 12.0);
        // another command every half second, amid the windows, at 50 rows a second
        let t: Vec<f64> = (0..300).map(|row| f64::from(row) / 50.0).collect();
        let command = |row: usize| {
            Input::Voltage([0.0, 1.0, 2.0, 3.0].map(|j: f64| 9.0 * (2.3 * ((row + 12) / 25) as f64 + j).sin()))
        };
        let input: Vec<_> = (0..300).map(command).collect();
        let setup = SensorSetup { sensors: robot.sensors, gyro: true, ..SensorSetup::default() };
        let whole = record(&model.plant(), "run", &t, &input, &setup, 1);
        let lost: Vec<usize> = (0..12).map(|step| 25 * step + 13).collect();
        let log = without_rows(&whole, &lost);
        let laid_out = |run: &Run| AlignedRun::<4>::new(run, &robot).unwrap();
        let (of_whole, of_log) = (missed(&model, &laid_out(&whole)), missed(&model, &laid_out(&log)));
        assert!(of_log < 1.2 * of_whole, "{of_log} of {of_whole}");
        // the same hole, but with a reason in place of the command
        let holed = whole.with_channels(|name, channel| {
            let sample = |row| if lost.contains(&row) { Err(Missing::Lost) } else { channel.get(row) };
            Some(
                (0..channel.len())
                    .map(|row| if name.starts_with('u') { sample(row) } else { channel.get(row) })
                    .collect(),
            )
        });
        let of_holed = missed(&model, &laid_out(&holed));
        assert!(of_holed < 1.2 * of_whole, "{of_holed} of {of_whole}");
        // without what is tested
        let goes_on = AlignedRun { resumes: Vec::new(), ..laid_out(&log) };
        let of_going_on = missed(&model, &goes_on);
        assert!(of_going_on > 20.0 * of_whole, "{of_going_on} of {of_whole}");
    }
}
