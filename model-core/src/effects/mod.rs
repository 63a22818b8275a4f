//! # The catalogue of effects
//!
//! What the plain model leaves out, one effect a file, in the folder of its stage. To add one: write its file (page,
//! card, law, hooks, tests), add its `mod` line in the stage's `mod.rs` and its entry in [`catalogue`]. Everything else
//! (files, ranking, pages, tests) finds it there; a test compares the folders with the list.
//!
//! An effect's page as data is its [`card`], what it sees and may change are the [`seams`], how it acts there is
//! [`Effect`], and the effects of one model, with their parameters and their memory, are in [`active`].

// What an effect is
pub mod card;

pub mod seams;

mod effect;
pub use effect::Effect;

// The effects, by stage
pub mod electrical;

pub mod drivetrain;

pub mod contact;

pub mod body;

pub mod sensing;

// The numbers that a robot file can have wrong
pub mod nominal;

mod catalogue;
pub use catalogue::{CARDS, CauseCard, catalogue, cause, causes, find};

// The effects of one model
pub mod active;
