//! # A run: what one recording says, in SI units
//!
//! A [`Channel`] is a column of numbers in which every hole has a reason; it never shows a NaN. A [`Group`] is the
//! channels of one kind, one per wheel, or x, y and heading for the pose. A [`Run`] is the groups on one clock.

use super::robot_file::RobotFile;
use std::path::{Path, PathBuf};

/// Why a sample is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Missing {
    /// The field was left empty: nothing was measured on this row.
    Blank,
    /// A sample was due and never arrived, or was not a number.
    Lost,
    /// The sensor was at its limit.
    Saturated,
    /// The sensor repeated an old value.
    Stale,
    /// The telegram failed its checksum.
    BadCrc,
}

const REASONS: [Missing; 5] = [Missing::Blank, Missing::Lost, Missing::Saturated, Missing::Stale, Missing::BadCrc];

/// One signal over the rows of a run. Values are finite; a hole has a reason.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Channel {
    values: Vec<f64>,
    // 0 = present, 1.. = index into REASONS plus one; empty while there is no hole at all
    holes: Vec<u8>,
}

impl Channel {
    /// An empty channel with room for `rows`.
    pub fn with_capacity(rows: usize) -> Channel {
        Channel { values: Vec::with_capacity(rows), holes: Vec::new() }
    }

    /// A channel of numbers in SI units; one that is not finite becomes a hole, [`Missing::Lost`].
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Channel {
        values.into_iter().map(Ok).collect()
    }

    /// Adds a sample in SI units. A number that is not finite is recorded as [`Missing::Lost`].
    pub fn push(&mut self, value: f64) {
        if !value.is_finite() {
            return self.push_missing(Missing::Lost);
        }
        self.values.push(value);
        if !self.holes.is_empty() {
            self.holes.push(0);
        }
    }

    /// Adds a hole.
    pub fn push_missing(&mut self, reason: Missing) {
        if self.holes.is_empty() {
            self.holes.reserve(self.values.capacity());
            self.holes.resize(self.values.len(), 0);
        }
        self.values.push(0.0);
        self.holes.push(reason as u8 + 1);
    }

    /// The sample on `row`, in SI units, or why there is none.
    ///
    /// # Panics
    /// Where the channel has no such row.
    #[inline]
    pub fn get(&self, row: usize) -> std::result::Result<f64, Missing> {
        match self.holes.get(row) {
            None | Some(0) => Ok(self.values[row]),
            Some(&code) => Err(REASONS[usize::from(code) - 1]),
        }
    }

    /// How many rows it has, holes included.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Whether no row has a sample.
    pub fn is_blank(&self) -> bool {
        self.present().next().is_none()
    }

    /// Whether every row has a sample.
    pub fn is_whole(&self) -> bool {
        self.holes.iter().all(|&code| code == 0)
    }

    /// The samples that are there: row and value.
    pub fn present(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.values
            .iter()
            .enumerate()
            .filter(|(row, _)| self.holes.get(*row).is_none_or(|&c| c == 0))
            .map(|(r, &v)| (r, v))
    }

    /// All rows in order.
    pub fn iter(&self) -> impl Iterator<Item = std::result::Result<f64, Missing>> + '_ {
        (0..self.len()).map(|row| self.get(row))
    }

    /// The same channel with each sample changed by `f(row, value)`; holes stay.
    pub fn map(&self, mut f: impl FnMut(usize, f64) -> f64) -> Channel {
        self.iter().enumerate().map(|(row, sample)| sample.map(|value| f(row, value))).collect()
    }

    /// Takes 2π jumps out of a heading in radians.
    ///
    /// A heading that stays within one turn (and 1 rad for noise) is taken as wrapped: a step of more than half a turn
    /// is a wrap. One that spans more was never wrapped, and is left as it is.
    pub fn unwrapped(&self) -> Channel {
        use std::f64::consts::{PI, TAU};
        let (low, high) = self.present().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(v), h.max(v)));
        if high - low < PI || high - low > TAU + 1.0 {
            return self.clone();
        }
        let mut last = None;
        self.map(|_, value| {
            let value = last.map_or(value, |before: f64| value - TAU * ((value - before) / TAU).round());
            last = Some(value);
            value
        })
    }
}

impl FromIterator<std::result::Result<f64, Missing>> for Channel {
    fn from_iter<I: IntoIterator<Item = std::result::Result<f64, Missing>>>(samples: I) -> Channel {
        let samples = samples.into_iter();
        let mut channel = Channel::with_capacity(samples.size_hint().0);
        for sample in samples {
            match sample {
                Ok(value) => channel.push(value),
                Err(reason) => channel.push_missing(reason),
            }
        }
        channel
    }
}

/// Channels of one kind: one per wheel, or x (m), y (m) and heading (rad) for the pose.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Group {
    /// The channels, in wheel order.
    pub channels: Vec<Channel>,
    /// Whether the log keeps only the magnitude.
    pub unsigned: bool,
    /// The step in which the signal was recorded, in the signal's own unit, where it is coarse.
    pub quantum: Option<f64>,
}

impl Group {
    /// A signed group without a coarse step.
    pub fn new(channels: Vec<Channel>) -> Group {
        Group { channels, unsigned: false, quantum: None }
    }

    /// A group from columns of numbers in SI units.
    pub fn from_columns(columns: Vec<Vec<f64>>) -> Group {
        Group::new(columns.into_iter().map(Channel::from_values).collect())
    }
}

/// Whether the currents of a row were measured before or after the row's voltage was applied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampled {
    /// Just before: the current still answers to the voltage of the row above.
    Before,
    /// Just after: the form of the contract.
    #[default]
    After,
}

/// One recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Run {
    /// The file's name without folder and suffix.
    pub name: String,
    /// The file it came from; empty for a run made in memory.
    pub path: PathBuf,
    /// The line of the file on which the first row stands, counted from 1; none for a run made in memory.
    pub first_line: Option<usize>,
    /// Time of each row (s), strictly increasing.
    pub t_s: Vec<f64>,
    /// Mean motor voltages (V), held from a row until the next.
    pub u: Option<Group>,
    /// DC-equivalent motor currents (A).
    pub i: Option<Group>,
    /// Wheel speeds at the wheel's shaft (rad/s).
    pub w: Option<Group>,
    /// Commanded wheel speeds (rad/s).
    pub wset: Option<Group>,
    /// Measured pose: x (m), y (m), heading (rad), the heading unwrapped.
    pub pose: Option<Group>,
    /// Supply voltage (V).
    pub vbat: Option<Channel>,
    /// Yaw rate (rad/s).
    pub gyro: Option<Channel>,
    /// One where the bridges are driven, zero where they are open and no current can flow; absent: always driven.
    pub enable: Option<Channel>,
    /// When, relative to the row's voltage, its currents were measured.
    pub currents_sampled: Sampled,
}

impl Run {
    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.t_s.len()
    }

    /// Whether the bridges are open on a row.
    pub fn is_open(&self, row: usize) -> bool {
        self.enable.as_ref().is_some_and(|enable| enable.get(row) == Ok(0.0))
    }

    /// Where it stands: its file; its name, for a run made in memory.
    pub fn place(&self) -> &Path {
        if self.path.as_os_str().is_empty() { Path::new(&self.name) } else { &self.path }
    }

    /// The line of the file on which a row stands; for a run made in memory, of the file that it would be written to.
    pub fn line_of(&self, row: usize) -> usize {
        self.first_line.unwrap_or(2) + row
    }

    /// From the first row to the last (s).
    pub fn duration_s(&self) -> f64 {
        self.t_s.last().zip(self.t_s.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// The middle one of the row lengths (s); zero for fewer than two rows.
    pub fn median_step_s(&self) -> f64 {
        let mut steps: Vec<f64> = self.t_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = steps.len() / 2;
        if steps.is_empty() { 0.0 } else { *steps.select_nth_unstable_by(middle, f64::total_cmp).1 }
    }

    /// Every signal that is there, under its column name in the contract, in the contract's order.
    pub fn signals(&self) -> Vec<(String, &Channel)> {
        let mut all = Vec::new();
        for (stem, unit, group) in [("u", "V", &self.u), ("i", "A", &self.i), ("w", "rad_s", &self.w)] {
            all.extend(per_wheel(stem, unit, group));
        }
        if let Some(pose) = &self.pose {
            all.extend(["x_m", "y_m", "theta_rad"].iter().zip(&pose.channels).map(|(n, c)| (n.to_string(), c)));
        }
        all.extend(per_wheel("wset", "rad_s", &self.wset));
        all.extend(self.vbat.iter().map(|c| ("vbat_V".to_string(), c)));
        all.extend(self.gyro.iter().map(|c| ("gyro_rad_s".to_string(), c)));
        all.extend(self.enable.iter().map(|c| ("enable".to_string(), c)));
        all
    }

    /// Writes the run in the contract's layout; a hole becomes an empty field.
    pub fn write_csv(&self, out: impl std::io::Write) -> std::io::Result<()> {
        use std::io::Write;
        let signals = self.signals();
        let mut out = std::io::BufWriter::with_capacity(1 << 16, out);
        write!(out, "t_s")?;
        for (name, _) in &signals {
            write!(out, ",{name}")?;
        }
        writeln!(out)?;
        for (row, t_s) in self.t_s.iter().enumerate() {
            write!(out, "{t_s}")?;
            for (_, channel) in &signals {
                match channel.get(row) {
                    Ok(value) => write!(out, ",{value}")?,
                    Err(_) => write!(out, ",")?,
                }
            }
            writeln!(out)?;
        }
        out.flush()
    }

    /// The voltage to take as the supply (V): the robot file's, or else the largest |u| or supply voltage seen.
    pub fn supply_v(&self, robot: &RobotFile) -> Option<f64> {
        let seen = self.u.iter().flat_map(|group| &group.channels).chain(&self.vbat);
        let largest = seen.flat_map(|c| c.present()).map(|(_, v)| v.abs()).fold(0.0, f64::max);
        robot.supply.map(|supply| supply.voltage_v).or((largest > 0.0).then_some(largest))
    }
}

fn per_wheel<'a>(stem: &str, unit: &str, group: &'a Option<Group>) -> Vec<(String, &'a Channel)> {
    let channels = group.iter().flat_map(|group| &group.channels).enumerate();
    channels.map(|(wheel, channel)| (format!("{stem}{wheel}_{unit}"), channel)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_keeps_its_reason_and_a_number_that_is_none_becomes_one() {
        let mut channel = Channel::from_values([1.0, f64::NAN]);
        channel.push_missing(Missing::BadCrc);
        channel.push(2.0);
        let all: Vec<_> = channel.iter().collect();
        assert_eq!(all, [Ok(1.0), Err(Missing::Lost), Err(Missing::BadCrc), Ok(2.0)]);
        assert_eq!(channel.present().collect::<Vec<_>>(), [(0, 1.0), (3, 2.0)]);
        assert!(!channel.is_whole() && !channel.is_blank());
    }

    #[test]
    fn a_wrapped_heading_is_unwrapped_across_a_hole() {
        let mut channel = Channel::from_values([3.0]);
        channel.push_missing(Missing::Blank);
        channel.push(-3.1);
        let after = channel.unwrapped().get(2).unwrap();
        assert!((after - (std::f64::consts::TAU - 3.1)).abs() < 1e-12);
    }

    #[test]
    fn a_heading_of_many_turns_is_left_alone() {
        let channel = Channel::from_values([0.0, 4.0, 8.0, 12.0]);
        assert_eq!(channel.unwrapped(), channel);
    }

    #[test]
    fn a_run_is_written_with_empty_fields_for_holes() {
        let mut i0 = Channel::from_values([0.5]);
        i0.push_missing(Missing::Lost);
        let run = Run { t_s: vec![0.0, 0.01], i: Some(Group::new(vec![i0])), ..Run::default() };
        let mut text = Vec::new();
        run.write_csv(&mut text).unwrap();
        assert_eq!(String::from_utf8(text).unwrap(), "t_s,i0_A\n0,0.5\n0.01,\n");
    }
}
