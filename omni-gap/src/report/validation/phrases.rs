//! The words of a validation.

use crate::localise::validation::{RunFigures, Signal, SignalFigures, SpeedsFrom, Validation};
use crate::report::number::{num, percent};
use crate::report::phrases::list;

/// How closely a model follows, by the points of fit that the worst axis lacks of what noise allows.
const CLOSENESS: [(f64, &str); 4] =
    [(1.0, "as closely as noise allows"), (5.0, "very closely"), (15.0, "closely"), (40.0, "roughly")];

/// How good the model is and where it is worst, in one sentence.
pub fn headline(validation: &Validation) -> String {
    let (verdict, figures) = (verdict(validation), figures(validation));
    match figures.is_empty() {
        true => format!("{verdict}."),
        false => format!("{verdict}: {figures}."),
    }
}

/// How good the model is, without a stop.
pub(super) fn verdict(validation: &Validation) -> String {
    let axes = axes(validation);
    let Some(lacks) = axes.iter().map(|a| a.2).reduce(f64::max) else {
        return "No axis of the body moves beyond its noise, so that v, vn and ω have no fit".to_owned();
    };
    let how = match CLOSENESS.iter().find(|(most, _)| lacks < *most) {
        Some((_, how)) => *how,
        None if axes.iter().all(|a| a.1 <= 0.0) => "no better than a constant would",
        None => "poorly",
    };
    format!("The model follows the body’s motion {how}")
}

/// "over all 6 runs the fit is 89 % for v; worst: vn in run03, fit 71 % where noise allows 96 %"
pub(super) fn figures(validation: &Validation) -> String {
    let fit = |(axis, fit, _): &(Signal, f64, f64)| format!("{} for {}", fit_text(*fit), short(*axis));
    let fits: Vec<String> = axes(validation).iter().map(fit).collect();
    let runs = match validation.runs.len() {
        1 => "over the one run".to_owned(),
        n => format!("over all {n} runs"),
    };
    let fits = (!fits.is_empty()).then(|| format!("{runs} the fit is {}", list(&fits)));
    let worst = validation.worst.as_ref().map(|w| {
        let (fit, allowed) = (fit_text(w.fit_percent), fit_text(w.noise_allows_percent));
        format!("worst: {} in {}, fit {fit} where noise allows {allowed}", name(w.signal), w.run)
    });
    fits.into_iter().chain(worst).collect::<Vec<_>>().join("; ")
}

/// The axes of the body that have a fit over all runs: their fit, and what it lacks of what noise allows [%].
fn axes(validation: &Validation) -> Vec<(Signal, f64, f64)> {
    let all = Signal::AXES.into_iter().filter_map(|axis| validation.over_all(axis));
    all.filter_map(|f| Some((f.signal, f.fit_percent?, f.lacking()?))).collect()
}

/// A fit with its sign of per cent.
pub(super) fn fit_text(fit_percent: f64) -> String {
    percent(fit_percent / 100.0)
}

/// A fit in a table whose head says per cent; a dash where there is none.
pub(super) fn fit_cell(figures: Option<&SignalFigures>) -> String {
    let fit = figures.and_then(|f| f.fit_percent);
    fit.map_or("–".into(), |fit| format!("{fit:.1}").replace('-', "−"))
}

/// An RMS in a table whose head says the unit; a dash where nothing was compared.
pub(super) fn rms_cell(figures: Option<&SignalFigures>) -> String {
    figures.map_or("–".into(), |f| num(f.rms_si))
}

/// A signal's symbol.
pub(super) fn short(signal: Signal) -> String {
    match signal {
        Signal::V => "v".into(),
        Signal::Vn => "vn".into(),
        Signal::Omega => "ω".into(),
        Signal::WheelSpeed(j) => format!("w{j}"),
        Signal::Current(j) => format!("i{j}"),
        Signal::X => "x".into(),
        Signal::Y => "y".into(),
        Signal::Heading => "θ".into(),
        Signal::Gyro => "ω (gyro)".into(),
        Signal::Battery => "battery".into(),
    }
}

/// A signal's name in a sentence or over a chart.
pub(super) fn name(signal: Signal) -> String {
    match signal {
        Signal::WheelSpeed(j) => format!("speed of wheel\u{a0}{j}"),
        Signal::Current(j) => format!("current\u{a0}{j}"),
        other => short(other),
    }
}

/// What drives the model along a run.
pub(super) fn driver(run: &RunFigures) -> &'static str {
    match run.driven_by.as_str() {
        "u" => "commanded voltages",
        "i" => "measured currents",
        "w" => "measured wheel speeds",
        _ => "commanded wheel speeds",
    }
}

/// Where the measured v, vn and ω of a run come from.
pub(super) fn source(run: &RunFigures) -> Option<&'static str> {
    run.speeds_from.map(|from| match from {
        SpeedsFrom::WheelSpeeds => "v, vn and ω are the least-squares twist of the wheel speeds, measured as simulated",
        SpeedsFrom::Pose => {
            "v, vn and ω are slopes of straight lines through ±100 ms of the pose, measured as simulated"
        }
    })
}

/// A run's name, and whether it is held out.
pub(super) fn run_name(run: &RunFigures) -> String {
    format!("{}{}", run.run, if run.held_out { " (held out)" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::validation::sample;

    #[test]
    fn a_headline_says_how_good_the_model_is_and_where_it_is_worst() {
        let plain = headline(&sample::validation()).replace('\u{a0}', " ");
        assert_eq!(
            plain,
            "The model follows the body’s motion closely: over all 2 runs the fit is 96 % for v and 88 % for vn; \
             worst: current 1 in run01, fit 71 % where noise allows 97 %."
        );
    }

    #[test]
    fn a_robot_that_stands_has_no_fit_of_its_motion() {
        let mut still = sample::validation();
        for figures in &mut still.all_runs {
            figures.fit_percent = None;
        }
        still.worst = None;
        assert!(headline(&still).starts_with("No axis of the body moves beyond its noise"));
    }

    #[test]
    fn the_words_go_from_noise_to_nothing() {
        let with = |fit: f64| {
            let mut validation = sample::validation();
            for figures in validation.all_runs.iter_mut().filter(|f| f.fit_percent.is_some()) {
                (figures.fit_percent, figures.noise_allows_percent) = (Some(fit), Some(98.0));
            }
            headline(&validation)
        };
        let said = [
            (97.5, "as noise allows"),
            (95.0, "very closely"),
            (70.0, "roughly"),
            (10.0, "poorly"),
            (-3.0, "no better"),
        ];
        for (fit, words) in said {
            assert!(with(fit).contains(words), "{fit}: {}", with(fit));
        }
    }
}
