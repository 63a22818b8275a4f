//! A recording, laid out row by row for the plant: what drives the model, and what it is compared with.

use model_core::number::scalar::Real;
use model_core::plant::Input;

use super::channels::{Channels, MAX_CHANNELS, Row, SignalGroup};
use super::open_circuit::open_circuit_voltage;
use super::row_passed::RowPassed;
use super::white_noise::white_sigma;
use crate::log::{Channel, Group, RobotFile, Run, Sampled};

/// The longest step that the plant takes [s]; longer rows are cut into equal ones.
pub(super) const LONGEST_STEP_S: f64 = 0.0026;

/// The most steps through one row: beyond half a minute without a row there is nothing to be told, and work must end.
const MOST_STEPS: usize = 10_000;

/// No gyro and no battery reading is believed to be better than this, whatever their log looks like [rad/s] [V]
const LEAST_GYRO_RAD_S: f64 = 1e-3;
const LEAST_BATTERY_V: f64 = 5e-3;

/// A quantum above this share of a signal's RMS is too coarse to drive a model with.
const COARSE: f64 = 0.05;

/// The signal that drives the model: the first of the chain that is there and good enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// A recording of a robot with `N` wheels, ready to be compared with a model.
#[derive(Clone, Debug)]
pub struct AlignedRun<const N: usize> {
    /// The run's name.
    pub name: String,
    /// Time of each row since the first [s]
    pub t: Vec<f64>,
    /// Length of each row's hold [s]; the last row's is the median
    pub dt: Vec<f64>,
    /// What drives the model.
    pub chain: Chain,
    /// The driving signal, row by row [V], [A] or [rad/s]; holes hold the last value
    pub input: Vec<[f64; N]>,
    /// Whether the bridges are open, row by row: then no current flows, whatever the driving signal says
    pub open: Vec<bool>,
    /// What was measured; only where [`AlignedRun::has`] says so
    pub measured: Vec<Row>,
    /// Bit c: channel c was measured on this row
    pub has: Vec<u16>,
    /// One-sigma noise of each channel, by the robot file
    pub sigma: Row,
    /// How long the noise of each channel remembers itself [s], as an Ornstein–Uhlenbeck process; zero is white
    pub correlation_time: Row,
    /// True if the currents are magnitudes.
    pub unsigned_current: bool,
    /// Largest voltage seen [V]; zero where none is logged
    pub largest_voltage: f64,
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

fn signals_of(group: &Option<Group>) -> &[Channel] {
    group.as_ref().map_or(&[], |group| &group.channels)
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
        // what a simulator gets is the command; a measurement drives only where there is none
        let good = |group: &Option<Group>| group.as_ref().is_some_and(good_enough);
        let (chain, driving) = if good(&run.u) {
            (Chain::Voltage, run.u.as_ref()?)
        } else if good(&run.wset) {
            (Chain::SetSpeed, run.wset.as_ref()?)
        } else if good(&run.i) {
            (Chain::Current, run.i.as_ref()?)
        } else if good(&run.w) {
            (Chain::WheelSpeed, run.w.as_ref()?)
        } else {
            (Chain::SetSpeed, run.wset.as_ref()?)
        };
        let rows = run.rows();
        let battery = run.vbat.as_ref().map(|vbat| {
            let unloaded = open_circuit_voltage(run, vbat);
            vbat.map(|_, volts| volts - unloaded)
        });
        let step = run.median_step_s();
        let start = *run.t_s.first()?;
        let t: Vec<f64> = run.t_s.iter().map(|t| t - start).collect();
        let dt = (0..rows).map(|k| t.get(k + 1).map_or(step, |next| next - t[k])).collect();

        let mut input = vec![[0.0; N]; rows];
        for (j, channel) in driving.channels.iter().enumerate().take(N) {
            let mut held = 0.0;
            for (row, value) in input.iter_mut().enumerate() {
                held = channel.get(row).unwrap_or(held);
                value[j] = held;
            }
        }
        if chain == Chain::WheelSpeed {
            // a measured speed changes evenly between its rows: hold the middle
            for k in 0..rows.saturating_sub(1) {
                input[k] = std::array::from_fn(|j| 0.5 * (input[k][j] + input[k + 1][j]));
            }
        }

        let channels = Self::channels();
        let mut measured = vec![[0.0; MAX_CHANNELS]; rows];
        let mut has = vec![0_u16; rows];
        let mut put = |of: SignalGroup, signals: &[Channel], shift: usize| {
            for (c, channel) in channels.of(of).zip(signals) {
                for (row, value) in channel.present().filter(|(row, _)| *row >= shift) {
                    measured[row - shift][c] = value;
                    has[row - shift] |= 1 << c;
                }
            }
        };
        // a current sampled before its row's voltage answers to the voltage of the row above
        let shift = usize::from(run.currents_sampled == Sampled::Before);
        // a model driven by speeds says nothing of the currents, one driven by currents nothing of the battery
        if chain == Chain::Voltage {
            put(SignalGroup::Current, signals_of(&run.i), shift);
            put(SignalGroup::Battery, battery.as_slice(), shift);
        }
        if chain != Chain::WheelSpeed {
            put(SignalGroup::WheelSpeed, signals_of(&run.w), 0);
        }
        put(SignalGroup::Pose, signals_of(&run.pose), 0);
        put(SignalGroup::Gyro, run.gyro.as_slice(), 0);

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

        let largest_voltage = run
            .u
            .iter()
            .flat_map(|g| &g.channels)
            .flat_map(|c| c.present())
            .chain(run.vbat.iter().flat_map(|c| c.present()))
            .fold(0.0, |most: f64, (_, u)| most.max(u.abs()));
        Some(Self {
            name: run.name.clone(),
            t,
            dt,
            chain,
            input,
            open: (0..rows).map(|row| run.is_open(row)).collect(),
            measured,
            has,
            sigma,
            correlation_time: [0.0; MAX_CHANNELS],
            unsigned_current: run.i.as_ref().is_some_and(|g| g.unsigned),
            largest_voltage,
        })
    }

    /// The run cut into `parts` of equal length.
    pub fn cut(&self, parts: usize) -> Vec<Self> {
        let rows = self.rows();
        (0..parts)
            .map(|k| (k * rows / parts, (k + 1) * rows / parts))
            .filter(|(first, end)| end > first)
            .map(|(first, end)| Self {
                name: format!("{} (rows {first} to {})", self.name, end - 1),
                t: self.t[first..end].iter().map(|t| t - self.t[first]).collect(),
                dt: self.dt[first..end].to_vec(),
                input: self.input[first..end].to_vec(),
                open: self.open[first..end].to_vec(),
                measured: self.measured[first..end].to_vec(),
                has: self.has[first..end].to_vec(),
                ..self.without_rows()
            })
            .collect()
    }

    fn without_rows(&self) -> Self {
        Self {
            name: String::new(),
            t: Vec::new(),
            dt: Vec::new(),
            input: Vec::new(),
            open: Vec::new(),
            measured: Vec::new(),
            has: Vec::new(),
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

    /// True if any row has a channel of the group.
    pub fn has_group(&self, group: SignalGroup) -> bool {
        let mask = Self::channels().of(group).fold(0_u16, |mask, channel| mask | 1 << channel);
        self.has.iter().any(|has| has & mask != 0)
    }

    /// The input of a row, in any number type.
    #[inline]
    pub fn input<T: Real>(&self, row: usize) -> Input<N, T> {
        let held = self.input[row].map(T::lit);
        match self.chain {
            Chain::Voltage | Chain::Current if self.open[row] => Input::Current([T::zero(); N]),
            Chain::Voltage => Input::Voltage(held),
            Chain::Current => Input::Current(held),
            Chain::WheelSpeed | Chain::SetSpeed => Input::Speed(held),
        }
    }

    /// In how many equal steps the plant takes a row.
    #[inline]
    pub fn steps(&self, row: usize) -> usize {
        ((self.dt[row] / LONGEST_STEP_S).ceil() as usize).clamp(1, MOST_STEPS)
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
        let mut error = self.measured[row][channel] - predicted;
        if channel == Self::channels().heading() {
            error -= std::f64::consts::TAU * (error / std::f64::consts::TAU).round();
        }
        error / self.sigma[channel]
    }
}
