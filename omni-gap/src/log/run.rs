//! # A run: what one recording says, in SI units
//!
//! A [`Group`] is the channels of one kind, one per wheel, or x, y and heading for the pose. A [`Run`] is the groups on
//! common rows. Where files with a clock each make the run, its rows are all instants at which anything was commanded or
//! measured, and a channel has holes, [`Missing::NotDue`], at the instants of other clocks: nothing is resampled.
//!
//! [`Missing::NotDue`]: super::Missing::NotDue

use super::channel::{Channel, Missing};
use super::robot_file::RobotFile;
use crate::error::Error;
use std::ops::Range;
use std::path::{Path, PathBuf};

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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, schemars::JsonSchema, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampled {
    /// Just before: the current still answers to the voltage of the row above.
    Before,
    /// Just after: the form of the contract.
    #[default]
    After,
}

const POSE: [&str; 3] = ["x_m", "y_m", "theta_rad"];
const VBAT: &str = "vbat_V";
const GYRO: &str = "gyro_rad_s";
const ENABLE: &str = "enable";

/// One of several files that make a run, each with a clock of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct RunFile {
    /// The file.
    pub path: PathBuf,
    /// The line of the file on which its first row stands, counted from 1; none where it is not text.
    pub first_line: Option<usize>,
    /// What was added to its times to bring them onto the clock of the first file (s).
    pub offset_s: f64,
    /// The columns of the run that it has, by their names in the contract.
    pub columns: Vec<String>,
}

/// One recording.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Run {
    /// The file's name without folder and suffix.
    pub name: String,
    /// The file, or folder of files, it came from; empty for a run made in memory.
    pub path: PathBuf,
    /// The line of the file on which the first row stands, counted from 1; none for a run of several files, of a file
    /// that is not text, and for one made in memory.
    pub first_line: Option<usize>,
    /// The files that make the run, where there are several; empty where all signals share one clock.
    pub files: Vec<RunFile>,
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

    /// Whether each wheel's bridge is open, row by row: all of them where they are not enabled, one where its voltage says so.
    pub fn open_bridges<const N: usize>(&self) -> Vec<[bool; N]> {
        let mut open: Vec<[bool; N]> = self.open_rows().into_iter().map(|open| [open; N]).collect();
        for (wheel, channel) in self.u.iter().flat_map(|group| &group.channels).enumerate().take(N) {
            let held = channel.held();
            open.iter_mut().zip(held.iter()).for_each(|(open, u)| open[wheel] |= u == Err(Missing::Open));
        }
        open
    }

    /// Whether on some row a bridge is open while others are driven, as after a fault of one motor.
    pub fn opens_single_bridges(&self) -> bool {
        let voltages = self.u.as_ref().map_or(&[][..], |group| &group.channels);
        let open = |row: usize| voltages.iter().filter(|u| u.get(row) == Err(Missing::Open)).count();
        (0..self.rows()).any(|row| (1..voltages.len()).contains(&open(row)))
    }

    /// Whether no bridge is enabled, row by row; what was true last stays true at instants of other clocks.
    pub fn open_rows(&self) -> Vec<bool> {
        match self.enable.as_ref().map(Channel::held) {
            Some(enable) => enable.iter().map(|sample| sample == Ok(0.0)).collect(),
            None => vec![false; self.rows()],
        }
    }

    /// Where it stands: its file; its name, for a run made in memory.
    pub fn place(&self) -> &Path {
        if self.path.as_os_str().is_empty() { Path::new(&self.name) } else { &self.path }
    }

    /// Whether its file has lines: a run made in memory has those of the file that it would be written to.
    pub fn is_text(&self) -> bool {
        self.first_line.is_some() || self.path.as_os_str().is_empty()
    }

    /// The line of the file on which a row stands; the row's number, counted from 1, where the file is not text.
    pub fn line_of(&self, row: usize) -> usize {
        let first = if self.is_text() { self.first_line.unwrap_or(2) } else { 1 };
        first + row
    }

    /// A mistake in a column on a row, told at its place in the file that has the column.
    pub(super) fn error_at(&self, row: usize, column: &str, problem: String, fix: &str) -> Error {
        let file = self.files.iter().find(|file| file.columns.iter().any(|name| name == column));
        let (path, first_line) = file.map_or((self.place(), self.first_line), |file| (&file.path, file.first_line));
        let channel = self.signals().into_iter().find(|(name, _)| name == column).map(|(_, channel)| channel);
        let rows_before = channel.map_or(row, |channel| (0..row).filter(|row| channel.is_due(*row)).count());
        let error = Error::input(path, problem, fix).in_column(column);
        first_line.map_or(error.clone(), |first| error.at_line(first + rows_before))
    }

    /// From the first row to the last (s).
    pub fn duration_s(&self) -> f64 {
        self.t_s.last().zip(self.t_s.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// Every signal that is there, under its column name in the contract, in the contract's order.
    pub fn signals(&self) -> Vec<(String, &Channel)> {
        self.signals_by_group().into_iter().flat_map(|(_, signals)| signals).collect()
    }

    /// The same by what they are of: `u`, `i`, `w`, `pose`, `wset`, `vbat`, `gyro`, `enable`.
    pub(super) fn signals_by_group(&self) -> [(&'static str, Vec<(String, &Channel)>); 8] {
        let pose = self.pose.iter().flat_map(|pose| POSE.iter().zip(&pose.channels));
        let one = |name: &str, channel| Option::iter(channel).map(|c| (name.to_string(), c)).collect();
        [
            ("u", per_wheel("u", "V", &self.u)),
            ("i", per_wheel("i", "A", &self.i)),
            ("w", per_wheel("w", "rad_s", &self.w)),
            ("pose", pose.map(|(n, c)| (n.to_string(), c)).collect()),
            ("wset", per_wheel("wset", "rad_s", &self.wset)),
            ("vbat", one(VBAT, &self.vbat)),
            ("gyro", one(GYRO, &self.gyro)),
            ("enable", one(ENABLE, &self.enable)),
        ]
    }

    /// The same recording with each channel, of which `f` gets the name in the contract, made anew; a group that lacks one
    /// is left out.
    pub fn with_channels(&self, mut f: impl FnMut(&str, &Channel) -> Option<Channel>) -> Run {
        let mut group = |names: &dyn Fn(usize) -> String, group: &Option<Group>| {
            let group = group.as_ref()?;
            let channels = group.channels.iter().enumerate().map(|(k, channel)| f(&names(k), channel));
            Some(Group { channels: channels.collect::<Option<_>>()?, ..*group })
        };
        let [u, i, w, wset] =
            [("u", "V", &self.u), ("i", "A", &self.i), ("w", "rad_s", &self.w), ("wset", "rad_s", &self.wset)]
                .map(|(stem, unit, of)| group(&|wheel| format!("{stem}{wheel}_{unit}"), of));
        let pose = group(&|axis| POSE[axis].to_owned(), &self.pose);
        let mut one = |name: &str, channel: &Option<Channel>| f(name, channel.as_ref()?);
        let (vbat, gyro) = (one(VBAT, &self.vbat), one(GYRO, &self.gyro));
        let enable = one(ENABLE, &self.enable);
        let (name, path, files, t_s) = (self.name.clone(), self.path.clone(), self.files.clone(), self.t_s.clone());
        let (first_line, currents_sampled) = (self.first_line, self.currents_sampled);
        Run { name, path, first_line, files, t_s, u, i, w, wset, pose, vbat, gyro, enable, currents_sampled }
    }

    /// A part of it as a run of its own, called after the time of its first row.
    ///
    /// # Panics
    /// Where it has no such rows.
    pub fn part(&self, rows: Range<usize>) -> Run {
        let mut part = self.with_channels(|_, channel| Some(rows.clone().map(|row| channel.get(row)).collect()));
        part.t_s = self.t_s[rows.clone()].to_vec();
        let since = part.t_s.first().zip(self.t_s.first()).map_or(0.0, |(first, start)| first - start);
        part.name = format!("{} from {since:.1} s", self.name);
        part.first_line = self.first_line.map(|line| line + rows.start);
        part
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
    use crate::log::Missing;

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
