//! How residuals are laid over features, and what counts as a shape.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How residuals are laid over features, and what counts as a shape.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct ShapeSettings {
    /// Length of a window of which a force is told [s]: short beside a robot's time constant, so that a wrong force has not yet
    /// changed the speed that it depends on.
    pub window_s: f64,
    /// Rows of such a window, at the least [rows]: a slope needs some. Slow logs have longer windows.
    pub window_rows: usize,
    /// Residuals that are this far apart are independent [s]: longer than noise remembers itself and than a start is smoothed over.
    pub independent_s: f64,
    /// What circumstances are told of a free run says nothing this soon after a restart [s]: its start shares noise with the residual.
    pub settled_s: f64,
    /// Recordings that are looked at, at the least where there are as many [s]; those held out come first.
    pub least_s: f64,
    /// Recordings that are looked at, at the most [s]: what has a shape shows in a minute.
    pub most_s: f64,
    /// Bins of a curve, at the most [bins]: as many as a person reads.
    pub bins: usize,
    /// Independent samples in each bin, at the least [samples]: an interval of fewer is a guess.
    pub fewest_independent: usize,
    /// A bin is no narrower than this share of the feature's range [1].
    pub least_width: f64,
    /// Chance that one shape is shown where there is none, all that was looked at counted [1].
    pub false_alarm: f64,
    /// A curve that holds less than this of the residual's mean square shows nothing to a person [1].
    pub least_share: f64,
    /// Curves that are shown, at the most [curves].
    pub most: usize,
    /// Highest order of a wheel's turn that is looked for [1/turn].
    pub highest_order: usize,
    /// Orders on either side of one that tell how large its neighbours are [orders]; where half as many are there it is told.
    pub order_neighbours: usize,
    /// Cells of the map of the floor along its longer side [cells].
    pub cells: usize,
}

impl Default for ShapeSettings {
    fn default() -> Self {
        Self {
            window_s: 0.05,
            window_rows: 5,
            independent_s: 0.25,
            settled_s: 0.1,
            least_s: 12.0,
            most_s: 60.0,
            bins: 14,
            fewest_independent: 8,
            least_width: 0.025,
            false_alarm: 0.02,
            least_share: 0.01,
            most: 3,
            highest_order: 240,
            order_neighbours: 20,
            cells: 8,
        }
    }
}
