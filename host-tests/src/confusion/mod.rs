//! # Confusion: which cause would be taken for which
//!
//! [`cases`] lists robots and motions, [`pairs`] brings the angles of all of them together and holds them to what the cards
//! say of look-alikes, [`page`] and [`picture`] write it down for a person. `cargo xtask confusion` does it and holds it to
//! `host-tests/golden/confusion.md` and the pictures beside it; a test reads that page again.

pub mod cases;
pub mod page;
pub mod pairs;
pub mod picture;
