use super::*;
use crate::effects::active::MOST_UNDONE;
use crate::effects::card::{Scope, Undone};
use crate::effects::contact::creep::Creep;
use crate::effects::drivetrain::gear_efficiency::GearEfficiency;

/// On a wheel where the effect needs one, on all otherwise.
fn wheel_of(kind: EffectKind) -> Option<usize> {
    (kind.scope() == Scope::OneWheel).then_some(1)
}

fn typical(kind: EffectKind) -> Effect<f64> {
    let card = kind.card();
    let mut params = [0.0; 8];
    for (x, param) in params.iter_mut().zip(card.params) {
        *x = param.typical;
    }
    kind.with(&params[..card.params.len()]).expect("as many as on the card")
}

#[test]
fn every_effect_is_undone_as_its_card_says_or_refused_with_its_cards_reason() {
    for kind in EffectKind::ALL {
        let card = kind.card();
        let mut compensation = Compensation::<4, f64>::none();
        let mut add = || compensation.add(typical(kind), wheel_of(kind));
        if kind.undone() {
            assert_eq!((add(), add()), (Ok(()), Err(NotCompensable::Twice)), "{}", card.id);
            assert_ne!(compensation, Compensation::none(), "{}", card.id);
        } else {
            assert_eq!(add(), Err(NotCompensable::Effect(kind)), "{}", card.id);
            assert_eq!(NotCompensable::Effect(kind).reason(), card.undone.words(), "{}", card.id);
        }
    }
}

#[test]
fn what_a_card_says_of_an_effect_is_what_a_robot_knows_without_it() {
    for kind in EffectKind::ALL {
        let card = kind.card();
        assert_eq!(kind.undone_at().is_some(), matches!(card.undone, Undone::By(_)), "{}", card.id);
        assert_eq!((kind.scope(), kind.home(), kind.undone()), (card.scope, card.seams[0], card.undone.possible()));
    }
}

#[test]
fn a_wheel_that_is_not_there_is_refused_and_changes_nothing() {
    let mut compensation = Compensation::<3, f64>::none();
    let refused = Err(NotCompensable::Wheel);
    assert_eq!(compensation.add(Creep { creep: 0.02 }.into(), Some(3)), refused);
    for kind in EffectKind::ALL.into_iter().filter(|kind| kind.undone()) {
        match kind.scope() {
            Scope::Robot => assert_eq!(compensation.add(typical(kind), Some(0)), refused, "{}", kind.id()),
            Scope::OneWheel => assert_eq!(compensation.add(typical(kind), None), refused, "{}", kind.id()),
            Scope::Wheels => {}
        }
    }
    assert_eq!(compensation, Compensation::none());
}

#[test]
fn an_effect_may_sit_on_two_wheels_but_not_twice_on_one() {
    let mut compensation = Compensation::<4, f64>::none();
    let gear = |efficiency| GearEfficiency { efficiency }.into();
    assert_eq!(compensation.add(gear(0.8), Some(0)), Ok(()));
    assert_eq!(compensation.add(gear(0.9), Some(2)), Ok(()));
    let on = |compensation: &Compensation<4, f64>| [0, 1, 2, 3].map(|j| compensation.on(j).next().map(|u| u.effect));
    assert_eq!(on(&compensation), [Some(gear(0.8)), None, Some(gear(0.9)), None]);
    let before = compensation;
    assert_eq!(compensation.add(gear(0.9), None), Err(NotCompensable::Twice));
    assert_eq!(compensation.add(gear(0.9), Some(2)), Err(NotCompensable::Twice));
    assert_eq!(compensation, before);
}

#[test]
fn one_effect_more_than_there_is_room_for_is_told() {
    let mut compensation = Compensation::<4, f64>::none();
    let wheels = EffectKind::ALL.into_iter().filter(|kind| kind.undone() && kind.scope() != Scope::Robot);
    let seats = wheels.flat_map(|kind| (0..4).map(move |j| (kind, j)));
    for (kind, j) in seats.take(MOST_UNDONE) {
        assert_eq!(compensation.add(typical(kind), Some(j)), Ok(()));
    }
    let of_robot = EffectKind::ALL.into_iter().find(|kind| kind.undone() && kind.scope() == Scope::Robot);
    let kind = of_robot.expect("one that sits on no wheel");
    assert_eq!(compensation.add(typical(kind), None), Err(NotCompensable::Full));
}
