//! # How a table of text is laid out: separator, decimal sign, where the names stand

use crate::log::source::Layout;

/// What the first lines of a file look like.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dialect {
    pub layout: Layout,
    /// A name of each column; empty where no line has them.
    pub names: Vec<String>,
}

/// Lines that are looked at.
const LINES: usize = 200;

/// Guesses from the beginning of a text; none where it has no rows of numbers.
pub(super) fn guess(text: &str) -> Option<Dialect> {
    let lines: Vec<&str> = text.lines().take(LINES).collect();
    let all = [b',', b';', b'\t', b'|', b' '].into_iter().filter_map(|separator| table(&lines, separator));
    // the one that makes the most numbers, and the least that is none
    all.max_by_key(|(numbers, dialect)| (*numbers, dialect.layout.separator != b' ')).map(|(_, dialect)| dialect)
}

/// The same with one separator, and how many numbers it makes, fields that are none taken off.
fn table(lines: &[&str], separator: u8) -> Option<(i64, Dialect)> {
    let decimal = if separator == b',' { b'.' } else { decimal(lines) };
    let fields = |line: &str| -> Vec<String> {
        let mut fields: Vec<String> =
            line.split(separator as char).map(|field| field.trim().trim_matches('"').to_owned()).collect();
        if fields.len() > 1 && fields.last().is_some_and(String::is_empty) {
            fields.pop();
        }
        fields
    };
    let is_number = |field: &String| field.replace(decimal as char, ".").parse::<f64>().is_ok();
    let is_row = |fields: &[String]| {
        let said = fields.iter().filter(|field| !field.is_empty());
        fields.len() > 1 && 2 * said.clone().filter(|field| is_number(field)).count() > said.count()
    };
    let split: Vec<Vec<String>> = lines.iter().map(|line| fields(line)).collect();
    let first = split.iter().position(|fields| is_row(fields))?;
    let columns = split[first].len();
    let rows = split[first..].iter().filter(|fields| fields.len() == columns && is_row(fields));
    let worth = |field: &String| i64::from(!field.is_empty()) * if is_number(field) { 1 } else { -1 };
    let numbers = rows.flatten().map(worth).sum();
    let named = |line: usize| {
        split[line].len() == columns && split[line].iter().all(|field| !field.is_empty() && !is_number(field))
    };
    let above: Vec<usize> = (0..first).rev().filter(|line| named(*line)).collect();
    let layout = |skip_lines, header| Layout { separator, decimal, skip_lines, header };
    let dialect = match above.as_slice() {
        // names, and units below them: no header can be read that is not right above the rows
        [units, names, ..] if is_units(&split[*units]) && *units + 1 == first => {
            let with =
                |(name, unit): (&String, &String)| format!("{name} [{}]", unit.trim_matches(['[', ']', '(', ')']));
            Dialect {
                layout: layout(first, false),
                names: split[*names].iter().zip(&split[*units]).map(with).collect(),
            }
        }
        [names, ..] if *names + 1 == first => Dialect { layout: layout(*names, true), names: split[*names].clone() },
        _ => Dialect { layout: layout(first, false), names: Vec::new() },
    };
    Some((numbers, dialect))
}

/// The sign that more numbers have one of.
fn decimal(lines: &[&str]) -> u8 {
    let between_digits = |sign: u8| {
        let of_line = |line: &&str| {
            line.as_bytes()
                .windows(3)
                .filter(|w| w[1] == sign && w[0].is_ascii_digit() && w[2].is_ascii_digit())
                .count()
        };
        lines.iter().map(of_line).sum::<usize>()
    };
    if between_digits(b',') > between_digits(b'.') { b',' } else { b'.' }
}

/// Whether most of a line's fields are units.
fn is_units(fields: &[String]) -> bool {
    let known = [
        "s", "ms", "us", "ns", "v", "mv", "a", "ma", "rad", "deg", "rad/s", "deg/s", "rpm", "m", "cm", "mm", "-", "1",
        "%",
    ];
    let is = |field: &&String| known.contains(&field.trim_matches(['[', ']', '(', ')']).to_lowercase().as_str());
    2 * fields.iter().filter(is).count() > fields.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> (u8, u8, usize, bool, Vec<String>) {
        let Dialect { layout, names } = guess(text).unwrap();
        (layout.separator, layout.decimal, layout.skip_lines, layout.header, names)
    }

    #[test]
    fn separators_decimals_and_names_are_found() {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        assert_eq!(told("t,a,b\n0,1,2\n1,2,3\n"), (b',', b'.', 0, true, names(&["t", "a", "b"])));
        assert_eq!(told("t;a\n0,5;1,25\n0,6;1,5\n"), (b';', b',', 0, true, names(&["t", "a"])));
        assert_eq!(
            told("made by X\nseconds\tvolts\n0.1\t2\n0.2\t3\n"),
            (b'\t', b'.', 1, true, names(&["seconds", "volts"]))
        );
        assert_eq!(told("1 2 3\n4 5 6\n"), (b' ', b'.', 0, false, names(&[])));
        assert_eq!(told("t;w\nms;rpm\n0;1\n5;2\n"), (b';', b'.', 2, false, names(&["t [ms]", "w [rpm]"])));
        assert_eq!(told("a,b,\n1,,\n2,3,\n"), (b',', b'.', 0, true, names(&["a", "b"])));
    }

    #[test]
    fn a_text_without_numbers_is_no_table() {
        assert_eq!(guess("dear diary\nit rained\n"), None);
    }
}
