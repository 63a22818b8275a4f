//! The sentences that terminal and page share. Each is made of fields of the report.

use std::borrow::Cow;

use super::model::Report;
use super::number::{NBSP, figures, num, percent};
use crate::engine::findings::{ChannelNoise, Corrected, SignalGap, Where, Which};
use crate::simulate::SignalGroup;
use crate::vocabulary::{Axis, Kind, Stage, Verdict};

/// The verdict as one sentence.
pub fn headline(report: &Report) -> String {
    match report.verdict {
        Verdict::Effect => {
            let (wrong, missing): (Vec<&Which>, Vec<&Which>) =
                report.named().into_iter().partition(|w| w.kind == Some(Kind::Parameter));
            let missing = format!("Missing from the simulator: {}.", named(report, &missing));
            if wrong.is_empty() { missing } else { format!("{missing} Also wrong: {}.", named(report, &wrong)) }
        }
        Verdict::Parameter => {
            format!("Wrong in the robot file: {}.", named(report, &report.named()))
        }
        Verdict::Unknown => {
            let lies = main_place(report).map(|w| format!(" It lies mostly in {}.", place(w))).unwrap_or_default();
            format!("There is a gap, and nothing in the catalogue explains it.{lies}")
        }
        Verdict::NoGap if numbers_tell(report) => {
            "No gap beyond what the robot file states of its own numbers: re-fitted within that, they predict these \
             runs as well as noise allows."
                .into()
        }
        Verdict::NoGap => {
            "No gap: the simulator predicts these runs as well as noise and stated uncertainty allow.".into()
        }
        Verdict::UnfitData => match report.faults.len() {
            1 => "This log is not fit for a diagnosis: mend one fault first.".into(),
            n => format!("This log is not fit for a diagnosis: mend {n} faults first."),
        },
    }
}

/// Which sensors are noisier, quieter or slower than is stated, in one sentence; none where all are as stated.
pub fn noise(report: &Report) -> Option<String> {
    let differs = |n: &&ChannelNoise| n.found != n.stated || n.correlation_time_s > 0.0;
    let of = |n: &ChannelNoise| {
        let memory = n.correlation_time_s;
        let alike = if memory > 0.0 { format!(", alike over {} ms", num(1e3 * memory)) } else { String::new() };
        let sensor = n.sensor.replace('_', " ");
        format!("{sensor} {}{NBSP}{} (file: {}{NBSP}{}){alike}", num(n.found), n.unit, num(n.stated), n.unit)
    };
    let all: Vec<String> = report.noise.iter().filter(differs).map(of).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// Which of the file's own numbers moved most where these alone, within what is stated of them, close what a reader would call a
/// gap; none elsewhere.
pub fn moved_numbers(report: &Report) -> Option<String> {
    if !numbers_tell(report) {
        return None;
    }
    let sigmas = |p: &Corrected| Some((p.corrected - p.nominal?) / p.nominal_std.filter(|std| *std > 0.0)?);
    let mut moved: Vec<(f64, &Corrected)> = report.parameters.iter().filter_map(|p| Some((sigmas(p)?, p))).collect();
    moved.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let of = |(sigmas, p): &(f64, &Corrected)| {
        let nominal = p.nominal.map(num).unwrap_or_default();
        let by = figures(sigmas.abs(), 2);
        format!("{} {nominal} → {}{NBSP}{} ({by} of its stated sigmas)", p.key, num(p.corrected), p.unit)
    };
    let most: Vec<String> = moved.iter().filter(|(sigmas, _)| sigmas.abs() > 1.0).take(3).map(of).collect();
    (!most.is_empty()).then(|| list(&most))
}

/// True where there is no gap, though the file as it stands predicts plainly worse than noise allows: its numbers close it.
fn numbers_tell(report: &Report) -> bool {
    let plainly = report.engine.as_ref().map_or(1.0, |engine| engine.knobs.outcome.inadequate);
    let shrink = &report.shrink;
    let worse = shrink.before.zip(shrink.noise_floor).is_some_and(|(before, floor)| before > plainly * floor);
    report.verdict == Verdict::NoGap && shrink.closed.is_some() && worse
}

/// Which signals beside the totals the answer leaves a gap in, as one sentence each.
pub fn left_beside(report: &Report) -> Vec<String> {
    let Some(engine) = &report.engine else { return Vec::new() };
    let open = |gap: &SignalGap| gap.after > engine.knobs.outcome.inadequate * gap.noise_floor;
    let beside = SignalGroup::ALL.into_iter().filter(|group| !group.in_totals());
    let gaps = beside.filter_map(|group| Some((group.name(), report.gap.signals.get(group.name())?)));
    gaps.filter(|(_, gap)| open(gap))
        .map(|(name, gap)| {
            let [before, after, floor] = [gap.before, gap.after, gap.noise_floor].map(num);
            format!("A gap stays in the {}: {before} → {after} σ, noise floor {floor}.", group(name))
        })
        .collect()
}

/// How the error changed, as one sentence; none where nothing was measured.
pub fn change(report: &Report) -> Option<String> {
    let s = &report.shrink;
    let before = s.before?;
    let floor = s.noise_floor.map(|f| format!("; noise alone gives {}", num(f))).unwrap_or_default();
    let closed = match (s.closed, &s.reason) {
        (Some(c), _) => format!(", so {} of the gap is closed", percent(c)),
        (None, Some(reason)) => format!(" ({reason})"),
        (None, None) => String::new(),
    };
    let after = s.after.filter(|_| report.verdict != Verdict::NoGap || numbers_tell(report));
    Some(match after {
        Some(after) => {
            format!(
                "The prediction error on held-out runs goes from {} to {} σ{floor}{closed}.",
                num(before),
                num(after)
            )
        }
        None => format!("The prediction error on held-out runs is {} σ{floor}{closed}.", num(before)),
    })
}

/// What a stage turns into what.
pub fn stage_path(stage: Stage) -> &'static str {
    match stage {
        Stage::Electrical => "voltage to current",
        Stage::Drivetrain => "current to wheel torque",
        Stage::Contact => "wheel to floor",
        Stage::Body => "force to motion",
        Stage::Sensing => "motion to reading",
    }
}

/// A body axis.
pub fn axis(axis: Axis) -> &'static str {
    match axis {
        Axis::V => "forward motion (v)",
        Axis::Vn => "sideways motion (vn)",
        Axis::W => "turning (w)",
    }
}

/// A signal group.
pub fn group(key: &str) -> &str {
    match key {
        "i" => "motor current",
        "w" => "wheel speed",
        "pose" => "pose",
        "gyro" => "yaw rate",
        "vbat" => "battery voltage",
        other => other,
    }
}

/// The verdict's name in a heading.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Effect => "effect",
        Verdict::Parameter => "parameter",
        Verdict::Unknown => "unknown",
        Verdict::NoGap => "no gap",
        Verdict::UnfitData => "unfit data",
    }
}

/// Stage, wheel and axis of an entry of `where`.
pub fn place(w: &Where) -> String {
    format!("the {} stage{}", w.stage.name(), spot(w.wheel, w.axis))
}

/// ", wheel 2" or ", turning (w)"; empty where neither is known.
pub fn spot(wheel: Option<usize>, on: Option<Axis>) -> String {
    let wheel = wheel.map(|j| format!(", wheel\u{a0}{j}")).unwrap_or_default();
    wheel + &on.map(|a| format!(", {}", axis(a))).unwrap_or_default()
}

/// The entry of `where` with the largest share.
pub fn main_place(report: &Report) -> Option<&Where> {
    report.where_.iter().max_by(|a, b| a.share.total_cmp(&b.share))
}

/// A cause's name for people: the title of its card, or its id in plain words.
pub fn title<'a>(report: &'a Report, id: &str) -> Cow<'a, str> {
    if let Some(title) = report.cause(id).and_then(|w| w.title.as_deref()) {
        return title.into();
    }
    match id {
        "unknown" => "Something outside the catalogue".into(),
        "no_gap" => "No gap".into(),
        _ => {
            let words = id.replace('_', " ");
            let mut letters = words.chars();
            letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>()).unwrap_or(words).into()
        }
    }
}

/// Causes that may be in the gap's place of this one, by name.
pub fn look_alikes(report: &Report, which: &Which) -> Option<String> {
    let names: Vec<_> = which.not_told_apart_from.iter().map(|id| title(report, id).into_owned()).collect();
    (!names.is_empty()).then(|| list(&names))
}

/// What further recordings settled of what a session alone left open.
pub fn settled(alone: &Report, together: &Report, names: &[&str]) -> String {
    let (before, after) = (in_question(alone), in_question(together));
    let told = |report: &Report, ids: &[&str], or: &str| {
        let names: Vec<String> = ids.iter().map(|id| title(report, id).into_owned()).collect();
        names.join(or)
    };
    let beside = format!("with {} beside it", list(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>()));
    let ruled_out: Vec<&str> = before.iter().copied().filter(|id| !after.contains(id)).collect();
    if before == after {
        let open = if before.len() > 1 { "nothing is settled" } else { "the answer is the same" };
        return format!("{beside} {open}: {}", told(together, &after, " or "));
    }
    if after.iter().all(|id| before.contains(id)) {
        let [left, out] = [told(together, &after, " or "), told(alone, &ruled_out, " and ")];
        return format!("{beside} {left} is left; ruled out: {out}");
    }
    let [now, was] = [told(together, &after, " or "), told(alone, &before, " or ")];
    format!("{beside} the answer is {now}; alone it was {was}")
}

/// What an answer leaves in question: the causes named and those that were not told from them; else the verdict.
fn in_question(report: &Report) -> Vec<&str> {
    let named = report.which.iter().filter(|entry| report.causes.contains(&entry.cause));
    let mut all: Vec<&str> = named
        .flat_map(|entry| std::iter::once(&entry.cause).chain(&entry.not_told_apart_from))
        .map(String::as_str)
        .collect();
    all.sort_unstable();
    all.dedup();
    match report.verdict {
        _ if !all.is_empty() => all,
        Verdict::NoGap => vec!["no_gap"],
        Verdict::UnfitData => vec!["unfit_data"],
        _ => vec!["unknown"],
    }
}

/// A sentence without its stop, so that another may follow.
pub fn open_ended(text: &str) -> &str {
    text.trim_end_matches(['.', ' '])
}

/// A whole sentence: a capital, unless the first word is a name of the files, and a stop.
pub fn sentence(text: &str) -> String {
    let text = open_ended(text);
    let first = text.split(' ').next().unwrap_or_default();
    let plain = first.chars().all(|c| c.is_ascii_lowercase());
    let mut letters = text.chars();
    match letters.next() {
        Some(letter) if plain => format!("{}{}.", letter.to_ascii_uppercase(), letters.as_str()),
        Some(_) => format!("{text}."),
        None => String::new(),
    }
}

/// "a", "a and b", "a, b and c".
pub fn list(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

fn named(report: &Report, causes: &[&Which]) -> String {
    let name = |w: &&Which| format!("{}{}", title(report, &w.cause), spot(w.wheel, w.axis).replacen(", ", " at ", 1));
    list(&causes.iter().map(name).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_headline_names_the_cause_and_its_place() {
        assert_eq!(headline(&sample::effect()), "Missing from the simulator: Wheel slip at wheel\u{a0}2.");
        assert_eq!(headline(&sample::parameter()), "Wrong in the robot file: Mass and Winding resistance.");
        let mut twice = sample::effect();
        twice.causes.push(twice.causes[0].clone());
        twice.which.insert(1, Which { wheel: Some(0), ..twice.which[0].clone() });
        let said = "Missing from the simulator: Wheel slip at wheel\u{a0}2 and Wheel slip at wheel\u{a0}0.";
        assert_eq!(headline(&twice), said);
    }

    #[test]
    fn numbers_are_told_where_they_alone_close_what_a_reader_calls_a_gap() {
        let said = moved_numbers(&sample::own_numbers()).expect("two moved");
        assert!(said.starts_with("motor.resistance_ohm 1.93 → 2.50\u{a0}Ω (3.0 of its stated sigmas)"), "{said}");
        assert!(!said.contains("mass"), "it moved by less than a sigma: {said}");
        assert_eq!(moved_numbers(&sample::no_gap()), None);
        assert_eq!(moved_numbers(&sample::parameter()), None);
    }

    #[test]
    fn noise_is_told_where_it_is_not_as_stated() {
        let of = |sensor: &str, found: f64, correlation_time_s: f64| ChannelNoise {
            sensor: sensor.to_owned(),
            group: "i".to_owned(),
            unit: "A".to_owned(),
            stated: 0.02,
            found,
            correlation_time_s,
        };
        let with = |noise| Report { noise, ..sample::effect() };
        let said = noise(&with(vec![of("current", 0.05, 0.0125), of("wheel_speed", 0.02, 0.0)]));
        assert_eq!(said.as_deref(), Some("current 0.0500\u{a0}A (file: 0.0200\u{a0}A), alike over 12.5 ms"));
        assert_eq!(noise(&with(vec![of("current", 0.02, 0.0)])), None);
    }

    #[test]
    fn what_further_recordings_settled_is_told() {
        let with = |causes: &[&str], alike: &[&str]| {
            let mut report = sample::effect();
            report.causes = causes.iter().map(|id| (*id).to_owned()).collect();
            report.which[0].not_told_apart_from = alike.iter().map(|id| (*id).to_owned()).collect();
            report
        };
        let open = with(&["wheel_slip"], &["load_transfer"]);
        let said = |after: &Report| settled(&open, after, &["tuesday"]);
        assert_eq!(
            said(&with(&["wheel_slip"], &[])),
            "with tuesday beside it Wheel slip is left; ruled out: Load transfer"
        );
        assert_eq!(said(&open), "with tuesday beside it nothing is settled: Load transfer or Wheel slip");
        assert_eq!(
            said(&sample::no_gap()),
            "with tuesday beside it the answer is No gap; alone it was Load transfer or Wheel slip"
        );
    }

    #[test]
    fn a_sentence_has_a_capital_and_one_stop_but_a_column_keeps_its_name() {
        assert_eq!(sentence("time falls."), "Time falls.");
        assert_eq!(sentence("w1_rad_s is frozen"), "w1_rad_s is frozen.");
    }

    #[test]
    fn a_cause_without_a_card_is_named_by_its_id() {
        assert_eq!(title(&sample::effect(), "cable_pull"), "Cable pull");
    }
}
