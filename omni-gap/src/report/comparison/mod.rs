//! # The report of a comparison: two sessions beside each other
//!
//! [`ComparisonReport`] is `compare.json` and nothing else; [`terminal()`] says it in words, [`html()`] draws it on one page that
//! needs no network, [`write()`] puts both into a folder so that none is ever half-written.

mod html;
mod model;
mod phrases;
#[cfg(test)]
mod sample;
mod terminal;
mod write;

pub use html::{html, pictures};
pub use model::{Against, ComparisonReport, Named, SCHEMA};
pub use phrases::headline;
pub use terminal::terminal;
pub use write::{FILES, Written, write};
