//! # Carried: effects that a robot file carries, fitted by `identify`
//!
//! [`cases`] stages robots that have an effect whose size their file has wrong, [`page`] writes down what `identify` makes of
//! it beside the truth. `cargo xtask carried` does it for the whole catalogue and holds it to
//! `host-tests/golden/carried_effects.md`; a test does it for some effects and reads that page again.

pub mod cases;
pub mod page;
