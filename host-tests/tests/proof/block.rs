//! The parameter block names the effects by numbers that never change, and knows every card.

use std::collections::BTreeSet;
use std::fmt::Write;

use model_core::effects::EffectKind;
use model_core::link::block::EFFECT_CODES;

use crate::golden;

/// What stands in blocks that robots keep. A line may be added to it; none may ever change, not even with `BLESS=1`.
const GIVEN_OUT: &str = "effect_codes.txt";

#[test]
fn numbers_that_were_given_out_keep_their_effects() {
    let given_out = std::fs::read_to_string(host_tests::golden::path(GIVEN_OUT)).expect("the numbers given out");
    let mut cards = EffectKind::ALL.map(EffectKind::card);
    cards.sort_by_key(|card| card.code);
    let mut page = String::new();
    for card in cards {
        let _ = writeln!(page, "{} {}", card.code, card.id);
    }
    for line in given_out.lines() {
        assert!(page.lines().any(|now| now == line), "`{line}` stands in blocks that robots keep, and is gone");
    }
    golden::holds(GIVEN_OUT, &page);
}

#[test]
fn no_number_stands_for_two_effects_and_none_is_left_out() {
    let codes: BTreeSet<usize> = EffectKind::ALL.iter().map(|kind| usize::from(kind.code())).collect();
    assert_eq!(codes, (1..=EffectKind::ALL.len()).collect());
}

#[test]
fn the_block_knows_every_effect_of_the_catalogue_as_its_card_says() {
    assert_eq!(EFFECT_CODES.len(), EffectKind::ALL.len());
    for (known, card) in EFFECT_CODES.iter().zip(EffectKind::ALL.map(EffectKind::card)) {
        assert_eq!((known.id, known.code, known.scope), (card.id, card.code, card.scope));
        let said: Vec<_> = known.fields().iter().map(|field| (field.key, field.within)).collect();
        let card: Vec<_> = card.params.iter().map(|p| (p.key, (p.within.0 as f32, p.within.1 as f32))).collect();
        assert_eq!(said, card, "{}", known.id);
    }
}
