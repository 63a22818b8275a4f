//! The rows of the three tables.

use model_core::plant::robot::Nominal;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::cells::{Cell, Row};
use crate::vocabulary::{Axis, Kind, Verdict};

/// A session, diagnosed or not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SessionRow {
    /// Hash of all that the answer rests on.
    pub key: String,
    /// Its folder, as it was named.
    pub session: String,
    /// The robot.
    pub robot: String,
    /// What kind of robot: the name in its robot file; none where that cannot be read.
    pub kind: Option<String>,
    /// The day, YYYY-MM-DD.
    pub date: String,
    /// The firmware's version, where it is known.
    pub firmware: Option<String>,
    /// The floor, where it is known.
    pub floor: Option<String>,
    /// The answer in one word; none where it could not be asked.
    pub verdict: Option<Verdict>,
    /// Why there is no answer, or why the data are unfit.
    pub reason: Option<String>,
    /// The causes that it named, separated by commas.
    pub causes: String,
    /// Runs, held-out ones too.
    pub runs: u32,
    /// Rows of them.
    pub rows: u64,
    /// Their length \[s\]
    pub duration_s: f64,
    /// The error of the free runs \[σ\]: by the robot file.
    pub gap: Option<f64>,
    /// With the causes in the model \[σ\].
    pub gap_after: Option<f64>,
    /// Of a perfect model \[σ\].
    pub floor_of_gap: Option<f64>,
    /// Its report, relative to the store; none where none was kept.
    pub report: Option<String>,
}

/// A number of a cause that a session considered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CauseRow {
    /// Hash of all that the answer rests on.
    pub key: String,
    /// The session's folder.
    pub session: String,
    /// The robot.
    pub robot: String,
    /// The day, YYYY-MM-DD.
    pub date: String,
    /// Id of the catalogue.
    pub cause: String,
    /// Effect or parameter.
    pub cause_kind: Kind,
    /// Wheel, where it sits on one.
    pub wheel: Option<u32>,
    /// Body axis, where it speaks of one.
    pub axis: Option<Axis>,
    /// The round of the search in which it was tried; zero: on top of the plain model, re-fitted.
    pub round: u32,
    /// Whether it was taken up.
    pub taken_up: bool,
    /// Key of the number.
    pub number: String,
    /// Its unit.
    pub unit: String,
    /// Where the cause is absent.
    pub absent: f64,
    /// Its estimate.
    pub value: Option<f64>,
    /// One standard error of it.
    pub std: Option<f64>,
    /// Drop of Σ error²/φ that the screen promises \[1\].
    pub promise: f64,
    /// What held-out runs gain by it; none where it was not fitted.
    pub gain: Option<f64>,
    /// Probability of the cause, all places together \[1\].
    pub probability: Option<f64>,
}

/// A line of a session's equations, [`SessionEquations`](crate::engine::findings::SessionEquations): of an effect, or of a number
/// of the robot file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquationRow {
    /// Hash of all that the answer rests on.
    pub key: String,
    /// The session's folder.
    pub session: String,
    /// Id of the effect; none of a number of the robot file.
    pub effect: Option<String>,
    /// Wheel, where it sits on one.
    pub wheel: Option<u32>,
    /// Key of the number.
    pub number: String,
    /// Its unit.
    pub unit: String,
    /// Where the effect is absent; of a number of the robot file one.
    pub absent: f64,
    /// For an amount of one.
    pub typical: f64,
    /// Whether the amount may be negative.
    pub either_way: bool,
    /// Whether it is an effect that was found: its line then completes those of the numbers.
    pub carried: bool,
    /// A with itself \[1\].
    pub size: f64,
    /// b \[1\].
    pub toward: f64,
    /// A with the numbers of the robot file \[1\].
    pub with: [f64; Nominal::COUNT],
    /// What the robot file states of it beside each number \[1\]; zero of an effect.
    pub stated_with: [f64; Nominal::COUNT],
}

impl Row for SessionRow {
    const TABLE: &'static str = "sessions";

    fn columns() -> Vec<(String, Cell)> {
        let text = ["key", "session", "robot", "kind", "date", "firmware", "floor", "verdict", "reason", "causes"];
        let numbers = ["duration_s", "gap", "gap_after", "floor_of_gap"];
        named(&text, Cell::Text)
            .chain(named(&["runs", "rows"], Cell::Whole))
            .chain(named(&numbers, Cell::Number))
            .chain(named(&["report"], Cell::Text))
            .collect()
    }

    fn session(&self) -> &str {
        &self.session
    }
}

impl Row for CauseRow {
    const TABLE: &'static str = "causes";

    fn columns() -> Vec<(String, Cell)> {
        let text = ["key", "session", "robot", "date", "cause", "cause_kind", "axis", "number", "unit"];
        let numbers = ["absent", "value", "std", "promise", "gain", "probability"];
        named(&text, Cell::Text)
            .chain(named(&["wheel", "round"], Cell::Whole))
            .chain(named(&["taken_up"], Cell::Truth))
            .chain(named(&numbers, Cell::Number))
            .collect()
    }

    fn session(&self) -> &str {
        &self.session
    }
}

impl Row for EquationRow {
    const TABLE: &'static str = "equations";

    fn columns() -> Vec<(String, Cell)> {
        named(&["key", "session", "effect", "number", "unit"], Cell::Text)
            .chain(named(&["wheel"], Cell::Whole))
            .chain(named(&["either_way", "carried"], Cell::Truth))
            .chain(named(&["absent", "typical", "size", "toward"], Cell::Number))
            .chain(
                LISTS.into_iter().flat_map(|list| Nominal::ALL.map(|number| (column_of(list, number), Cell::Number))),
            )
            .collect()
    }

    fn session(&self) -> &str {
        &self.session
    }

    fn flattened(mut object: Map<String, Value>) -> Map<String, Value> {
        for list in LISTS {
            let Some(Value::Array(values)) = object.remove(list) else { continue };
            let named = Nominal::ALL.into_iter().zip(values);
            object.extend(named.map(|(number, value)| (column_of(list, number), value)));
        }
        object
    }

    fn gathered(mut object: Map<String, Value>) -> Map<String, Value> {
        for list in LISTS {
            let values = Nominal::ALL.map(|number| object.remove(&column_of(list, number)).unwrap_or(Value::Null));
            object.insert(list.to_owned(), values.to_vec().into());
        }
        object
    }
}

/// The fields that are one column for each number of the robot file.
const LISTS: [&str; 2] = ["with", "stated_with"];

/// `with_mass_kg`: a list's column of a number.
fn column_of(list: &str, number: Nominal) -> String {
    format!("{list}_{}", number.number().key)
}

fn named(names: &[&str], cell: Cell) -> impl Iterator<Item = (String, Cell)> {
    names.iter().map(move |name| ((*name).to_owned(), cell)).collect::<Vec<_>>().into_iter()
}
