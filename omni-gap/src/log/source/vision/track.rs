//! The track of one robot: a row for each time that a camera saw it, in the order of one of its clocks.

use super::detection::{DetectionFrame, DetectionRobot};
use crate::error::Result;
use crate::log::channel::{Channel, Missing};
use crate::log::source::opened::{OwnClock, Source};
use std::path::{Path, PathBuf};

/// The columns of a track, named as the messages have them; `log_time` is when the packet was received (s since 1970).
const COLUMNS: [&str; 9] =
    ["t_capture", "t_sent", "log_time", "frame_number", "camera_id", "confidence", "x", "y", "orientation"];

/// Which of them are clocks.
const T_CAPTURE: usize = 0;
const T_SENT: usize = 1;
const LOG_TIME: usize = 2;
const CONFIDENCE: usize = 5;

/// A row; what a message does not tell is no number.
type Row = [f64; COLUMNS.len()];

/// What the cameras saw of one robot.
///
/// Rows of all cameras stand together in the order of the clock that is wanted. Of rows at the very same time the one of
/// the highest confidence is kept, so that times increase.
#[derive(Debug)]
pub(super) struct Track {
    path: PathBuf,
    names: Vec<String>,
    rows: Vec<Row>,
    clock: OwnClock,
    notices: Vec<String>,
}

/// What a frame says of one robot.
pub(super) fn row(received_ns: i64, frame: &DetectionFrame, robot: &DetectionRobot) -> Row {
    let time = |time: Option<f64>| time.unwrap_or(f64::NAN);
    let whole = |number: Option<u32>| number.map_or(f64::NAN, f64::from);
    let part = |number: Option<f32>| number.map_or(f64::NAN, f64::from);
    [
        time(frame.t_capture),
        time(frame.t_sent),
        seconds(received_ns),
        whole(frame.frame_number),
        whole(frame.camera_id),
        part(robot.confidence),
        part(robot.x),
        part(robot.y),
        part(robot.orientation),
    ]
}

/// Nanoseconds in seconds. A double holds some quarter of a microsecond of times since 1970.
fn seconds(ns: i64) -> f64 {
    ns.div_euclid(1_000_000_000) as f64 + 1e-9 * ns.rem_euclid(1_000_000_000) as f64
}

impl Track {
    pub fn new(path: &Path, topic: &str, rows: Vec<Row>, mut notices: Vec<String>) -> Track {
        let stands_still = rows.iter().all(|row| row[T_CAPTURE] == rows[0][T_CAPTURE]);
        let column = if stands_still { LOG_TIME } else { T_CAPTURE };
        let told = format!("topic `{topic}`: its times are those of `{}`", COLUMNS[column]);
        let names = COLUMNS.map(str::to_owned).to_vec();
        let doubled = rows.len() - in_order(&rows, column).len();
        if doubled > 0 {
            notices.push(format!(
                "topic `{topic}`: {doubled} of {} rows left out: two at the same time, the one of higher confidence is \
                 kept",
                rows.len()
            ));
        }
        Track { path: path.into(), names, rows, clock: OwnClock { column, told }, notices }
    }
}

/// The rows in the order of a clock, one for each time.
fn in_order(rows: &[Row], clock: usize) -> Vec<&Row> {
    let mut order: Vec<&Row> = rows.iter().collect();
    let surest_first = |a: &Row, b: &Row| b[CONFIDENCE].total_cmp(&a[CONFIDENCE]);
    order.sort_by(|a, b| a[clock].total_cmp(&b[clock]).then_with(|| surest_first(a, b)));
    order.dedup_by(|later, kept| later[clock] == kept[clock]);
    order
}

impl Source for Track {
    fn path(&self) -> &Path {
        &self.path
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn columns(&mut self, wanted: &[usize]) -> Result<Vec<Channel>> {
        // whichever clock is asked for has to increase
        let clocks = [self.clock.column, T_CAPTURE, T_SENT, LOG_TIME];
        let clock = clocks.into_iter().find(|clock| wanted.contains(clock)).unwrap_or(self.clock.column);
        let rows = in_order(&self.rows, clock);
        let of = |column: &usize| -> Channel {
            let number = |row: &&Row| Some(row[*column]).filter(|number| number.is_finite()).ok_or(Missing::Blank);
            rows.iter().map(number).collect()
        };
        Ok(wanted.iter().map(of).collect())
    }

    fn clock(&self) -> Option<&OwnClock> {
        Some(&self.clock)
    }

    fn notices(&self) -> Vec<String> {
        self.notices.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A robot seen at `t_capture`, received at `log_time`, so sure, at `x`.
    fn seen(t_capture: f64, log_time: f64, confidence: f64, x: f64) -> Row {
        let mut row = [f64::NAN; COLUMNS.len()];
        (row[T_CAPTURE], row[LOG_TIME], row[CONFIDENCE], row[6]) = (t_capture, log_time, confidence, x);
        row
    }

    fn track(rows: &[Row]) -> Track {
        Track::new(Path::new("game.log"), "yellow/3", rows.to_vec(), Vec::new())
    }

    #[test]
    fn cameras_are_merged_by_the_clock_that_is_wanted() {
        // the second camera is looked at sooner
        let mut track =
            self::track(&[seen(1.0, 9.3, 1.0, 10.0), seen(1.2, 9.4, 1.0, 12.0), seen(1.1, 9.35, 1.0, 11.0)]);
        assert_eq!(track.clock.column, T_CAPTURE);
        let mut x = |clock| track.columns(&[clock, 6]).unwrap().remove(1);
        assert_eq!(x(T_CAPTURE), Channel::from_values([10.0, 11.0, 12.0]));
        let mut late = self::track(&[seen(1.0, 9.5, 1.0, 10.0), seen(1.1, 9.3, 1.0, 11.0)]);
        assert_eq!(late.columns(&[6, LOG_TIME]).unwrap()[0], Channel::from_values([11.0, 10.0]));
    }

    #[test]
    fn of_two_rows_at_one_time_the_surer_is_kept_and_told() {
        let mut track = self::track(&[seen(1.0, 9.0, 0.5, 99.0), seen(1.0, 9.1, 0.9, 10.0), seen(1.1, 9.2, 0.9, 11.0)]);
        assert_eq!(track.columns(&[T_CAPTURE, 6]).unwrap()[1], Channel::from_values([10.0, 11.0]));
        assert!(track.notices[0].contains("1 of 3 rows left out"), "{:?}", track.notices);
    }

    #[test]
    fn a_clock_that_stands_still_is_none() {
        let mut track = self::track(&[seen(0.0, 9.0, 1.0, 10.0), seen(0.0, 9.1, 1.0, 11.0)]);
        assert_eq!(track.clock.column, LOG_TIME);
        assert_eq!(track.columns(&[0, 1, 2, 6]).unwrap()[3], Channel::from_values([10.0, 11.0]));
    }

    #[test]
    fn times_before_1970_and_of_now_are_seconds() {
        assert_eq!(seconds(1_700_000_000_250_000_000), 1.700_000_000_25e9);
        assert_eq!(seconds(-500_000_000), -0.5);
    }
}
