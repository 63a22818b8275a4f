//! Where an effect shows: in which channels, when, which way round and how often in a turn, of two drives without it and
//! with it.
//!
//! The model is restarted from the truth every few milliseconds: what is told is what the effect does at once, and not what
//! it led to. All changes are in units of their sensors' noise.

use model_core::effects::card::{Card, Scope, Stage};
use model_core::effects::shows::{Channel, Parity, Regime};
use model_core::effects::{EffectKind, drivetrain};
use model_core::plant::Input;

use super::channels::{Channels, SignalGroup};
use super::commanded::commanded;
use super::effect_shown::{ONE_WHEEL, Part, noise_of, pair, played};
use super::excite::voltages;
use super::limits::usual_voltage;
use super::model::{EffectInstance, Model};
use super::regimes::{Driven, REGIMES};
use super::restarted::{Beside, RowBeside, TurnedRound};
use super::ripple_order::ripple_order;
use super::script::{along, final_speed};
use crate::log::RobotFile;

/// Where an effect shows, by drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhereShown {
    /// Share of each channel in the change, squared, in the order of [`Channel::ALL`].
    pub shares: [f64; Channel::ALL.len()],
    /// How well each regime explains when it changes, in the order of [`Regime::ALL`]: 1 is throughout.
    pub regimes: [f64; REGIMES],
    /// How the change in the channel with the largest share goes with that of the motion turned round: −1 changes its sign, 1
    /// keeps it.
    pub mirrored: f64,
    /// Periods in a turn of the wheel, of a ripple.
    pub order: Option<u32>,
}

/// A channel of a smaller share tells little of an effect: what only follows from another channel is below it.
const A_SHARE: f64 = 0.065;
/// Nearer than that to 1 or −1, the sign is kept or changed.
const A_SIGN: f64 = 0.8;

impl WhereShown {
    /// The channels in which it shows, most in the first.
    pub fn channels(&self) -> Vec<Channel> {
        let mut of: Vec<_> = Channel::ALL.into_iter().zip(self.shares).filter(|(_, share)| *share >= A_SHARE).collect();
        of.sort_by(|a, b| b.1.total_cmp(&a.1));
        of.into_iter().map(|(channel, _)| channel).collect()
    }

    /// The regime that explains best.
    pub fn regime(&self) -> Regime {
        let of = Regime::ALL.into_iter().zip(self.regimes);
        of.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(Regime::Always, |(regime, _)| regime)
    }

    /// What becomes of it when the motion turns round.
    pub fn parity(&self) -> Parity {
        match self.mirrored {
            x if x >= A_SIGN => Parity::Even,
            x if x <= -A_SIGN => Parity::Odd,
            _ => Parity::Neither,
        }
    }
}

const fn part(to: [f64; 3], ramp: f64, hold: f64) -> Part {
    Part { name: "", to, ramp_and_hold: (ramp, hold) }
}

/// What is driven: every axis alone, fast and slow, both ways and aslant, with ramps and rests; then turning while driving.
const DRIVE: [Part; 24] = [
    part([0.0; 3], 0.0, 0.1),
    part([1.0, 0.0, 0.0], 0.0, 0.5),
    part([-1.0, 0.0, 0.0], 0.0, 0.5),
    part([0.5, 0.0, 0.0], 0.3, 0.2),
    part([0.0; 3], 0.0, 0.3),
    part([0.0, 1.0, 0.0], 0.0, 0.5),
    part([0.0, 0.3, 0.0], 0.0, 0.3),
    part([0.0, -1.0, 0.0], 0.2, 0.4),
    part([0.0; 3], 0.0, 0.2),
    part([0.7, 0.7, 0.0], 0.0, 0.4),
    part([-0.7, 0.7, 0.0], 0.0, 0.5),
    part([0.0; 3], 0.0, 0.2),
    part([-0.22, -0.22, 0.0], 0.4, 0.4),
    part([0.22, 0.22, 0.0], 0.6, 0.2),
    part([0.0; 3], 0.0, 0.2),
    part([0.0, 0.0, 0.8], 0.0, 0.4),
    part([0.0, 0.0, -0.8], 0.0, 0.3),
    part([0.0, 0.0, -0.25], 0.0, 0.2),
    part([0.0; 3], 0.0, 0.2),
    part([0.7, 0.0, 0.6], 0.0, 0.5),
    part([0.3, 0.8, -0.5], 0.1, 0.5),
    part([-0.8, 0.3, 0.2], 0.0, 0.5),
    part([0.2, -0.4, 0.3], 0.2, 0.3),
    part([0.0; 3], 0.0, 0.2),
];

/// Rows a second [1/s]
const RATE: f64 = 500.0;
/// Length of a plant step [s], and steps in a row
const STEPS: (f64, usize) = (0.0005, 4);
/// Rows from one restart of the model to the next.
const RESTARTED: usize = 2;
/// Rows over which a size is compared with what marks a regime.
const INTERVAL: usize = 10;

/// The speed along the second axis at which ripples are looked for [m/s], for how long [s], and the time before [s]
const STEADY: (f64, f64, f64) = (0.3, 5.0, 0.5);
/// Step of that drive, which has one in a row [s]
const FINE: f64 = 0.000_25;

/// Drives the robot of a file without an effect and with it at its typical size, and tells where that shows.
pub fn where_shown(file: &RobotFile, card: &'static Card) -> WhereShown {
    match file.wheel.len() {
        3 => Compared::<3>::new(file, card).shown(),
        _ => Compared::<4>::new(file, card).shown(),
    }
}

/// The same robot without an effect and with it.
struct Compared<'a, const N: usize> {
    file: &'a RobotFile,
    card: &'static Card,
    models: [Model<N>; 2],
    voltage: f64,
}

impl<'a, const N: usize> Compared<'a, N> {
    fn new(file: &'a RobotFile, card: &'static Card) -> Self {
        let mut models = pair::<N>(file, card);
        // what makes a shaft yield is compared with a rigid one that turns the same rotor
        let rotor = drivetrain::rotor_inertia::CARD;
        let rotor = card.param("rotor_inertia_kg_m2").zip(EffectKind::find(rotor.id));
        if let Some((at, effect)) = rotor {
            let mut rigid = EffectInstance::typical(effect.card(), None);
            rigid.params[0] = card.params[at].typical;
            models.iter_mut().for_each(|model| _ = model.add_effect(rigid.clone()));
        }
        Self { file, card, models, voltage: usual_voltage(file) }
    }

    /// Both as plants.
    fn beside(&self, steps: (f64, usize), restarted: usize) -> Beside<N> {
        let [model, truth] = &self.models;
        Beside { model: model.plant(), truth: truth.plant(), steps, restarted }
    }

    /// What the robot gets for voltages [V]; a drive that controls speed, the speeds that they would come to.
    fn input(&self, volts: &[[f64; N]], sign: f64) -> Vec<Input<N, f64>> {
        let of = |u: &[f64; N]| commanded(self.file, self.card.of_speed_drive(), u.map(|u| sign * u));
        volts.iter().map(of).collect()
    }

    fn shown(&self) -> WhereShown {
        let volts = played(&DRIVE, |axes| voltages(&self.models[0].robot().wheels, axes, self.voltage));
        let beside = self.beside(STEPS, RESTARTED);
        let ahead = beside.drive(&self.input(&volts, 1.0), None);
        // a camera sees the places to which the motion leads; forces of the world are met at the same places
        let turned = TurnedRound { of: &ahead, same_places: self.card.stage() != Stage::Sensing };
        let back = beside.drive(&self.input(&volts, -1.0), Some(&turned));
        let shares = self.shares(&ahead);
        let most = (0..shares.len()).fold(0, |most, k| if shares[k] > shares[most] { k } else { most });
        let together = |a: &[RowBeside<N>], b: &[RowBeside<N>]| {
            let product = |k: usize| a.iter().zip(b).map(|(a, b)| a.change[k] * b.change[k]).sum::<f64>();
            self.channels(most).map(product).sum::<f64>()
        };
        let size = (together(&ahead, &ahead) * together(&back, &back)).sqrt();
        WhereShown {
            shares,
            regimes: self.regimes(&ahead, &volts, &shares),
            mirrored: together(&ahead, &back) / size,
            order: self.order(),
        }
    }

    /// The channels of a row that count as one of [`Channel::ALL`].
    fn channels(&self, as_one: usize) -> std::ops::Range<usize> {
        let channels = Channels { wheels: N };
        let pose = channels.of(SignalGroup::Pose);
        match Channel::ALL[as_one] {
            Channel::Current => channels.of(SignalGroup::Current),
            Channel::WheelSpeed => channels.of(SignalGroup::WheelSpeed),
            Channel::Position => pose.start..channels.heading(),
            Channel::Heading => channels.heading()..pose.end,
            Channel::YawRate => channels.of(SignalGroup::Gyro),
            Channel::BusVoltage => channels.of(SignalGroup::Battery),
        }
    }

    /// The change of a row in one of [`Channel::ALL`], squared, in units of the noise.
    fn squared(&self, row: &RowBeside<N>, as_one: usize) -> f64 {
        let noise = |k| noise_of(&self.file.sensors, Channels { wheels: N }, k);
        self.channels(as_one).map(|k| (row.change[k] / noise(k)).powi(2)).sum()
    }

    /// Shares of the channels.
    fn shares(&self, rows: &[RowBeside<N>]) -> [f64; Channel::ALL.len()] {
        let sums = std::array::from_fn(|k| rows.iter().map(|row| self.squared(row, k)).sum::<f64>());
        let all: f64 = sums.iter().sum();
        sums.map(|sum| sum / all)
    }

    /// How well regimes explain when it shows. What sits on wheels is looked at where they show it: a gyro tells of one axis.
    fn regimes(&self, rows: &[RowBeside<N>], volts: &[[f64; N]], shares: &[f64; Channel::ALL.len()]) -> [f64; REGIMES] {
        let gyro = Channel::ALL.iter().position(|channel| *channel == Channel::YawRate);
        let of_wheels = self.card.scope != Scope::Robot;
        let counts = |k: usize| shares[k] >= A_SHARE && (Some(k) != gyro || !of_wheels);
        let size = |row| (0..shares.len()).filter(|k| counts(*k)).map(|k| self.squared(row, k)).sum::<f64>().sqrt();
        let size: Vec<f64> = rows.iter().map(size).collect();
        let all: [usize; N] = std::array::from_fn(|j| j);
        let command: Vec<[f64; N]> = volts.iter().map(|u| u.map(|u| u / self.voltage)).collect();
        let sensors = &self.file.sensors;
        let driven = Driven {
            plant: &self.models[0].plant(),
            rows,
            command: &command,
            wheels: if self.card.scope == Scope::OneWheel { &[ONE_WHEEL] } else { &all },
            of_wheels,
            in_pose: Channel::ALL
                .iter()
                .zip(shares)
                .any(|(channel, share)| matches!(channel, Channel::Position | Channel::Heading) && *share >= A_SHARE),
            rate: (RATE, INTERVAL),
            pose_noise: [sensors.position_noise_m, sensors.heading_noise_rad],
        };
        driven.explain(&size)
    }

    /// How often it comes in a turn of its wheel.
    fn order(&self) -> Option<u32> {
        let (speed, seconds, before) = STEADY;
        let robot = self.models[0].robot();
        // v(V) rises evenly
        let [still, one] = [0.0, 1.0].map(|volts| final_speed(robot, 1, volts));
        let volts = along(&robot.wheels, 1, (speed - still) / (one - still));
        let rows = |seconds: f64| (seconds / FINE).round() as usize;
        let volts = vec![volts; rows(before + seconds)];
        let drive = self.beside((FINE, 1), RESTARTED).drive(&self.input(&volts, 1.0), None);
        ripple_order(&drive[rows(before)..], ONE_WHEEL, (FINE, RESTARTED))
    }
}
