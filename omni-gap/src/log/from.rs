//! # Where a column comes from, as a mapping says it

use super::channel::Channel;
use super::formula::Formula;
use super::toml_walk::Section;
use crate::error::{InputKind, Result};

/// Where a column comes from.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum From {
    #[default]
    Itself,
    Name(String),
    /// Counted from 1.
    Position(usize),
    /// Several columns of a row together.
    Formula(Box<Formula>),
}

impl From {
    /// What a rule says of the column `name`: `from`, or `expr`.
    pub fn read(rule: &Section, name: &str, header: bool) -> Result<From> {
        match (rule.table.get("from"), rule.text("expr")?) {
            (Some(_), Some(_)) => Err(rule
                .key_error("expr", "the column comes `from` another one already", "Keep one of the two")
                .of_kind(InputKind::Conflict)),
            (None, Some(text)) if header => {
                Formula::parse(text).map(|formula| From::Formula(Box::new(formula))).map_err(|reason| {
                    let fix =
                        "Write it of columns, numbers, + - * / ^ and functions, such as \"{duty [%]} / 100 * vbat\"";
                    rule.key_error("expr", format!("this is no formula: {reason}"), fix)
                })
            }
            (Some(item), None) if item.is_integer() => match rule.whole("from")? {
                Some(0) | None => Err(rule.key_error("from", "found position 0", "Positions are counted from 1")),
                Some(number) => Ok(From::Position(number)),
            },
            (Some(item), None) if item.is_str() && header => {
                Ok(From::Name(item.as_str().unwrap_or_default().to_string()))
            }
            (Some(item), None) if item.is_str() => Err(rule.key_error(
                "from",
                "found a name, but the log has no header",
                "Give the position, counted from 1",
            )),
            (None, Some(_)) => Err(rule.key_error(
                "expr",
                "columns have names in a formula, and the log has no header",
                "Give the log a header, or compute the column before",
            )),
            _ => Err(rule
                .error("`from` is missing", "Name the source column, give its position, or compute it with `expr`")
                .in_column(name)
                .of_kind(InputKind::Missing)),
        }
    }

    /// The columns that are needed; the name of one that is missing.
    pub fn find(&self, names: &[String], width: usize) -> std::result::Result<Vec<usize>, String> {
        let named = |name: &String| names.iter().position(|other| other == name).ok_or_else(|| format!("`{name}`"));
        match self {
            From::Itself => Err("of its own name".into()),
            From::Name(name) => Ok(vec![named(name)?]),
            From::Position(number) if *number <= width => Ok(vec![number - 1]),
            From::Position(number) => Err(number.to_string()),
            From::Formula(formula) => formula.names().iter().map(named).collect(),
        }
    }

    /// Whether a column of this name may be needed.
    pub fn needs(&self, name: &str) -> bool {
        match self {
            From::Name(own) => own == name,
            From::Formula(formula) => formula.names().iter().any(|own| own == name),
            From::Itself | From::Position(_) => true,
        }
    }

    /// What the columns that were found make.
    pub fn channel(&self, mut columns: Vec<Channel>) -> Channel {
        match self {
            From::Formula(formula) => formula.of(&columns),
            _ => columns.remove(0),
        }
    }

    /// The key of a mapping that says it.
    pub fn key(&self) -> &'static str {
        if matches!(self, From::Formula(_)) { "expr" } else { "from" }
    }
}
