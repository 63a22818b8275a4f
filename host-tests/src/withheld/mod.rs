//! # The effect withheld: a benchmark that others can enter
//!
//! [`suites`] draws robots and causes, and how they are driven and logged, and lets `ground-truth` record them; [`set`] keeps
//! recordings and labels apart and seals the labels; a [`contestant`] is any command that takes a session folder and leaves `report.json`, run where it sees
//! nothing else, and [`watch`]ed; [`scored`] holds each [`answer`] to its [`label`], [`closed`] drives what was left over the
//! recordings beside the [`true_model`], [`estimates`] holds its numbers to what was put in, and [`table`], [`honest`] and
//! [`picture`] put [`figures`] with their intervals beside one another. An engine of an old commit is [`frozen`], and what was
//! scored on fresh splits stands in a [`ledger`]. `cargo xtask bench help`; the test command asks the product the [`reduced`] split; the rules stand in `BENCHMARK.md`.

pub mod answer;
pub mod calibrated;
pub mod classes;
pub mod closed;
pub mod contestant;
pub mod estimates;
pub mod figures;
pub mod frozen;
pub mod honest;
pub mod label;
pub mod ledger;
mod logged;
pub mod picture;
pub mod reduced;
pub mod rival_fits;
pub mod scored;
pub mod selective;
pub mod set;
pub mod suites;
pub mod table;
pub mod true_model;
mod turns;
pub mod watch;
