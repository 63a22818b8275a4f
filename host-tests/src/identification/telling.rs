//! What the fit says where it cannot tell everything: words, trade-offs, refusals.

use omni_gap::identify::{IDENTIFIED, Refused, TradeOff, Word};

use super::asked::{Answer, Told};
use super::believed::symbol;
use super::digits::{percent, two};
use super::idle::Idle;
use super::missing::Missing;

/// In the order in which they are told.
const WORDS: [Word; 5] = [Word::Identified, Word::Weak, Word::Combined, Word::NotSeen, Word::AtBound];

const fn word(word: Word) -> &'static str {
    match word {
        Word::Identified => "identified",
        Word::Weak => "weak",
        Word::Combined => "combined",
        Word::AtBound => "at bound",
        Word::NotSeen => "not seen",
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
pub fn words(missing: &[Missing]) -> String {
    let mut text = head("missing");
    for m in missing {
        let cells = IDENTIFIED.iter().enumerate().map(|(k, _)| said(m, k)).collect::<Vec<_>>();
        text += &format!("| {} | {} | {} |\n", m.group.word(), m.wheels, cells.join(" | "));
    }
    text
}

/// The words that a number gets, with how often where they differ; in the first place the largest error of those that are
/// called identified.
fn said(m: &Missing, k: usize) -> String {
    let told: Vec<Told> = m.answers.iter().flatten().map(|a| a.numbers[k]).collect();
    let mut parts = Vec::new();
    for kind in WORDS {
        let those: Vec<&Told> = told.iter().filter(|t| t.word == kind).collect();
        if those.is_empty() {
            continue;
        }
        let often = if those.len() == told.len() { String::new() } else { format!("{} × ", those.len()) };
        let error = if kind == Word::Identified {
            let largest = |of: &dyn Fn(&Told) -> f64| those.iter().map(|t| of(t)).fold(0.0, f64::max);
            let (error, off) = (largest(&|t| (t.factor - 1.0).abs()), largest(&Told::off));
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

/// What could move together, as the first morning says it.
pub fn together(missing: &[Missing]) -> String {
    let told: Vec<String> = missing
        .iter()
        .filter_map(|m| {
            let first = m.answers.iter().flatten().next()?;
            if first.trade_offs.is_empty() {
                return None;
            }
            Some(format!("- without {}, {} wheels: {}\n", m.group.word(), m.wheels, trade_offs(first)))
        })
        .collect();
    if told.is_empty() { "- nothing\n".to_owned() } else { told.concat() }
}

fn trade_offs(answer: &Answer) -> String {
    answer.trade_offs.iter().map(trade_off).collect::<Vec<_>>().join("; ")
}

fn trade_off(t: &TradeOff) -> String {
    let moves: Vec<String> = t.moves.iter().map(|(p, by)| format!("{} by {}", symbol(*p), two(*by))).collect();
    let known = t.known.map_or(String::new(), |([(a, _), (b, power)], std)| {
        format!(", but {}·{}^({}) is known to {} %", symbol(a), symbol(b), two(power), percent(std))
    });
    format!("{} move together (the first uncertain by {} %){known}", moves.join(", "), percent(t.std))
}

/// What is said of recordings without excitation.
pub fn idle(idle: &[Idle]) -> String {
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
        let told: Vec<String> = answers.iter().map(|(answer, n)| format!("{}{answer}", often(*n))).collect();
        let off = i.answers.iter().flatten().flat_map(Answer::identified).map(Told::off).fold(0.0, f64::max);
        let within =
            if off > 0.0 { format!("; what is identified is within {off:.1} σ of the truth") } else { String::new() };
        text += &format!(
            "| {} | {} | {} | {} | {}{within} |\n",
            i.lack.does(),
            i.sensing.word(),
            i.wheels,
            i.answers.len(),
            told.join("; or ")
        );
    }
    text
}

fn answer(answer: &Result<Answer, Refused>) -> String {
    let told = match answer {
        Err(why) => return refused(*why).to_owned(),
        Ok(told) => told,
    };
    let mut parts = Vec::new();
    for kind in WORDS {
        let those = IDENTIFIED.iter().zip(&told.numbers).filter(|(_, told)| told.word == kind);
        let names: Vec<&str> = those.map(|(p, _)| symbol(*p)).collect();
        if !names.is_empty() {
            parts.push(format!("{} {}", word(kind), names.join(", ")));
        }
    }
    parts.join("; ")
}
