//! The page that says which cause would be taken for which: it speaks of every cause, and short recordings say the same.

use std::collections::BTreeSet;

use host_tests::confusion::cases::{Amount, ConfusionCase, Layout, Motion, cases};
use host_tests::confusion::page::{ReadCause, read_table, written};
use host_tests::golden::path;
use model_core::effects::EffectKind;
use model_core::plant::robot::Nominal;

/// Nearest rivals at smaller angles than this are looked for in short recordings [°]
const SAME_DEG: f64 = 2.0;
/// How near those have to be there [°]: fewer rows, and other noise in the starts.
const STILL_NEAR_DEG: f64 = 5.0;

fn golden(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap_or_else(|why| panic!("{name}: {why}: cargo xtask confusion makes it"))
}

#[test]
fn every_table_and_every_picture_has_every_cause_that_acts_on_voltages() {
    let page = golden("confusion.md");
    let effects = EffectKind::ALL.iter().map(|effect| effect.card());
    let (still, acting): (Vec<_>, Vec<_>) = effects.partition(|card| card.of_speed_drive());
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
fn short_recordings_say_the_same_of_causes_that_are_nearly_one() {
    let case = ConfusionCase { layout: Layout::Plus, motion: Motion::AllAxes };
    let short = case.confusion(Amount { pieces: 2, duration: 4.0 }).expect("a sound robot file");
    let table = read_table(&golden("confusion.md"), case);
    let mut looked_at = 0;
    for row in table.iter().filter(|row| row.nearest.first().is_some_and(|(_, angle)| *angle < SAME_DEG)) {
        let now = short.causes.iter().find(|cause| written(cause) == row.name);
        // on which wheel an effect shows least can change with the recordings
        let Some(now) = now else { continue };
        let (nearest, _) = &row.nearest[0];
        let angle = now.others.iter().find(|other| other.cause == nearest).map(|other| other.angle_rad.to_degrees());
        assert!(angle.is_some_and(|angle| angle < STILL_NEAR_DEG), "{}: {nearest} is now at {angle:?}°", row.name);
        looked_at += 1;
    }
    assert!(looked_at >= 2, "nothing on the page is below {SAME_DEG}°");
}
