//! The tables of the estimators: error by error, and the bias of experiment 3.

use omni_gap::simulate::Sensing;

use super::comparison::{EstimatorComparison, median_ratio};
use super::prior::symbol;
use super::promises::SIGNIFICANT;
use super::significant_figures::{percent, signed, two_figures};
use super::statistics::EstimatorStatistics;
use super::study::StudyResult;

/// The played cases.
pub fn played(cases: &[StudyResult]) -> String {
    let mut text = "| wheels | measured | camera errors | seeds | runs | together (s) | rows |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    for s in cases {
        let (runs, seconds, rows) = s.size;
        let (case, seeds) = (s.case, s.trials.len());
        text += &format!(
            "| {} | {} | {} | {seeds} | {runs} | {seconds:.0} | {rows} |\n",
            case.wheels,
            case.measured(),
            case.camera()
        );
    }
    text
}

/// A case.
pub fn case(s: &StudyResult) -> String {
    let numbers = EstimatorComparison::all(s);
    let bound = if s.case.is_white() { "bound (%)" } else { "bound for this noise (%)" };
    let mut text = format!(
        "### {}\n\n\
         | | experiments 1, 2, motor | 3, least squares | 3, instrumental | paper's table | all together | {bound} | RMS over \
         bound | ratio | 90 % holds (%) |\n|---|---|---|---|---|---|---|---|---|---|\n",
        capital(&s.case.title())
    );
    let error = |q: Option<EstimatorStatistics>| {
        q.map_or("–".to_owned(), |q| format!("{} ({})", percent(q.median), signed(q.bias.0, q.median)))
    };
    for c in &numbers {
        let over = c.over_bound().map_or("–".to_owned(), |(x, se)| format!("{x:.2} ± {se:.2}"));
        text += &format!(
            "| {} | {} | {} | {} | {} | {} | {} | {over} | {} | {} |\n",
            symbol(c.nominal),
            error(c.first),
            error(c.least_squares),
            error(c.instrumental),
            error(c.table),
            error(c.joint),
            percent(c.bound),
            c.ratio().map_or("–".to_owned(), two_figures),
            c.joint.map_or("–".to_owned(), |q| format!("{:.1}", 100.0 * q.covered)),
        );
    }
    let most = numbers.iter().filter_map(EstimatorComparison::ratio).fold(f64::NAN, f64::max);
    let n = s.trials.len() as f64;
    text += &format!(
        "\nMedian of the ratios {}, largest {}. With {n} robots the share of intervals is sure to ± {:.1} %.{}\n\n",
        two_figures(median_ratio(&numbers)),
        two_figures(most),
        100.0 * (0.9 * 0.1 / n).sqrt(),
        without(s, &numbers)
    );
    text
}

/// What some trials did not give, where there is any.
fn without(s: &StudyResult, numbers: &[EstimatorComparison]) -> String {
    let n = s.trials.len();
    let lost = |of: fn(&EstimatorComparison) -> Option<EstimatorStatistics>| {
        numbers.iter().filter_map(|c| of(c).map(|q| n - q.count)).max().unwrap_or(0)
    };
    let strays = s.trials.iter().filter(|m| !m.follows).count();
    let counts = [
        (lost(|c| c.joint), "all runs together gave nothing"),
        (lost(|c| c.first), "an experiment of 1, 2 or the motor's gave nothing"),
        (lost(|c| c.instrumental), "experiment 3 gave nothing"),
        (strays, "the fit did not follow whole runs and kept to short windows"),
    ];
    let number = counts.iter().filter(|(count, _)| *count > 0);
    number.map(|(count, what)| format!(" In {count} {what}.")).collect()
}

/// The bias of experiment 3 by both methods, as the paper measured.
pub fn bias(cases: &[StudyResult]) -> String {
    let mut text = "| | wheels | camera errors | least squares (%) | instrumental (%) | less by (%) | less biased |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    let with_error = |(x, se): (f64, f64)| format!("{} ± {}", signed(x, se), percent(se));
    for s in cases.iter().filter(|s| s.case.sensing == Sensing::Paper) {
        for c in EstimatorComparison::all(s) {
            let (Some(ls), Some(iv), Some(off)) = (c.least_squares, c.instrumental, c.bias_reduction) else { continue };
            let by = match off.0 / off.1 {
                x if x > SIGNIFICANT => "instrumental",
                x if x < -SIGNIFICANT => "**least squares**",
                _ => "not told apart",
            };
            text += &format!(
                "| {} | {} | {} | {} | {} | {} | {by} |\n",
                symbol(c.nominal),
                s.case.wheels,
                s.case.camera(),
                with_error(ls.bias),
                with_error(iv.bias),
                with_error(off),
            );
        }
    }
    text
}

/// A text with a capital at its beginning.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}
