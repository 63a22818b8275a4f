//! What is told of a place.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A cause at a place, and the number that says how much of it there is.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
pub struct PooledNumber {
    /// Id of the catalogue.
    pub id: String,
    /// Wheel, where it sits on one.
    pub wheel: Option<usize>,
    /// Key of the number.
    pub key: String,
    /// Its unit; `1` where dimensionless, and for the factor on a number of the robot file.
    pub unit: String,
}
