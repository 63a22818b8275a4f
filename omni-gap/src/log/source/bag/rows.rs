//! # Messages of one topic, as rows of columns

use super::super::opened::Keeps;
use super::flatten::flatten;
use super::value::Value;
use crate::log::channel::{Channel, Missing};
use std::collections::HashMap;

/// When the recorder wrote a message down (s since 1970).
pub(super) const LOG_TIME: &str = "log_time";

/// When a message was sent (s since 1970), by the recorder.
const PUBLISH_TIME: &str = "publish_time";

/// What a time of measurement is called inside a message, the likeliest first.
const STAMPS: [&str; 3] = ["header.stamp", "stamp", "timestamp"];

/// A message that was recorded, and when.
#[derive(Debug, Clone, Copy)]
pub(super) struct Recorded<'a> {
    pub log_ns: u64,
    pub publish_ns: u64,
    pub bytes: &'a [u8],
}

/// Columns that grow by a row with each message; a number that a message lacks is a hole.
pub(super) struct Rows<'a> {
    keeps: &'a Keeps<'a>,
    places: HashMap<String, usize>,
    names: Vec<String>,
    /// A column for each name; none of what is neither kept nor a clock.
    columns: Vec<Option<Channel>>,
    rows: usize,
}

impl<'a> Rows<'a> {
    /// No rows yet, of columns with names that are kept.
    pub fn new(keeps: &'a Keeps<'a>) -> Self {
        Self { keeps, places: HashMap::new(), names: Vec::new(), columns: Vec::new(), rows: 0 }
    }

    pub fn push(&mut self, recorded: Recorded, message: &Value) {
        self.put(LOG_TIME, seconds(recorded.log_ns));
        self.put(PUBLISH_TIME, seconds(recorded.publish_ns));
        flatten(message, &mut |path, number| self.put(path, number));
        self.rows += 1;
        for column in self.columns.iter_mut().flatten() {
            fill(column, self.rows);
        }
    }

    fn put(&mut self, name: &str, number: f64) {
        let place = self.places.get(name).copied().unwrap_or_else(|| {
            self.places.insert(name.to_owned(), self.columns.len());
            self.names.push(name.to_owned());
            let is_wanted = (self.keeps)(name) || name == LOG_TIME || STAMPS.contains(&name);
            self.columns.push(is_wanted.then(Channel::default));
            self.columns.len() - 1
        });
        let Some(column) = &mut self.columns[place] else { return };
        // a name that stands twice in a message keeps its first number
        if column.len() <= self.rows {
            fill(column, self.rows);
            column.push(number);
        }
    }

    /// Names, columns and the place of the clock, rows in the order in which they were recorded.
    pub fn finish(mut self) -> (Vec<String>, Vec<Channel>, Option<usize>) {
        let of_recording = self.columns.first().and_then(Option::as_ref);
        let log_time = |row: usize| of_recording.and_then(|column| column.get(row).ok()).unwrap_or_default();
        if (1..self.rows).any(|row| log_time(row) < log_time(row - 1)) {
            let mut order: Vec<usize> = (0..self.rows).collect();
            order.sort_by(|a, b| log_time(*a).total_cmp(&log_time(*b)));
            let sorted = |column: &Channel| order.iter().map(|row| column.get(*row)).collect();
            self.columns = self.columns.iter().map(|column| column.as_ref().map(sorted)).collect();
        }
        let clock = self.clock();
        let wanted = |(place, name): (usize, &String)| Some(place) == clock || (self.keeps)(name);
        let wanted: Vec<bool> = self.names.iter().enumerate().map(wanted).collect();
        let columns = self.columns.into_iter().zip(wanted).map(|(column, wanted)| column.filter(|_| wanted));
        (self.names, columns.map(Option::unwrap_or_default).collect(), clock)
    }

    /// The time of measurement where every message has one and they increase, else when it was recorded.
    fn clock(&self) -> Option<usize> {
        let increases = |place: &usize| {
            let Some(column) = &self.columns[*place] else { return false };
            let times = column.present().map(|(_, time)| time);
            column.is_whole() && column.get(0).is_ok_and(|first| first > 0.0) && times.is_sorted_by(|a, b| a < b)
        };
        let stamp = STAMPS.iter().filter_map(|name| self.places.get(*name).copied()).find(increases);
        stamp.or_else(|| self.places.get(LOG_TIME).copied())
    }
}

fn fill(column: &mut Channel, rows: usize) {
    while column.len() < rows {
        column.push_missing(Missing::Blank);
    }
}

/// Nanoseconds in seconds. A double holds some quarter of a microsecond of times since 1970.
fn seconds(ns: u64) -> f64 {
    (ns / 1_000_000_000) as f64 + 1e-9 * (ns % 1_000_000_000) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(fields: &[(&'static str, f64)]) -> Value<'static> {
        Value::Fields(fields.iter().map(|(name, number)| ((*name).into(), Value::Number(*number))).collect())
    }

    fn rows(messages: &[(u64, Value)]) -> (Vec<String>, Vec<Channel>, Option<usize>) {
        let mut rows = Rows::new(&|_| true);
        for (log_ns, message) in messages {
            rows.push(Recorded { log_ns: *log_ns, publish_ns: 0, bytes: &[] }, message);
        }
        rows.finish()
    }

    #[test]
    fn a_number_that_a_message_lacks_is_a_hole_before_and_after() {
        let (names, columns, _) =
            rows(&[(1, message(&[("a", 1.0)])), (2, message(&[("b", 2.0)])), (3, message(&[("a", 3.0)]))]);
        assert_eq!(names, ["log_time", "publish_time", "a", "b"]);
        let hole = Err(Missing::Blank);
        assert_eq!(columns[2].iter().collect::<Vec<_>>(), [Ok(1.0), hole, Ok(3.0)]);
        assert_eq!(columns[3].iter().collect::<Vec<_>>(), [hole, Ok(2.0), hole]);
    }

    #[test]
    fn of_what_is_not_kept_there_is_the_name_and_a_clock_is_kept_as_long_as_it_is_the_clock() {
        let keeps = |name: &str| name == "a";
        let rows = |stamps: [f64; 2]| {
            let mut rows = Rows::new(&keeps);
            for (k, stamp) in (1..).zip(stamps) {
                let message = message(&[("stamp", stamp), ("a", 3.0), ("b", 4.0)]);
                rows.push(Recorded { log_ns: k, publish_ns: k, bytes: &[] }, &message);
            }
            let (names, columns, clock) = rows.finish();
            assert_eq!(names, ["log_time", "publish_time", "stamp", "a", "b"]);
            (columns.iter().map(Channel::len).collect::<Vec<_>>(), clock)
        };
        assert_eq!(rows([1.0, 2.0]), (vec![0, 0, 2, 2, 0], Some(2)));
        assert_eq!(rows([2.0, 1.0]), (vec![2, 0, 0, 2, 0], Some(0)));
    }

    #[test]
    fn rows_stand_in_the_order_of_their_recording() {
        let (_, columns, _) = rows(&[(2_000_000_000, message(&[("a", 2.0)])), (1_000_000_000, message(&[("a", 1.0)]))]);
        assert_eq!(columns[2], Channel::from_values([1.0, 2.0]));
    }

    #[test]
    fn the_stamp_is_the_clock_where_it_increases_and_else_the_recording() {
        let clock = |stamps: [f64; 2]| {
            let (names, _, clock) =
                rows(&[(1, message(&[("stamp", stamps[0])])), (2, message(&[("stamp", stamps[1])]))]);
            clock.map(|place| names[place].clone()).unwrap()
        };
        assert_eq!(clock([1.0, 1.1]), "stamp");
        assert_eq!(clock([1.0, 1.0]), LOG_TIME);
        assert_eq!(clock([0.0, 0.0]), LOG_TIME);
    }
}
