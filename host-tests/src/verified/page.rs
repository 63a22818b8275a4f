//! The page: how many sizes agree, which do not, then every cause of every robot.

use std::fmt::Write;

use omni_gap::api::SelfTest;
use omni_gap::engine::findings::{SeenCause, ShownThere};
use omni_gap::report::{Kind, num};

use crate::confusion::cases::{CAMERA, Layout, RATE, WHOLE};

/// Two sizes agree where neither is more than this many times the other [1].
pub const AGREES: f64 = 1.5;

/// What is found at no more than this multiple of the typical size is found at the least that is looked at [1].
const LEAST_TIMES: f64 = 1.001e-3;
/// A model with the true cause that leaves more than this share of the error does not know its law [1].
const LEAVES: f64 = 0.25;
/// A gain of which more than this part was stated is one of numbers that imitate [1].
const STATES: f64 = 0.25;

/// A robot, and what was foretold and found of its causes.
pub type Verified = (Layout, SelfTest);

/// The whole page.
pub fn page(all: &[Verified]) -> String {
    let mut text = opening();
    text += &counts(all);
    text += &apart(all);
    for (layout, said) in all {
        text += &table(*layout, said);
    }
    text
}

fn opening() -> String {
    format!(
        "# Sizes that are foretold, and sizes that are found\n\n\
         `omni-gap selftest` foretells from what size on recordings show a cause: from how the cause moves a simulated recording,\n\
         less what the windows' starts and the robot's own numbers can imitate of that, along a straight line. With `--verify` it\n\
         looks for the same size in recordings: a robot that has the cause is simulated with whole laws, in steps ten times finer\n\
         than a row, the plain model and the model with the cause are fitted to two thirds of the runs and judged on the last\n\
         third by the engine's own hand, and the size is searched at which the engine would take the cause up. Those recordings\n\
         have no noise and are judged by the sensors' sigmas: over seeds of noise, the size found in them is the median.\n\n\
         The paper's robots and the one with four wheels turned by 45°, {} runs of {} s of random motion on all axes at {RATE} rows\n\
         a second, with currents, wheel speeds and a camera of {CAMERA} frames a second. An effect on one wheel sits where it shows\n\
         least.\n\n\
         `cargo xtask selftest` makes this page again and compares it with this one; BLESS=1 rewrites it.\n\n",
        WHOLE.pieces, WHOLE.duration,
    )
}

/// The size that is foretold and the one that is found, as multiples of the typical one; none where none is within bounds.
fn both(cause: &SeenCause) -> (Option<f64>, Option<f64>) {
    let found = cause.verified.and_then(|size| size.from.and(size.times));
    (cause.seen_from.and(cause.seen_times), found)
}

/// The size found over the one foretold [1]; none where one of them is not within bounds.
fn ratio(cause: &SeenCause) -> Option<f64> {
    let (foretold, found) = both(cause);
    Some(found? / foretold?)
}

/// True if both are the same to within [`AGREES`].
fn agrees(ratio: f64) -> bool {
    (1.0 / AGREES..=AGREES).contains(&ratio)
}

fn counts(all: &[Verified]) -> String {
    let mut text = format!(
        "## Counts\n\n\
         Both are within the bounds of the cause's number; they agree where neither is more than {AGREES} times the other.\n\n\
         | robot | causes | both within bounds | of these agree | within 1.1 | neither within bounds | only foretold | only found |\n\
         |---|---|---|---|---|---|---|---|\n"
    );
    let mut line = |title: &str, causes: &[&SeenCause]| {
        let count = |is: &dyn Fn(&SeenCause) -> bool| causes.iter().filter(|cause| is(cause)).count();
        let ratio_is = |is: &dyn Fn(f64) -> bool| count(&|cause| ratio(cause).is_some_and(is));
        let with =
            |foretold: bool, found: bool| count(&|c| both(c).0.is_some() == foretold && both(c).1.is_some() == found);
        let _ = writeln!(
            text,
            "| {title} | {} | {} | {} | {} | {} | {} | {} |",
            causes.len(),
            with(true, true),
            ratio_is(&agrees),
            ratio_is(&|ratio| (1.0 / 1.1..=1.1).contains(&ratio)),
            with(false, false),
            with(true, false),
            with(false, true),
        );
    };
    for (layout, said) in all {
        line(layout.title(), &said.causes.iter().collect::<Vec<_>>());
    }
    line("all", &all.iter().flat_map(|(_, said)| &said.causes).collect::<Vec<_>>());
    text
}

/// The causes whose sizes do not agree, with what recordings show at the size found.
fn apart(all: &[Verified]) -> String {
    let mut text = String::from(
        "\n## Where they do not agree\n\n\
         Measured at the size that is found: `left`, the share of the plain model's error that the model with the cause leaves,\n\
         since the diagnosis takes one step where the simulator takes ten; `stated`, the part of its gain that is what was stated\n\
         of the robot's numbers and not what was measured; `held out`, the error of a run that is held out over that of a run to\n\
         fit on, where the self-test takes all runs for alike; `taken`, the share that the cause takes off one channel, of which\n\
         the engine asks 1 % of an effect.\n\n\
         | robot | cause | found/foretold | left | stated | held out | taken | reason |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (layout, said) in all {
        for cause in said.causes.iter().filter(|cause| !agree(cause)) {
            let there = cause.verified.and_then(|size| size.there);
            let cells = there.map_or("– | – | – | –".to_owned(), |there| {
                let [left, stated, taken] = [there.left, stated_part(&there), there.taken].map(|x| num(100.0 * x));
                format!("{left} % | {stated} % | {} | {taken} %", num(there.held_out))
            });
            let _ = writeln!(
                text,
                "| {} | {} | {} | {cells} | {} |",
                layout.title(),
                name(cause),
                ratio(cause).map_or("–".to_owned(), num),
                reason(cause)
            );
        }
    }
    text
}

/// True if both sizes agree, or neither is within bounds.
fn agree(cause: &SeenCause) -> bool {
    ratio(cause).map_or(both(cause) == (None, None), agrees)
}

/// The error of a run that is held out over that of any run [1]; one run in three is.
fn held_out_over_all(there: &ShownThere) -> f64 {
    3.0 * there.held_out / (2.0 + there.held_out)
}

/// The part of a gain that is what was stated [1].
fn stated_part(there: &ShownThere) -> f64 {
    there.stated / there.gain
}

/// Why the size that is found is another than the one that is foretold, as far as it was measured.
fn reason(cause: &SeenCause) -> &'static str {
    let Some((times, there)) = cause.verified.and_then(|size| Some((size.times?, size.there?))) else {
        return "found nowhere within its bounds";
    };
    let evenly = ratio(cause).map(|ratio| ratio * held_out_over_all(&there).sqrt());
    if times <= LEAST_TIMES {
        "seen at the least size that is looked at: a law with a step where it is absent"
    } else if there.left > LEAVES {
        "even the true law leaves much: for the diagnosis's own time steps, or since a record tells only a part of it"
    } else if stated_part(&there) > STATES {
        "numbers imitate it along a curve, nearly whole: no straight line leads there"
    } else if evenly.is_some_and(agrees) {
        "the runs that are held out show more or less of it than the others, and with as much as these it agrees"
    } else {
        "not known"
    }
}

/// A cause with its place.
fn name(cause: &SeenCause) -> String {
    match (cause.axis, cause.wheel) {
        (Some(axis), _) => format!("`{}` ({})", cause.cause, axis.symbol()),
        (None, Some(wheel)) => format!("`{}` (wheel {wheel})", cause.cause),
        (None, None) => format!("`{}`", cause.cause),
    }
}

/// A size in its unit.
fn size(x: f64, cause: &SeenCause) -> String {
    match (cause.kind, cause.unit) {
        (Kind::Parameter, _) => format!("{} %", num(100.0 * x)),
        (_, "1") => num(x),
        (_, unit) => format!("{} {unit}", num(x)),
    }
}

/// What heads a table's columns.
const HEADS: &str = "| cause | typical | foretold | found | found/foretold |";

fn table(layout: Layout, said: &SelfTest) -> String {
    let mut text = format!("\n## {}\n\n{} numbers.\n\n{HEADS}\n|---|---|---|---|---|\n", layout.title(), said.numbers);
    for cause in &said.causes {
        let from = |x: Option<f64>| {
            x.map_or("not within bounds".to_owned(), |x| {
                format!("{}{}", if cause.shows_below { "up to " } else { "" }, size(x, cause))
            })
        };
        let ratio = ratio(cause).map_or("–".to_owned(), |ratio| match agrees(ratio) {
            true => format!("{ratio:.2}"),
            false => format!("**{}**", num(ratio)),
        });
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {ratio} |",
            name(cause),
            size(cause.typical, cause),
            from(cause.seen_from),
            from(cause.verified.and_then(|size| size.from)),
        );
    }
    text
}

/// A line of a robot's table that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadSize {
    /// The cause with its place, as it stands.
    pub name: String,
    /// The size found over the one foretold [1]; none where one of them is not within bounds.
    pub ratio: Option<f64>,
}

impl ReadSize {
    /// Its id.
    pub fn id(&self) -> &str {
        self.name.split('`').nth(1).unwrap_or_default()
    }

    /// True if both sizes are within bounds and agree.
    pub fn agrees(&self) -> bool {
        self.ratio.is_some_and(agrees)
    }
}

/// The table of a robot, as it stands on a page.
pub fn read_table(page: &str, layout: Layout) -> Vec<ReadSize> {
    let head = format!("## {}", layout.title());
    let section = page.lines().skip_while(|line| *line != head).skip(1).take_while(|line| !line.starts_with("## "));
    let cells = section.map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    let row = |cells: Vec<&str>| {
        let [name, _, _, _, ratio] = cells[..] else { return None };
        let ratio = ratio.trim_matches('*').replace('−', "-").parse().ok();
        name.starts_with('`').then(|| ReadSize { name: name.to_owned(), ratio })
    };
    cells.filter_map(row).collect()
}

/// How many sizes of a robot, or of `all`, the page counts as within bounds, and how many of these as the same.
pub fn read_counts(page: &str, title: &str) -> Option<(usize, usize)> {
    let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    let row = rows.into_iter().find(|cells| cells.len() == 8 && cells[0] == title)?;
    Some((row[2].parse().ok()?, row[3].parse().ok()?))
}
