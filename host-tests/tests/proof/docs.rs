//! The catalogue as a page for people, made from the cards.

use std::fmt::Write;

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Role, Scope, Undone};
use omni_gap::report::shown_in;

use crate::{golden, shown};

fn scope_of(card: &Card) -> &'static str {
    match card.scope {
        Scope::Robot => "the robot as a whole",
        Scope::Wheels => "all wheels alike, or one wheel",
        Scope::OneWheel => "one wheel",
    }
}

fn role(role: Role) -> &'static str {
    match role {
        Role::Size => "sizes it",
        Role::Shape => "shapes it",
        Role::Fixed => "held",
    }
}

/// A number as a person writes it.
fn number(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-3 {
        return format!("{x:e}");
    }
    let text = format!("{x:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn section(card: &Card) -> String {
    let mut page = String::new();
    let seams: Vec<String> = card.seams.iter().map(|seam| format!("{seam:?}").to_lowercase()).collect();
    let _ = writeln!(page, "## {} · `{}`\n", card.title, card.id);
    let _ = writeln!(page, "{}\n", card.summary);
    let _ = writeln!(page, "```text\n{}\n```\n", card.equation);
    let _ = writeln!(page, "{}\n", shown::picture_of(card.id));
    let _ = writeln!(page, "- stage: {} (seam: {})", card.stage().name(), seams.join(", "));
    let _ = writeln!(page, "- sits on: {}", scope_of(card));
    let _ = writeln!(page, "- shows in: {}", shown_in(card));
    let _ = writeln!(page, "- shows as: {}", card.signature);
    let _ = match card.undone {
        Undone::By(how) | Undone::Folded(how) => writeln!(page, "- the robot undoes it: {how}"),
        Undone::No(why) => writeln!(page, "- the robot cannot undo it: {why}"),
    };
    let _ = writeln!(page, "- source: {}\n", card.source);
    let _ = writeln!(page, "| parameter | symbol | unit | absent | typical | from | to | role |");
    let _ = writeln!(page, "|---|---|---|---|---|---|---|---|");
    for p in card.params {
        let [absent, typical, low, high] = [p.absent, p.typical, p.within.0, p.within.1].map(number);
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {absent} | {typical} | {low} | {high} | {} |",
            p.key,
            p.symbol,
            p.unit,
            role(p.role)
        );
    }
    if !card.look_alikes.is_empty() {
        let _ = writeln!(page, "\nLooks like:\n");
        for like in card.look_alikes {
            let _ = writeln!(page, "- `{}`: {}", like.with, like.settled_by);
        }
    }
    page
}

#[test]
fn a_source_is_nothing_that_only_we_have() {
    for kind in EffectKind::ALL {
        let source = kind.card().source;
        assert!(!source.contains("catalogue"), "{}: {source}", kind.card().id);
    }
}

#[test]
fn the_page_of_effects_is_made_from_the_cards() {
    let mut page = String::from("# The catalogue of effects\n\n");
    page += "What the plain model leaves out, in the order of the signal path. This page is made from the cards in\n";
    page += "`model-core/src/effects` by `host-tests/tests/proof/docs.rs`; `BLESS=1 cargo test -p host-tests` rewrites it.\n\n";
    page += "Each effect has a picture: the robot `feup-4w` drives a few seconds without the effect and with it, at its typical\n";
    page +=
        "size; shown is the signal in which that is most, in units of its sensor's noise. `omni-gap explain ID --out\n";
    page += "PICTURE.svg` draws the same.\n\n";
    page += "| effect | stage | sits on | parameters that size it |\n|---|---|---|---|\n";
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let sizes: Vec<_> =
            card.params.iter().filter(|p| p.role == Role::Size).map(|p| format!("`{}`", p.key)).collect();
        let sizes = if sizes.is_empty() { "none is fitted".to_string() } else { sizes.join(", ") };
        let _ = writeln!(page, "| `{}` | {} | {} | {sizes} |", card.id, card.stage().name(), scope_of(card));
    }
    page.push('\n');
    page += &shown::section();
    for effect in &EffectKind::ALL {
        page.push('\n');
        page += &section(effect.card());
    }
    golden::holds("effects.md", &page);
}

#[test]
fn numbers_are_written_as_people_write_them() {
    for (x, text) in [(0.0, "0"), (12.0, "12"), (0.0175, "0.0175"), (7.5e-5, "7.5e-5"), (-0.5, "-0.5")] {
        assert_eq!(number(x), text);
    }
}
