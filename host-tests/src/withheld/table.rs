//! The table: contestants beside one another, suite by suite, each figure with its interval.

use std::fmt::Write;

use model_core::effects::card::Stage;
use omni_gap::error::{Error, Result};
use omni_gap::report::num;

use super::answer::Answer;
use super::closed::Closed;
use super::contestant::{Contestant, Ended};
use super::figures::{Figure, figure, macro_share, share};
use super::honest::{honest, percent as as_percent};
use super::label::{Label, Severity, Suite};
use super::picture::answered;
use super::scored::{Scored, stage_of};
use super::set::{About, SetFolder};

/// All that a contestant answered, in the order of the labels; a session that it was not asked is no failure, and no row.
///
/// # Errors
/// Where the set is not sealed, or not any more what it was, or nobody answered under this name.
pub fn scored(set: &SetFolder, contestant: &str) -> Result<Vec<Scored>> {
    let of = |label: Label| {
        let ended: Ended = Contestant::ended(contestant, set, &label.session)?;
        let report = set.answers(contestant).join(&label.session).join("report.json");
        let text = std::fs::read_to_string(report).ok();
        let answer = if ended.failed.is_some() { None } else { text.and_then(|text| Answer::parse(&text).ok()) };
        let closed = Closed::of(set, contestant, &label.session);
        Some(Scored { label, ended, answer, closed })
    };
    let all: Vec<Scored> = set.labels()?.into_iter().filter_map(of).collect();
    if all.is_empty() {
        let place = set.answers(contestant);
        return Err(Error::input(&place, "nobody has answered under this name", "Run it first: cargo xtask bench run"));
    }
    Ok(all)
}

/// One column of the table.
struct Column {
    /// Its heading.
    name: &'static str,
    /// What stands in it.
    of: fn(&[Scored]) -> Option<Figure>,
    /// Its numbers are shares of 1.
    percent: bool,
}

const fn percent(name: &'static str, of: fn(&[Scored]) -> Option<Figure>) -> Column {
    Column { name, of, percent: true }
}

const fn plain(name: &'static str, of: fn(&[Scored]) -> Option<Figure>) -> Column {
    Column { name, of, percent: false }
}

const COLUMNS: [Column; 17] = [
    percent("right", |all| share(all, |one| Some(one.right()))),
    percent("right, classes as one", |all| by_class(all, |one| Some(one.right_by_class()))),
    percent("macro recall", macro_recall),
    percent("another named", |all| share(all, |one| Some(one.names_another()))),
    percent("in the set", |all| share(all, Scored::in_set)),
    percent("in the set, classes as one", |all| by_class(all, Scored::in_set_by_class)),
    plain("causes in it", |all| figure(all, Scored::set_size)),
    percent("among three", |all| share(all, Scored::in_three)),
    percent("of several, named", |all| figure(all, Scored::recall)),
    percent("stage", |all| share(all, Scored::stage_right)),
    percent("wheel", |all| share(all, Scored::wheel_right)),
    percent("false alarms", |all| share(all, Scored::false_alarm)),
    percent("probability of the truth", |all| figure(all, |one| Some(one.probability()))),
    percent("failed", |all| share(all, |one| Some(one.answer.is_none()))),
    plain("time [s]", |all| figure(all, |one| Some(one.ended.seconds))),
    plain("longest [s]", |all| most(all, |one| one.ended.seconds)),
    plain("memory [MB]", |all| most(all, |one| one.ended.megabytes)),
];

/// Where some label has a class.
fn by_class(all: &[Scored], of: fn(&Scored) -> Option<bool>) -> Option<Figure> {
    let some = all.iter().any(|one| !one.label.class.is_empty());
    some.then(|| share(all, of))?
}

/// Single causes that can be seen, each cause as much as any other.
pub(super) fn macro_recall(all: &[Scored]) -> Option<Figure> {
    let mut causes: Vec<&str> = all.iter().filter_map(Scored::cause).collect();
    causes.sort_unstable();
    causes.dedup();
    let of = |one: &Scored| Some((causes.binary_search(&one.cause()?).ok()?, one.right()));
    let pairs: Vec<(usize, bool)> = all.iter().filter_map(of).collect();
    macro_share(&pairs)
}

/// The most of all: no draw of sessions says how much more there could be.
fn most(all: &[Scored], of: fn(&Scored) -> f64) -> Option<Figure> {
    let most = all.iter().map(of).max_by(f64::total_cmp)?;
    Some(Figure { mean: most, within: (most, most), count: all.len() })
}

fn cell(column: &Column, all: &[Scored]) -> String {
    let Some(Figure { mean, within: (low, high), count }) = (column.of)(all) else { return "–".to_owned() };
    if column.percent {
        as_percent(Some(Figure { mean, within: (low, high), count }))
    } else if low == high {
        num(mean)
    } else {
        format!("{} ({}–{})", num(mean), num(low), num(high))
    }
}

/// The whole page of contestants and what they answered.
pub fn page(about: &About, contestants: &[(String, Vec<Scored>)]) -> String {
    let mut text = format!(
        "# The effect withheld\n\n\
         Recordings of a second simulator, which shares no line with the one that the diagnosis is made of; robots, sensors and\n\
         drives drawn; a robot file that is wrong by what it states. What is hidden was sealed before anybody answered\n\
         (`BENCHMARK.md` has the rules). Split *{}*, seed {:016x}, recorded at commit {}.\n\n\
         *Right*: the hidden cause first, on its wheel; all of several; `unknown` of what no entry describes; `no_gap` of nothing,\n\
         and of a cause that no size within bounds makes visible. *Another named*: the first cause is none of the hidden ones.\n\
         *Macro recall*: how often single causes are right, each cause as much as any other. *Memory* and *longest* are the most\n\
         that a session took. Figures about single causes leave out the invisible ones. Intervals are those of the bootstrap, 95 of 100.\n",
        about.split, about.seed, about.commit
    );
    let of_suites = Suite::ALL.into_iter().map(|suite| (suite.name().to_owned(), Which::Suite(suite)));
    let of_severity =
        [Severity::Invisible, Severity::Weak, Severity::Medium, Severity::Strong].into_iter().map(|severity| {
            (format!("{severity:?}").to_lowercase() + " causes of laboratory and life", Which::Severity(severity))
        });
    let of_stage = Stage::ALL.into_iter().map(|stage| (format!("{} causes", stage.name()), Which::Stage(stage.name())));
    let of_sensors = SENSORS.into_iter().map(|(key, title)| (format!("life without {title}"), Which::Without(key)));
    let all = std::iter::once(("all".to_owned(), Which::All));
    for (title, which) in all.chain(of_suites).chain(of_severity).chain(of_stage).chain(of_sensors) {
        section(&mut text, &title, which, contestants);
    }
    honest(&mut text, contestants);
    if let Some((name, all)) = contestants.first() {
        text += &by_cause(name, all);
    }
    text
}

const FITS: &str = "a string takes any text";

/// Sessions of a section.
#[derive(Clone, Copy)]
enum Which {
    All,
    Suite(Suite),
    Severity(Severity),
    /// Single causes of a stage that can be seen.
    Stage(&'static str),
    /// Logs as robots leave them, of which these signals are missing.
    Without(&'static str),
}

/// Signals that some logs lack: as labels call them, and as people do.
const SENSORS: [(&str, &str); 3] = [("currents", "currents"), ("wheel_speeds", "wheel speeds"), ("pose", "pose")];

impl Which {
    fn has(self, one: &Scored) -> bool {
        match self {
            Which::All => true,
            Which::Suite(suite) => one.of(suite),
            Which::Stage(stage) => one.cause().and_then(stage_of) == Some(stage),
            Which::Without(key) => {
                one.of(Suite::Life) && one.label.about.get(key).is_some_and(|logged| logged == "false")
            }
            Which::Severity(severity) => {
                let drawn = one.of(Suite::Laboratory) || one.of(Suite::Life);
                drawn && one.single() && one.label.severity() == Some(severity)
            }
        }
    }
}

fn section(text: &mut String, title: &str, which: Which, contestants: &[(String, Vec<Scored>)]) {
    let of: Vec<(&str, Vec<Scored>)> = contestants
        .iter()
        .map(|(name, all)| (name.as_str(), all.iter().filter(|one| which.has(one)).cloned().collect()))
        .collect();
    let shown: Vec<&Column> =
        COLUMNS.iter().filter(|column| of.iter().any(|(_, all)| (column.of)(all).is_some())).collect();
    if shown.is_empty() {
        return;
    }
    let heads: Vec<&str> = shown.iter().map(|column| column.name).collect();
    writeln!(text, "\n## {title}\n\n| contestant | sessions | {} |", heads.join(" | ")).expect(FITS);
    writeln!(text, "|---|---|{}", "---|".repeat(shown.len())).expect(FITS);
    for (name, all) in of {
        let cells: Vec<String> = shown.iter().map(|column| cell(column, &all)).collect();
        writeln!(text, "| {name} | {} | {} |", all.len(), cells.join(" | ")).expect(FITS);
    }
}

/// What became of each cause, of one contestant.
fn by_cause(name: &str, all: &[Scored]) -> String {
    let mut text = format!("\n## Each cause, {name}\n\nSingle causes that can be seen, of all suites.\n\n");
    text += "| cause | stage | sessions | first | named with the first | most often answered instead |\n|---|---|---|---|---|---|\n";
    let mut causes: Vec<&str> =
        all.iter().flat_map(|one| &one.label.hidden).map(|hidden| hidden.cause.as_str()).collect();
    causes.sort_unstable();
    causes.dedup();
    for cause in causes {
        let of: Vec<&Scored> =
            all.iter().filter(|one| one.in_set().is_some() && one.label.hidden[0].cause == cause).collect();
        if of.is_empty() {
            continue;
        }
        let right = of.iter().filter(|one| one.right()).count();
        let named = of.iter().filter(|one| !one.right() && one.in_set() == Some(true)).count();
        let mut instead: Vec<String> = of.iter().filter(|one| !one.right()).map(|one| answered(one)).collect();
        instead.sort_unstable();
        let most = instead.chunk_by(|a, b| a == b).max_by_key(|same| same.len());
        let most = most.map_or("–".to_owned(), |same| format!("`{}` × {}", same[0], same.len()));
        let stage = stage_of(cause).unwrap_or("–");
        writeln!(text, "| `{cause}` | {stage} | {} | {right} | {named} | {most} |", of.len()).expect(FITS);
    }
    text
}
