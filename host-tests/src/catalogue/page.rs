//! The page: the promises first, then what every session was answered, and how good its numbers are.
//!
//! It holds no time of day and no duration, so that the same program writes the same page.

use std::fmt::Write;

use omni_gap::report::{Verdict, estimate, num, percent};

use super::outcome::{BenchmarkOutcome, EstimatedNumber, Judgement, TOO_SMALL_A_SHARE, too_small};
use super::sessions::{FIRST_FURTHER_SEED, FIRST_SEED, FURTHER_WRONG_PARAMETERS, HiddenCause, WRONG_PARAMETERS};

/// Share of what the true model closes that the diagnosis has to close.
pub const ENOUGH_CLOSED: f64 = 0.8;

/// Something that was promised, and how far it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Promise {
    /// What was promised.
    pub what: String,
    /// Sessions that keep it.
    pub kept: usize,
    /// Sessions that it speaks of.
    pub of: usize,
    /// How many have to.
    pub least: usize,
}

/// What was promised of these sessions.
pub fn promises(outcomes: &[BenchmarkOutcome]) -> Vec<Promise> {
    let of = |kind: fn(&HiddenCause) -> bool| outcomes.iter().filter(move |o| kind(&o.case.hidden));
    let effect = |h: &HiddenCause| matches!(h, HiddenCause::Effect(_));
    let right = || of(effect).filter(|o| o.judged() != Judgement::Wrong);
    let closing = || right().filter_map(BenchmarkOutcome::closed_of_truth);
    let nothing = |h: &HiddenCause| *h == HiddenCause::Nothing;
    let wrong = |h: &HiddenCause| matches!(h, HiddenCause::Parameter(_));
    let promise = |what: &str, kept: usize, of: usize, least: usize| Promise { what: what.to_owned(), kept, of, least };
    vec![
        promise("the hidden effect first, or named in the set of the first", right().count(), of(effect).count(), 93),
        promise(
            "of these, closed at least 80 % of what the true model closes",
            closing().filter(|share| *share >= ENOUGH_CLOSED).count(),
            closing().count(),
            closing().count(),
        ),
        promise(
            "nothing hidden, answered `no_gap`",
            of(nothing).filter(|o| o.report.verdict == Verdict::NoGap).count(),
            of(nothing).count(),
            20,
        ),
        promise(
            "a wrong number, answered `parameter`",
            of(wrong).filter(|o| o.report.verdict == Verdict::Parameter).count(),
            of(wrong).count(),
            16,
        ),
    ]
}

/// The promises as they stand on a page.
pub fn read_promises(page: &str) -> Vec<Promise> {
    let rows = page.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [what, kept, of, least] = cells[..] else { return None };
        Some(Promise {
            what: what.to_owned(),
            kept: kept.parse().ok()?,
            of: of.parse().ok()?,
            least: least.parse().ok()?,
        })
    });
    rows.collect()
}

/// The whole page.
pub fn page(outcomes: &[BenchmarkOutcome]) -> String {
    let mut text = opening();
    text += "## What was promised\n\n";
    for (engine, outcomes) in by_engine(outcomes) {
        let _ = writeln!(text, "Engine `{engine}`:\n\n| | sessions that keep it | of | at least |\n|---|---|---|---|");
        for Promise { what, kept, of, least } in promises(&outcomes) {
            let _ = writeln!(text, "| {what} | {kept} | {of} | {least} |");
        }
        text += &aside(&outcomes);
    }
    text += &answers(outcomes);
    text += &gaps(outcomes);
    text += &numbers(outcomes);
    text
}

/// The outcomes of each engine, engines in the order in which they first stand.
pub fn by_engine(outcomes: &[BenchmarkOutcome]) -> Vec<(&str, Vec<BenchmarkOutcome>)> {
    let mut all: Vec<(&str, Vec<BenchmarkOutcome>)> = Vec::new();
    for o in outcomes {
        match all.iter_mut().find(|(engine, _)| *engine == o.engine) {
            Some((_, own)) => own.push(o.clone()),
            None => all.push((&o.engine, vec![o.clone()])),
        }
    }
    all
}

fn opening() -> String {
    let wrong: Vec<String> = WRONG_PARAMETERS
        .iter()
        .chain(&FURTHER_WRONG_PARAMETERS)
        .map(|w| format!("{w} (stated: {} at one sigma)", plain(&percent(w.stated))))
        .collect();
    format!(
        "# What the diagnosis finds where the truth is known\n\n\
         Every session is a robot of the paper, with three wheels or four, that is simulated with something that its robot\n\
         file does not say: one effect of the catalogue at its typical size, or nothing, or a number that is plainly wrong\n\
         (true value over the file's: {}). An effect that can only sit on one wheel\n\
         sits on wheel 1.\n\n\
         All have 10 runs of 6 s at 500 rows a second, white noise of the robot file's sigmas, a camera of 60 frames a second\n\
         that loses 3 % of them, and a plant that takes steps ten times finer than the diagnosis. Every nominal number is off\n\
         by a Gaussian draw of its stated uncertainty, also where nothing is hidden. The seeds count up from {FIRST_SEED} and,\n\
         for the sessions at the end, {FIRST_FURTHER_SEED} in the order of the tables; none was chosen by its result.\n\n\
         `cargo xtask benchmark` makes this page again, and prints how long each diagnosis takes.\n\n",
        wrong.join(", ")
    )
}

/// Counts that nobody promised.
fn aside(outcomes: &[BenchmarkOutcome]) -> String {
    let count = |kind: fn(&HiddenCause) -> bool, judged: Judgement| {
        outcomes.iter().filter(|o| kind(&o.case.hidden) && o.judged() == judged).count()
    };
    let effect = |h: &HiddenCause| matches!(h, HiddenCause::Effect(_));
    let wrong = |h: &HiddenCause| matches!(h, HiddenCause::Parameter(_));
    let offs: Vec<f64> = outcomes.iter().flat_map(|o| &o.numbers).filter_map(EstimatedNumber::off).collect();
    format!(
        "\nOf the effects {} stand first and {} are named in the set of the first; of the wrong numbers {} and {}. Of {}\n\
         fitted numbers of hidden causes {} lie within two of their own standard deviations of the truth (were they Gaussian:\n\
         95 %).\n",
        count(effect, Judgement::First),
        count(effect, Judgement::Named),
        count(wrong, Judgement::First),
        count(wrong, Judgement::Named),
        offs.len(),
        offs.iter().filter(|off| **off <= 2.0).count()
    )
}

fn answers(outcomes: &[BenchmarkOutcome]) -> String {
    let mut text = "\n## The answers\n\n\
        \"Right\" is `first` where the first cause is the hidden one (on its wheel), `named` where the hidden one is a member\n\
        of the set that the data cannot tell from the first, and **wrong** otherwise. The probability is the one that the\n\
        report gives to the truth: to the hidden cause, or to there being no gap.\n\n\
        | seed | wheels | hidden | verdict | causes | not told apart from the first | probability | right | engine |\n\
        |---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for o in outcomes {
        let causes: Vec<String> = o.report.causes.iter().map(|id| o.named(id)).collect();
        let _ = writeln!(
            text,
            "| {} | {} | {} | `{}` | {} | {} | {:.2} | {} | `{}` |",
            o.case.seed,
            o.case.wheels,
            o.case.hidden,
            word(o.report.verdict),
            listed(&causes),
            listed(&o.alike().iter().map(|id| format!("`{id}`")).collect::<Vec<_>>()),
            o.probability(),
            right(o.judged()),
            o.engine,
        );
    }
    text
}

fn gaps(outcomes: &[BenchmarkOutcome]) -> String {
    let mut text = format!(
        "\n## The gaps\n\n\
        Errors of free runs of 0.5 s over the runs held out, in sigmas of the sensors: with the session's robot file, with the\n\
        corrected one, and what noise alone gives. \"Closed\" is (before − after) over (before − floor); \"by the true model\" is\n\
        the same for a model with the true numbers and the hidden effect as it was simulated. \"Of that\" is (before − after) of\n\
        the diagnosis over that of the true model. A gap under {} σ is not divided by, nor, in the last two columns, one under {} of\n\
        what the true model leaves: robots that slip part by chance.\n\n\
        | wheels | hidden | before | after | floor | closed | by the true model | of that | engine |\n|---|---|---|---|---|---|---|---|---|\n",
        too_small(),
        percent(TOO_SMALL_A_SHARE),
    );
    let share = |x: Option<f64>| x.map_or("–".to_owned(), |x| plain(&percent(x)));
    let sigmas = |x: Option<f64>| x.map_or("–".to_owned(), num);
    for o in outcomes {
        let s = &o.report.shrink;
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | `{}` |",
            o.case.wheels,
            o.case.hidden,
            sigmas(s.before),
            sigmas(s.after),
            sigmas(s.noise_floor),
            share(s.closed),
            share(o.closed_by_truth()),
            share(o.closed_of_truth()),
            o.engine,
        );
    }
    if outcomes.iter().any(|o| !o.same_runs()) {
        text += "\nIn some sessions the report speaks of other runs than the true model was measured on: \"of that\" is then\n\
                 not to be trusted.\n";
    }
    text
}

fn numbers(outcomes: &[BenchmarkOutcome]) -> String {
    let mut text = "\n## The numbers\n\n\
        What the report says of the hidden cause's own numbers, one standard deviation with each; a number without one was\n\
        not fitted. \"Off\" is the distance to the truth in these deviations.\n\n\
        | wheels | hidden | number | truth | estimate | off | engine |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    for o in outcomes {
        for n in &o.numbers {
            let said = n.estimate.as_ref().map_or("–".to_owned(), |e| plain(&estimate(e.value, e.std, "")));
            let off = n.off().map_or("–".to_owned(), |off| format!("{off:.1}"));
            let _ = writeln!(
                text,
                "| {} | {} | `{}` | {} | {said} | {off} | `{}` |",
                o.case.wheels,
                o.case.hidden,
                n.key,
                num(n.truth),
                o.engine,
            );
        }
    }
    text
}

impl BenchmarkOutcome {
    /// A cause of the report, with its wheel.
    pub(super) fn named(&self, id: &str) -> String {
        match self.report.cause(id).and_then(|which| which.wheel) {
            Some(wheel) => format!("`{id}` on wheel {wheel}"),
            None => format!("`{id}`"),
        }
    }
}

/// How good an answer is, as it stands on a page.
pub fn right(judged: Judgement) -> &'static str {
    match judged {
        Judgement::First => "first",
        Judgement::Named => "named",
        Judgement::Wrong => "**wrong**",
    }
}

/// The verdict as `report.json` writes it.
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Effect => "effect",
        Verdict::Parameter => "parameter",
        Verdict::Unknown => "unknown",
        Verdict::NoGap => "no_gap",
        Verdict::UnfitData => "unfit_data",
    }
}

/// Names in a cell; a dash where there are none.
pub fn listed(names: &[String]) -> String {
    if names.is_empty() { "–".to_owned() } else { names.join(", ") }
}

/// A text with ordinary spaces.
pub fn plain(text: &str) -> String {
    text.replace('\u{a0}', " ")
}
