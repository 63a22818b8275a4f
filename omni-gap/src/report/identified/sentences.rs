//! The sentences below the tables: what is missing, what is known only together, the noise, what does not fit.

use super::symbol::symbol;
use crate::identify::{Answer, Apart, Identifiability, Moved, Power, Product, SensorNoise, Side, Together};
use crate::report::number::{NBSP, estimate, num, percent};

/// Powers that are said as such if one is this close.
const NICE: [f64; 6] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];
const CLOSE: f64 = 0.05;
/// A product is known if its relative uncertainty is not above this.
const KNOWN: f64 = 0.15;
/// What to try where the model lacks something.
const TRY: &str = "try omni-gap diagnose";

/// "feup-4w: 2 runs of experiment 1 (steady spin), 9 of experiment 2 (coast-down)"
pub(super) fn headline(answer: &Answer) -> String {
    let told = answer.runs.iter().enumerate().map(|(n, counted)| {
        let word = match (n, counted.runs) {
            (0, 1) => " run",
            (0, _) => " runs",
            _ => "",
        };
        format!("{}{word} of {}", counted.runs, the(counted.experiment))
    });
    format!("{}: {}", answer.robot, told.collect::<Vec<_>>().join(", "))
}

/// All sentences, each with its label.
pub(super) fn all(answer: &Answer) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    all.extend(
        answer
            .left_out
            .iter()
            .map(|l| ("left out", format!("of the fit of all runs: {} ({})", l.runs.join(", "), l.why))),
    );
    all.extend(missing(answer).map(|told| ("not logged", told)));
    all.extend(answer.guessed.iter().map(|g| {
        let (symbol, unit) = symbol(g.key);
        ("guessed", format!("{symbol} is zero in the file and began at a guess, {} {unit}", num(g.value)))
    }));
    all.extend(answer.trade_offs.iter().map(|t| ("together", trade_off(t))));
    all.push(("noise", noise(&answer.noise)));
    all.push(("fit", follows(answer)));
    // what it means is said once, at the end
    let last = answer.disagreements.len().saturating_sub(1);
    all.extend(answer.disagreements.iter().enumerate().map(|(n, d)| ("disagreed", disagreement(d, n == last))));
    all.extend(kept(answer).map(|told| ("kept", told)));
    let mut last = "";
    // a label is said once
    all.into_iter()
        .map(|(label, told)| (if std::mem::replace(&mut last, label) == label { "" } else { label }, told))
        .collect()
}

/// "no currents are logged; without them R and K_v are known only as a combination"
fn missing(answer: &Answer) -> Option<String> {
    if answer.not_logged.is_empty() {
        return None;
    }
    let unsure = by_word(answer, |word| word != Identifiability::Identified);
    let outcome = if unsure.is_empty() { "the other signals tell every number".to_owned() } else { unsure.join(", ") };
    Some(format!("no {} are logged; without them {outcome}", answer.not_logged.join(", no ")))
}

/// The numbers of each word: "B_v, C_v are not seen"
fn by_word(answer: &Answer, wanted: impl Fn(Identifiability) -> bool) -> Vec<String> {
    [Identifiability::Weak, Identifiability::Combined, Identifiability::AtBound, Identifiability::NotSeen]
        .into_iter()
        .filter(|word| wanted(*word))
        .filter_map(|word| {
            let names: Vec<&str> = answer.numbers.iter().filter(|n| n.word == word).map(|n| symbol(n.key).0).collect();
            let are = if names.len() == 1 { "is" } else { "are" };
            let known = if word == Identifiability::Combined { "known " } else { "" };
            (!names.is_empty()).then(|| format!("{} {are} {known}{}", names.join(", "), word.said()))
        })
        .collect()
}

fn trade_off(t: &Together) -> String {
    let names: Vec<&str> = t.moves.iter().map(|m| symbol(m.key).0).collect();
    match &t.known {
        Some(known) if known.std_relative <= KNOWN => {
            let (product, std) = product(known);
            format!("{} are known only together: {product} to {}", names.join(" and "), percent(std))
        }
        _ => {
            let moved = |m: &Moved| {
                let change = percent(0.01 * m.relative);
                let sign = if m.relative > 0.0 { "+" } else { "" };
                format!("{}{NBSP}{sign}{change}", symbol(m.key).0)
            };
            let moves: Vec<String> = t.moves.iter().map(moved).collect();
            format!(
                "these move together unseen: {} ({} is uncertain by {} so)",
                moves.join(", "),
                names[0],
                percent(t.std_relative)
            )
        }
    }
}

/// "R/K_v²", and how sure it is; a power that is not nice stands at the number that counts less.
fn product(Product { powers: [a, b], std_relative }: &Product) -> (String, f64) {
    let nice = |x: f64| NICE.into_iter().find(|n| (x - n).abs() <= CLOSE).unwrap_or(x);
    if nice(b.power) == b.power && b.power.abs() > 1.0 && !NICE.contains(&b.power) {
        let turned = [Power { power: 1.0, ..*b }, Power { power: a.power / b.power, ..*a }];
        return product(&Product { powers: turned, std_relative: std_relative / b.power.abs() });
    }
    let powered = |p: &Power| {
        let name = symbol(p.key).0;
        match nice(p.power).abs() {
            1.0 => name.to_owned(),
            2.0 => format!("{name}²"),
            0.5 => format!("√{name}"),
            other => format!("{name}^{other:.2}"),
        }
    };
    (format!("{}{}{}", powered(a), if b.power < 0.0 { "/" } else { "·" }, powered(b)), *std_relative)
}

fn noise(all: &[SensorNoise]) -> String {
    let one = |n: &SensorNoise| {
        let (name, unit) = match n.key {
            "current_noise_A" => ("current", "A"),
            "wheel_speed_noise_rad_s" => ("wheel speed", "rad/s"),
            "position_noise_m" => ("position", "m"),
            _ => ("heading", "rad"),
        };
        let alike = match n.correlation_time_s {
            0.0 => String::new(),
            time => format!(", alike over {time:.2}{NBSP}s"),
        };
        format!("{name} {}{NBSP}{unit} (file: {}{NBSP}{unit}){alike}", num(n.found), num(n.stated))
    };
    all.iter().map(one).collect::<Vec<_>>().join("; ")
}

fn follows(answer: &Answer) -> String {
    let times = num(answer.misfit);
    match answer.follows {
        true => format!("the model follows whole runs to within their noise (error {times} of it)"),
        false => {
            format!("the model cannot follow whole runs ({times} times the noise): something is missing in it, {TRY}")
        }
    }
}

fn disagreement(d: &Apart, last: bool) -> String {
    let meaning =
        if last { format!(", which is a sign of an effect that the model lacks; {TRY}") } else { String::new() };
    let (name, unit) = symbol(d.key);
    let value = |side: &Side| estimate(side.value.value, side.value.std, unit);
    let [one, other] = &d.sides;
    format!(
        "{} says {name} {}, {} {}: they disagree by {:.0}{NBSP}σ{meaning}",
        the(one.by),
        value(one),
        the(other.by),
        value(other),
        d.sigmas
    )
}

/// "the motor experiment"
fn the(title: &str) -> String {
    if title.starts_with("motor") { format!("the {title}") } else { title.to_owned() }
}

/// "J is not seen: the file that is written keeps its value"
fn kept(answer: &Answer) -> Option<String> {
    let kept = by_word(answer, |word| !word.is_known());
    (!kept.is_empty()).then(|| format!("{}: the file that is written keeps what it had", kept.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_said_nicely_where_they_are_nearly_nice() {
        let of = |a: f64, b: f64| {
            let powers = [Power { key: "resistance_ohm", power: a }, Power { key: "emf_constant_V_s", power: b }];
            product(&Product { powers, std_relative: 0.08 }).0
        };
        assert_eq!(of(1.0, -0.97), "R/K_v");
        assert_eq!(of(1.0, 2.04), "R·K_v²");
        assert_eq!(of(1.0, -0.5), "R/√K_v");
        assert_eq!(of(1.0, -0.3), "R/K_v^0.30");
        assert_eq!(of(1.0, 4.0), "K_v·R^0.25");
    }
}
