//! What experiments tell of a robot, as data: the paper's numbers, those of all runs together, and what to make of them.

pub(super) mod model;

use model_core::plant::robot::Nominal;

use super::disagree::{Disagreement, disagreements};
use super::experiments::{Classic, Estimate, classic};
use super::guess::guessed;
use super::identifiability::TradeOff;
use super::joint::{Identified, Joint, Refused, joint};
use crate::log::{Change, RobotFile};
use crate::simulate::{AlignedRun, Chain, Experiment, Model, NOMINAL_KEYS, NominalKey, SignalGroup, supply_seen};
use model::*;

/// Figures of a number that is written into a robot file, and of its uncertainty.
const FIGURES: (i32, i32) = (6, 2);

/// The key of the robot file that stands for a number.
pub fn number_key(nominal: Nominal) -> &'static NominalKey {
    NominalKey::alone(nominal).expect("every number that is identified has a key")
}

/// What the runs of the experiments that are asked say of a robot. All of the session's drivable runs are given: the
/// paper takes numbers of one experiment for another.
///
/// # Errors
/// Where the runs that are to be fitted cannot tell a single number.
pub fn answer<const N: usize>(file: &RobotFile, runs: &[AlignedRun<N>], asked: Asked) -> Result<Answer, Refused> {
    let (begin, guessed) = guessed(file);
    let model = Model::<N>::nominal(&begin, supply_seen(runs));
    let (fitted, left_out) = chosen(runs, asked);
    let found = joint(&model, &begin, &fitted)?;
    let paper = classic(&model, &with_volts(runs));
    let disagreements = match asked {
        Asked::All => disagreements(&model, &begin, &runs.iter().collect::<Vec<_>>()),
        Asked::One(_) => Vec::new(),
    };
    Ok(Answer {
        schema: SCHEMA,
        robot: file.name.clone(),
        asked: asked.word(),
        runs: counted(runs, asked),
        fitted_runs: fitted.len(),
        left_out,
        not_logged: not_logged(&fitted),
        guessed,
        numbers: found.numbers.iter().map(|n| number(n, (file, &begin), &paper, asked)).collect(),
        trade_offs: found.trade_offs.iter().map(together).collect(),
        noise: noise(&found, file, &fitted),
        follows: found.follows,
        misfit: found.misfit,
        samples: found.samples,
        disagreements: disagreements.iter().map(|d| apart(d, &begin)).collect(),
    })
}

impl Answer {
    /// The changes that write what is known into the robot file, with how sure it is.
    pub fn changes(&self, file: &RobotFile) -> Vec<Change> {
        let mut changes = Vec::new();
        for n in self.numbers.iter().filter(|n| n.word.is_known()) {
            let std = n.together.std.unwrap_or(0.0).hypot(n.std_given) / n.together.value;
            let nominal = NominalKey::of(n.key).map_or(&[][..], |key| key.factors);
            // K_t and K_v go together, as the file has them to each other
            for key in NOMINAL_KEYS.iter().filter(|key| key.factors.first() == nominal.first()) {
                let scale = if key.key == n.key { 1.0 } else { key.value(file) / n.file };
                let path = format!("{}.{}", key.table, key.key);
                changes.push(Change::Number { path, value: rounded(n.together.value * scale, FIGURES.0) });
                let path = format!("uncertainty.{}", key.key);
                changes.push(Change::Number { path, value: rounded(std, FIGURES.1) });
            }
        }
        changes
    }
}

/// A number with so many figures.
fn rounded(x: f64, figures: i32) -> f64 {
    format!("{x:.*e}", (figures - 1) as usize).parse().unwrap_or(x)
}

/// The runs to fit together, and those left out: more friction than the robot has is not to be fitted as the robot's.
fn chosen<const N: usize>(runs: &[AlignedRun<N>], asked: Asked) -> (Vec<&AlignedRun<N>>, Vec<LeftOut>) {
    let asked_for = |run: &&AlignedRun<N>| asked.takes(&run.name);
    let is_motor = |run: &&AlignedRun<N>| Experiment::of(&run.name) == Some(Experiment::Motor);
    let unloaded = |run: &&AlignedRun<N>| run.name.rsplit('-').next() == Some("0");
    let (motor, others): (Vec<_>, Vec<_>) = runs.iter().filter(asked_for).partition(is_motor);
    let (fitted, loaded) = match others.is_empty() {
        true => motor.into_iter().partition(unloaded),
        false => (others, motor),
    };
    let names = |runs: Vec<&AlignedRun<N>>| runs.iter().map(|run| run.name.clone()).collect();
    let strangers = runs.iter().filter(|run| asked == Asked::All && !asked.takes(&run.name)).collect();
    let left_out = [
        LeftOut { runs: names(loaded), why: "what the motor experiment drags is no friction of the robot" },
        LeftOut { runs: names(strangers), why: "their names tell no experiment" },
    ];
    (fitted, left_out.into_iter().filter(|l| !l.runs.is_empty()).collect())
}

/// The runs that the paper's estimators can use: they take voltages, but for a coast-down.
fn with_volts<const N: usize>(runs: &[AlignedRun<N>]) -> Vec<AlignedRun<N>> {
    let usable =
        |run: &&AlignedRun<N>| run.chain == Chain::Voltage || Experiment::of(&run.name) == Some(Experiment::Coast);
    runs.iter().filter(usable).cloned().collect()
}

fn counted<const N: usize>(runs: &[AlignedRun<N>], asked: Asked) -> Vec<Counted> {
    let of = |e: Experiment| runs.iter().filter(|r| asked.takes(&r.name) && Experiment::of(&r.name) == Some(e)).count();
    let counts = Experiment::ALL.into_iter().map(|e| Counted { experiment: e.title(), runs: of(e) });
    counts.filter(|c| c.runs > 0).collect()
}

fn not_logged<const N: usize>(runs: &[&AlignedRun<N>]) -> Vec<&'static str> {
    let no = |has: &dyn Fn(&AlignedRun<N>) -> bool| !runs.iter().any(|run| has(run));
    let by = |chain: Chain| move |run: &AlignedRun<N>| run.chain == chain;
    let (volts, amps) = (by(Chain::Voltage), by(Chain::Current));
    let speeds = by(Chain::WheelSpeed);
    let groups = [
        ("voltages", no(&volts)),
        ("currents", no(&|run| run.has_group(SignalGroup::Current) || amps(run))),
        ("wheel speeds", no(&|run| run.has_group(SignalGroup::WheelSpeed) || speeds(run))),
        ("poses", no(&|run| run.has_group(SignalGroup::Pose))),
    ];
    groups.into_iter().filter(|(_, missing)| *missing).map(|(name, _)| name).collect()
}

fn number(n: &Identified, (file, begin): (&RobotFile, &RobotFile), paper: &Classic, asked: Asked) -> Number {
    let key = number_key(n.nominal);
    let size = key.value(begin);
    let value = |e: Estimate| Value { value: e.value, std: Some(e.std).filter(|std| std.is_finite()) };
    let wanted = |e: Experiment| matches!(asked, Asked::All) || asked == Asked::One(e);
    let third = |s: Option<super::experiments::Stepped>| {
        s.filter(|_| wanted(Experiment::Step)).and_then(|s| s.of(n.nominal)).map(value)
    };
    Number {
        key: key.key,
        file: key.value(file),
        first: paper.first(n.nominal).filter(|_| first_of(n.nominal).is_some_and(wanted)).map(value),
        least_squares: third(paper.least_squares),
        instrumental: third(paper.instrumental),
        average: paper.table(n.nominal).filter(|_| asked == Asked::All).map(value),
        together: Value { value: size * n.factor, std: Some(size * n.std).filter(|std| std.is_finite()) },
        std_given: size * n.std_given,
        word: n.word,
    }
}

/// The experiment that a number of the paper's Table 1 comes from.
fn first_of(nominal: Nominal) -> Option<Experiment> {
    match nominal {
        Nominal::Resistance | Nominal::TorqueConstant => Some(Experiment::Motor),
        Nominal::ViscousW | Nominal::CoulombW => Some(Experiment::Spin),
        Nominal::Inertia | Nominal::ViscousV | Nominal::ViscousVn | Nominal::CoulombV | Nominal::CoulombVn => {
            Some(Experiment::Coast)
        }
        _ => None,
    }
}

fn together(t: &TradeOff) -> Together {
    let key = |p: &Nominal| number_key(*p).key;
    let power = |(p, power): (Nominal, f64)| Power { key: key(&p), power };
    Together {
        moves: t.moves.iter().map(|(p, relative)| Moved { key: key(p), relative: *relative }).collect(),
        std_relative: t.std,
        known: t.known.map(|(two, std_relative)| Product { powers: two.map(power), std_relative }),
    }
}

fn noise<const N: usize>(found: &Joint<N>, file: &RobotFile, runs: &[&AlignedRun<N>]) -> Vec<SensorNoise> {
    let (sensors, channels) = (&file.sensors, AlignedRun::<N>::channels());
    let of = [
        ("current_noise_A", sensors.current_noise_a, channels.current(0)),
        ("wheel_speed_noise_rad_s", sensors.wheel_speed_noise_rad_s, channels.wheel_speed(0)),
        ("position_noise_m", sensors.position_noise_m, channels.pose()[0]),
        ("heading_noise_rad", sensors.heading_noise_rad, channels.heading()),
    ];
    let mut all = Vec::new();
    for (group, (key, stated, channel)) in of.into_iter().enumerate() {
        let seen = |run: &&&AlignedRun<N>| (0..run.rows()).any(|row| run.saw(row, channel));
        // a channel's sigma has its quantum in it
        let Some(sigma) = runs.iter().find(seen).map(|run| run.sigma[channel]) else { continue };
        let correlation_time_s = found.noise.correlation_time[group];
        all.push(SensorNoise { key, found: found.noise.scale[group] * sigma, stated, correlation_time_s });
    }
    all
}

fn apart(d: &Disagreement, begin: &RobotFile) -> Apart {
    let key = number_key(d.nominal);
    let size = key.value(begin);
    let side = |told: &super::disagree::IndependentEstimate| Side {
        by: told.by,
        value: Value { value: size * told.factor, std: Some(size * told.std) },
    };
    Apart { key: key.key, sides: [side(&d.one), side(&d.other)], sigmas: d.sigmas }
}
