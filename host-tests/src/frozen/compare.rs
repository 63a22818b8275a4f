//! Two sets of answers, compared field by field; a field that only the new one has is left aside.

use serde_json::Value;

/// One answer a line.
pub fn written(answers: &[Value]) -> String {
    answers.iter().map(|answer| format!("{answer}\n")).collect()
}

/// Where answers differ from a file of frozen ones: the recording, the path of the field, and what stands there.
pub fn differences(frozen: &str, now: &[Value]) -> Vec<String> {
    let frozen: Vec<Value> = frozen.lines().map(|line| serde_json::from_str(line).unwrap_or(Value::Null)).collect();
    let mut found = Vec::new();
    if frozen.len() != now.len() {
        found.push(format!("{} recordings, frozen were {}", now.len(), frozen.len()));
    }
    for (old, new) in frozen.iter().zip(now) {
        let mut here = Vec::new();
        walk(old, new, "", &mut here);
        let name = new["recording"].as_str().unwrap_or("?");
        found.extend(here.into_iter().map(|what| format!("{name}: {what}")));
    }
    found
}

fn walk(old: &Value, new: &Value, path: &str, found: &mut Vec<String>) {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in old {
                walk(value, new.get(key).unwrap_or(&Value::Null), &format!("{path}.{key}"), found);
            }
        }
        (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
            for (k, (old, new)) in old.iter().zip(new).enumerate() {
                walk(old, new, &format!("{path}[{k}]"), found);
            }
        }
        _ if old == new => {}
        _ => found.push(format!("{path}: {old} was frozen, now {new}")),
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
}
