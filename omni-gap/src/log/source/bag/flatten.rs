//! # A message as one row: every number in it has a path for a name
//!
//! `velocity[0]`, `pose.position.x`, `header.stamp`. What roboticists mean by some shapes is told as well:
//!
//! - a time of two members (`sec` and `nanosec`, or what other encodings call them) is one number, in seconds;
//! - a quaternion (`x`, `y`, `z`, `w`) has its heading beside it, `orientation.yaw` (rad);
//! - a list whose members are named, by a list `name` beside it as in joint states or by `child_frame_id` as in
//!   transforms, goes by these names: `velocity[front_left]`, `transforms[base_link].transform.translation.x`.

use super::value::{LONGEST_LIST, Value};

/// What the whole and the rest of a time are called: in ROS 2, in ROS 1, in protobuf, in JSON by Foxglove's schemas.
const TIMES: [(&str, &str); 4] = [("sec", "nanosec"), ("secs", "nsecs"), ("seconds", "nanos"), ("sec", "nsec")];

/// Hands every number of a message to `take`, with its path.
pub(super) fn flatten(message: &Value, take: &mut impl FnMut(&str, f64)) {
    walk(message, &mut String::new(), take);
}

fn walk(value: &Value, path: &mut String, take: &mut impl FnMut(&str, f64)) {
    match value {
        Value::Number(number) => take(path, *number),
        Value::Text(_) | Value::Other => {}
        Value::List(list) => walk_list(list, None, path, take),
        Value::Fields(fields) => match time(value) {
            Some(seconds) => take(path, seconds),
            None => {
                let names = value.member("name").and_then(names);
                for (name, member) in fields {
                    with(path, if path.is_empty() { "" } else { "." }, name, |path| match member {
                        Value::List(list) => walk_list(list, names.as_deref(), path, take),
                        member => walk(member, path, take),
                    });
                }
                if let Some(yaw_rad) = yaw_rad(value) {
                    with(path, if path.is_empty() { "" } else { "." }, "yaw", |path| take(path, yaw_rad));
                }
            }
        },
    }
}

fn walk_list(list: &[Value], names: Option<&[&str]>, path: &mut String, take: &mut impl FnMut(&str, f64)) {
    if list.len() > LONGEST_LIST {
        return;
    }
    let names = names.filter(|names| names.len() == list.len());
    for (place, member) in list.iter().enumerate() {
        let own = member.member("child_frame_id").and_then(Value::text);
        let key = match own.or(names.map(|names| names[place])) {
            Some(name) => format!("[{name}]"),
            None => format!("[{place}]"),
        };
        with(path, "", &key, |path| walk(member, path, take));
    }
}

/// Runs `f` with a longer path.
fn with(path: &mut String, between: &str, name: &str, f: impl FnOnce(&mut String)) {
    let length = path.len();
    path.push_str(between);
    path.push_str(name);
    f(path);
    path.truncate(length);
}

/// The names in a list of texts, where all are different and none is empty.
fn names<'a>(list: &'a Value) -> Option<Vec<&'a str>> {
    let Value::List(list) = list else { return None };
    let names: Vec<&str> = list.iter().map(Value::text).collect::<Option<_>>()?;
    let sound = |(place, name): (usize, &&str)| !name.is_empty() && !names[..place].contains(name);
    (!names.is_empty() && names.iter().enumerate().all(sound)).then_some(names)
}

/// Seconds, of a time in two members.
fn time(value: &Value) -> Option<f64> {
    let Value::Fields(fields) = value else { return None };
    let both = |(whole, rest): &(&str, &str)| {
        let (whole, rest) = (value.member(whole)?.number()?, value.member(rest)?.number()?);
        // 1 s = 10⁹ ns
        Some(whole + 1e-9 * rest)
    };
    (fields.len() == 2).then(|| TIMES.iter().find_map(both)).flatten()
}

/// The heading (rad) that a rotation about the vertical has, of a quaternion.
fn yaw_rad(value: &Value) -> Option<f64> {
    let Value::Fields(fields) = value else { return None };
    if fields.len() != 4 {
        return None;
    }
    let number = |name| value.member(name).and_then(Value::number);
    let (x, y, z, w) = (number("x")?, number("y")?, number("z")?, number("w")?);
    // ψ = atan2(2(wz + xy), w² + x² − y² − z²)
    Some((2.0 * (w * z + x * y)).atan2(w * w + x * x - y * y - z * z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields<'a>(fields: &[(&'a str, Value<'a>)]) -> Value<'a> {
        Value::Fields(fields.iter().map(|(name, value)| ((*name).into(), value.clone())).collect())
    }

    fn numbers<'a>(values: &[f64]) -> Value<'a> {
        Value::List(values.iter().copied().map(Value::Number).collect())
    }

    fn texts<'a>(values: &[&str]) -> Value<'a> {
        Value::List(values.iter().map(|text| Value::Text((*text).into())).collect())
    }

    fn flat(message: &Value) -> Vec<(String, f64)> {
        let mut all = Vec::new();
        flatten(message, &mut |path, number| all.push((path.to_owned(), number)));
        all
    }

    #[test]
    fn joints_go_by_their_names_and_a_time_is_one_number() {
        let stamp = fields(&[("sec", Value::Number(12.0)), ("nanosec", Value::Number(5e8))]);
        let state = fields(&[
            ("header", fields(&[("stamp", stamp), ("frame_id", Value::Text("base".into()))])),
            ("name", texts(&["right", "left"])),
            ("velocity", numbers(&[1.0, 2.0])),
            ("effort", numbers(&[])),
        ]);
        let told = [("header.stamp", 12.5), ("velocity[right]", 1.0), ("velocity[left]", 2.0)];
        assert_eq!(flat(&state), told.map(|(path, number)| (path.to_owned(), number)));
    }

    #[test]
    fn names_that_are_doubled_or_too_few_leave_the_places() {
        for names in [texts(&["a", "a"]), texts(&["a"]), texts(&["a", ""])] {
            let state = fields(&[("name", names), ("velocity", numbers(&[1.0, 2.0]))]);
            assert_eq!(flat(&state)[1], ("velocity[1]".to_owned(), 2.0));
        }
    }

    #[test]
    fn a_quaternion_has_its_heading_beside_it() {
        let half: f64 = 0.3;
        // about the vertical by 0.6 rad; a scale of the quaternion changes no angle
        let turned = [("x", 0.0), ("y", 0.0), ("z", 2.0 * half.sin()), ("w", 2.0 * half.cos())];
        let pose = fields(&[("orientation", fields(&turned.map(|(name, number)| (name, Value::Number(number)))))]);
        let told = flat(&pose);
        assert_eq!(told[4].0, "orientation.yaw");
        assert!((told[4].1 - 0.6).abs() < 1e-12);
    }

    #[test]
    fn transforms_go_by_the_frame_that_they_place() {
        let one = |frame: &str, x| {
            fields(&[
                ("child_frame_id", Value::Text(frame.into())),
                ("translation", fields(&[("x", Value::Number(x))])),
            ])
        };
        let all = fields(&[("transforms", Value::List(vec![one("base", 1.0), one("arm", 2.0)]))]);
        assert_eq!(flat(&all)[1], ("transforms[arm].translation.x".to_owned(), 2.0));
    }

    #[test]
    fn a_picture_is_no_column() {
        assert!(flat(&fields(&[("data", numbers(&[0.0; 65]))])).is_empty());
        assert_eq!(flat(&fields(&[("data", numbers(&[0.0; 64]))])).len(), 64);
    }
}
