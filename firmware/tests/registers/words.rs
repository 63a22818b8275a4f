//! Words and their fields: what stops a build stops a test where it is no constant.

use firmware::registers::words::{Field, Word};

enum Register {}

/// Bits 4 to 6.
const MODE: fn() -> Field<Register> = || Field::at(4, 3);

#[test]
fn a_field_takes_what_fits_it_and_leaves_the_others() {
    let word = Word::ZERO.with(MODE(), 0b101).with(Field::at(31, 1), 1).with(Field::at(0, 4), 0);
    assert_eq!(word.bits(), 0x8000_0050);
    assert_eq!(word.without(MODE()).bits(), 0x8000_0000);
    assert!(word.has(MODE()) && !word.without(MODE()).has(MODE()) && !word.has(Field::at(0, 4)));
    assert_eq!(Word::<Register>::ZERO.with(Field::at(0, 32), u32::MAX).bits(), u32::MAX);
}

#[test]
fn flags_are_ones_and_joined_words_have_those_of_both() {
    let flags = Word::ones([MODE(), Field::at(0, 1)]);
    assert_eq!(flags.bits(), 0x71);
    assert_eq!((flags | Word::ones([Field::at(9, 1)])).bits(), 0x271);
}

#[test]
#[should_panic(expected = "larger than its field")]
fn a_value_that_is_too_large_for_its_field_stops() {
    let _ = Word::ZERO.with(MODE(), 0b1000);
}

#[test]
#[should_panic(expected = "set already")]
fn a_field_that_is_set_twice_stops() {
    let _ = Word::ZERO.with(MODE(), 1).with(Field::at(6, 2), 1).with(MODE(), 2);
}

#[test]
#[should_panic(expected = "within its register")]
fn a_field_that_reaches_out_of_its_register_stops() {
    let _ = Field::<Register>::at(30, 3);
}
