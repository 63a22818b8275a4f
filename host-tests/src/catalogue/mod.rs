//! # The benchmark: what the diagnosis finds where the truth is known
//!
//! [`sessions`] lists what is hidden in which recordings, [`outcome`] diagnoses one of them and holds the answer to the
//! truth, [`misses`] asks the self-test why what was missed was missed, [`page`] writes all of it down for a person.
//! `cargo xtask benchmark` does it and rewrites `host-tests/golden/catalogue.md`; a test reads that page again.
//!
//! The diagnosis's own medicine shares them: [`foretold`] asks the self-test what it will find, [`medicine_page`] writes down
//! what it found, and `cargo xtask medicine` holds both to `host-tests/golden/own_medicine.md`.

pub mod foretold;
pub mod medicine_page;
pub mod misses;
pub mod outcome;
pub mod page;
pub mod sessions;
