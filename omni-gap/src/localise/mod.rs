//! # Localise: where the gap lies
//!
//! How large the gap is by the protocol ([`measure`]), which measured link of the signal path it belongs to ([`links`]),
//! in which regime of the motion it is largest ([`regimes`]), and what shape it has over what a roboticist would look at
//! ([`shape`]). [`validation`] lays whole free runs over what was
//! measured, signal by signal.

mod floor;
mod gap;
mod links;
mod regime;
pub mod shape;
pub mod validation;

pub use floor::{FLOOR_SEED, floor, replay};
pub use gap::{HORIZONS_S, Measured, measure};
pub use links::{Link, Links, links};
pub use regime::{Hotspot, RegimeSettings, regimes};
