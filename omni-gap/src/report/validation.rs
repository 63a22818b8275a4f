//! # The report of a validation: a model laid over its recordings
//!
//! [`terminal()`] says it in a table and a sentence, [`html()`] draws every run on one page that needs no network. As in
//! all of the report nothing is computed here: every number stands in [`Validation`].

mod curves;
mod page;
mod phrases;
mod run;
#[cfg(test)]
mod sample;
mod terminal;

pub use page::html;
pub use phrases::headline;
pub use terminal::terminal;

#[cfg(doc)]
use crate::localise::validation::Validation;
