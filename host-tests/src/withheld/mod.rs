//! # The effect withheld: a benchmark that others can enter
//!
//! [`suites`] draws robots and causes, and how they are driven and logged, and lets `ground-truth` record them; [`set`] keeps recordings and labels apart and
//! seals the labels; a [`contestant`] is any command that takes a session folder and leaves `report.json`, run where it sees
//! nothing else, and [`watch`]ed; [`scored`] holds each [`answer`] to its [`label`], and [`table`] puts [`figures`] with their
//! intervals beside one another. `cargo xtask bench make | run | score | table`; the rules stand in `BENCHMARK.md`.

pub mod answer;
pub mod classes;
pub mod closed;
pub mod contestant;
pub mod estimates;
pub mod figures;
pub mod honest;
pub mod label;
mod logged;
pub mod picture;
pub mod scored;
pub mod selective;
pub mod set;
pub mod suites;
pub mod table;
pub mod true_model;
mod turns;
pub mod watch;
