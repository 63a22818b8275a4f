//! Where: the links' shares, told further by stage, wheel, axis and regime.

use model_core::geometry::frames::BodyTwist;

use super::candidate::Cause;
use super::judged::Outcome;
use super::scored::Data;
use super::search::Search;
use super::settle::stage_of;
use crate::engine::findings::{Regime, Where};
use crate::engine::knobs::PlacesKnobs;
use crate::localise::{Hotspot, Link, links, regimes};
use crate::simulate::{AlignedRun, Chain, Model, Prediction, SignalGroup, predict};
use crate::vocabulary::{Axis, Stage};

/// The places of the gap, the largest first.
pub(super) fn places<const N: usize>(search: &Search<N>, nominal: &Model<N>, data: &Data<'_, N>) -> Vec<Where> {
    if let Some(group) = search.beside {
        let found = search.found.first().map(|found| stage_of(found.cause.id()));
        return vec![Where {
            stage: found.unwrap_or(at_the_end_of(group)),
            axis: None,
            wheel: None,
            share: 1.0,
            regime: None,
        }];
    }
    let (knobs, horizon) = (&data.knobs.places, data.knobs.measure.horizon_s);
    // what lies within stated uncertainty is not where an effect sits; a wrong parameter is all there is to see
    let effect = search.found.iter().any(|f| matches!(f.cause, Cause::Effect(..)));
    let model = if effect || matches!(search.outcome, Outcome::Unknown) { &search.refitted.fit.model } else { nominal };
    let plant = model.plant();
    let split = links(&plant, &search.corrected.fit.model.plant(), &data.held, horizon);
    let weights = stage_weights(search, data);
    let mut shares = [0.0; 5];
    for (link, share) in &split.shares {
        let stages: Vec<usize> = (0..5).filter(|s| belongs(Stage::ALL[*s], *link, data.held[0].chain)).collect();
        let total: f64 = stages.iter().map(|s| weights[*s]).sum();
        for s in stages {
            shares[s] += share * weights[s] / total;
        }
    }
    let predictions: Vec<(&AlignedRun<N>, Prediction)> =
        data.held.iter().map(|run| (*run, predict(&plant, run, horizon))).collect();
    let pairs: Vec<(&AlignedRun<N>, &Prediction)> = predictions.iter().map(|(r, p)| (*r, p)).collect();
    let (wheel, axis) = standing_out(&pairs, model, knobs);
    let hot = regimes(&pairs, &knobs.regime).into_iter().next();
    let mut places: Vec<Where> = (0..5)
        .filter(|s| shares[*s] > knobs.negligible)
        .map(|s| Where { stage: Stage::ALL[s], axis: None, wheel: None, share: shares[s], regime: None })
        .collect();
    let total: f64 = places.iter().map(|p| p.share).sum();
    for place in &mut places {
        place.share /= total;
    }
    places.sort_by(|a, b| b.share.total_cmp(&a.share));
    if let Some(first) = places.first_mut() {
        first.wheel = search.found.first().and_then(|f| f.cause.wheel()).or(wheel.filter(|_| search.found.is_empty()));
        first.axis = if first.wheel.is_none() { axis } else { None };
        first.regime = hot.map(regime);
    }
    places
}

/// The stage that a gap in one group alone belongs to where no cause says more.
fn at_the_end_of(group: SignalGroup) -> Stage {
    match group {
        SignalGroup::Current | SignalGroup::Battery => Stage::Electrical,
        SignalGroup::WheelSpeed => Stage::Drivetrain,
        SignalGroup::Pose | SignalGroup::Gyro => Stage::Sensing,
    }
}

fn regime(spot: Hotspot) -> Regime {
    Regime { feature: spot.feature.to_owned(), low: spot.low, high: spot.high, share: spot.share, text: spot.text }
}

fn belongs(stage: Stage, link: Link, chain: Chain) -> bool {
    match link {
        // a speed that was commanded and not reached is the drive's: the floor and the body have no say in the model
        Link::Motion if chain == Chain::SetSpeed => {
            matches!(stage, Stage::Electrical | Stage::Drivetrain | Stage::Sensing)
        }
        Link::Electrical => matches!(stage, Stage::Electrical | Stage::Sensing),
        Link::Motion => {
            matches!(stage, Stage::Electrical | Stage::Drivetrain | Stage::Contact | Stage::Body | Stage::Sensing)
        }
        Link::Contact => matches!(stage, Stage::Contact | Stage::Sensing),
    }
}

/// How much each stage's causes explain. The measured signals split the gap among links; which stage of a link it is can
/// only be told by what explains it.
fn stage_weights<const N: usize>(search: &Search<N>, data: &Data<'_, N>) -> [f64; 5] {
    let (prior, mut weights) = (data.prior, [data.knobs.places.grain; 5]);
    let at = |stage: Stage| Stage::ALL.iter().position(|s| *s == stage).unwrap_or(0);
    if search.found.is_empty() {
        for s in &search.rounds[0].screened {
            weights[at(s.candidate.card.stage())] += s.gain.sqrt();
        }
        // a nominal value that a re-fit drives far from what was stated speaks for its own stage
        for (row, violation) in prior.rows.iter().zip(prior.violations(&search.refitted.fit.model)) {
            weights[at(stage_of(row.terms[0].0.cause()))] += violation.abs();
        }
    }
    for found in &search.found {
        weights[at(stage_of(found.cause.id()))] += found.earns.max(0.0);
    }
    weights
}

/// The wheel whose current and speed, and the axis whose velocity, hold most of the error.
fn standing_out<const N: usize>(
    runs: &[(&AlignedRun<N>, &Prediction)],
    model: &Model<N>,
    knobs: &PlacesKnobs,
) -> (Option<usize>, Option<Axis>) {
    let mut by_wheel = vec![0.0; N];
    let mut by_axis = [0.0; 3];
    let wheels = &model.robot().wheels;
    let channels = AlignedRun::<N>::channels();
    let lever: f64 = wheels.rows().iter().map(|r| r[2] * r[2]).sum::<f64>() / N as f64;
    for (run, prediction) in runs {
        for (row, p) in prediction.rows.iter().enumerate() {
            let mut speed = [0.0; N];
            let mut whole = true;
            for j in 0..N {
                let w = channels.wheel_speed(j);
                for c in [channels.current(j), w] {
                    if run.saw(row, c) {
                        by_wheel[j] += run.error(row, c, p[c]).powi(2);
                    }
                }
                whole &= run.saw(row, w);
                speed[j] = run.error(row, w, p[w]);
            }
            if whole {
                let BodyTwist { v, vn, w } = wheels.twist_of_wheel_speeds(speed);
                by_axis[0] += v * v;
                by_axis[1] += vn * vn;
                by_axis[2] += w * w * lever;
            }
        }
    }
    let top = |x: &[f64]| {
        let total: f64 = x.iter().sum();
        let (k, most) = x.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        (total > 0.0).then_some((k, most / total))
    };
    let wheel = top(&by_wheel).filter(|(_, share)| *share > knobs.wheel_stands_out / N as f64).map(|(k, _)| k);
    let axis = top(&by_axis).filter(|(_, share)| *share > knobs.axis_holds).map(|(k, _)| Axis::ALL[k]);
    (wheel, axis)
}
