//! # Verified: the sizes that the self-test foretells, found in simulated recordings
//!
//! [`cases`] asks the self-test about three robots and looks for every cause in recordings of robots that have it, [`page`]
//! writes it down for a person. `cargo xtask selftest` does it and holds it to `host-tests/golden/selftest_verified.md`; a
//! test reads that page again.

pub mod cases;
pub mod page;
