//! How many effects and parameters there is room for, and that what does not fit is refused.

use model_core::effects::active::{EffectError, Effects, MAX_EFFECTS};
use model_core::effects::card::MAX_PARAMS;
use model_core::plant::Plant;
use model_core::plant::paper;

use crate::effects::{Ability, Rollers};

#[test]
fn a_model_carries_at_least_24_effects_of_at_least_8_parameters() {
    const { assert!(MAX_EFFECTS >= 24 && MAX_PARAMS >= 8) }
    assert!(omni_gap::known_effects().most_at_once >= 24, "{}", omni_gap::known_effects().most_at_once);
}

#[test]
fn all_of_them_act_and_one_more_is_refused() {
    let mut effects = Effects::<4, f64, Ability>::none();
    for _ in 0..MAX_EFFECTS {
        effects.put(Ability::Rollers(Rollers(0.01, 0.0)), None).expect("room");
    }
    assert_eq!(effects.put(Ability::Rollers(Rollers(0.01, 0.0)), None), Err(EffectError::Full));
    let plant = Plant::new(paper::four_wheels(), effects);
    assert_eq!(plant.effects().iter().count(), MAX_EFFECTS);
}
