//! Two sets of answers, compared field by field; a field that only the new one has is left aside.

use serde_json::Value;

/// One answer a line.
pub fn written(answers: &[Value]) -> String {
    answers.iter().map(|answer| format!("{answer}\n")).collect()
}

/// Where answers differ from a file of frozen ones: the recording, the path of the field, and what stands there.
pub fn differences(frozen: &str, now: &[Value]) -> Vec<String> {
    let mut found = missing(frozen, now);
    for (old, new, name) in pairs(frozen, now) {
        walk(&old, new, "", &mut |old, new, path| found.push(format!("{name}: {path}: {old} was frozen, now {new}")));
    }
    found
}

/// What to tell of another number of answers than were frozen.
fn missing(frozen: &str, now: &[Value]) -> Vec<String> {
    let were = frozen.lines().count();
    if were == now.len() { Vec::new() } else { vec![format!("{} recordings, frozen were {were}", now.len())] }
}

/// Every frozen answer with its new one and the recording's name.
fn pairs<'a>(frozen: &'a str, now: &'a [Value]) -> impl Iterator<Item = (Value, &'a Value, &'a str)> {
    let read = |line| serde_json::from_str(line).unwrap_or(Value::Null);
    frozen.lines().zip(now).map(move |(old, new)| (read(old), new, new["recording"].as_str().unwrap_or("?")))
}

/// Tells every pair of fields that differ, with their path.
fn walk(old: &Value, new: &Value, path: &str, differs: &mut impl FnMut(&Value, &Value, &str)) {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in old {
                walk(value, new.get(key).unwrap_or(&Value::Null), &format!("{path}.{key}"), differs);
            }
        }
        (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
            for (k, (old, new)) in old.iter().zip(new).enumerate() {
                walk(old, new, &format!("{path}[{k}]"), differs);
            }
        }
        _ if old == new => {}
        _ => differs(old, new, path),
    }
}

/// How far answers are from frozen ones that another machine made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distance {
    /// Numbers that were compared.
    pub numbers: usize,
    /// Those whose last digits differ.
    pub moved: usize,
    /// The largest difference of a number, relative to the larger one, or to what is nothing in any unit.
    pub farthest: f64,
    /// Where that is: the recording and the path of the field.
    pub at: String,
    /// What differs and is no number.
    pub others: Vec<String>,
}

/// What is smaller is nothing in any unit of a report.
const NOTHING: f64 = 1e-9;

/// How far answers are from a file of frozen ones.
pub fn distance(frozen: &str, now: &[Value]) -> Distance {
    let mut distance = Distance::default();
    let mut others = missing(frozen, now);
    for (old, new, name) in pairs(frozen, now) {
        distance.numbers += numbers(&old);
        walk(&old, new, "", &mut |old, new, path| match (old.as_f64(), new.as_f64()) {
            (Some(x), Some(y)) => {
                distance.moved += 1;
                let relative = (x - y).abs() / x.abs().max(y.abs()).max(NOTHING);
                if relative > distance.farthest {
                    distance.farthest = relative;
                    distance.at = format!("{name}: {path}: {x} was frozen, now {y}");
                }
            }
            _ => others.push(format!("{name}: {path}: {old} was frozen, now {new}")),
        });
    }
    distance.others = others;
    distance
}

fn numbers(value: &Value) -> usize {
    match value {
        Value::Object(fields) => fields.values().map(numbers).sum(),
        Value::Array(values) => values.iter().map(numbers).sum(),
        Value::Number(_) => 1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_last_bit_of_a_number_counts_and_a_new_field_does_not() {
        let x = 0.1_f64 + 0.2;
        let frozen = written(&[json!({ "recording": "a", "report": { "x": [1, x] } })]);
        let now = |x: f64| json!({ "recording": "a", "report": { "x": [1, x], "new": 7 } });
        assert_eq!(differences(&frozen, &[now(x)]), [""; 0]);
        let found = differences(&frozen, &[now(x.next_down())]);
        assert_eq!(found, ["a: .report.x[1]: 0.30000000000000004 was frozen, now 0.3"]);
    }

    #[test]
    fn a_field_that_is_gone_and_a_recording_that_is_gone_are_told() {
        let frozen = written(&[json!({ "recording": "a", "x": 1 }), json!({ "recording": "b" })]);
        let found = differences(&frozen, &[json!({ "recording": "a" })]);
        assert_eq!(found, ["1 recordings, frozen were 2", "a: .x: 1 was frozen, now null"]);
    }

    #[test]
    fn the_distance_of_numbers_is_relative_and_words_are_told_by_themselves() {
        let frozen = written(&[json!({ "recording": "a", "x": [2.0, 1e-12], "which": "creep" })]);
        let same = distance(&frozen, &[json!({ "recording": "a", "x": [2.0, 1e-12], "which": "creep" })]);
        assert_eq!(same, Distance { numbers: 2, ..Distance::default() });
        let other = distance(&frozen, &[json!({ "recording": "a", "x": [2.5, 0.0], "which": "slip" })]);
        assert_eq!((other.numbers, other.moved, other.farthest), (2, 2, 0.2));
        assert_eq!(other.at, "a: .x[0]: 2 was frozen, now 2.5");
        assert_eq!(distance(&frozen, &[]).others, ["0 recordings, frozen were 1"]);
        assert_eq!(other.others, ["a: .which: \"creep\" was frozen, now \"slip\""]);
    }
}
