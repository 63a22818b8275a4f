//! What was promised of the identification, and how far it is kept.

use model_core::plant::robot::Nominal;
use omni_gap::report::num;
use omni_gap::simulate::Sensing;

use super::Results;
use super::comparison::{EstimatorComparison, median_ratio};
use super::missing_group::MissingGroup;
use super::no_excitation::MissingExcitation;
use super::prior::symbol;
use super::study::StudyResult;

/// A bias, or a difference of two, counts as plain above this many of its standard errors.
pub const SIGNIFICANT: f64 = 3.0;

/// On which side of the bar a promise is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// At most this.
    AtMost(f64),
    /// At least this.
    AtLeast(f64),
}

/// Something that was promised.
#[derive(Clone, Debug, PartialEq)]
pub struct Promise {
    /// What.
    pub what: String,
    /// The worst value found; not a number where nothing was measured.
    pub found: f64,
    /// Where it was found.
    pub at: String,
    /// What it has to be.
    pub threshold: Threshold,
}

impl Promise {
    /// True if it is kept.
    pub fn kept(&self) -> bool {
        match self.threshold {
            Threshold::AtMost(most) => self.found <= most,
            Threshold::AtLeast(least) => self.found >= least,
        }
    }
}

/// A value and where it was found.
type Found = (f64, String);

/// What was promised of these results.
pub fn promises(results: &Results) -> Vec<Promise> {
    let cases: Vec<(&StudyResult, Vec<EstimatorComparison>)> =
        results.cases.iter().map(|s| (s, EstimatorComparison::all(s))).collect();
    let numbers = |of: fn(&StudyResult) -> bool, value: &dyn Fn(&EstimatorComparison) -> Option<f64>| -> Vec<Found> {
        let all = cases.iter().filter(|(s, _)| of(s)).flat_map(|(s, all)| all.iter().map(move |c| (s, c)));
        all.filter_map(|(s, c)| Some((value(c)?, format!("{}, {} wheels", symbol(c.nominal), s.case.wheels)))).collect()
    };
    let white = |s: &StudyResult| s.case.is_the_papers();
    // with fewer robots, chance alone takes one number or the other out of these bars: the mean of all is held to them
    let wandering = cases.iter().filter(|(s, _)| !s.case.is_white()).map(|(s, all)| {
        let covered: Vec<f64> = all.iter().filter_map(|c| Some(100.0 * c.joint?.covered)).collect();
        (covered.iter().sum::<f64>() / covered.len() as f64, format!("{} wheels", s.case.wheels))
    });
    let wandering: Vec<Found> = wandering.collect();
    let modern = |s: &StudyResult| s.case.sensing != Sensing::Paper;
    let covered = |c: &EstimatorComparison| Some(100.0 * c.joint?.covered);
    let over = |c: &EstimatorComparison| Some(c.over_bound()?.0);
    let worst = |c: &EstimatorComparison| (c.nominal != Nominal::TorqueConstant).then_some(100.0 * c.joint?.worst);
    let of_cases = cases.iter().filter(|(s, _)| white(s));
    let medians = of_cases.map(|(s, all)| (median_ratio(all), format!("{} wheels", s.case.wheels))).collect();
    let more_biased = |c: &EstimatorComparison| {
        let (less, error) = c.bias_reduction?;
        Some(if -less > SIGNIFICANT * error { 1.0 } else { 0.0 })
    };
    let left = |c: &EstimatorComparison| c.bias_left(SIGNIFICANT);
    let seeds = results.cases.iter().filter(|s| white(s)).map(|s| (s.trials.len() as f64, s.case.title())).collect();
    vec![
        least("robots identified, paper's sensing", seeds, 400.0),
        most("RMS error over the Cramér–Rao bound, paper's sensing", numbers(white, &over), 1.3),
        most("median error over that of the paper's table, median of the numbers", medians, 0.5),
        most("the same, the worst number", numbers(white, &EstimatorComparison::ratio), 1.0),
        least("90 % intervals that hold the truth (%), lowest", numbers(white, &covered), 85.0),
        most("90 % intervals that hold the truth (%), highest", numbers(white, &covered), 95.0),
        least("with correlated camera errors (%), mean of the numbers, lowest", wandering.clone(), 85.0),
        most("with correlated camera errors (%), mean of the numbers, highest", wandering, 95.0),
        most("largest error of R, J and friction with modern sensors (%)", numbers(modern, &worst), 3.0),
        most(
            "bias of experiment 3: instrumental variables over least squares, median",
            middle(numbers(white, &left)),
            1.0,
        ),
        most(
            "numbers that instrumental variables leave plainly more biased than least squares",
            total(numbers(white, &more_biased)),
            0.0,
        ),
        most("a group missing: error of what is called identified (own σ)", off(&results.missing), 5.0),
        most("standing robots that were given numbers", total(standing(results)), 0.0),
    ]
}

fn most(what: &str, found: Vec<Found>, bar: f64) -> Promise {
    let worst = found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    promise(what, worst, Threshold::AtMost(bar))
}

fn least(what: &str, found: Vec<Found>, bar: f64) -> Promise {
    let worst = found.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    promise(what, worst, Threshold::AtLeast(bar))
}

fn promise(what: &str, found: Option<Found>, bar: Threshold) -> Promise {
    let (found, at) = found.unwrap_or((f64::NAN, "nowhere".to_owned()));
    Promise { what: what.to_owned(), found, at, threshold: bar }
}

/// The median, as one value.
fn middle(found: Vec<Found>) -> Vec<Found> {
    let mut values: Vec<f64> = found.iter().map(|f| f.0).collect();
    values.sort_by(f64::total_cmp);
    if values.is_empty() { Vec::new() } else { vec![(super::statistics::median(&values), of_numbers(values.len()))] }
}

/// The sum, as one value.
fn total(found: Vec<Found>) -> Vec<Found> {
    if found.is_empty() { Vec::new() } else { vec![(found.iter().map(|f| f.0).sum(), of_numbers(found.len()))] }
}

fn of_numbers(count: usize) -> String {
    format!("of {count}")
}

fn off(missing: &[MissingGroup]) -> Vec<Found> {
    let at = |m: &MissingGroup| format!("without {}, {} wheels", m.group.word(), m.wheels);
    let answers = missing.iter().flat_map(|m| m.answers.iter().flatten().map(move |a| (m, a)));
    answers.flat_map(|(m, a)| a.identified().map(move |number| (number.off(), at(m)))).collect()
}

fn standing(results: &Results) -> Vec<Found> {
    let standing = results.idle.iter().filter(|idle| idle.missing == MissingExcitation::Motion);
    standing.flat_map(|idle| &idle.answers).map(|a| (f64::from(u8::from(a.is_ok())), String::new())).collect()
}

/// The promises as a table.
pub fn table(promises: &[Promise]) -> String {
    let mut text = "| | worst found | where | promised | kept |\n|---|---|---|---|---|\n".to_owned();
    for p in promises {
        let bar = match p.threshold {
            Threshold::AtMost(most) => format!("at most {most}"),
            Threshold::AtLeast(least) => format!("at least {least}"),
        };
        let found = if p.found.is_nan() {
            "–".to_owned()
        } else if p.found.fract() == 0.0 {
            format!("{}", p.found)
        } else {
            num(p.found)
        };
        let kept = if p.kept() { "yes" } else { "**no**" };
        text += &format!("| {} | {found} | {} | {bar} | {kept} |\n", p.what, p.at);
    }
    text
}

/// The promises as they stand on a page.
pub fn read_promises(page: &str) -> Vec<Promise> {
    let rows = page.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [what, found, at, bar, _] = cells[..] else { return None };
        let bar = match (bar.strip_prefix("at most "), bar.strip_prefix("at least ")) {
            (Some(most), _) => Threshold::AtMost(most.parse().ok()?),
            (_, Some(least)) => Threshold::AtLeast(least.parse().ok()?),
            _ => return None,
        };
        let found = found.parse().unwrap_or(f64::NAN);
        Some(Promise { what: what.to_owned(), found, at: at.to_owned(), threshold: bar })
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_promise_is_read_as_it_was_written() {
        let all = [
            promise("one", Some((1.25, "R, 3 wheels".to_owned())), Threshold::AtMost(1.3)),
            promise("two", Some((84.5, "J, 4 wheels".to_owned())), Threshold::AtLeast(85.0)),
        ];
        assert_eq!(read_promises(&table(&all)), all);
        assert_eq!(all.each_ref().map(Promise::kept), [true, false]);
    }

    #[test]
    fn what_nobody_measured_is_not_kept() {
        let none = most("nothing", Vec::new(), 1.0);
        assert!(!none.kept());
        assert!(table(std::slice::from_ref(&none)).contains("| – | nowhere | at most 1 | **no** |"));
        assert!(read_promises(&table(&[none]))[0].found.is_nan());
    }
}
