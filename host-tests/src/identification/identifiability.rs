//! What the fit says where it cannot tell everything: words, trade-offs, refusals.

use omni_gap::identify::{IDENTIFIED, Identifiability, Refused, TradeOff};

use super::joint_fit::{FittedNumber, JointAnswer};
use super::missing_group::MissingGroup;
use super::no_excitation::NoExcitation;
use super::prior::symbol;
use super::significant_figures::{percent, two_figures};

/// In the order in which they are told.
const WORDS: [Identifiability; 5] = [
    Identifiability::Identified,
    Identifiability::Weak,
    Identifiability::Combined,
    Identifiability::NotSeen,
    Identifiability::AtBound,
];

const fn word(word: Identifiability) -> &'static str {
    match word {
        Identifiability::Identified => "identified",
        Identifiability::Weak => "weak",
        Identifiability::Combined => "combined",
        Identifiability::AtBound => "at bound",
        Identifiability::NotSeen => "not seen",
    }
}

const fn refused(why: Refused) -> &'static str {
    match why {
        Refused::NothingMeasured => "refused: nothing was measured that a model could be compared with",
        Refused::NothingMoves => "refused: nothing moves enough to show a number above the noise",
    }
}

fn head(first: &str) -> String {
    let symbols: Vec<&str> = IDENTIFIED.iter().map(|p| symbol(*p)).collect();
    format!("| {first} | wheels | {} |\n|---|---|{}\n", symbols.join(" | "), "---|".repeat(symbols.len()))
}

/// What is said of each number with a group missing.
pub fn words(missing: &[MissingGroup]) -> String {
    let mut text = head("missing");
    for m in missing {
        let cells = IDENTIFIED.iter().enumerate().map(|(k, _)| said(m, k)).collect::<Vec<_>>();
        text += &format!("| {} | {} | {} |\n", m.group.word(), m.wheels, cells.join(" | "));
    }
    text
}

/// The words that a number gets, with how often where they differ; in the first place the largest error of those that are
/// called identified.
fn said(m: &MissingGroup, k: usize) -> String {
    let numbers: Vec<FittedNumber> = m.answers.iter().flatten().map(|a| a.numbers[k]).collect();
    let mut parts = Vec::new();
    for kind in WORDS {
        let those: Vec<&FittedNumber> = numbers.iter().filter(|t| t.word == kind).collect();
        if those.is_empty() {
            continue;
        }
        let often = if those.len() == numbers.len() { String::new() } else { format!("{} × ", those.len()) };
        let error = if kind == Identifiability::Identified {
            let largest = |of: &dyn Fn(&FittedNumber) -> f64| those.iter().map(|t| of(t)).fold(0.0, f64::max);
            let (error, off) = (largest(&|t| (t.factor - 1.0).abs()), largest(&FittedNumber::off));
            format!(" {} % ({off:.1} σ)", percent(error))
        } else {
            String::new()
        };
        parts.push(format!("{often}{}{error}", word(kind)));
    }
    let none = m.answers.iter().filter(|a| a.is_err()).count();
    if none > 0 {
        parts.push(format!("{none} × refused"));
    }
    parts.join("; ")
}

/// What could move together, as the first trial says it.
pub fn together(missing: &[MissingGroup]) -> String {
    let lines: Vec<String> = missing
        .iter()
        .filter_map(|m| {
            let first = m.answers.iter().flatten().next()?;
            if first.trade_offs.is_empty() {
                return None;
            }
            Some(format!("- without {}, {} wheels: {}\n", m.group.word(), m.wheels, trade_offs(first)))
        })
        .collect();
    if lines.is_empty() { "- nothing\n".to_owned() } else { lines.concat() }
}

fn trade_offs(answer: &JointAnswer) -> String {
    answer.trade_offs.iter().map(trade_off).collect::<Vec<_>>().join("; ")
}

fn trade_off(t: &TradeOff) -> String {
    let moves: Vec<String> = t.moves.iter().map(|(p, by)| format!("{} by {}", symbol(*p), two_figures(*by))).collect();
    let known = t.known.map_or(String::new(), |([(a, _), (b, power)], std)| {
        format!(", but {}·{}^({}) is known to {} %", symbol(a), symbol(b), two_figures(power), percent(std))
    });
    format!("{} move together (the first uncertain by {} %){known}", moves.join(", "), percent(t.std))
}

/// What is said of recordings without excitation.
pub fn idle(idle: &[NoExcitation]) -> String {
    let mut text = "| the robot | sensors | wheels | seeds | answer |\n|---|---|---|---|---|\n".to_owned();
    for i in idle {
        let mut answers: Vec<(String, usize)> = Vec::new();
        for answer in i.answers.iter().map(answer) {
            match answers.iter_mut().find(|(known, _)| *known == answer) {
                Some((_, often)) => *often += 1,
                None => answers.push((answer, 1)),
            }
        }
        let often = |n: usize| if n == i.answers.len() { String::new() } else { format!("{n} × ") };
        let texts: Vec<String> = answers.iter().map(|(answer, n)| format!("{}{answer}", often(*n))).collect();
        let off =
            i.answers.iter().flatten().flat_map(JointAnswer::identified).map(FittedNumber::off).fold(0.0, f64::max);
        let within =
            if off > 0.0 { format!("; what is identified is within {off:.1} σ of the truth") } else { String::new() };
        text += &format!(
            "| {} | {} | {} | {} | {}{within} |\n",
            i.missing.does(),
            i.sensing.word(),
            i.wheels,
            i.answers.len(),
            texts.join("; or ")
        );
    }
    text
}

fn answer(answer: &Result<JointAnswer, Refused>) -> String {
    let fitted = match answer {
        Err(why) => return refused(*why).to_owned(),
        Ok(fitted) => fitted,
    };
    let mut parts = Vec::new();
    for kind in WORDS {
        let those = IDENTIFIED.iter().zip(&fitted.numbers).filter(|(_, number)| number.word == kind);
        let names: Vec<&str> = those.map(|(p, _)| symbol(*p)).collect();
        if !names.is_empty() {
            parts.push(format!("{} {}", word(kind), names.join(", ")));
        }
    }
    parts.join("; ")
}
