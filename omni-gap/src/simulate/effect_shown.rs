//! What an effect does to a run: the same short drive of a robot without it and with it, by sensors without noise.
//!
//! The drive has what effects show in: steps, a long turn while driving, a reversal, rests, creeping to and fro, and all
//! axes at once.

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Scope};
use model_core::plant::Input;

use super::channels::{Channels, SignalGroup};
use super::commanded::commanded;
use super::excite::voltages;
use super::limits::usual_voltage;
use super::model::{EffectInstance, Model};
use super::record::{BATTERY_NOISE_V, GYRO_NOISE_RAD_S, SensorSetup, record};
use crate::log::{Channel, RobotFile, Run, SensorsFile};

/// The same drive of a robot without an effect and with it.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectShown {
    /// The robot's name.
    pub robot: String,
    /// Its wheels.
    pub wheels: usize,
    /// The effect, at its typical size.
    pub effect: EffectInstance,
    /// Time of every row [s]
    pub t_s: Vec<f64>,
    /// What the robot does, part by part, and until when [s]
    pub parts: Vec<(&'static str, f64)>,
    /// What the sensors say, in the order of the channels.
    pub signals: Vec<ShownSignal>,
}

/// One channel of both drives, in its SI unit.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownSignal {
    /// Its place among [`Channels`].
    pub channel: usize,
    /// Noise of its sensor: what the robot file states, or what a recording is made with where it states none.
    pub noise: f64,
    /// One value a row, without the effect.
    pub without: Vec<f64>,
    /// One value a row, with it.
    pub with: Vec<f64>,
}

impl ShownSignal {
    /// What the effect adds, row by row.
    pub fn change(&self) -> impl Iterator<Item = f64> {
        self.with.iter().zip(&self.without).map(|(with, without)| with - without)
    }

    /// The largest change; infinite where one is not finite.
    pub fn largest_change(&self) -> f64 {
        largest(self.change())
    }

    /// The same in units of the sensor's noise.
    pub fn in_noise(&self) -> f64 {
        self.largest_change() / self.noise
    }
}

impl EffectShown {
    /// The channel in which the effect shows most, in units of its noise.
    pub fn most(&self) -> &ShownSignal {
        let more = |a: &&ShownSignal, b: &&ShownSignal| a.in_noise().total_cmp(&b.in_noise());
        self.signals.iter().max_by(more).expect("a pose is always read")
    }
}

/// The largest of these by amount; infinite where one is not finite.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, |most, x| if x.is_finite() { f64::max(most, x) } else { f64::INFINITY })
}

/// A part of the drive.
pub(super) struct Part {
    /// What the robot does in it.
    pub name: &'static str,
    /// How much is asked of v, vn and ω, each within ±1.
    pub to: [f64; 3],
    /// How long it takes to get from the part before to that, and how long that is held [s]
    pub ramp_and_hold: (f64, f64),
}

/// What is driven.
const DRIVE: [Part; 9] = [
    Part { name: "rest", to: [0.0; 3], ramp_and_hold: (0.0, 0.2) },
    Part { name: "ahead", to: [1.0, 0.0, 0.0], ramp_and_hold: (0.0, 0.6) },
    Part { name: "and turning", to: [0.7, 0.0, 0.6], ramp_and_hold: (0.0, 0.9) },
    Part { name: "back", to: [-1.0, 0.0, 0.0], ramp_and_hold: (0.0, 0.5) },
    Part { name: "rest", to: [0.0; 3], ramp_and_hold: (0.0, 0.4) },
    Part { name: "creeping", to: [0.2, 0.0, 0.08], ramp_and_hold: (0.0, 0.7) },
    Part { name: "and back", to: [-0.2, 0.0, -0.08], ramp_and_hold: (0.4, 0.3) },
    Part { name: "all axes", to: [0.4, 0.8, -0.5], ramp_and_hold: (0.1, 0.5) },
    Part { name: "rest", to: [0.0; 3], ramp_and_hold: (0.0, 0.4) },
];

/// Rows a second [1/s], and plant steps in each.
const RATE: f64 = 500.0;
const STEPS_A_ROW: usize = 4;
/// More frames a second than there are rows, so that every row gets one [1/s]
const EVERY_ROW: f64 = 1e8;
/// The wheel of an effect that sits on one wheel alone.
pub(super) const ONE_WHEEL: usize = 0;

/// Drives the robot of a file without an effect and with it at its typical size. Effects of drives that control wheel
/// speed are driven by speeds that are set, and say nothing of currents; all others by voltages. What shows beside another
/// effect alone has that one in both drives.
pub fn effect_shown(file: &RobotFile, card: &'static Card) -> EffectShown {
    match file.wheel.len() {
        3 => shown::<3>(file, card),
        _ => shown::<4>(file, card),
    }
}

/// An effect at its typical size, where it sits on a robot that is to show it.
fn typical(card: &'static Card) -> EffectInstance {
    EffectInstance::typical(card, (card.scope == Scope::OneWheel).then_some(ONE_WHEEL))
}

/// The robot of a file without an effect and with it.
pub(super) fn pair<const N: usize>(file: &RobotFile, card: &'static Card) -> [Model<N>; 2] {
    let voltage = usual_voltage(file);
    let effect = typical(card);
    // what both drives have: what the file names, and the effect beside which alone this one shows
    let mut without = Model::<N>::nominal(file, voltage);
    without.effects.retain(|there| there.id != effect.id);
    let beside = card.physics.shows_beside.filter(|id| without.effects.iter().all(|there| there.id != *id));
    if let Some(beside) = beside.and_then(EffectKind::find) {
        without.add_effect(typical(beside.card()));
    }
    let mut with = without.clone();
    with.add_effect(effect);
    [without, with]
}

fn shown<const N: usize>(file: &RobotFile, card: &'static Card) -> EffectShown {
    let voltage = usual_voltage(file);
    let [without, with] = pair::<N>(file, card);

    let volts = played(&DRIVE, |axes| voltages(&without.robot().wheels, axes, voltage));
    let input: Vec<Input<N, f64>> = volts.into_iter().map(|u| commanded(file, card.of_speed_drive(), u)).collect();
    let t_s: Vec<f64> = (0..input.len()).map(|row| row as f64 / RATE).collect();
    let how = SensorSetup {
        steps_a_row: STEPS_A_ROW,
        camera_rate: EVERY_ROW,
        dropouts: 0.0,
        sensors: SensorsFile::SILENT,
        gyro: true,
        battery: true,
        ..SensorSetup::default()
    };
    let [without, with] = [without, with].map(|model| record(&model.plant(), card.id, &t_s, &input, &how, 0));
    let channels = Channels { wheels: N };
    let signal = |channel: usize| {
        let [without, with] = [&without, &with].map(|run| Some(values(channel_of(run, channels, channel)?)));
        let noise = noise_of(&file.sensors, channels, channel);
        Some(ShownSignal { channel, noise, without: without?, with: with? })
    };
    let signals = (0..channels.count()).filter_map(signal).collect();
    EffectShown { robot: file.name.clone(), wheels: N, effect: typical(card), parts: parts(), t_s, signals }
}

/// The drive row by row, of what `of` makes of its three axes.
pub(super) fn played<T>(drive: &[Part], of: impl Fn([f64; 3]) -> T) -> Vec<T> {
    let mut from = [0.0; 3];
    let mut script = Vec::new();
    for Part { to, ramp_and_hold: (ramp, hold), .. } in drive {
        let ramp = in_rows(*ramp);
        for k in 1..=ramp + in_rows(*hold) {
            let share = if k < ramp { k as f64 / ramp as f64 } else { 1.0 };
            script.push(of(std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]))));
        }
        from = *to;
    }
    script
}

fn in_rows(seconds: f64) -> usize {
    (seconds * RATE).round() as usize
}

/// The parts of the drive, and when they end [s].
fn parts() -> Vec<(&'static str, f64)> {
    let ends = DRIVE.iter().scan(0, |rows, part| {
        *rows += in_rows(part.ramp_and_hold.0) + in_rows(part.ramp_and_hold.1);
        Some((part.name, *rows as f64 / RATE))
    });
    ends.collect()
}

/// What was recorded in a channel.
fn channel_of(run: &Run, channels: Channels, channel: usize) -> Option<&Channel> {
    let group = channels.group(channel);
    let at = channel - channels.of(group).start;
    match group {
        SignalGroup::Current => run.i.as_ref()?.channels.get(at),
        SignalGroup::WheelSpeed => run.w.as_ref()?.channels.get(at),
        SignalGroup::Pose => run.pose.as_ref()?.channels.get(at),
        SignalGroup::Gyro => run.gyro.as_ref(),
        SignalGroup::Battery => run.vbat.as_ref(),
    }
}

/// All values of a channel that misses none.
fn values(channel: &Channel) -> Vec<f64> {
    channel.iter().map(|x| x.unwrap_or(f64::NAN)).collect()
}

pub(super) fn noise_of(sensors: &SensorsFile, channels: Channels, channel: usize) -> f64 {
    match channels.group(channel) {
        SignalGroup::Current => sensors.current_noise_a,
        SignalGroup::WheelSpeed => sensors.wheel_speed_noise_rad_s,
        SignalGroup::Pose if channel == channels.heading() => sensors.heading_noise_rad,
        SignalGroup::Pose => sensors.position_noise_m,
        SignalGroup::Gyro => sensors.gyro_noise_rad_s.unwrap_or(GYRO_NOISE_RAD_S),
        SignalGroup::Battery => sensors.battery_noise_v.unwrap_or(BATTERY_NOISE_V),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Catalogue, EffectEntry};
    use std::path::Path;

    const FOUR: &str = include_str!("../../robots/feup-4w/robot.toml");

    fn four() -> RobotFile {
        RobotFile::parse(FOUR, Path::new("robot.toml"), &Catalogue::default()).unwrap()
    }

    fn card(id: &str) -> &'static Card {
        EffectKind::find(id).unwrap().card()
    }

    fn at(shown: &EffectShown, channel: usize) -> &ShownSignal {
        shown.signals.iter().find(|signal| signal.channel == channel).unwrap()
    }

    #[test]
    fn a_camera_with_a_wrong_scale_moves_places_alone_and_by_its_share() {
        let shown = effect_shown(&four(), card("camera_scale"));
        let channels = Channels { wheels: 4 };
        let scale = shown.effect.params[0];
        for signal in &shown.signals {
            let share = if channels.pose()[..2].contains(&signal.channel) { scale } else { 0.0 };
            let meant = largest(signal.without.iter().map(|x| share * x));
            assert!((signal.largest_change() - meant).abs() < 1e-12, "{signal:?}");
        }
        assert!(channels.pose()[..2].contains(&shown.most().channel));
    }

    #[test]
    fn the_drive_turns_reverses_creeps_and_rests() {
        let shown = effect_shown(&four(), card("camera_scale"));
        let channels = Channels { wheels: 4 };
        let speeds = |name: &str| -> Vec<f64> {
            let part = shown.parts.iter().position(|part| part.0 == name).unwrap();
            let from = part.checked_sub(1).map_or(0.0, |before| shown.parts[before].1);
            let rows = shown.t_s.iter().map(|t| (from..shown.parts[part].1).contains(t));
            let speed = &at(&shown, channels.wheel_speed(1)).without;
            speed.iter().zip(rows).filter(|(_, is)| *is).map(|(x, _)| *x).collect()
        };
        assert!(speeds("rest").iter().all(|w| *w == 0.0));
        let back = speeds("back");
        assert!(back[0] * back[back.len() - 1] < 0.0 && back[back.len() - 1].abs() > 20.0, "{back:?}");
        let creeping = speeds("creeping");
        let slow = creeping[creeping.len() - 1].abs();
        assert!(slow > 0.5 && slow < 8.0, "{slow} rad/s");
        assert!(largest(at(&shown, channels.gyro()).without.iter().copied()) > 3.0);
        assert_eq!(shown.parts[shown.parts.len() - 1].1, shown.t_s.len() as f64 / RATE);
    }

    #[test]
    fn a_drive_that_controls_the_speed_tells_no_currents() {
        let shown = effect_shown(&four(), card("speed_loop"));
        assert!(shown.signals.iter().all(|s| Channels { wheels: 4 }.group(s.channel) != SignalGroup::Current));
        assert!(shown.most().in_noise() > 1.0);
    }

    #[test]
    fn an_effect_that_the_file_names_is_left_out_of_the_drive_without_it() {
        let mut named = four();
        named.effects.push(EffectEntry { id: "creep".to_owned(), wheel: None, params: [].into() });
        let creep = card("creep");
        assert_eq!(effect_shown(&named, creep).signals, effect_shown(&four(), creep).signals);
    }

    #[test]
    fn what_shows_beside_another_effect_alone_has_it_in_both_drives() {
        let shown = EffectKind::ALL.iter().map(|kind| kind.card()).find(|card| card.physics.shows_beside.is_some());
        let (shown, mut named) = (shown.unwrap(), four());
        let beside = shown.physics.shows_beside.unwrap();
        let of_the_plain_robot = effect_shown(&named, shown);
        named.effects.push(EffectEntry { id: beside.to_owned(), wheel: None, params: [].into() });
        assert_eq!(of_the_plain_robot.signals, effect_shown(&named, shown).signals);
        assert!(of_the_plain_robot.most().in_noise() > 0.1);
    }
}
