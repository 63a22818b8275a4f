//! Labels: what is true of a session, in a file that no contestant is given.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::true_model::TrueModel;

/// What a session is there to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Suite {
    /// One cause, recorded as a laboratory would.
    Laboratory,
    /// Nothing beyond what the file states.
    NoGap,
    /// One cause, in logs as robots leave them.
    Life,
    /// Two or three causes, or three to five wrong numbers.
    Several,
    /// Physics that the catalogue does not know.
    Open,
    /// Drives that control speed.
    SetSpeed,
}

impl Suite {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 6] = [Self::Laboratory, Self::NoGap, Self::Life, Self::Several, Self::Open, Self::SetSpeed];

    /// As files and tables call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Laboratory => "laboratory",
            Self::NoGap => "no-gap",
            Self::Life => "life",
            Self::Several => "several",
            Self::Open => "open",
            Self::SetSpeed => "set-speed",
        }
    }
}

/// How large the gap is that a cause makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// No size within bounds makes a gap of [`VISIBLE`].
    Invisible,
    /// Up to 3.5 σ.
    Weak,
    /// Up to 9 σ.
    Medium,
    /// More.
    Strong,
}

/// A gap below this is none that anybody has to see [σ]
pub const VISIBLE: f64 = 1.5;

/// Between weak and medium, and between medium and strong [σ]: between what is asked of each.
const PARTED_AT: [f64; 2] = [3.5, 9.0];

impl Severity {
    /// Gaps that are drawn, from and to [σ].
    pub fn range(self) -> (f64, f64) {
        match self {
            Self::Invisible => (0.0, VISIBLE),
            Self::Weak => (VISIBLE, 3.0),
            Self::Medium => (4.0, 8.0),
            Self::Strong => (10.0, 25.0),
        }
    }

    /// Of a gap [σ].
    pub fn of(gap: f64) -> Self {
        match gap {
            _ if gap < VISIBLE => Self::Invisible,
            _ if gap < PARTED_AT[0] => Self::Weak,
            _ if gap < PARTED_AT[1] => Self::Medium,
            _ => Self::Strong,
        }
    }
}

/// One cause that is hidden.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hidden {
    /// Its name in the data contract.
    pub cause: String,
    /// The wheel that it sits on alone.
    pub wheel: Option<usize>,
    /// Its size, of the typical one [1]
    pub times: f64,
    /// The gap that it makes alone [σ]
    pub gap: f64,
}

/// As answers and classes call it that there is nothing to be seen.
pub const NO_GAP: &str = "no_gap";

/// What is true of one session.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// Name of its folder.
    pub session: String,
    /// What it asks.
    pub suite: Suite,
    /// Of everything that is drawn in it.
    pub seed: u64,
    /// What is hidden, the largest gap first; empty where nothing is, or nothing that has a name.
    pub hidden: Vec<Hidden>,
    /// What is hidden that no entry of the catalogue describes.
    pub foreign: Option<String>,
    /// Causes that name a number of the file that is off by twice what is stated of it: naming one is no false alarm.
    pub far_off: Vec<String>,
    /// The robot and how it was logged, for whoever looks for what is hard.
    pub about: BTreeMap<String, String>,
    /// The robot in the words of the catalogue; none where no entry describes what is hidden.
    #[serde(default)]
    pub truth: Option<TrueModel>,
    /// Causes that no log of these sensors parts from the one that is hidden; [`NO_GAP`] where nothing parts it from none.
    #[serde(default)]
    pub class: Vec<String>,
}

impl Label {
    /// True where nothing has to be found.
    pub fn nothing(&self) -> bool {
        self.hidden.is_empty() && self.foreign.is_none()
    }

    /// Of the cause with the largest gap.
    pub fn severity(&self) -> Option<Severity> {
        self.hidden.first().map(|hidden| Severity::of(hidden.gap))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn severities_part_where_no_gap_is_asked_for() {
        for severity in [Severity::Weak, Severity::Medium, Severity::Strong] {
            let (low, high) = severity.range();
            // a tenth to either side is as close as a size is found
            for gap in [low * 1.05, high, high * 1.1] {
                assert_eq!(Severity::of(gap), severity, "{gap} σ");
            }
        }
        assert_eq!(Severity::of(1.49), Severity::Invisible);
    }

    #[test]
    fn names_are_those_of_the_files() {
        for suite in Suite::ALL {
            assert_eq!(serde_json::to_string(&suite).expect("a word"), format!("\"{}\"", suite.name()));
        }
    }
}
