//! # The benchmark: what the diagnosis finds where the truth is known
//!
//! [`sessions`] lists what is hidden in which recordings, [`outcome`] diagnoses one of them and holds the answer to the
//! truth, [`page`] writes all of it down for a person. `cargo xtask benchmark` does it and rewrites
//! `host-tests/golden/catalogue.md`; a test reads that page again.

pub mod outcome;
pub mod page;
pub mod sessions;
