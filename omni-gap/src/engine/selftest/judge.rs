//! Judges every suspect: from what size on it would be found, and told from its rivals.

use model_core::effects::card::{Card, Role};
use rayon::prelude::*;

use super::laid::Laid;
use super::left::Left;
use super::sensors::Sensors;
use super::sizes::size_needed;
use super::sizing::Sizing;
use super::suspects::{Column, Suspect, suspects};
use crate::engine::findings::{Rival, SeenCause, SelfTest, WithSensor};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::stepwise::Cause;
use crate::identify::Prior;
use crate::log::{RobotFile, Run};
use crate::simulate::{AlignedRun, Model, SignalGroup, supply_seen};

/// What recordings of the robot of a file could show. `runs` are such recordings by a robot that is just what the file
/// says, with every sensor there is; `sensors` says which of these would be logged, and others that might be added.
pub fn selftest(file: &RobotFile, runs: &[Run], sensors: &Sensors, knobs: &SelftestKnobs) -> SelfTest {
    match file.wheel.len() {
        3 => of_wheels::<3>(file, runs, sensors, knobs),
        _ => of_wheels::<4>(file, runs, sensors, knobs),
    }
}

fn of_wheels<const N: usize>(file: &RobotFile, runs: &[Run], sensors: &Sensors, knobs: &SelftestKnobs) -> SelfTest {
    let aligned: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, file)).collect();
    let Some(chain) = aligned.first().map(|run| run.chain) else { return sensors.show_nothing(file) };
    let model = Model::<N>::nominal(file, supply_seen(&aligned));
    let (suspects, columns) = suspects::<N>(&model.effects, chain, knobs.shape_moved);
    let mask = |groups: &[SignalGroup]| {
        groups.iter().flat_map(|g| AlignedRun::<N>::channels().of(*g)).fold(0_u16, |mask, c| mask | 1 << c)
    };
    let logged = mask(&sensors.logged);
    let with_each = sensors.might_be_added.iter().map(|group| logged | mask(&[*group]));
    let laid = Laid::new(file, model, &aligned, knobs);
    let left = laid.left(&columns, &std::iter::once(logged).chain(with_each).collect::<Vec<_>>());
    let standings = |left: &Left| Standing::of_all(&suspects, left, file, knobs);
    let now = standings(&left[0]);
    // of effects on one wheel, the wheel where they show least
    let mut shown: Vec<usize> = Vec::new();
    for k in 0..suspects.len() {
        let same = |a: &Cause, b: &Cause| a.same_id(b) && a.axis() == b.axis();
        match shown.iter_mut().find(|at| same(&suspects[**at].cause, &suspects[k].cause)) {
            None => shown.push(k),
            Some(at) if now[*at].size > now[k].size => *at = k,
            Some(_) => {}
        }
    }
    let cause = |k: &usize| {
        let seen_times = match &columns[suspects[*k].typical] {
            // an effect without a size is there or not
            Column::Effect(effect) if !has_size(effect.card()) => now[*k].is_seen().then_some(1.0),
            Column::Effect(effect) => size_needed(&laid, effect, logged, (now[*k].size, now[*k].needed), knobs),
            Column::Factors(_) => Some(now[*k].seen()).filter(|times| times.is_finite()),
        };
        now[*k].as_seen(&suspects[*k], seen_times, left[0].share_taken(&suspects[*k]), knobs.wrong)
    };
    let replaced = sensors.might_replace.iter().map(|(name, runs)| {
        let aligned: Vec<AlignedRun<N>> = runs.iter().filter_map(|run| AlignedRun::new(run, file)).collect();
        (*name, standings(&Laid::new(file, laid.model.clone(), &aligned, knobs).left(&columns, &[logged])[0]))
    });
    let added = sensors.might_be_added.iter().zip(&left[1..]).map(|(group, left)| (group.name(), standings(left)));
    let with = |(sensor, then): (&'static str, Vec<Standing>)| {
        let newly = |is: fn(&Standing) -> bool| -> Vec<&'static str> {
            let comes = shown.iter().filter(|k| !is(&now[**k]) && is(&then[**k]));
            let mut ids: Vec<&'static str> = comes.map(|k| suspects[*k].cause.id()).collect();
            ids.dedup();
            ids
        };
        WithSensor { sensor, seen: newly(Standing::is_seen), named: newly(Standing::is_named) }
    };
    SelfTest {
        numbers: left[0].numbers(),
        causes: shown.par_iter().map(cause).collect(),
        with_sensor: added.chain(replaced).map(with).collect(),
        ..sensors.show_nothing(file)
    }
}

/// How a suspect of typical size stands in the channels of one set.
struct Standing {
    /// |s⊥|² [σ²]
    size: f64,
    /// What the engine would ask of it [σ²]
    needed: f64,
    /// The multiple of its size from which on it is told from the rival that is hardest to tell from it.
    told: f64,
    /// Those that it is not told from.
    rivals: Vec<Rival>,
}

impl Standing {
    fn of_all(suspects: &[Suspect], left: &Left, file: &RobotFile, knobs: &SelftestKnobs) -> Vec<Self> {
        let prior = Prior::stated(file);
        suspects.iter().map(|s| Self::of(s, suspects, left, s.cause.freedom(&prior), knobs)).collect()
    }

    fn of(suspect: &Suspect, all: &[Suspect], left: &Left, freedom: usize, knobs: &SelftestKnobs) -> Self {
        let search = &knobs.engine.search;
        // a cause is judged by the runs that are held out
        let held = 1.0 / knobs.engine.layout.hold_out_every as f64;
        let gain = search.convincing + (search.convincing_each + search.price_of_freedom) * freedom as f64;
        let relevant = match suspect.cause {
            Cause::Effect(..) => search.relevant * left.numbers() as f64,
            Cause::Parameter(_) => 0.0,
        };
        let size = left.size(suspect);
        let mut told = 0.0_f64;
        let mut rivals: Vec<Rival> = Vec::new();
        for rival in all.iter().filter(|rival| !rival.cause.same_id(&suspect.cause)) {
            let beside = left.beside(suspect, rival, knobs.regular);
            let angle_rad = (beside / size).sqrt().clamp(0.0, 1.0).asin();
            let times =
                if angle_rad > knobs.same_angle_rad { (search.tie / (held * beside)).sqrt() } else { f64::INFINITY };
            told = told.max(times);
            if times > 1.0 {
                rivals.push(Rival { cause: rival.cause.id(), axis: rival.cause.axis(), angle_rad });
            }
        }
        rivals.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad));
        let mut ids: Vec<&str> = Vec::new();
        rivals.retain(|rival| {
            let new = !ids.contains(&rival.cause);
            ids.push(rival.cause);
            new
        });
        Self { size, needed: (gain / held).max(relevant), told, rivals }
    }

    /// The multiple of its size from which on it is seen, as a straight line.
    fn seen(&self) -> f64 {
        (self.needed / self.size).sqrt()
    }

    fn is_seen(&self) -> bool {
        self.size >= self.needed
    }

    fn is_named(&self) -> bool {
        self.is_seen() && self.rivals.is_empty()
    }

    /// The same as an answer, seen from this multiple on.
    fn as_seen(&self, suspect: &Suspect, seen_times: Option<f64>, imitated: f64, wrong: f64) -> SeenCause {
        let sizing = Sizing::of(&suspect.cause, wrong);
        // a coefficient of friction shows the more the smaller it is
        let shows_below = self.is_seen() && seen_times.is_some_and(|times| times > 1.0);
        let more = (self.told / self.seen()).max(1.0);
        let named_times = seen_times.map(|times| if shows_below { times / more } else { times * more });
        let named_times = named_times.filter(|times| times.is_finite() && *times > 0.0);
        SeenCause {
            cause: suspect.cause.id(),
            kind: suspect.cause.kind(),
            wheel: suspect.cause.wheel(),
            axis: suspect.cause.axis(),
            parameter: sizing.key,
            unit: sizing.unit,
            typical: sizing.typical,
            sigma: self.size.sqrt(),
            imitated,
            shows_below,
            seen_from: seen_times.and_then(|times| sizing.at(times)),
            seen_times,
            named_from: named_times.and_then(|times| sizing.at(times)),
            named_times,
            rivals: if self.is_seen() { self.rivals.clone() } else { Vec::new() },
        }
    }
}

fn has_size(card: &Card) -> bool {
    card.params.iter().any(|p| p.role == Role::Size)
}
