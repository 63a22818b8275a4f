//! The parameter block names the effects by numbers that never change, and knows every card.

use model_core::effects;
use model_core::link::block::EFFECT_CODES;

/// What stands in blocks that robots keep: a number may be added, none may ever change.
const GIVEN_OUT: [(u8, &str); 13] = [
    (1, "actuation_delay"),
    (2, "supply_sag"),
    (3, "dead_time"),
    (4, "motor_mismatch"),
    (5, "gear_efficiency"),
    (6, "stribeck"),
    (7, "rotor_inertia"),
    (8, "wheel_slip"),
    (9, "creep"),
    (10, "coriolis"),
    (11, "floor_tilt"),
    (12, "camera_latency"),
    (13, "current_sensor_offset"),
];

#[test]
fn numbers_that_were_given_out_keep_their_effects() {
    for (code, id) in GIVEN_OUT {
        assert!(EFFECT_CODES.iter().any(|known| (known.code, known.id) == (code, id)), "{code} is {id}");
    }
    assert!(
        EFFECT_CODES.iter().enumerate().all(|(k, known)| usize::from(known.code) == k + 1),
        "no number twice, none left out"
    );
}

#[test]
fn the_block_knows_every_effect_of_the_catalogue_as_its_card_says() {
    let catalogue = effects::catalogue::<f64>();
    assert_eq!(EFFECT_CODES.len(), catalogue.len(), "a new effect needs a number in model-core/src/block/effects.rs");
    for card in catalogue.iter().map(|effect| effect.card()) {
        let known = EFFECT_CODES
            .iter()
            .find(|known| known.id == card.id)
            .unwrap_or_else(|| panic!("{} has no number", card.id));
        assert_eq!(known.scope, card.scope);
        let said: Vec<_> = known.fields().iter().map(|field| (field.key, field.within)).collect();
        let card: Vec<_> = card.params.iter().map(|p| (p.key, (p.within.0 as f32, p.within.1 as f32))).collect();
        assert_eq!(said, card, "{}", known.id);
    }
}
