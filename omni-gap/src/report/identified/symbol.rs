//! How a number of the robot file is written in equations.

use model_core::effects::nominal;

/// Its symbol and its unit, as its card says.
pub(super) fn symbol(key: &str) -> (&'static str, &'static str) {
    nominal::numbers().find(|number| number.key == key).map_or(("?", ""), |number| (number.symbol, number.unit))
}
