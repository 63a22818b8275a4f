//! The page that says which cause would be taken for which: it speaks of every cause, and short recordings say the same.

use std::collections::BTreeSet;

use host_tests::confusion::cases::{Amount, ConfusionCase, Layout, Motion, cases};
use host_tests::confusion::page::{ReadCause, read_table, written};
use host_tests::golden::path;
use model_core::effects::EffectKind;
use model_core::effects::card::Card;
use model_core::plant::robot::Nominal;

/// Nearest rivals at smaller angles than this are looked for in short recordings [°]
const NEAR_DEG: f64 = 10.0;
/// By how much the angle may differ there [°]: fewer rows, and other noise in the starts.
const APART_DEG: f64 = 3.0;

fn golden(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap_or_else(|why| panic!("{name}: {why}: cargo xtask confusion makes it"))
}

#[test]
fn every_table_and_every_picture_has_every_cause_that_acts_on_voltages_by_itself() {
    let page = golden("confusion.md");
    let cards: Vec<&Card> = EffectKind::ALL.iter().map(|effect| effect.card()).collect();
    let (still, acting): (Vec<&Card>, Vec<&Card>) =
        cards.into_iter().partition(|card| card.of_speed_drive() || card.physics.shows_beside.is_some());
    for card in still {
        assert!(page.contains(&format!("`{}`", card.id)), "{}: the page does not say why it is not there", card.id);
    }
    let numbers = Nominal::ALL.iter().map(|nominal| nominal.cause());
    let causes: BTreeSet<&str> = acting.into_iter().map(|card| card.id).chain(numbers).collect();
    for case in cases() {
        let table = read_table(&page, case);
        let standing: BTreeSet<&str> = table.iter().map(ReadCause::id).collect();
        assert_eq!(standing, causes, "{}: cargo xtask confusion makes it again", case.title());
        let picture = golden(&case.picture());
        for id in &causes {
            // once a column, and at least once a row
            assert!(picture.matches(&format!(">{id}")).count() >= 2, "{}: {id}", case.picture());
        }
    }
}

#[test]
fn short_recordings_have_the_same_nearest_rivals_at_small_angles() {
    let case = ConfusionCase { layout: Layout::Plus, motion: Motion::AllAxes };
    let short = case.confusion(Amount { pieces: 2, duration: 4.0 }).expect("a sound robot file");
    let table = read_table(&golden("confusion.md"), case);
    let mut looked_at = 0;
    for row in table.iter().filter(|row| row.nearest.first().is_some_and(|(_, angle)| *angle < NEAR_DEG)) {
        let now = short.causes.iter().find(|cause| written(cause) == row.name);
        // on which wheel an effect shows least can change with the recordings
        let Some(now) = now else { continue };
        let (nearest, angle) = &row.nearest[0];
        assert_eq!(now.others[0].cause, nearest, "{}", row.name);
        let angle_now = now.others[0].angle_rad.to_degrees();
        assert!((angle_now - angle).abs() < APART_DEG, "{}: {angle_now}° and not {angle}°", row.name);
        looked_at += 1;
    }
    assert!(looked_at >= 3, "{looked_at} rows of the page have a rival below {NEAR_DEG}°");
}
