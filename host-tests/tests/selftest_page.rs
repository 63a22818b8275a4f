//! The page of sizes that are foretold and found: it speaks of every cause, its counts are those of its tables, and short
//! recordings say the same.

use std::collections::BTreeSet;

use host_tests::confusion::cases::{Amount, Layout};
use host_tests::golden::path;
use host_tests::verified::cases::{LAYOUTS, verified};
use host_tests::verified::page::{ReadSize, read_counts, read_table};
use model_core::effects::EffectKind;
use model_core::plant::robot::Nominal;

/// Of sizes that are within bounds, so many agree at the least [1].
const MOST: f64 = 0.8;

fn golden() -> String {
    let name = "selftest_verified.md";
    std::fs::read_to_string(path(name)).unwrap_or_else(|why| panic!("{name}: {why}: cargo xtask selftest makes it"))
}

#[test]
fn every_table_has_every_cause_that_acts_on_voltages_by_itself_and_is_counted() {
    let page = golden();
    let cards = EffectKind::ALL.iter().map(|effect| effect.card());
    let acting = cards.filter(|card| !card.of_speed_drive() && card.physics.shows_beside.is_none());
    let numbers = Nominal::ALL.iter().map(|nominal| nominal.cause());
    let causes: BTreeSet<&str> = acting.map(|card| card.id).chain(numbers).collect();
    let mut all = (0, 0);
    for layout in LAYOUTS {
        let table = read_table(&page, layout);
        let standing: BTreeSet<&str> = table.iter().map(ReadSize::id).collect();
        assert_eq!(standing, causes, "{}: cargo xtask selftest makes it again", layout.title());
        let within = table.iter().filter(|row| row.ratio.is_some()).count();
        let agree = table.iter().filter(|row| row.agrees()).count();
        assert_eq!(read_counts(&page, layout.title()), Some((within, agree)), "{}", layout.title());
        all = (all.0 + within, all.1 + agree);
    }
    assert_eq!(read_counts(&page, "all"), Some(all));
    assert!(all.1 as f64 > MOST * all.0 as f64, "{all:?}");
}

#[test]
fn short_recordings_find_what_they_foretell_of_causes_that_the_page_says_agree() {
    let looked_for = ["dead_time", "cog_offset", "encoder_scale", "torque_constant"];
    let table = read_table(&golden(), Layout::Three);
    let said = verified(Layout::Three, Amount { pieces: 3, duration: 3.0 }, |id| looked_for.contains(&id))
        .expect("a sound robot file");
    assert_eq!(said.causes.len(), looked_for.len());
    for cause in &said.causes {
        let on_page = table.iter().find(|row| row.id() == cause.cause).expect("a cause of the page");
        assert!(on_page.agrees(), "{on_page:?}");
        let found = cause.verified.and_then(|size| size.times).zip(cause.seen_times);
        let ratio = found.map(|(found, foretold)| found / foretold);
        assert!(ratio.is_some_and(|ratio| (0.6..1.7).contains(&ratio)), "{}: {ratio:?}", cause.cause);
    }
}
