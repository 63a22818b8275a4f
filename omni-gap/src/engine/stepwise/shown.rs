//! Shown: the shapes of the residual by which a person sees the causes, or the gap that none explains.

use model_core::effects::shows::Order;

use super::candidate::Cause;
use super::distances::Plants;
use super::judged::Outcome;
use super::scored::Data;
use super::search::Search;
use crate::engine::findings::Shape;
use crate::localise::shape::{Models, shapes};
use crate::simulate::{AlignedRun, EffectInstance, Model};

/// The shapes, the plainest first; none where there is no gap.
pub(super) fn shown<const N: usize>(search: &Search<N>, plants: &Plants<N>, data: &Data<'_, N>) -> Vec<Shape> {
    if matches!(search.outcome, Outcome::NoGap) {
        return Vec::new();
    }
    // what lies within stated uncertainty is no effect; a wrong parameter is all there is to see
    let effect = search.found.iter().any(|found| matches!(found.cause, Cause::Effect(..)));
    let unexplained = matches!(search.outcome, Outcome::Unknown);
    let before = if effect || unexplained { &plants.refitted } else { &plants.nominal };
    let models = Models { before, nominal: &plants.nominal, corrected: &plants.corrected };
    let knobs = &data.knobs.evidence;
    let mut shapes = shapes(&models, &looked_at(data), data.knobs.measure.horizon_s, knobs);
    for shape in &mut shapes {
        for line in &mut shape.lines {
            line.name = name(line.order, shape.wheel, &search.reported().fit.model);
        }
    }
    shapes
}

/// What comes so often in a turn of a wheel, by the effects of a model and its gear.
fn name<const N: usize>(order: usize, wheel: Option<usize>, model: &Model<N>) -> Option<String> {
    let gear = model.robot().motor.gear_ratio;
    let times = |effect: &EffectInstance| match effect.card().shows.order? {
        Order::Fixed(times) => Some(f64::from(times)),
        Order::OfWheel(at) => effect.params.get(at).copied(),
        Order::OfRotor(at) => effect.params.get(at).map(|times| times * gear),
    };
    let here = |effect: &&EffectInstance| effect.wheel.is_none() || effect.wheel == wheel;
    let same = |effect: &&EffectInstance| times(effect).is_some_and(|times| times.round() == order as f64);
    let effect = model.effects.iter().filter(here).find(same).map(|effect| effect.card().title.to_owned());
    let turns = order as f64 / gear;
    let of_rotor = (gear > 1.0 && turns >= 1.0 && turns.fract() == 0.0).then(|| match turns as usize {
        1 => "once a turn of the rotor".to_owned(),
        times => format!("{times} times a turn of the rotor"),
    });
    effect.or_else(|| (order == 1).then(|| "once a turn of the wheel".to_owned())).or(of_rotor)
}

/// Runs that are looked at: those that no fit has seen, and as many others as it takes.
fn looked_at<'a, const N: usize>(data: &Data<'a, N>) -> Vec<&'a AlignedRun<N>> {
    let knobs = &data.knobs.evidence;
    let (mut runs, mut seconds): (Vec<&AlignedRun<N>>, f64) = (Vec::new(), 0.0);
    let held = data.held.iter().map(|run| (*run, knobs.most_s));
    for (run, enough) in held.chain(data.fit.iter().map(|run| (*run, knobs.least_s))) {
        if seconds < enough {
            seconds += run.t.last().copied().unwrap_or_default();
            runs.push(run);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;

    use super::*;
    use crate::log::{Catalogue, RobotFile};

    #[test]
    fn an_order_is_named_by_what_the_model_has_so_often_else_by_its_shafts() {
        let text = include_str!("../../../robots/feup-4w/robot.toml");
        let file = RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let mut model = Model::<4>::nominal(&file, 12.0);
        let rollers = EffectKind::find("roller_ripple").unwrap().card();
        model.add_effect(EffectInstance {
            params: vec![0.004, 0.003, 13.0],
            ..EffectInstance::typical(rollers, Some(1))
        });
        let named = |order: usize, wheel: usize| name(order, Some(wheel), &model);
        assert_eq!(named(13, 1).as_deref(), Some(rollers.title));
        assert_eq!(named(13, 2), None, "the rollers of another wheel");
        assert_eq!(named(1, 0).as_deref(), Some("once a turn of the wheel"));
        // its gear turns the rotor five times
        assert_eq!(named(5, 0).as_deref(), Some("once a turn of the rotor"));
        assert_eq!(named(30, 0).as_deref(), Some("6 times a turn of the rotor"));
    }
}
