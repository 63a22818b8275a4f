//! What effects of a bridge share.

use super::card::{Param, Role};

/// The number of a card: i₀, current below which a loss that goes against it fades, so that it has no corner where the current
/// changes its sign.
pub const SMOOTHING_CURRENT: Param = Param {
    key: "smoothing_current_A",
    symbol: "i₀",
    unit: "A",
    absent: 0.05,
    typical: 0.05,
    within: (0.01, 0.5),
    role: Role::Fixed,
};
