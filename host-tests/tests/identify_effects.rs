//! Identify, of a robot file that carries an effect whose numbers are wrong: it finds the true ones, and the page says so of
//! the whole catalogue.

use std::collections::BTreeSet;

use host_tests::carried::cases::{CarriedCase, cases};
use host_tests::carried::page::{CarriedNumber, SHARE, read_counts, read_table};
use host_tests::golden::path;
use model_core::effects::EffectKind;
use model_core::effects::card::Role;
use omni_gap::api::FitRemark;

/// Effects that are looked at in every run of the tests, on four wheels.
const LOOKED_AT: [&str; 6] = ["supply_sag", "dead_time", "cog_offset", "floor_tilt", "encoder_scale", "presliding"];

fn case(wheels: usize, id: &str) -> CarriedCase {
    let case = cases().into_iter().find(|case| (case.wheels(), case.effect.id) == (wheels, id));
    case.unwrap_or_else(|| panic!("no robot with {wheels} wheels carries {id}"))
}

#[test]
fn wrong_sizes_of_effects_that_a_file_carries_are_found() {
    for id in LOOKED_AT {
        let case = case(4, id);
        let found = case.identified().expect("a sound robot file");
        // what is written is what is said
        let written = case.written(&found).expect("a sound robot file");
        for number in &found.effects {
            assert_eq!(written.effects[0].params[number.key], number.fitted, "{id}: {}", number.key);
        }
        let own = CarriedNumber::of(&case, found).expect("a sound robot file");
        assert!(!own.is_empty());
        for number in own {
            assert!(number.is_told() && number.is_sure() && number.is_close(), "{number:?}");
            // these are plain in such recordings, whatever is said of their sigmas
            assert!(!number.size || number.off_share().is_none_or(|off| off <= SHARE), "{number:?}");
        }
    }
}

#[test]
fn what_recordings_tell_nothing_of_stays_as_the_file_has_it() {
    // nobody logged a gyro
    let found = case(4, "gyro_bias").without_gyro().expect("a sound robot file");
    let [number] = &found.effects[..] else { panic!("{:?}", found.effects) };
    assert_eq!((number.remark, number.std), (FitRemark::NotTold, None));
    assert_eq!(number.fitted, number.nominal);
}

#[test]
fn the_page_speaks_of_every_number_of_every_effect_and_counts_right() {
    let name = "carried_effects.md";
    let page = std::fs::read_to_string(path(name)).unwrap_or_else(|why| panic!("{name}: {why}: cargo xtask carried"));
    let table = read_table(&page);
    let standing: BTreeSet<(usize, &str, &str)> =
        table.iter().map(|row| (row.wheels, row.effect.as_str(), row.number.as_str())).collect();
    let numbers = |wheels| {
        let cards = EffectKind::ALL.iter().map(|effect| effect.card());
        cards.flat_map(move |card| {
            let free = card.params.iter().filter(|param| param.role != Role::Fixed);
            free.map(move |param| (wheels, card.id, param.key))
        })
    };
    assert_eq!(standing, numbers(3).chain(numbers(4)).collect(), "cargo xtask carried makes it again");
    let counts = read_counts(&page);
    let told = table.iter().filter(|row| row.off_sigmas.is_some()).count();
    let sure = table.iter().filter(|row| row.off_sigmas.is_some() && !row.unsure).count();
    assert_eq!(counts[0], (sure, told));
    assert_eq!(counts[2], (table.len() - told, table.len()));
}
