//! # The identification of a robot, measured on many whose truth is known
//!
//! [`case`] says what is played and how it is measured, [`prior`] what is known beforehand, [`joint_fit`] what the
//! joint fit answers, and [`cramer_rao`] what no estimator can go below. [`study`] rehearses the experiments over many
//! seeds and keeps every estimate; [`missing_group`] leaves out one group of sensors at a time, [`no_excitation`] the
//! excitation. [`statistics`] sums up an estimator, [`comparison`] sets them side by side, [`promises`] holds them to
//! what was promised, and [`page`] writes it all down.

pub mod case;
pub mod comparison;
pub mod cramer_rao;
mod identifiability;
pub mod joint_fit;
pub mod missing_group;
pub mod no_excitation;
pub mod page;
pub mod prior;
pub mod promises;
mod significant_figures;
pub mod statistics;
pub mod study;
mod tables;

pub use study::StudyResult;

/// All that is measured.
#[derive(Clone, Debug)]
pub struct Results {
    /// The cases, in the order of [`case::CASES`].
    pub cases: Vec<StudyResult>,
    /// Recordings with one group missing.
    pub missing: Vec<missing_group::MissingGroup>,
    /// Recordings without excitation.
    pub idle: Vec<no_excitation::NoExcitation>,
}
