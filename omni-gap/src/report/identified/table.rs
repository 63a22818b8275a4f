//! The tables: the paper's numbers beside those of all runs together.

use super::symbol::symbol;
use crate::identify::{Answer, Identifiability, Number, Value};
use crate::report::number::{NBSP, num, percent};

/// Space between two columns (characters).
const GAP: usize = 2;
/// Figures of a number, however sure it is.
const MOST_FIGURES: i32 = 5;

/// A column: its head, and what stands in it.
type Column<'a> = (&'a str, Box<dyn Fn(&Number) -> String>);

/// The tables of an answer; of one experiment alone, the one table.
pub(super) fn tables(page: &mut String, answer: &Answer) {
    let all = answer.asked == "all";
    let paper: Vec<Column> = [
        (first_of(answer.asked), (|n| n.first) as fn(&Number) -> Option<Value>),
        (if all { "exp. 3, LS" } else { "least squares" }, |n| n.least_squares),
        (if all { "exp. 3, IV" } else { "instruments" }, |n| n.instrumental),
        ("average", |n| n.average),
    ]
    .into_iter()
    .filter(|(_, of)| answer.numbers.iter().any(|n| of(n).is_some()))
    .map(|(head, of)| -> Column { (head, Box::new(move |n| of(n).map_or_else(none, cell))) })
    .collect();
    let file: Column = ("file", Box::new(|n| num(n.file)));
    let found: [Column; 4] = [
        (if all { "all runs together" } else { "runs together" }, Box::new(together)),
        ("change", Box::new(change)),
        ("± by mass, geometry", Box::new(given)),
        ("", Box::new(|n| n.word.said().to_owned())),
    ];
    if all {
        page.push_str(
            "The paper's estimators: experiments 1, 2 and the motor's (its Table 1), experiment 3 by least squares\n\
             (LS) and by instrumental variables (IV), and the paper's average of these (its Table 3)\n",
        );
        grid(page, &answer.numbers, &paper);
        page.push_str("\nThe model, fitted to all runs together; ± is of the noise, mass and geometry add theirs\n");
        grid(page, &answer.numbers, &[file].into_iter().chain(found).collect::<Vec<_>>());
    } else {
        grid(page, &answer.numbers, &[file].into_iter().chain(paper).chain(found).collect::<Vec<_>>());
    }
    let unknown = |v: Option<Value>| v.is_some_and(|v| v.std.is_none());
    let lonely = |n: &Number| [n.first, n.least_squares, n.instrumental].into_iter().any(unknown);
    if answer.numbers.iter().any(lonely) {
        page.push_str("± ? stands where there is one run: the paper's estimators tell their noise from several\n");
    }
}

fn first_of(asked: &str) -> &'static str {
    match asked {
        "spin" => "experiment 1",
        "coast" => "experiment 2",
        "motor" => "motor experiment",
        _ => "1, 2 and motor",
    }
}

/// What stands where nothing is.
fn none() -> String {
    "–".into()
}

/// "4.311 ± 0.013": two figures of the uncertainty, as far as the number has not more than five.
fn cell(Value { value, std }: Value) -> String {
    let Some(std) = std else { return format!("{}{NBSP}±{NBSP}?", num(value)) };
    let exponent = |x: f64| if x == 0.0 { 0 } else { x.abs().log10().floor() as i32 };
    let places = (1 - exponent(std)).min(MOST_FIGURES - 1 - exponent(value)).max(0) as usize;
    let least = 10f64.powi(-(places as i32));
    let less = if std < 0.5 * least { "<" } else { "" };
    format!("{value:.places$}{NBSP}±{NBSP}{less}{:.places$}", std.max(least)).replace('-', "−")
}

fn together(n: &Number) -> String {
    if n.word == Identifiability::NotSeen { none() } else { cell(n.together) }
}

fn change(n: &Number) -> String {
    match n.word {
        Identifiability::NotSeen => none(),
        _ if n.file == 0.0 => "from 0".into(),
        _ => format!("{:+.1} %", 100.0 * (n.together.value / n.file - 1.0)).replace("-0.0", "+0.0").replace('-', "−"),
    }
}

fn given(n: &Number) -> String {
    if n.std_given > 0.0 { percent(n.std_given / n.together.value.abs()) } else { none() }
}

/// Rows under heads, the numbers to the right and the last column to the left.
fn grid(page: &mut String, numbers: &[Number], columns: &[Column]) {
    let name = |n: &Number| {
        let (symbol, unit) = symbol(n.key);
        format!("{symbol} [{unit}]")
    };
    let mut rows: Vec<Vec<String>> = vec![columns.iter().map(|(head, _)| (*head).to_owned()).collect()];
    rows.extend(numbers.iter().map(|n| columns.iter().map(|(_, of)| of(n)).collect::<Vec<_>>()));
    let names: Vec<String> = std::iter::once(String::new()).chain(numbers.iter().map(name)).collect();
    let width = |texts: &mut dyn Iterator<Item = &String>| texts.map(|t| t.chars().count()).max().unwrap_or(0);
    let first = width(&mut names.iter());
    for (name, row) in names.iter().zip(&rows) {
        let mut line = format!("{name:first$}");
        for (k, text) in row.iter().enumerate() {
            let wide = width(&mut rows.iter().map(|row| &row[k]));
            let last = k + 1 == row.len() && columns[k].0.is_empty();
            line += &" ".repeat(GAP);
            line += &if last { text.clone() } else { format!("{text:>wide$}") };
        }
        page.push_str(line.trim_end());
        page.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_the_figures_that_its_uncertainty_allows_and_five_at_most() {
        let of = |value, std| cell(Value { value, std }).replace(NBSP, " ");
        assert_eq!(of(4.30881, Some(0.0026)), "4.3088 ± 0.0026");
        assert_eq!(of(0.0259018, Some(3.7e-6)), "0.025902 ± 0.000004");
        assert_eq!(of(0.0259018, Some(2.6e-7)), "0.025902 ± <0.000001");
        assert_eq!(of(-1234.5, Some(56.7)), "−1234 ± 57");
        assert_eq!(of(4.3, None), "4.30 ± ?");
    }
}
