//! What a session says of small changes of its model: equations that add up over sessions and robots.
//!
//! ```text
//! −2·ln(likelihood) = const − 2·bᵀ·x + xᵀ·A·x        x = (a; ln f)
//! ```
//!
//! a is how much of an effect there is, in typical sizes of its card, and f are the factors on the numbers of the robot file. The
//! starts of all windows are eliminated, and so is what the model carries; the data are weighted down by their dispersion;
//! of what the file states of its numbers nothing is in A or b.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The equations of a session, about the model with all causes that were found in it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SessionEquations {
    /// A of the numbers of the robot file among themselves, row by row, in the order of the catalogue [1]
    pub numbers: Vec<Vec<f64>>,
    /// b of the numbers [1]
    pub toward: Vec<f64>,
    /// What the robot file states of its numbers, in the same coordinates: the inverse of a covariance [1]
    pub stated: Vec<Vec<f64>>,
    /// Every effect of the catalogue, at every place.
    pub directions: Vec<Direction>,
}

impl SessionEquations {
    /// The same, its data counted that much.
    #[must_use]
    pub fn weighted(mut self, by: f64) -> Self {
        self.numbers.iter_mut().flatten().chain(&mut self.toward).for_each(|x| *x *= by);
        for direction in &mut self.directions {
            direction.size *= by;
            direction.toward *= by;
            direction.with_numbers.iter_mut().for_each(|x| *x *= by);
        }
        self
    }
}

/// One way in which an effect may depart from absent: one of its sizes, or a shape that is an effect of its own.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Direction {
    /// Id of the catalogue.
    pub id: String,
    /// Wheel, where it sits on one.
    pub wheel: Option<usize>,
    /// Key of the number that departs.
    pub key: String,
    /// Unit of that number; `1` where dimensionless.
    pub unit: String,
    /// The number where the effect is absent.
    pub absent: f64,
    /// The number for a = 1.
    pub typical: f64,
    /// True if a may be negative.
    pub either_way: bool,
    /// True of an effect that was found: it is then eliminated from the numbers' own equations, and these are completed by its line,
    /// A + w·wᵀ/s and b + w·t/s (w: with_numbers, s: size, t: toward).
    pub carried: bool,
    /// A of a with itself [1]
    pub size: f64,
    /// b of a [1]
    pub toward: f64,
    /// A of a with the numbers of the robot file [1]
    pub with_numbers: Vec<f64>,
}
