//! # Localise: where the gap lies
//!
//! How large the gap is by the protocol ([`measure`]), which measured link of the signal path it belongs to ([`links`]),
//! in which regime of the motion it is largest ([`regimes`]), and what shape it has over what a roboticist would look at
//! ([`shape`]); whether a model leaves more than noise ([`excess`]), and how much any model could explain ([`flexible`]).
//! [`validation`] lays whole free runs over what was measured, signal by signal.

mod excess;
pub mod flexible;
mod floor;
mod gap;
mod links;
mod own;
mod regime;
pub mod shape;
pub mod validation;

pub use excess::excess;
pub use floor::{FLOOR_SEED, floor, replay};
pub use gap::{HORIZONS_S, Measured, measure};
pub use links::{Link, Links, links};
pub use regime::{Hotspot, RegimeSettings, regimes};
