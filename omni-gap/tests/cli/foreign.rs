//! The bench's run as another program would have logged it.

use crate::bench::{Bench, table};

/// A column of the run, what the foreign log calls it, and what becomes of its numbers.
pub type Foreign<'a> = (&'a str, &'a str, fn(f64) -> String);

/// Columns of the bench's run in the foreign log's words.
pub fn foreign(bench: &Bench, columns: &[Foreign<'_>], separator: &str) -> String {
    let text = bench.read("session/runs/run01.csv");
    let (names, rows) = table(&text);
    let place = |column: &str| names.iter().position(|name| *name == column).unwrap();
    let join = |fields: Vec<String>| fields.join(separator) + "\n";
    let mut out = join(columns.iter().map(|(_, foreign, _)| (*foreign).to_owned()).collect());
    for row in &rows {
        let field = |(own, _, change): &Foreign<'_>| row[place(own)].parse().map_or(String::new(), change);
        out += &join(columns.iter().map(field).collect());
    }
    out
}

/// A number as it is.
pub fn same(number: f64) -> String {
    number.to_string()
}
