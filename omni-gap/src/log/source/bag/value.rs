//! # What a message says, whatever it was encoded in

use std::borrow::Cow;

/// What reading a message can fail of, in words.
pub(super) type Told<T> = Result<T, String>;

/// Longer lists are pictures, clouds and maps: no columns.
pub(super) const LONGEST_LIST: usize = 64;

/// A decoded message, or a part of one.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value<'a> {
    Number(f64),
    Text(String),
    List(Vec<Value<'a>>),
    Fields(Vec<(Cow<'a, str>, Value<'a>)>),
    /// Bytes, pictures, and whatever else is no number.
    Other,
}

impl Value<'_> {
    /// The member of this name.
    pub fn member(&self, name: &str) -> Option<&Value<'_>> {
        match self {
            Value::Fields(fields) => fields.iter().find(|(other, _)| other == name).map(|(_, value)| value),
            _ => None,
        }
    }

    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    pub fn text(&self) -> Option<&str> {
        match self {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }
}
