//! # Engine: which cause, and never a name without its look-alikes
//!
//! [`Evidence`] goes in, [`Findings`] come out, and what decides between them is written down in [`Knobs`]. Behind the
//! seam stands [`Stepwise`], the engine of the product; another is whatever has the trait [`Engine`].

pub mod design;
pub mod evidence;
mod excerpt;
pub mod findings;
pub mod knobs;
mod predictions;
mod seam;
pub mod selftest;
mod stepwise;

pub use evidence::Evidence;
pub use findings::Findings;
pub use knobs::Knobs;
pub use seam::Engine;
pub use stepwise::Stepwise;
