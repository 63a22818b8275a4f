//! # The report of a fleet: what many robots tell together
//!
//! [`FleetReport`] is `fleet.json` and nothing else; [`terminal()`] says it in words, [`html()`] draws it on one page that needs no
//! network, [`write()`] puts both into a folder so that none is ever half-written.

mod course;
mod html;
mod map;
mod model;
mod phrases;
#[cfg(test)]
mod sample;
mod terminal;
mod write;

pub use html::html;
pub use model::{FleetReport, KindOfRobot, SCHEMA, SessionLine};
pub use terminal::terminal;
pub use write::{FILES, Written, write};
