//! A recording, laid out row by row for the plant: what drives the model, and what it is compared with.
//!
//! A row is an instant at which something was commanded or measured. The input is held from one row of the driving signal
//! to the next, and the plant stops at every instant between: a measurement is compared at its own time.

use std::f64::consts::TAU;
use std::ops::Range;

use model_core::effects::telegram::Telegram;
use model_core::number::scalar::Real;
use model_core::plant::Input;

use super::channels::{Channels, MAX_CHANNELS, Row, SignalGroup};
use super::losses::Losses;
use super::lost_rows::LostRows;
use super::model::robot_of;
use super::open_circuit::open_circuit_voltage;
use super::row_passed::RowPassed;
use super::step_lengths::{RimSpeed, steps_of_rows};
use super::white_noise::white_sigma;
use crate::log::{Chain, Channel, Group, RobotFile, Run, Sampled};

/// No gyro and no battery reading is believed to be better than this, whatever their log looks like [rad/s] [V]
const LEAST_GYRO_RAD_S: f64 = 1e-3;
const LEAST_BATTERY_V: f64 = 5e-3;

/// Parts of a step that are rounding [1]
const ROUNDED: f64 = 1e-6;

/// A recording of a robot with `N` wheels, ready to be compared with a model.
#[derive(Clone, Debug)]
pub struct AlignedRun<const N: usize> {
    /// The run's name.
    pub name: String,
    /// Time of each row since the first [s]
    pub t: Vec<f64>,
    /// Time from each row to the next [s]; the last row's is what is left of its hold, whose length is the median
    pub dt: Vec<f64>,
    /// In how many equal steps the plant takes each row
    pub steps: Vec<u16>,
    /// How many times as many it takes: more than one where a law's own number is to be known as well as the noise allows
    pub finer: u16,
    /// What drives the model.
    pub chain: Chain,
    /// The driving signal, row by row [V], [A] or [rad/s]; holes hold the last value
    pub input: Vec<[f64; N]>,
    /// Whether the row is one of the driving signal's clock; on others something was measured by another clock
    pub driven: Vec<bool>,
    /// The rows at which the driving signal is known again after rows that were lost, in which it changed: free runs begin anew
    pub resumes: Vec<usize>,
    /// Whether each wheel's bridge is open, row by row: then no current flows, whatever the driving signal says
    pub open: Vec<[bool; N]>,
    /// What was measured; only where [`AlignedRun::has`] says so
    pub measured: Vec<Row>,
    /// Bit c: channel c was measured on this row
    pub has: Vec<u16>,
    /// By how much each wheel has turned before each row, by its measured speed [rad]; empty where none is logged
    pub turned: Vec<[f64; N]>,
    /// How the telegrams with the driving signal fared
    pub losses: Losses<N>,
    /// One-sigma noise of each channel by the robot file: the unit in which gaps are told
    pub stated: Row,
    /// One-sigma noise of each channel that models are weighed by: what is stated, or what the recordings show
    pub sigma: Row,
    /// How long the noise of each channel remembers itself [s], as an Ornstein–Uhlenbeck process; zero is white
    pub correlation_time: Row,
    /// True if the currents are magnitudes.
    pub unsigned_current: bool,
    /// Largest voltage seen [V]; zero where none is logged
    pub largest_voltage: f64,
}

fn signals_of(group: &Option<Group>) -> &[Channel] {
    group.as_ref().map_or(&[], |group| &group.channels)
}

/// A channel row by row; holes hold the last value, zero before the first.
fn filled(channel: &Channel, mut rows: Range<usize>) -> impl Iterator<Item = f64> {
    let mut last = 0.0;
    std::iter::from_fn(move || {
        last = channel.get(rows.next()?).unwrap_or(last);
        Some(last)
    })
}

/// By how much wheels have turned before each row [rad], their speeds in between straight lines; empty without speeds.
fn turned<const N: usize>(speeds: &[Channel], rows: Range<usize>, dt: &[f64]) -> Vec<[f64; N]> {
    if speeds.is_empty() {
        return Vec::new();
    }
    let mut turned = vec![[0.0; N]; rows.len()];
    for (j, speed) in speeds.iter().enumerate().take(N) {
        let speed: Vec<f64> = filled(speed, rows.clone()).collect();
        for k in 1..rows.len() {
            turned[k][j] = turned[k - 1][j] + 0.5 * (speed[k - 1] + speed[k]) * dt[k - 1];
        }
    }
    turned
}

/// The bus voltage to take where the robot file states none: the largest that these runs show, one where they show none
/// [V]
pub fn supply_seen<'a, const N: usize>(runs: impl IntoIterator<Item = &'a AlignedRun<N>>) -> f64 {
    let largest = runs.into_iter().map(|run| run.largest_voltage).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

impl<const N: usize> AlignedRun<N> {
    /// Lays a run out; `None` where nothing in it can drive a model.
    pub fn new(run: &Run, robot: &RobotFile) -> Option<Self> {
        let (chain, driving) = run.driving()?;
        let span = run.driven_span();
        let rows = span.len();
        let battery = run.vbat.as_ref().map(|vbat| {
            let unloaded = open_circuit_voltage(run, vbat);
            vbat.map(|_, volts| volts - unloaded)
        });
        let step = run.median_step_s();
        let start = *run.t_s.get(span.start)?;
        let t: Vec<f64> = run.t_s[span.clone()].iter().map(|t| t - start).collect();
        let mut driven = vec![false; rows];
        let driving_rows: Vec<usize> = run.driving_rows().into_iter().map(|row| row - span.start).collect();
        driving_rows.iter().for_each(|row| driven[*row] = true);
        let last_hold = driving_rows.last().zip(t.last()).map_or(step, |(row, last)| step - (last - t[*row]));
        let dt: Vec<f64> = (0..rows).map(|k| t.get(k + 1).map_or(last_hold, |next| next - t[k])).collect();

        let mut input = vec![[0.0; N]; rows];
        for (j, channel) in driving.channels.iter().enumerate().take(N) {
            input.iter_mut().zip(filled(channel, span.clone())).for_each(|(value, held)| value[j] = held);
        }
        if chain == Chain::WheelSpeed {
            // a measured speed changes evenly between its rows: hold the middle
            for pair in driving_rows.windows(2) {
                let middle = std::array::from_fn(|j| 0.5 * (input[pair[0]][j] + input[pair[1]][j]));
                input[pair[0]..pair[1]].fill(middle);
            }
        }

        let open: Vec<[bool; N]> = run.open_bridges()[span.clone()].to_vec();
        let told = |row: &usize| {
            let mut wheels = driving.channels.iter().zip(open[*row]);
            wheels.all(|(channel, open)| open || channel.get(row + span.start).is_ok())
        };
        let commanded: Vec<usize> = driving_rows.iter().copied().filter(told).collect();
        let lost = match chain {
            Chain::WheelSpeed => LostRows::default(),
            Chain::Voltage | Chain::Current | Chain::SetSpeed => LostRows::of(&t, &commanded, &input),
        };

        let channels = Self::channels();
        let mut measured = vec![[0.0; MAX_CHANNELS]; rows];
        let mut has = vec![0_u16; rows];
        let mut put = |of: SignalGroup, signals: &[Channel], at: &dyn Fn(usize) -> Option<usize>| {
            for (c, channel) in channels.of(of).zip(signals) {
                for (row, value) in channel.present().filter(|(row, _)| span.contains(row)) {
                    let Some(row) = at(row - span.start) else { continue };
                    measured[row][c] = value;
                    has[row] |= 1 << c;
                }
            }
        };
        let here = |row: usize| Some(row);
        // a current sampled before its row's voltage answers to the voltage of the row above
        let row_above = |row: usize| driving_rows[..driving_rows.partition_point(|k| *k < row)].last().copied();
        let late = run.currents_sampled == Sampled::Before;
        let answered = |channel: Option<&Channel>| -> &dyn Fn(usize) -> Option<usize> {
            if late && channel.is_some_and(|channel| run.is_on_driving_clock(channel)) { &row_above } else { &here }
        };
        // a model driven by speeds says nothing of the currents, one driven by currents nothing of the battery
        if chain == Chain::Voltage {
            put(SignalGroup::Current, signals_of(&run.i), answered(signals_of(&run.i).first()));
            put(SignalGroup::Battery, battery.as_slice(), answered(run.vbat.as_ref()));
        }
        if chain != Chain::WheelSpeed {
            put(SignalGroup::WheelSpeed, signals_of(&run.w), &here);
        }
        put(SignalGroup::Pose, signals_of(&run.pose), &here);
        put(SignalGroup::Gyro, run.gyro.as_slice(), &here);
        lost.unknown.iter().for_each(|rows| has[rows.clone()].fill(0));

        // quantisation adds its own variance, q²/12
        let noisy = |sigma: f64, group: &Option<Group>| {
            let quantum = group.as_ref().and_then(|g| g.quantum).unwrap_or(0.0);
            (sigma * sigma + quantum * quantum / 12.0).sqrt()
        };
        let sensors = &robot.sensors;
        let mut sigma = [1.0; MAX_CHANNELS];
        sigma[channels.of(SignalGroup::Current)].fill(noisy(sensors.current_noise_a, &run.i));
        sigma[channels.of(SignalGroup::WheelSpeed)].fill(noisy(sensors.wheel_speed_noise_rad_s, &run.w));
        let [x, y, heading] = channels.pose();
        (sigma[x], sigma[y], sigma[heading]) =
            (sensors.position_noise_m, sensors.position_noise_m, sensors.heading_noise_rad);
        let stated_or_seen = |stated: Option<f64>, channel: &Option<Channel>, least: f64| {
            stated.or(channel.as_ref().and_then(white_sigma)).unwrap_or(1.0).max(least)
        };
        sigma[channels.gyro()] = stated_or_seen(sensors.gyro_noise_rad_s, &run.gyro, LEAST_GYRO_RAD_S);
        sigma[channels.battery()] = stated_or_seen(sensors.battery_noise_v, &run.vbat, LEAST_BATTERY_V);

        let rims: Vec<RimSpeed> = signals_of(&run.w)
            .iter()
            .zip(&robot.wheel)
            .map(|(speed, wheel)| RimSpeed {
                values: filled(speed, span.clone()).map(|speed| speed * wheel.radius_m).collect(),
                noise: sigma[channels.wheel_speed(0)] * wheel.radius_m,
            })
            .collect();
        let largest_voltage = run
            .u
            .iter()
            .flat_map(|g| &g.channels)
            .flat_map(|c| c.present())
            .chain(run.vbat.iter().flat_map(|c| c.present()))
            .fold(0.0, |most: f64, (_, u)| most.max(u.abs()));
        let turned = turned(signals_of(&run.w), span.clone(), &dt);
        Some(Self {
            name: run.name.clone(),
            steps: steps_of_rows(&robot_of::<N, f64>(robot, 1.0), &rims, &t, &dt),
            finer: 1,
            t,
            dt,
            chain,
            input,
            resumes: lost.resumes,
            open,
            driven,
            measured,
            has,
            turned,
            losses: Losses::default(),
            stated: sigma,
            sigma,
            correlation_time: [0.0; MAX_CHANNELS],
            unsigned_current: run.i.as_ref().is_some_and(|g| g.unsigned),
            largest_voltage,
        })
    }

    /// Some of its rows as a run of its own, with its time from their first.
    pub(super) fn part(&self, rows: Range<usize>) -> Self {
        Self {
            name: format!("{} (rows {} to {})", self.name, rows.start, rows.end - 1),
            t: self.t[rows.clone()].iter().map(|t| t - self.t[rows.start]).collect(),
            dt: self.dt[rows.clone()].to_vec(),
            steps: self.steps[rows.clone()].to_vec(),
            input: self.input[rows.clone()].to_vec(),
            open: self.open[rows.clone()].to_vec(),
            driven: self.driven[rows.clone()].to_vec(),
            resumes: self.resumes.iter().filter(|row| rows.contains(row)).map(|row| row - rows.start).collect(),
            measured: self.measured[rows.clone()].to_vec(),
            has: self.has[rows.clone()].to_vec(),
            turned: self.turned.get(rows.clone()).unwrap_or_default().to_vec(),
            losses: self.losses.part(rows),
            ..self.without_rows()
        }
    }

    fn without_rows(&self) -> Self {
        Self {
            name: String::new(),
            t: Vec::new(),
            dt: Vec::new(),
            steps: Vec::new(),
            input: Vec::new(),
            open: Vec::new(),
            driven: Vec::new(),
            resumes: Vec::new(),
            measured: Vec::new(),
            has: Vec::new(),
            turned: Vec::new(),
            losses: Losses::default(),
            ..*self
        }
    }

    /// The channels' order.
    pub const fn channels() -> Channels {
        Channels { wheels: N }
    }

    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.t.len()
    }

    /// True if the channel was measured on this row.
    #[inline]
    pub fn saw(&self, row: usize, channel: usize) -> bool {
        self.has[row] & (1 << channel) != 0
    }

    /// By how much each wheel has turned before a row [rad]; none where no wheel speed is logged.
    #[inline]
    pub fn turned(&self, row: usize) -> Option<[f64; N]> {
        self.turned.get(row).copied()
    }

    /// The telegram that was sent on a row; none where nothing new was.
    #[inline]
    pub fn telegram(&self, row: usize) -> Option<Telegram<N>> {
        self.driven[row].then(|| self.losses.telegram(row))
    }

    /// True if any row has a channel of the group.
    pub fn has_group(&self, group: SignalGroup) -> bool {
        let mask = Self::channels().mask(group);
        self.has.iter().any(|has| has & mask != 0)
    }

    /// The input of a row, in any number type.
    #[inline]
    pub fn input<T: Real>(&self, row: usize) -> Input<N, T> {
        let mut held = self.input[row].map(T::lit);
        let open = &self.open[row];
        match self.chain {
            Chain::Voltage if *open == [false; N] => Input::Voltage(held),
            Chain::Voltage => Input::Bridges(std::array::from_fn(|j| (!open[j]).then_some(held[j]))),
            Chain::Current => {
                held.iter_mut().zip(open).filter(|(_, open)| **open).for_each(|(i, _)| *i = T::zero());
                Input::Current(held)
            }
            Chain::WheelSpeed => Input::Speed(held),
            Chain::SetSpeed => Input::SetSpeed(held),
        }
    }

    /// In how many equal steps a plant takes a row that asks for none longer than this [s].
    #[inline]
    pub fn steps_within(&self, row: usize, longest_s: f64) -> usize {
        // a row that lasts as long as so many longest steps is not taken in one more
        let asked = (self.dt[row] / longest_s - ROUNDED).ceil() as usize;
        usize::from(self.finer) * asked.max(self.steps[row].into())
    }

    /// What a plant says on a row as a row of channels, currents as magnitudes where the log keeps only those.
    #[inline]
    pub fn row_of<T: Real>(&self, passed: &RowPassed<N, T>) -> [T; MAX_CHANNELS] {
        let channels = const { Channels { wheels: N } };
        let reading = &passed.reading;
        let mut row = [T::zero(); MAX_CHANNELS];
        for j in 0..N {
            row[channels.current(j)] =
                if self.unsigned_current { reading.current[j].abs() } else { reading.current[j] };
            row[channels.wheel_speed(j)] = reading.wheel_speed[j];
        }
        let [x, y, heading] = channels.pose();
        (row[x], row[y], row[heading]) = (reading.pose.x, reading.pose.y, reading.pose.theta);
        row[channels.gyro()] = reading.gyro;
        row[channels.battery()] = passed.load_drop;
        row
    }

    /// Measured minus predicted in units of sigma; headings modulo a turn.
    #[inline]
    pub fn error(&self, row: usize, channel: usize, predicted: f64) -> f64 {
        let error = self.measured[row][channel] - predicted;
        let error = if channel == Self::channels().heading() { within_half_turn(error) } else { error };
        error / self.sigma[channel]
    }
}

/// An angle less the whole turns in it, between half a turn back and half a turn on [rad]
#[inline]
pub fn within_half_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
