//! The ledger: what was scored on splits that nobody can have tuned on, line by line, and never rewritten.

use super::figures::{Figure, calibration, figure, median_of, share};
use super::honest::{Contestants, closable, percent};
use super::scored::Scored;
use super::set::About;
use super::table::macro_recall;

/// What stands above the lines.
const HEAD: &str = "# Ledger of fresh splits\n\n\
    One line for each contestant on each split whose seed is a commit, in the order in which they were scored; lines are added\n\
    and never changed. The figures are those of `cargo xtask bench score`, over all suites, with intervals of 95 of 100.\n\n\
    | commit | seed | contestant | sessions | right | another named | macro recall | false alarms | probability of the truth \
    | calibration error | of what the true model closes |\n\
    |---|---|---|---|---|---|---|---|---|---|---|\n";

/// The split whose seed is a commit.
const FRESH: &str = "fresh";

/// The ledger with a line more for each contestant.
///
/// # Errors
/// Why there can be none, in words: of a split that anybody may tune on, and of what is there already.
pub fn added(ledger: &str, about: &About, contestants: &Contestants) -> Result<String, String> {
    if about.split != FRESH {
        return Err(format!("a split that is {} is no fresh one: it proves nothing", about.split));
    }
    let mut text = if ledger.is_empty() { HEAD.to_owned() } else { ledger.to_owned() };
    for (name, all) in contestants {
        let key = format!("| {} | {:016x} | {name} |", about.commit, about.seed);
        if text.contains(&key) {
            return Err(format!("{name} stands there already, on the split of {}", about.commit));
        }
        text += &format!("{key} {} | {} |\n", all.len(), figures(all).join(" | "));
    }
    Ok(text)
}

fn figures(all: &[Scored]) -> [String; 7] {
    let stated: Vec<_> = all.iter().filter_map(Scored::stated).collect();
    let closed = |one: &Scored| one.closed.as_ref()?.share();
    let of: [Option<Figure>; 7] = [
        share(all, |one| Some(one.right())),
        share(all, |one| Some(one.names_another())),
        macro_recall(all),
        share(all, Scored::false_alarm),
        figure(all, |one| Some(one.probability())),
        calibration(&stated),
        median_of(&closable(all), closed),
    ];
    of.map(percent)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::contestant::Ended;
    use super::super::label::{Label, Suite};
    use super::*;

    fn about(split: &str) -> About {
        About { split: split.to_owned(), seed: 10, commit: "abc".to_owned() }
    }

    /// Somebody who failed.
    fn failed(name: &str) -> (String, Vec<Scored>) {
        let label = Label {
            session: "s".to_owned(),
            suite: Suite::NoGap,
            seed: 0,
            hidden: Vec::new(),
            foreign: None,
            far_off: Vec::new(),
            about: BTreeMap::new(),
            truth: None,
            class: Vec::new(),
        };
        let ended = Ended { failed: Some("it crashed".to_owned()), seconds: 1.0, megabytes: 1.0 };
        (name.to_owned(), vec![Scored { label, ended, answer: None, closed: None }])
    }

    #[test]
    fn lines_are_added_once_and_those_above_stay() {
        let one = added("", &about("fresh"), &[failed("us")]).expect("a line");
        let two = added(&one, &about("fresh"), &[failed("them")]).expect("another");
        assert!(two.starts_with(&one) && two.len() > one.len());
        assert!(one.contains("| abc | 000000000000000a | us | 1 | 0 % (0–0) |"), "{one}");
        let again = added(&two, &about("fresh"), &[failed("us")]).expect_err("there already");
        assert!(again.contains("us stands there already"), "{again}");
        let columns = |line: &str| line.matches('|').count();
        let lines: Vec<&str> = two.lines().filter(|line| line.starts_with('|')).collect();
        assert!(lines.iter().all(|line| columns(line) == columns(lines[0])), "{two}");
    }

    #[test]
    fn a_split_that_anybody_may_tune_on_is_refused() {
        let why = added("", &about("tuning"), &[failed("us")]).expect_err("not fresh");
        assert!(why.contains("tuning is no fresh one"), "{why}");
    }
}
