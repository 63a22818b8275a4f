//! # The signal that drives: what a model of the robot is given, and whose clock windows follow

use super::channel::Channel;
use super::median_step::median_step;
use super::run::{Group, Run, RunFile};
use std::ops::Range;

/// A quantum above this share of a signal's RMS is too coarse to drive a model with.
const COARSE: f64 = 0.05;

/// The signal that drives a model: the first of the chain that is there and good enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, schemars::JsonSchema, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Chain {
    /// Commanded voltages.
    Voltage,
    /// Measured currents.
    Current,
    /// Measured wheel speeds.
    WheelSpeed,
    /// Commanded wheel speeds.
    SetSpeed,
}

impl Chain {
    /// The signal as it is said.
    pub const fn said(self) -> &'static str {
        match self {
            Self::Voltage => "the commanded voltages",
            Self::Current => "the measured currents",
            Self::WheelSpeed => "the measured wheel speeds",
            Self::SetSpeed => "the commanded wheel speeds",
        }
    }
}

fn good_enough(group: &Group) -> bool {
    if group.unsigned {
        return false;
    }
    let Some(quantum) = group.quantum else { return true };
    let (mut sum, mut n) = (0.0, 0.0);
    for channel in &group.channels {
        for (_, x) in channel.present() {
            sum += x * x;
            n += 1.0;
        }
    }
    n > 0.0 && quantum <= COARSE * f64::sqrt(sum / n)
}

impl Run {
    /// What drives a model; none where nothing in the run can.
    pub fn driving(&self) -> Option<(Chain, &Group)> {
        // what a simulator gets is the command; a measurement drives only where there is none
        let chain = [
            (Chain::Voltage, &self.u),
            (Chain::SetSpeed, &self.wset),
            (Chain::Current, &self.i),
            (Chain::WheelSpeed, &self.w),
        ];
        let mut there = chain.into_iter().filter_map(|(chain, group)| Some((chain, group.as_ref()?)));
        let good = there.find(|(_, group)| good_enough(group));
        good.or(self.wset.as_ref().map(|group| (Chain::SetSpeed, group)))
    }

    /// The file that has the signal that drives, of a run of several; the first, where nothing drives.
    pub fn driving_file(&self) -> Option<&RunFile> {
        let driving = self.driving().and_then(|(_, group)| group.channels.first());
        let drives = |channel: &Channel| driving.is_some_and(|driving| std::ptr::eq(driving, channel));
        let name = self.signals().into_iter().find(|(_, channel)| drives(channel)).map(|(name, _)| name);
        let has = |file: &&RunFile| name.as_ref().is_some_and(|name| file.columns.contains(name));
        self.files.iter().find(has).or(self.files.first())
    }

    /// The rows on the clock of the signal that drives: all of them where there is one clock, or where nothing drives.
    pub fn driving_rows(&self) -> Vec<usize> {
        let channel = self.driving().filter(|_| !self.files.is_empty()).and_then(|(_, group)| group.channels.first());
        (0..self.rows()).filter(|row| channel.is_none_or(|channel| channel.is_due(*row))).collect()
    }

    /// Whether a channel has its samples on the rows of the signal that drives.
    pub fn is_on_driving_clock(&self, channel: &Channel) -> bool {
        let first = self.driving().filter(|_| !self.files.is_empty()).and_then(|(_, group)| group.channels.first());
        first.is_none_or(|first| (0..self.rows()).all(|row| first.is_due(row) == channel.is_due(row)))
    }

    /// The middle one of the row lengths (s), on the clock of the signal that drives; zero for fewer than two rows.
    pub fn median_step_s(&self) -> f64 {
        median_step(self.driving_rows().iter().map(|row| self.t_s[*row])).unwrap_or_default()
    }

    /// The rows from the first on which something drives to the last before its last hold ends.
    pub fn driven_span(&self) -> Range<usize> {
        let rows = self.driving_rows();
        let Some((first, last)) = rows.first().zip(rows.last()).filter(|_| !self.files.is_empty()) else {
            return 0..self.rows();
        };
        let ends_s = self.t_s[*last] + self.median_step_s();
        *first..self.t_s.partition_point(|t| *t < ends_s).max(last + 1)
    }
}
