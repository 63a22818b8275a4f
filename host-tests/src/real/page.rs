//! The page: what was recorded, what was answered, and whether a person believes it.

use std::fmt::Write;

use omni_gap::report::{Report, Which, estimate, num, percent};

use super::known::Known;
use super::score::{Score, row, scored};
use super::sessions::{RealSession, judged};
use crate::catalogue::page::{plain, word};

/// Causes below this probability are left out.
const WORTH_A_LINE: f64 = 0.05;

/// What stands between an effect and how little it would have moved the recordings.
const TOO_SMALL: &str = ": at its typical size";

const OPENING: &str = "# What the diagnosis says of real robots

Public recordings of three robots: a Festo Robotino v2 with three omni wheels (github.com/BrOleg5/research-wheel-slippage,
Apache licence 2.0), a small-size robot of RoboJackets with four (github.com/RoboJackets/robocup-firmware-data, Apache licence
2.0), and a kiwi robot built for a thesis (github.com/MaverickST/mobile-robot-estimation-suite, MIT licence). They are read
through the robot files and mappings in `examples/`; no code was made for them.

Nobody knows the truth of a real robot. But some of it was published by those who recorded it, and some can be measured in the
recordings without any model: that was written down (`host-tests/src/real/known/`, each line with its source) before an answer
was looked at, and every answer is scored by it. *Right*: a verdict, causes and a stage that may be, with all that have to be
there. *Partly*: some of that, and nothing impossible for sure. *Wrong*: the rest. Below each answer stands what a person
thinks of it.

Three robots prove little: this is an anecdote, told because the rest of the proof is of simulated robots.

`cargo xtask real FOLDER` makes this page again, where FOLDER holds the recordings as `robotino/`, `ssl2018/` and `kiwi2026/`.
";

const TABLE: &str = "
| recordings | answer | its probability | score | what speaks against it |
|---|---|---|---|---|
";

/// The whole page, of sessions and their answers.
///
/// # Errors
/// Where a file of what is known is not sound.
pub fn page(answered: &[(RealSession, Report)]) -> Result<String, String> {
    let mut table = TABLE.to_owned();
    let mut counts = [0; 3];
    let mut sure = 0;
    for (real, report) in answered {
        let scored = scored(&Known::read(real.known)?, report);
        counts[scored.score as usize] += 1;
        sure += usize::from(scored.is_wrong_and_sure());
        let [score, confidence, against] = row(&scored);
        let answer = answer(report);
        let _ = writeln!(table, "| {} | {answer} | {} | {score} | {against} |", real.title, plain(&confidence));
    }
    let [right, partly, wrong] = [Score::Right, Score::Partly, Score::Wrong].map(|score| counts[score as usize]);
    let _ = writeln!(table, "\n{right} right, {partly} partly, {wrong} wrong, of these {sure} sure of it.");
    let mut text = OPENING.to_owned() + &table;
    for (real, report) in answered {
        text += &section(real, report, &Known::read(real.known)?);
    }
    Ok(text)
}

/// The answer in a line, as a judgement names it: the verdict with its causes, or with the cause that came closest.
pub fn answer(report: &Report) -> String {
    let verdict = word(report.verdict);
    let closest = report.which.iter().find(|which| which.kind.is_some() && which.probability >= WORTH_A_LINE);
    match (report.causes.is_empty(), closest) {
        (false, _) => format!("{verdict}: {}", report.causes.join(", ")),
        (true, Some(closest)) => format!("{verdict}, closest: {}", closest.cause),
        (true, None) => verdict.to_owned(),
    }
}

/// What to say where the answer is another than the one that was judged.
pub fn warning(real: &RealSession, report: &Report) -> Option<String> {
    let (of, is) = (judged(real.judgement).0, answer(report));
    (of != is).then(|| format!("This was written of the answer \"{of}\"; the answer is now \"{is}\": judge it again."))
}

fn section(real: &RealSession, report: &Report, known: &Known) -> String {
    let mut text = format!("\n## {}\n\n", real.title);
    let mut line = |label: &str, said: &str| {
        let _ = writeln!(text, "- **{label}**: {}", plain(said));
    };
    line("recorded", &format!("{} (`{}`)", real.recorded, real.folder));
    known.known.iter().for_each(|fact| line("known", &format!("{} ({})", fact.what, fact.source)));
    known.changed.iter().for_each(|why| line("known, changed since", why));
    line("verdict", &format!("`{}`", word(report.verdict)));
    for place in &report.where_ {
        let wheel = place.wheel.map_or(String::new(), |wheel| format!(", wheel {wheel}"));
        let axis = place.axis.map_or(String::new(), |axis| format!(", axis {}", format!("{axis:?}").to_lowercase()));
        let regime = place.regime.as_ref();
        let regime = regime.map_or(String::new(), |r| format!("; {} of it where {}", percent(r.share), r.text));
        let stage = format!("{:?}", place.stage).to_lowercase();
        line("where", &format!("{stage}{wheel}{axis}: {}{regime}", percent(place.share)));
    }
    for which in report.which.iter().filter(|w| w.probability >= WORTH_A_LINE || report.causes.contains(&w.cause)) {
        line("which", &cause(which));
    }
    line("how far", &how_far(report));
    if let Some(numbers) = numbers(report) {
        line("numbers", &numbers);
    }
    let (small, missing): (Vec<&str>, Vec<&str>) =
        report.not_seen.iter().map(String::as_str).partition(|said| said.contains(TOO_SMALL));
    missing.iter().for_each(|said| line("not seen", said));
    if !small.is_empty() {
        let ids: Vec<String> =
            small.iter().filter_map(|said| Some(format!("`{}`", said.split_once(TOO_SMALL)?.0))).collect();
        line("not seen", &format!("too small here at their typical size: {}", ids.join(", ")));
    }
    for fault in &report.faults {
        let file = fault.file.as_ref().map_or(String::new(), |file| format!("{file}: "));
        line("fault", &format!("`{}`, {file}{}", fault.code, fault.what));
    }
    if !report.notices.is_empty() {
        line("notice", &report.notices.join("; "));
    }
    text += "\n**Is this to be believed?** ";
    if let Some(warning) = warning(real, report) {
        let _ = write!(text, "*{warning}* ");
    }
    text += judged(real.judgement).1;
    text.push('\n');
    text
}

fn cause(which: &Which) -> String {
    let mut said = format!("`{}`", which.cause);
    if let Some(wheel) = which.wheel {
        let _ = write!(said, " on wheel {wheel}");
    }
    let _ = write!(said, ", probability {}", percent(which.probability));
    let fitted = which.parameters.iter().filter(|(_, e)| e.std.is_some());
    let numbers: Vec<String> = fitted.map(|(key, e)| format!("`{key}` {}", estimate(e.value, e.std, ""))).collect();
    if !numbers.is_empty() {
        let _ = write!(said, "; {}", numbers.join(", "));
    }
    if !which.not_told_apart_from.is_empty() {
        let _ = write!(said, "; not told apart from {}", which.not_told_apart_from.join(", "));
    }
    if let Some(settle) = &which.settle_by {
        let _ = write!(said, "; settle it by: {settle}");
    }
    said
}

/// The robot file's numbers that the corrected model moves by more than is stated of them.
fn numbers(report: &Report) -> Option<String> {
    let moved: Vec<String> = report
        .parameters
        .iter()
        .filter_map(|p| {
            let (nominal, stated) = (p.nominal?, p.nominal_std?);
            let beyond = (p.corrected - nominal).abs() > stated;
            beyond.then(|| format!("`{}` {} instead of {}", p.key, estimate(p.corrected, p.std, ""), num(nominal)))
        })
        .collect();
    (!moved.is_empty()).then(|| format!("moved by more than is stated: {}", moved.join(", ")))
}

fn how_far(report: &Report) -> String {
    let s = &report.shrink;
    let sigmas = |x: Option<f64>| x.map_or("–".to_owned(), num);
    let mut said = format!("{} → {} σ, floor {}", sigmas(s.before), sigmas(s.after), sigmas(s.noise_floor));
    if let Some(closed) = s.closed {
        let _ = write!(said, ": {} closed", percent(closed));
    }
    if let Some(refit) = s.closed_by_refit_alone {
        let _ = write!(said, ", {} by re-fitting the numbers alone", percent(refit));
    }
    for (group, gap) in &report.gap.signals {
        let _ = write!(said, "; `{group}` {} → {}, floor {}", num(gap.before), num(gap.after), num(gap.noise_floor));
    }
    said
}
