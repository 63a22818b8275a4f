//! Judges every suspect: from what size on it would be found, and told from its rivals.

use model_core::effects::card::{Card, Role};
use rayon::prelude::*;

use super::laid::Laid;
use super::left::Left;
use super::sensors::Sensors;
use super::sizes::{often_enough, size_needed, within_bounds};
use super::standing::Standing;
use super::suspects::{Column, Suspect, suspects};
use super::view::View;
use crate::engine::findings::{ConfusedCause, Confusion, SelfTest, WithSensor};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::stepwise::Cause;
use crate::log::{RobotFile, Run};
use crate::simulate::{AlignedRun, Chain, Model, SignalGroup, supply_seen};

/// What recordings of the robot of a file could show. `runs` are such recordings by a robot that is just what the file
/// says, with every sensor there is; `sensors` says which of these would be logged, and others that might be added.
pub fn selftest(file: &RobotFile, runs: &[Run], sensors: &Sensors, knobs: &SelftestKnobs) -> SelfTest {
    match file.wheel.len() {
        3 => of_wheels::<3>(file, runs, sensors, knobs),
        _ => of_wheels::<4>(file, runs, sensors, knobs),
    }
}

/// Which cause of typical size would be taken for which in recordings of the robot of a file, by the channels that are
/// `logged`; `runs` as in [`selftest`].
pub fn confusion(file: &RobotFile, runs: &[Run], logged: &[SignalGroup], knobs: &SelftestKnobs) -> Confusion {
    let (numbers, causes) = match file.wheel.len() {
        3 => confused::<3>(file, runs, logged, knobs),
        _ => confused::<4>(file, runs, logged, knobs),
    }
    .unwrap_or_default();
    let logged = logged.iter().map(|group| group.name()).collect();
    Confusion { robot: file.name.clone(), logged, numbers, causes }
}

fn of_wheels<const N: usize>(file: &RobotFile, runs: &[Run], sensors: &Sensors, knobs: &SelftestKnobs) -> SelfTest {
    let aligned = aligned::<N>(file, runs, &sensors.logged);
    let Some(asked) = Asked::new(file, &aligned, knobs) else { return sensors.show_nothing(file) };
    let Asked { laid, suspects, columns, .. } = &asked;
    let logged = mask::<N>(&sensors.logged);
    let with_each = sensors.might_be_added.iter().map(|group| logged | mask::<N>(&[*group]));
    let views: Vec<View> = std::iter::once(logged).chain(with_each).map(|mask| laid.view(mask)).collect();
    let left = laid.left(columns, &views);
    let now = asked.standings(laid, &left[0]);
    let shown = asked.shown(&now);
    let cause = |k: &usize| {
        let seen_times = match &columns[suspects[*k].typical] {
            // an effect without a size is there or not
            Column::Effect(effect) if !has_size(effect.card()) => now[*k].is_seen().then_some(1.0),
            Column::Effect(effect) if effect.card().shows_event_by_event() => {
                within_bounds(now[*k].seen(), effect, knobs)
            }
            Column::Effect(effect) => size_needed(laid, effect, &views[0], (now[*k].size, now[*k].needed), knobs),
            Column::Factors(_) => Some(now[*k].seen()).filter(|times| times.is_finite()),
        };
        now[*k].as_seen(&suspects[*k], seen_times, left[0].share_taken(suspects[*k].typical), knobs.wrong)
    };
    let replaced = sensors.might_replace.iter().map(|(name, runs)| {
        let aligned = self::aligned::<N>(file, runs, &sensors.logged);
        let laid = Laid::new(file, laid.model.clone(), &aligned, knobs);
        (*name, asked.standings(&laid, &laid.left(columns, &[laid.view(logged)])[0]))
    });
    let added =
        sensors.might_be_added.iter().zip(&left[1..]).map(|(group, left)| (group.name(), asked.standings(laid, left)));
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
        numbers: views[0].seen.measured(),
        causes: shown.par_iter().map(cause).collect(),
        with_sensor: added.chain(replaced).map(with).collect(),
        ..sensors.show_nothing(file)
    }
}

/// How many numbers are measured, and every cause among the others; none where nothing drives the model.
fn confused<const N: usize>(
    file: &RobotFile,
    runs: &[Run],
    logged: &[SignalGroup],
    knobs: &SelftestKnobs,
) -> Option<(usize, Vec<ConfusedCause>)> {
    let aligned = aligned::<N>(file, runs, logged);
    let asked = Asked::new(file, &aligned, knobs)?;
    let view = [asked.laid.view(mask::<N>(logged))];
    let now = asked.standings(&asked.laid, &asked.laid.left(&asked.columns, &view)[0]);
    let causes = asked.shown(&now).into_iter().map(|k| now[k].as_confused(&asked.suspects[k])).collect();
    Some((view[0].seen.measured(), causes))
}

/// Runs laid out. None of them was made, so that none shows which telegrams it lost: where what answers to commands is
/// logged, that is drawn.
fn aligned<const N: usize>(file: &RobotFile, runs: &[Run], logged: &[SignalGroup]) -> Vec<AlignedRun<N>> {
    let drawn = |(seed, run): (u64, AlignedRun<N>)| {
        let answers = if run.chain == Chain::SetSpeed { SignalGroup::WheelSpeed } else { SignalGroup::Current };
        if logged.contains(&answers) { run.with_drawn_losses(file, seed) } else { run }
    };
    (0..).zip(runs.iter().filter_map(|run| AlignedRun::new(run, file))).map(drawn).collect()
}

/// The channels of groups of signals, as a bit mask.
pub(in crate::engine) fn mask<const N: usize>(groups: &[SignalGroup]) -> u16 {
    groups.iter().fold(0, |mask, group| mask | AlignedRun::<N>::channels().mask(*group))
}

/// Recordings, and everybody who is asked whether it could be the cause of a gap on them.
struct Asked<'a, const N: usize> {
    file: &'a RobotFile,
    knobs: &'a SelftestKnobs,
    laid: Laid<'a, N>,
    suspects: Vec<Suspect>,
    columns: Vec<Column>,
}

impl<'a, const N: usize> Asked<'a, N> {
    /// None where nothing drives the model.
    fn new(file: &'a RobotFile, aligned: &'a [AlignedRun<N>], knobs: &'a SelftestKnobs) -> Option<Self> {
        let chain = aligned.first()?.chain;
        let model = Model::<N>::nominal(file, supply_seen(aligned));
        let (suspects, columns) = suspects::<N>(&model.effects, chain, knobs.shape_moved);
        Some(Self { file, knobs, laid: Laid::new(file, model, aligned, knobs), suspects, columns })
    }

    /// By what is left of the signatures in recordings laid out.
    fn standings(&self, laid: &Laid<'_, N>, left: &Left) -> Vec<Standing> {
        Standing::of_all(&self.suspects, left, self.file, self.knobs, |suspect| match &self.columns[suspect.typical] {
            Column::Effect(effect) if effect.card().shows_event_by_event() => {
                Some(often_enough(laid, effect, self.knobs))
            }
            _ => None,
        })
    }

    /// The suspects that an answer speaks of: of effects on one wheel, that wheel where they show least.
    fn shown(&self, now: &[Standing]) -> Vec<usize> {
        let same = |a: &Cause, b: &Cause| a.same_id(b) && a.axis() == b.axis();
        let mut shown: Vec<usize> = Vec::new();
        for k in 0..self.suspects.len() {
            match shown.iter_mut().find(|at| same(&self.suspects[**at].cause, &self.suspects[k].cause)) {
                None => shown.push(k),
                Some(at) if now[*at].size > now[k].size => *at = k,
                Some(_) => {}
            }
        }
        shown
    }
}

fn has_size(card: &Card) -> bool {
    card.params.iter().any(|p| p.role == Role::Size)
}
