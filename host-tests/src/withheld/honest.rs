//! How sure contestants are and how far they come: tables beside those of the suites.

use std::fmt::Write;

use omni_gap::report::num;

use super::estimates::Estimated;
use super::figures::{Figure, auroc, calibration, calibration_error_of_chance, figure, median_of, of_sample, share};
use super::scored::Scored;
use super::selective::{accuracy_at, area_of_risk, false_at_95};

const FITS: &str = "a string takes any text";

/// Contestants by their names, and what they answered.
pub type Contestants = [(String, Vec<Scored>)];

/// A figure with two digits behind the point.
fn plain(figure: Option<Figure>) -> String {
    figure.map_or("–".to_owned(), |of| format!("{:.2} ({:.2}–{:.2})", of.mean, of.within.0, of.within.1))
}

/// A figure as a share of a hundred.
pub fn percent(figure: Option<Figure>) -> String {
    figure.map_or("–".to_owned(), |Figure { mean, within: (low, high), .. }| {
        format!("{:.0} % ({:.0}–{:.0})", 100.0 * mean, 100.0 * low, 100.0 * high)
    })
}

/// A table with a row a contestant.
fn table(
    text: &mut String,
    title: &str,
    words: &str,
    heads: &[&str],
    rows: impl Iterator<Item = (String, Vec<String>)>,
) {
    writeln!(text, "\n## {title}\n\n{words}\n\n| contestant | {} |", heads.join(" | ")).expect(FITS);
    writeln!(text, "|---|{}", "---|".repeat(heads.len())).expect(FITS);
    for (name, cells) in rows {
        writeln!(text, "| {name} | {} |", cells.join(" | ")).expect(FITS);
    }
}

/// All of them.
pub fn honest(text: &mut String, contestants: &Contestants) {
    how_sure(text, contestants);
    when_silent(text, contestants);
    how_far(text, contestants);
    numbers(text, contestants);
    in_pairs(text, contestants);
}

fn how_sure(text: &mut String, contestants: &Contestants) {
    let row = |(name, all): &(String, Vec<Scored>)| {
        let stated: Vec<_> = all.iter().filter_map(Scored::stated).collect();
        let (off, chance) = (calibration(&stated), calibration_error_of_chance(&stated));
        let beyond = off.map_or("–".to_owned(), |off| format!("{:.2}", off.mean - chance));
        // a truth that is given no chance at all costs as much as one in a thousand
        let loss = figure(all, |one| Some(-one.probability().max(1e-3).ln()));
        let brier = figure(all, |one| Some(one.brier()));
        (name.clone(), vec![plain(off), format!("{chance:.2}"), beyond, plain(brier), plain(loss)])
    };
    let words = "The calibration error is that of what each holds most likely, over 15 bins of equal numbers; of chance is what\n\
                 one who is calibrated perfectly gets of as many answers. The Brier score is the sum over all that was considered.";
    let heads = ["calibration error", "of chance", "beyond chance", "Brier score", "log-loss of the truth"];
    table(text, "How sure", words, &heads, contestants.iter().map(row));
}

fn when_silent(text: &mut String, contestants: &Contestants) {
    let row = |(name, all): &(String, Vec<Scored>)| {
        let sure: Vec<_> = all.iter().map(Scored::sure).collect();
        let unknown: Vec<_> = all.iter().filter_map(Scored::unknown).collect();
        let right = |part: f64| percent(accuracy_at(&sure, part));
        let area = plain(area_of_risk(&sure));
        (
            name.clone(),
            vec![right(0.8), right(0.9), right(1.0), area, plain(auroc(&unknown)), percent(false_at_95(&unknown))],
        )
    };
    let words = "Right among the surest 80, 90 and 100 of 100 answers, and the area under the curve of what is wrong among the\n\
                 surest (AURC; less is better). `unknown` against single causes that can be seen: the area under the receiver's\n\
                 curve, and the share of these that is taken for `unknown` where 95 of 100 of what no entry describes are (FPR95).";
    let heads = ["of 80", "of 90", "of all", "AURC", "AUROC of `unknown`", "FPR95 of `unknown`"];
    table(text, "When to be silent", words, &heads, contestants.iter().map(row));
}

/// Median and interval of an error [σ].
fn sigmas(figure: Option<Figure>) -> String {
    figure.map_or("–".to_owned(), |of| format!("{} ({}–{})", num(of.mean), num(of.within.0), num(of.within.1)))
}

/// Sessions of which the true model closes something, and whose laws are the catalogue's.
pub fn closable(all: &[Scored]) -> Vec<Scored> {
    let exact = |one: &&Scored| one.label.truth.as_ref().is_some_and(|truth| truth.own_laws.is_empty());
    let closes = |one: &&Scored| one.closed.as_ref().is_some_and(|closed| closed.share().is_some());
    let hides = |one: &&Scored| !one.label.hidden.is_empty();
    all.iter().filter(exact).filter(closes).filter(hides).cloned().collect()
}

fn how_far(text: &mut String, contestants: &Contestants) {
    if contestants.iter().all(|(_, all)| closable(all).is_empty()) {
        return;
    }
    let before = |all: &[Scored]| sigmas(median_of(all, |one| Some(one.closed.as_ref()?.before)));
    let of_truth = contestants.iter().map(|(name, all)| (name, closable(all))).max_by_key(|(_, all)| all.len());
    let oracle = of_truth.map(|(_, all)| {
        let after = sigmas(median_of(&all, |one| one.closed.as_ref()?.truth));
        let cells =
            vec![all.len().to_string(), before(&all), after, "100 %".to_owned(), "–".to_owned(), "–".to_owned()];
        ("*the true model*".to_owned(), cells)
    });
    let row = |(name, all): &(String, Vec<Scored>)| {
        let all = closable(all);
        let of = |one: &Scored| one.closed.clone();
        let after = sigmas(median_of(&all, |one| Some(of(one)?.after)));
        let closed = percent(median_of(&all, |one| of(one)?.share()));
        let most = percent(share(&all, |one| Some(of(one)?.share()? >= 0.95)));
        // where no cause is named, a claim is about a re-fit, of which no file is left
        let named = |one: &Scored| one.answer.as_ref().is_some_and(|answer| !answer.causes.is_empty());
        let claims = percent(share(&all, |one| if named(one) { of(one)?.claim_holds() } else { None }));
        (name.clone(), vec![all.len().to_string(), before(&all), after, closed, most, claims])
    };
    let words = "Free runs of half a second, driven by the scorer itself: under the robot file that was given, under the corrected one\n\
                 (the given one where there is none), and under the true model. Medians over sessions with a hidden cause of which\n\
                 the true model closes at least 0.1 σ, causes whose law the recording simulator has of its own left out. A claim\n\
                 of a report that names a cause is true where its own `closed` is within five points of what was found.";
    let heads =
        ["sessions", "before [σ]", "after [σ]", "of what the true model closes", "95 of 100 or more", "claims true"];
    table(text, "How far the gap shrinks", words, &heads, oracle.into_iter().chain(contestants.iter().map(row)));
}

fn numbers(text: &mut String, contestants: &Contestants) {
    let of = |all: &[Scored]| -> Vec<Estimated> { all.iter().flat_map(Scored::estimates).collect() };
    if contestants.iter().all(|(_, all)| of(all).is_empty()) {
        return;
    }
    let row = |(name, all): &(String, Vec<Scored>)| {
        let all = of(all);
        let off = |effect: bool| percent(median_of(&all, |one| (one.effect == effect).then_some(one.off)));
        let covered: Vec<bool> = all.iter().flat_map(|one| &one.covered).copied().collect();
        let count = |effect: bool| all.iter().filter(|one| one.effect == effect).count().to_string();
        let within = percent(share(&covered, |is| Some(*is)));
        (name.clone(), vec![count(true), off(true), count(false), off(false), covered.len().to_string(), within])
    };
    let words = "Of causes that were named rightly: by how much their numbers are off (an effect's, of what parts it from doing\n\
                 nothing; a robot's own, of the number), medians; and how often the truth lies within a stated 90 % interval.";
    let heads = ["effects", "off by", "robot's numbers", "off by", "intervals", "that hold the truth"];
    table(text, "Their numbers", words, &heads, contestants.iter().map(row));
}

/// What another answered better or worse than the first, on the sessions that both were asked.
fn in_pairs(text: &mut String, contestants: &Contestants) {
    let [(first, ours), others @ ..] = contestants else { return };
    if others.is_empty() {
        return;
    }
    let row = |(name, all): &(String, Vec<Scored>)| {
        let pairs = paired(ours, all);
        let right = difference(&pairs, |one| Some(f64::from(u8::from(one.right()))));
        let truth = difference(&pairs, |one| Some(one.probability()));
        let closed = difference(&pairs, |one| one.closed.as_ref()?.share().map(|share| share.clamp(-1.0, 1.0)));
        (name.clone(), vec![pairs.len().to_string(), percent(right), percent(truth), percent(closed)])
    };
    let words = format!(
        "What each has more than *{first}*, session by session, in points: an interval that leaves out zero is a difference.\n\
         What is closed is held within ± 100 % of what the true model closes."
    );
    let heads = ["sessions of both", "right", "probability of the truth", "closed"];
    table(text, "In pairs", &words, &heads, others.iter().map(row));
}

/// Answers to the same sessions.
pub fn paired<'a>(ours: &'a [Scored], theirs: &'a [Scored]) -> Vec<(&'a Scored, &'a Scored)> {
    let same = |one: &&Scored, session: &str| one.label.session == session;
    ours.iter().filter_map(|a| Some((a, theirs.iter().find(|b| same(b, &a.label.session))?))).collect()
}

/// The mean of what the second of each pair has more, its interval by drawing pairs.
pub fn difference(pairs: &[(&Scored, &Scored)], of: impl Fn(&Scored) -> Option<f64>) -> Option<Figure> {
    let all: Vec<f64> = pairs.iter().filter_map(|(a, b)| Some(of(b)? - of(a)?)).collect();
    of_sample(&all, |sample| sample.iter().sum::<f64>() / sample.len() as f64)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::answer::Answer;
    use super::super::closed::Closed;
    use super::super::contestant::Ended;
    use super::super::label::{Hidden, Label, Suite};
    use super::super::true_model::TrueModel;
    use super::*;

    /// A session that hides `creep`, answered with a probability of it, and a gap of 5 σ of which 1 σ is left at the best.
    fn scored(session: &str, probability: f64, after: f64, own_laws: &[&str]) -> Scored {
        let own_laws = own_laws.iter().map(|id| (*id).to_owned()).collect();
        let label = Label {
            session: session.to_owned(),
            suite: Suite::Laboratory,
            seed: 0,
            hidden: vec![Hidden { cause: "creep".to_owned(), wheel: None, times: 1.0, gap: 5.0 }],
            foreign: None,
            far_off: Vec::new(),
            about: BTreeMap::new(),
            truth: Some(TrueModel { robot: String::new(), own_laws, out_of_bounds: Vec::new() }),
            class: Vec::new(),
        };
        let (first, rest) = (if probability > 0.5 { "creep" } else { "backlash" }, 1.0 - probability);
        let said = format!(
            r#"{{"verdict": "effect", "causes": ["{first}"], "which": [{{"cause": "creep", "probability": {probability}}},
            {{"cause": "backlash", "probability": {rest}}}]}}"#
        );
        let closed = Closed { runs: 1, before: 5.0, after, truth: Some(1.0), claimed: Some(0.75), note: None };
        Scored {
            label,
            ended: Ended { failed: None, seconds: 1.0, megabytes: 1.0 },
            answer: Some(Answer::parse(&said).expect("a good answer")),
            closed: Some(closed),
        }
    }

    #[test]
    fn contestants_are_compared_on_what_both_were_asked() {
        let ours = [scored("a", 0.9, 2.0, &[]), scored("b", 0.2, 5.0, &[]), scored("c", 0.9, 1.0, &[])];
        let theirs = [scored("b", 0.8, 1.0, &[]), scored("a", 0.6, 1.0, &[]), scored("d", 0.1, 1.0, &[])];
        let pairs = paired(&ours, &theirs);
        assert_eq!(pairs.len(), 2);
        // −0.3 of a, +0.6 of b
        let found = difference(&pairs, |one| Some(one.probability())).expect("pairs");
        assert!((found.mean - 0.15).abs() < 1e-12 && found.count == 2, "{found:?}");
        let right = difference(&pairs, |one| Some(f64::from(u8::from(one.right())))).expect("pairs");
        assert_eq!((right.mean, right.within), (0.5, (0.0, 1.0)));
    }

    #[test]
    fn what_is_closed_is_a_median_of_what_the_true_model_could() {
        // three quarters, nothing, all, and one of another law
        let all = [
            scored("a", 0.9, 2.0, &[]),
            scored("b", 0.9, 5.0, &[]),
            scored("c", 0.9, 1.0, &[]),
            scored("d", 0.9, 0.5, &["creep"]),
        ];
        assert_eq!(closable(&all).len(), 3);
        let mut text = String::new();
        how_far(&mut text, &[("us".to_owned(), all.to_vec())]);
        let row = text.lines().find(|line| line.starts_with("| us")).expect("a row");
        assert!(
            row.starts_with("| us | 3 | 5.00") && row.contains("| 75 % (0–100) | 33 % (0–100) | 33 % (0–100) |"),
            "{row}"
        );
    }
}
