//! Every cause of every round, fitted or only screened, with the estimate of its numbers.

use model_core::effects::card::{Card, Role};

use super::candidate::Cause;
use super::numbers::own_keys;
use super::released::ScreenedRelease;
use super::round::{Ranked, Ranking};
use super::screen::Screened;
use super::search::Search;
use crate::engine::findings::{ConsideredCause, EstimatedBy, EstimatedNumber};
use crate::identify::{Extent, FreedPrior, relative_std};
use crate::log::RobotFile;
use crate::simulate::Slot;

/// All of them, round by round, effects first.
pub(super) fn considered<const N: usize>(search: &Search<N>, robot: &RobotFile) -> Vec<ConsideredCause> {
    let mut all = Vec::new();
    for (round, ranking) in search.rounds.iter().enumerate() {
        let effects = ranking.screened.iter().map(|s| effect(s, ranking));
        let taken_up = |cause: &Cause| search.found.iter().any(|f| f.round == round && f.cause.is(cause));
        // numbers that are wrong by one factor and those that are wrong each by itself are one line: what was taken up, else the latter
        let common = |cause: &'static str| FreedPrior { cause, extent: Extent::CommonFactor };
        let told = |release: &FreedPrior| match release.extent {
            Extent::CommonFactor => taken_up(&Cause::Parameter(*release)),
            Extent::Each => !taken_up(&Cause::Parameter(common(release.cause))),
            Extent::Axis(_) => true,
        };
        let parameters = ranking.released.iter().filter(|r| told(&r.release)).map(|r| parameter(r, ranking, robot));
        for (cause, considered) in effects.chain(parameters) {
            all.push(ConsideredCause { round, taken_up: taken_up(&cause), ..considered });
        }
    }
    all
}

fn effect<const N: usize>(screened: &Screened, ranking: &Ranking<N>) -> (Cause, ConsideredCause) {
    let card = screened.candidate.card;
    let cause = Cause::Effect(card, screened.candidate.wheel);
    let fitted = ranking.ranked.iter().find(|r| r.cause.is(&cause));
    let numbers = match fitted {
        Some(ranked) => fitted_effect(card, ranked),
        None => screened.numbers.clone(),
    };
    (cause, entry(&cause, screened.gain, fitted, ranking, numbers))
}

fn fitted_effect<const N: usize>(card: &Card, ranked: &Ranked<N>) -> Vec<EstimatedNumber> {
    let fit = &ranked.scored.fit;
    let (id, wheel) = (ranked.cause.id(), ranked.cause.wheel());
    let Some(at) = fit.model.effects.iter().position(|e| e.id == id && e.wheel == wheel) else { return Vec::new() };
    let free = card.params.iter().enumerate().filter(|(_, p)| p.role != Role::Fixed);
    free.map(|(k, p)| EstimatedNumber {
        key: p.key.to_owned(),
        unit: p.unit.to_owned(),
        absent: p.absent,
        value: Some(fit.model.effects[at].params[k]),
        std: fit.std(Slot::Param(at, k)).filter(|std| std.is_finite()),
    })
    .collect()
}

fn parameter<const N: usize>(
    screened: &ScreenedRelease,
    ranking: &Ranking<N>,
    robot: &RobotFile,
) -> (Cause, ConsideredCause) {
    let cause = Cause::Parameter(screened.release);
    let fitted = ranking.ranked.iter().find(|r| r.cause.is(&cause));
    let numbers = own_keys(screened.release).map(|key| {
        let (factor, std) = match fitted {
            Some(Ranked { scored, .. }) => (Some(key.factor(&scored.fit.model.factor)), scored.fit.relative_std(key)),
            None => {
                let step = screened.step.as_ref();
                let std = step.and_then(|s| relative_std(key, &s.factors, |a, b| s.covariance_of(a, b)));
                (step.map(|s| key.factor(&s.factors)), std)
            }
        };
        let absent = key.value(robot);
        EstimatedNumber {
            key: key.key.to_owned(),
            unit: key.unit.to_owned(),
            absent,
            value: factor.map(|f| f * absent),
            std: factor.zip(std).map(|(f, std)| (std * f * absent).abs()).filter(|std| std.is_finite()),
        }
    });
    (cause, entry(&cause, screened.gain, fitted, ranking, numbers.collect()))
}

fn entry<const N: usize>(
    cause: &Cause,
    promise: f64,
    fitted: Option<&Ranked<N>>,
    ranking: &Ranking<N>,
    numbers: Vec<EstimatedNumber>,
) -> ConsideredCause {
    let score = fitted.map(|r| r.scored.score(ranking.scale));
    ConsideredCause {
        id: cause.id().to_owned(),
        kind: cause.kind(),
        wheel: cause.wheel(),
        axis: cause.axis(),
        round: 0,
        taken_up: false,
        estimated_by: if fitted.is_some() { EstimatedBy::Fit } else { EstimatedBy::Screen },
        numbers,
        promise,
        score,
        gain: score.map(|score| ranking.base.score(ranking.scale) - score),
    }
}
