//! Chance: a share of telegrams that was counted in so many of them is known no better than chance lets it be.
//!
//! ```text
//! Var p = p·(1 − p)/n        n telegrams in which a loss would have shown
//! ```

use super::shoot::Shots;
use crate::simulate::{Model, Slot};

/// What chance adds to the variance of a number of a model that was fitted to these runs.
pub(super) fn variance<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, slot: Slot) -> f64 {
    let Slot::Param(at, _) = slot else { return 0.0 };
    let effect = &model.effects[at];
    if !effect.card().shows_event_by_event() {
        return 0.0;
    }
    let telegrams: usize = shots.runs.iter().map(|run| run.losses.told(effect.wheel)).sum();
    let share = model.get(slot);
    if telegrams == 0 { 0.0 } else { share * (1.0 - share) / telegrams as f64 }
}
