//! The page: counts first, then what the cards say of look-alikes, then every cause's nearest rivals.

use std::collections::BTreeMap;
use std::fmt::Write;

use model_core::effects::EffectKind;
use omni_gap::api::Confusion;
use omni_gap::engine::findings::{ConfusedCause, Rival};
use omni_gap::report::num;

use super::cases::{CAMERA, ConfusionCase, Layout, Motion, RATE, WHOLE};
use super::pairs::{Pair, angles, numbers_in, smallest, stated};

/// Pairs are counted below these angles [°]
const NEAR_DEG: [f64; 3] = [5.0, 15.0, 30.0];
/// A pair of look-alikes that a card states is doubted beyond this angle [°]
const DOUBTED_DEG: f64 = 45.0;
/// A pair that no card states is told below this angle [°]
const UNSTATED_DEG: f64 = 10.0;
/// A cause that moves recordings by less than this has no angles: what is left of it is noise in the starts, and rounding [σ]
pub const LEAST_SIGMA: f64 = 0.1;
/// Rivals in a line.
const RIVALS: usize = 3;

/// A case and what came of it.
pub type Confused = (ConfusionCase, Confusion);

/// The whole page.
pub fn page(all: &[Confused]) -> String {
    let mut text = opening(all);
    text += &counts(all);
    text += &look_alikes(all);
    for (case, confusion) in all {
        text += &table(*case, confusion);
    }
    text
}

fn opening(all: &[Confused]) -> String {
    let still: Vec<String> = EffectKind::ALL
        .iter()
        .filter(|effect| all.iter().all(|(_, c)| c.causes.iter().all(|cause| cause.cause != effect.id())))
        .map(|effect| format!("`{}`", effect.id()))
        .collect();
    format!(
        "# Which cause would be taken for which\n\n\
         Every cause at its typical size (a number of the robot file: wrong by 10 %) moves recordings by its signature. What the\n\
         windows' starts and the nominal numbers, within what the robot file states of them, can imitate of it is taken away;\n\
         between what is left of two causes there is an angle. At 0° no recording of this kind tells them apart, at 90° they have\n\
         nothing in common. The angle from a cause to a rival is that to the nearest that the rival's free numbers can make, so\n\
         it is not quite the same the other way round. It is the self-test's own (`omni-gap selftest`), on the paper's robots and\n\
         on the one with four wheels turned by 45°; {} runs of {} s at {RATE} rows a second, with currents, wheel speeds and a\n\
         camera of {CAMERA} frames a second: random motion on all axes at once, or the same steps along v, then along vn, then\n\
         about ω, alone. Voltages are commanded; what acts on set speeds or beside another effect alone has no\n\
         signature there: {}.\n\n\
         A number that is wrong by no more than what is stated of it is taken away nearly whole, and few numbers are seen at\n\
         10 %. What it shares with an effect is taken away with it: between an effect and a number the angle is wide, and says\n\
         how they differ beyond what is stated.\n\n\
         `cargo xtask confusion` makes this page and its pictures again, and compares them with these; BLESS=1 rewrites them.\n\n",
        WHOLE.pieces,
        WHOLE.duration,
        still.join(", "),
    )
}

fn counts(all: &[Confused]) -> String {
    let mut text = "## Counts\n\n\
        A cause is seen if a diagnosis of such recordings would find something, and named if it is told from every other too. A\n\
        pair has the smaller of its two angles, counted where its cause is seen.\n\n\
        | robot and motion | causes | seen | named | pairs below 5° | below 15° | below 30° |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for (case, confusion) in all {
        let causes = &confusion.causes;
        let angles = angles(confusion);
        let below = NEAR_DEG.map(|near| angles.values().filter(|angle| angle.to_degrees() < near).count().to_string());
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            case.title(),
            causes.len(),
            causes.iter().filter(|cause| cause.seen).count(),
            causes.iter().filter(|cause| cause.is_named()).count(),
            below.join(" | ")
        );
    }
    text
}

fn look_alikes(all: &[Confused]) -> String {
    let (everywhere, stated) = (smallest(all.iter().map(|(_, confusion)| confusion)), stated());
    let on_four = |case: &ConfusionCase| case.motion == Motion::AllAxes && case.layout != Layout::Three;
    let rich = smallest(all.iter().filter(|(case, _)| on_four(case)).map(|(_, confusion)| confusion));
    let of = |angles: &BTreeMap<Pair, f64>, which: &dyn Fn(&Pair, f64) -> bool| {
        let mut found: Vec<(Pair, f64)> = angles.iter().map(|(pair, angle)| (*pair, angle.to_degrees())).collect();
        found.retain(|(pair, angle)| which(pair, *angle));
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        let said = found.iter().map(|((a, b), angle)| format!("- `{a}`, `{b}`: {}\n", degrees(*angle)));
        if found.is_empty() { "- none\n".to_owned() } else { said.collect() }
    };
    let unseen: Vec<String> =
        stated.iter().filter(|pair| !everywhere.contains_key(pair)).map(|(a, b)| format!("`{a}` and `{b}`")).collect();
    let doubted = |pair: &Pair, angle: f64| angle > DOUBTED_DEG && stated.contains(pair);
    let unstated = |pair: &Pair, angle: f64| angle < UNSTATED_DEG && !stated.contains(pair);
    format!(
        "\n## Look-alikes that the cards state\n\n\
         Two effects, stated, and beyond {DOUBTED_DEG}° in every table below (the smallest angle of all): the cards are wrong, or\n\
         speak of another motion, of other sensors or of sizes far from the typical ones.\n\n{}\n\
         The same of an effect and a number of the robot file; what is stated of the number has already taken what they share:\n\n{}\n\
         Stated, and not compared, since neither is seen at its typical size in any table, or one has no signature there: {}.\n\n\
         Below {UNSTATED_DEG}° on four wheels, + or X, driven on all axes at once, and stated on no card:\n\n{}\n\
         The same of two numbers of the robot file, which have no look-alikes on their cards:\n\n{}",
        of(&everywhere, &|pair, angle| doubted(pair, angle) && numbers_in(pair) == 0),
        of(&everywhere, &|pair, angle| doubted(pair, angle) && numbers_in(pair) > 0),
        if unseen.is_empty() { "none".to_owned() } else { unseen.join(", ") },
        of(&rich, &|pair, angle| unstated(pair, angle) && numbers_in(pair) < 2),
        of(&rich, &|pair, angle| unstated(pair, angle) && numbers_in(pair) == 2),
    )
}

/// What heads a table's columns, after the cause.
const HEADS: &str = "moves by | seen | nearest rivals";

fn table(case: ConfusionCase, confusion: &Confusion) -> String {
    let mut text = format!(
        "\n## {}\n\n\
         {} numbers. **Bold**: not told apart at the typical size.\n\n\
         ![angles]({})\n\n\
         | cause | {HEADS} |\n|---|---|---|---|\n",
        title(case),
        confusion.numbers,
        case.picture()
    );
    for cause in &confusion.causes {
        let nearest: Vec<String> = cause.others.iter().take(RIVALS).map(rival).collect();
        let (sigma, nearest) = match cause.sigma >= LEAST_SIGMA {
            true => (num(cause.sigma), nearest.join(", ")),
            false => (format!("below {LEAST_SIGMA}"), "–".to_owned()),
        };
        let seen = if cause.seen { "yes" } else { "no" };
        let _ = writeln!(text, "| {} | {sigma} σ | {seen} | {nearest} |", written(cause));
    }
    text
}

/// The title of a case's table.
fn title(case: ConfusionCase) -> String {
    let title = case.title();
    title[..1].to_uppercase() + &title[1..]
}

/// A cause as it stands in a table.
pub fn written(cause: &ConfusedCause) -> String {
    match (cause.axis, cause.wheel) {
        (Some(axis), _) => format!("`{}` ({})", cause.cause, axis.symbol()),
        (None, Some(wheel)) => format!("`{}` (wheel {wheel})", cause.cause),
        (None, None) => format!("`{}`", cause.cause),
    }
}

fn rival(rival: &Rival) -> String {
    let axis = rival.axis.map_or(String::new(), |axis| format!(" ({})", axis.symbol()));
    let text = format!("`{}`{axis} {}", rival.cause, degrees(rival.angle_rad.to_degrees()));
    if rival.is_told() { text } else { format!("**{text}**") }
}

/// An angle, in tenths where it is small.
fn degrees(angle: f64) -> String {
    if angle < 9.95 { format!("{angle:.1}°") } else { format!("{angle:.0}°") }
}

/// A line of a table that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadCause {
    /// The cause with its place, as it stands.
    pub name: String,
    /// Its nearest rivals by id, with their angles [°].
    pub nearest: Vec<(String, f64)>,
}

impl ReadCause {
    /// Its id.
    pub fn id(&self) -> &str {
        self.name.split('`').nth(1).unwrap_or_default()
    }
}

/// The table of a case, as it stands on a page.
pub fn read_table(page: &str, case: ConfusionCase) -> Vec<ReadCause> {
    let head = format!("## {}", title(case));
    let section = page.lines().skip_while(|line| *line != head).skip(1).take_while(|line| !line.starts_with("## "));
    section.filter_map(read_line).collect()
}

fn read_line(line: &str) -> Option<ReadCause> {
    let cells: Vec<&str> = line.strip_prefix('|')?.trim_end_matches('|').split('|').map(str::trim).collect();
    let [name, _, _, nearest] = cells[..] else { return None };
    let one = |text: &str| {
        let (id, angle) = text.trim_matches('*').strip_prefix('`')?.split_once('`')?;
        Some((id.to_owned(), angle.split(' ').next_back()?.trim_end_matches('°').parse().ok()?))
    };
    let nearest = nearest.split(", ").filter_map(one).collect();
    name.starts_with('`').then(|| ReadCause { name: name.to_owned(), nearest })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_read_as_it_was_written() {
        let line = "| `creep` (wheel 2) | 3.10 σ | no | **`mass` 0.4°**, `viscous_friction` (vn) 12° |";
        let read = read_line(line).unwrap();
        assert_eq!((read.id(), read.name.as_str()), ("creep", "`creep` (wheel 2)"));
        assert_eq!(read.nearest, [("mass".to_owned(), 0.4), ("viscous_friction".to_owned(), 12.0)]);
        assert_eq!(read_line("| cause | moves by | seen | nearest rivals |"), None);
    }
}
