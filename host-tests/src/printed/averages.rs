//! Table 3 from Tables 1 and 2, and what that tells of the digits that Table 1 does not print.

use std::fmt::Write;

use super::tables::{FOUR, Printed, R_STEADY, Row, THREE};

/// How a number of Table 1 came to its three places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// Rounding would print another number, whatever the digits that are not known.
    Truncated,
    /// The digits leave it open, or both print the same.
    Either,
}

/// What the printed third place says.
pub fn cut(row: &Row) -> Cut {
    // rounding prints T₁ only from numbers below T₁ + ½ unit of the third place
    let least = row.hidden() + row.hidden_within().0;
    if least > row.table1 + 0.5e-3 { Cut::Truncated } else { Cut::Either }
}

/// A number to three places, cut.
fn truncated(x: f64) -> f64 {
    // 1e-9: the binary number below a decimal one
    (x * 1e3 + 1e-9).floor() / 1e3
}

fn table(page: &mut String, printed: &Printed) {
    let _ = writeln!(page, "\n{}:\n", capital(printed.name));
    *page += "| | unit | Table 1 | Table 2 | mean of both | Table 3 | hidden Table 1 | rounded | cut | so it was |\n";
    *page += "|---|---|---|---|---|---|---|---|---|---|\n";
    for row in &printed.rows {
        let Row { name, unit, table1, table2, table3 } = row;
        let hidden = row.hidden();
        let (t2, mean) = table2
            .map_or(("–".into(), "–".into()), |t2| (format!("{t2:.4}"), format!("{:.5}", 0.5 * (table1 + t2))));
        let so = match cut(row) {
            Cut::Truncated => "**cut**",
            Cut::Either => "either",
        };
        let _ = writeln!(
            page,
            "| {name} | {unit} | {table1:.3} | {t2} | {mean} | {table3:.4} | {hidden:.4} | {hidden:.3} | {:.3} | {so} |",
            truncated(hidden)
        );
    }
}

pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The section of the page.
pub fn section() -> String {
    let mut page = "## Table 3 is the mean of Tables 1 and 2\n\n".to_owned();
    page += "Table 1 holds experiments 1 and 2, Table 2 experiment 3. *Hidden Table 1* is 2·Table 3 − Table 2, what Table 1\n";
    page += "must have been before it was cut to three places; it is known to ±0.0002. Cv and Cvn are not in Table 2: Table 3\n";
    page += "has them as experiment 2 gave them, with one place more.\n";
    table(&mut page, &THREE);
    table(&mut page, &FOUR);
    let (steady, driven) = (R_STEADY, THREE.table3.resistance);
    let j = &FOUR.rows[0];
    let _ = write!(
        page,
        "
- R is not averaged: Table 3 has {driven:.4} Ω, which is experiment 3's; the mean with the {steady:.4} Ω of Table 1 would be
  {:.4} Ω.
- Table 1 is cut, not rounded: the four-wheel J of {:.4} is printed as {:.3}. In the rows marked **cut** rounding would print
  another number whatever the unknown digits are; in the others both print the same, or the digits leave it open.
- With Table 1 as printed, {} of the ten means miss Table 3 by more than its last place allows. All hidden values lie within
  the thousandth above the printed one, where cut numbers must come from.
",
        0.5 * (steady + driven),
        j.hidden(),
        j.table1,
        means_that_miss(),
    );
    page
}

/// How many means of the printed Tables 1 and 2 are not Table 3, by more than its last place.
pub fn means_that_miss() -> usize {
    let all = THREE.rows.iter().chain(&FOUR.rows);
    all.filter(|row| row.table2.is_some_and(|t2| (0.5 * (row.table1 + t2) - row.table3).abs() > 1e-4 + 1e-9)).count()
}
