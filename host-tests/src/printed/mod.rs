//! # What the paper prints, and what comes out

mod core;

pub use self::core::of_the_core;
