//! Topics of a recording: which there are, and what is said where the one that is meant is not clear.

use crate::error::{Error, InputKind, Result};
use std::path::Path;

/// A topic that a recording has messages of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Seen {
    pub topic: String,
    /// The type of its messages.
    pub of_type: String,
    pub messages: usize,
}

/// The topic of a recording that has one only.
pub(super) fn the_only_one(path: &Path, topics: &[Seen]) -> Result<String> {
    let problem = match topics {
        [only] => return Ok(only.topic.clone()),
        [] => "there is no message in the recording".to_owned(),
        _ => format!("the recording has several topics: {}", listed(topics)),
    };
    let fix = "Say in columns.toml which to read: a [[file]] table with `topic` for each (`omni-gap explain columns`)";
    Err(Error::input(path, problem, fix).of_kind(InputKind::Missing))
}

/// What is said of a topic that a recording does not have.
pub(super) fn absent(path: &Path, topic: &str, topics: &[Seen]) -> Error {
    let there = if topics.is_empty() { "none at all".to_owned() } else { listed(topics) };
    let problem = format!("there are no messages of topic `{topic}`; it has {there}");
    Error::input(path, problem, "Correct `topic` in columns.toml").of_kind(InputKind::Missing)
}

/// Topics, in words.
fn listed(topics: &[Seen]) -> String {
    let told = |seen: &Seen| match seen.of_type.as_str() {
        "" => format!("`{}` ({})", seen.topic, seen.messages),
        of_type => format!("`{}` ({}, {of_type})", seen.topic, seen.messages),
    };
    topics.iter().map(told).collect::<Vec<_>>().join(", ")
}
