//! # Self-test: what recordings could show, before anybody drives
//!
//! A robot file, an excitation and its sensors are enough to say what a diagnosis of such recordings could find. Every cause
//! moves the recording by its signature s. What the windows' starts and the nominal numbers, within what the robot file
//! states of them, can imitate of it is taken away; what is left says from what size on the cause can be found, and the
//! angles between what is left of two causes, from what size on they can be told apart.
//!
//! ```text
//! s⊥ = s − what starts and numbers imitate      seen: m²·|s⊥|² ≥ what the engine asks of a cause
//! r² = |s⊥|² − what a rival imitates of s⊥      told apart: m²·r² ≥ what parts two causes
//! ```
//!
//! m is a multiple of the typical size. From what size on an effect is seen is looked for at that size; what it takes more to
//! be told apart is taken as at the typical one. `verify` finds the first of these sizes once more, in recordings.

mod judge;
mod laid;
mod left;
mod sensors;
mod sizes;
mod sizing;
mod standing;
mod suspects;
mod verify;
mod view;

pub(super) use judge::mask;
pub use judge::{confusion, selftest};
pub(super) use laid::{Laid, Look};
pub(super) use left::{Left, Remainder};
pub use sensors::Sensors;
pub(super) use suspects::{Column, Suspect, of_effect, of_number, put};
pub use verify::verify;
