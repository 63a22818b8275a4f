//! What hands or a further sensor would settle, on the same scale as a script.

use model_core::effects::nominal;
use model_core::plant::robot::Nominal;

use super::bench::Bench;
use crate::engine::findings::Measure;
use crate::engine::selftest::mask;
use crate::engine::stepwise::Cause;
use crate::simulate::{AlignedRun, SignalGroup};

/// The most useful measurements: of numbers of the robot file, in place of a further recording; and sensors that are not logged,
/// while the script (`chosen`) is played. Left out is what answers nothing that is not answered `now`, or by the script.
pub(super) fn measures<const N: usize>(
    bench: &Bench<'_, N>,
    chosen: &AlignedRun<N>,
    [now, by_script]: [&[f64]; 2],
) -> Vec<Measure> {
    let asked = &bench.asked;
    let answers = |measure: &Measure, before: &[f64]| {
        let new = |k: &usize| before[*k] < asked.needed(*k) && measure.then[*k] >= asked.needed(*k);
        (0..before.len()).any(|k| new(&k))
    };
    let mut all: Vec<Measure> = by_hand(bench).into_iter().filter(|measure| answers(measure, now)).collect();
    all.extend(by_sensors(bench, chosen).into_iter().filter(|measure| answers(measure, by_script)));
    all.sort_by(|a, b| asked.worth(&b.then).total_cmp(&asked.worth(&a.then)));
    all.truncate(bench.knobs.measures);
    all
}

/// Each number that hands know better than the file states it.
fn by_hand<const N: usize>(bench: &Bench<'_, N>) -> Vec<Measure> {
    let (asked, knobs, stated) = (&bench.asked, bench.knobs, bench.laid.stated());
    let measured = |(at, factor): (usize, Nominal)| {
        let (number, to) = (factor.number(), knobs.by_hand);
        if stated.rows[at].sigma < knobs.betters * to {
            return None;
        }
        let mut known = stated.clone();
        known.rows[at].sigma = to;
        let told = asked.told_by_number(|cause| matches!(cause, Cause::Parameter(r) if r.speaks_of(factor)), to);
        let then = bench.differences(&bench.before, &known).into_iter().zip(told).map(|(by_runs, told)| by_runs + told);
        Some(Measure {
            what: format!("{}.{}", number.table.name(), number.key),
            how: factor.card().measured_by.to_owned(),
            to: Some(to),
            then: then.collect(),
        })
    };
    debug_assert_eq!(nominal::numbers().count(), stated.rows.len());
    Nominal::ALL.into_iter().enumerate().filter_map(measured).collect()
}

/// Each sensor that is not logged.
fn by_sensors<const N: usize>(bench: &Bench<'_, N>, chosen: &AlignedRun<N>) -> Vec<Measure> {
    let new = SignalGroup::ALL.into_iter().filter(|group| !bench.site.logged.contains(group));
    let with = |group: SignalGroup| Measure {
        what: group.name().to_owned(),
        how: format!("Log {} while the script is played.", in_words(group)),
        to: None,
        then: bench.with_channels(chosen, bench.site.mask::<N>() | mask::<N>(&[group])),
    };
    new.map(with).collect()
}

fn in_words(group: SignalGroup) -> &'static str {
    match group {
        SignalGroup::Current => "the motor currents",
        SignalGroup::WheelSpeed => "the wheel speeds",
        SignalGroup::Pose => "the pose, as a camera sees it",
        SignalGroup::Gyro => "the yaw rate of a gyro",
        SignalGroup::Battery => "the battery voltage",
    }
}
