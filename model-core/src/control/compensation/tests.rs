use super::*;
use crate::effects::card::{Scope, Undone};

/// On a wheel where the effect needs one, on all otherwise.
fn wheel_of(card: &Card) -> Option<usize> {
    (card.scope == Scope::OneWheel).then_some(1)
}

fn typical(card: &Card) -> ([f64; 4], usize) {
    let mut params = [0.0; 4];
    for (x, param) in params.iter_mut().zip(card.params) {
        *x = param.typical;
    }
    (params, card.params.len())
}

#[test]
fn every_effect_of_the_catalogue_is_undone_or_refused_with_its_own_reason() {
    for effect in EffectKind::ALL {
        let card = effect.card();
        let (params, count) = typical(card);
        let mut compensation = Compensation::<4, f64>::none();
        let mut add = || compensation.add(card.id, wheel_of(card), &params[..count]);
        match card.undone {
            Undone::By(_) => {
                assert_eq!((add(), add()), (Ok(()), Err(NotCompensable::Twice)), "{}", card.id);
                assert_ne!(compensation, Compensation::none(), "{}", card.id);
            }
            Undone::No(why) => assert_eq!(add(), Err(NotCompensable::Effect(why)), "{}", card.id),
        }
    }
}

#[test]
fn what_is_not_on_the_card_is_refused_and_changes_nothing() {
    let mut compensation = Compensation::<3, f64>::none();
    assert_eq!(compensation.add("backlash", None, &[0.1]), Err(NotCompensable::Unknown));
    assert_eq!(compensation.add("creep", Some(3), &[0.02]), Err(NotCompensable::Wheel));
    assert_eq!(compensation.add("coriolis", Some(0), &[1.0]), Err(NotCompensable::Wheel));
    assert_eq!(compensation.add("motor_mismatch", None, &[0.9, 1.0]), Err(NotCompensable::Wheel));
    for params in [&[][..], &[0.02, 0.02], &[-0.01], &[0.3], &[f64::NAN], &[f64::INFINITY]] {
        assert_eq!(compensation.add("creep", None, params), Err(NotCompensable::Parameters), "{params:?}");
    }
    assert_eq!(compensation, Compensation::none());
}

#[test]
fn an_effect_may_sit_on_two_wheels_but_not_twice_on_one() {
    let mut compensation = Compensation::<4, f64>::none();
    assert_eq!(compensation.add("gear_efficiency", Some(0), &[0.8]), Ok(()));
    assert_eq!(compensation.add("gear_efficiency", Some(2), &[0.9]), Ok(()));
    assert_eq!(compensation.gear_efficiency, [0.8, 1.0, 0.9, 1.0]);
    let before = compensation;
    assert_eq!(compensation.add("gear_efficiency", None, &[0.9]), Err(NotCompensable::Twice));
    assert_eq!(compensation, before);
}

#[test]
fn an_absent_effect_is_nothing_to_undo() {
    for effect in EffectKind::ALL {
        let card = effect.card();
        let (mut params, count) = typical(card);
        for (x, param) in params.iter_mut().zip(card.params) {
            *x = param.absent;
        }
        let mut compensation = Compensation::<4, f64>::none();
        if compensation.add(card.id, wheel_of(card), &params[..count]).is_ok() {
            // the same effect may still be added: nothing is there
            let (params, count) = typical(card);
            assert_eq!(compensation.add(card.id, wheel_of(card), &params[..count]), Ok(()), "{}", card.id);
        }
    }
    assert!(EffectKind::find("coriolis").is_some());
}
