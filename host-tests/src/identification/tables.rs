//! The tables of the estimators: error by error, and the bias of experiment 3.

use omni_gap::simulate::Sensing;

use super::believed::symbol;
use super::compared::{Compared, median_ratio};
use super::digits::{percent, signed, two};
use super::promises::PLAIN;
use super::quality::Quality;
use super::study::Studied;

/// The played cases.
pub fn played(cases: &[Studied]) -> String {
    let mut text = "| wheels | measured | camera errors | seeds | runs | together (s) | rows |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    for s in cases {
        let (runs, seconds, rows) = s.size;
        let (case, seeds) = (s.case, s.mornings.len());
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
pub fn case(s: &Studied) -> String {
    let numbers = Compared::all(s);
    let bound = if s.case.is_white() { "bound (%)" } else { "bound for this noise (%)" };
    let mut text = format!(
        "### {}\n\n\
         | | experiments 1, 2, motor | 3, least squares | 3, instrumental | paper's table | all together | {bound} | RMS over \
         bound | ratio | 90 % holds (%) |\n|---|---|---|---|---|---|---|---|---|---|\n",
        capital(&s.case.title())
    );
    let error = |q: Option<Quality>| {
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
            c.ratio().map_or("–".to_owned(), two),
            c.joint.map_or("–".to_owned(), |q| format!("{:.1}", 100.0 * q.covered)),
        );
    }
    let most = numbers.iter().filter_map(Compared::ratio).fold(f64::NAN, f64::max);
    let n = s.mornings.len() as f64;
    text += &format!(
        "\nMedian of the ratios {}, largest {}. With {n} robots the share of intervals is sure to ± {:.1} %.{}\n\n",
        two(median_ratio(&numbers)),
        two(most),
        100.0 * (0.9 * 0.1 / n).sqrt(),
        without(s, &numbers)
    );
    text
}

/// What some mornings did not give, where there is any.
fn without(s: &Studied, numbers: &[Compared]) -> String {
    let n = s.mornings.len();
    let lost = |of: fn(&Compared) -> Option<Quality>| {
        numbers.iter().filter_map(|c| of(c).map(|q| n - q.count)).max().unwrap_or(0)
    };
    let strays = s.mornings.iter().filter(|m| !m.follows).count();
    let counts = [
        (lost(|c| c.joint), "all runs together gave nothing"),
        (lost(|c| c.first), "an experiment of 1, 2 or the motor's gave nothing"),
        (lost(|c| c.instrumental), "experiment 3 gave nothing"),
        (strays, "the fit did not follow whole runs and kept to short windows"),
    ];
    let told = counts.iter().filter(|(count, _)| *count > 0);
    told.map(|(count, what)| format!(" In {count} {what}.")).collect()
}

/// The bias of experiment 3 by both methods, as the paper measured.
pub fn bias(cases: &[Studied]) -> String {
    let mut text = "| | wheels | camera errors | least squares (%) | instrumental (%) | less by (%) | less biased |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    let with_error = |(x, se): (f64, f64)| format!("{} ± {}", signed(x, se), percent(se));
    for s in cases.iter().filter(|s| s.case.sensing == Sensing::Paper) {
        for c in Compared::all(s) {
            let (Some(ls), Some(iv), Some(off)) = (c.least_squares, c.instrumental, c.bias_taken_off) else { continue };
            let by = match off.0 / off.1 {
                x if x > PLAIN => "instrumental",
                x if x < -PLAIN => "**least squares**",
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
