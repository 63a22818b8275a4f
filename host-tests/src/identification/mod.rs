//! # The identification of a robot, measured on many whose truth is known
//!
//! [`case`] says what is played and how it is measured, [`believed`] what is known beforehand, [`asked`] what the joint
//! fit answers, and [`bound`] what no estimator can go below. [`study`] rehearses the experiments over many seeds and
//! keeps every estimate; [`missing`] leaves out one group of sensors at a time, [`idle`] the excitation. [`quality`] sums
//! up an estimator, [`compared`] sets them side by side, [`promises`] holds them to what was promised, and [`page`] writes
//! it all down.

pub mod asked;
pub mod believed;
pub mod bound;
pub mod case;
pub mod compared;
mod digits;
pub mod idle;
pub mod missing;
pub mod page;
pub mod promises;
pub mod quality;
pub mod study;
mod tables;
mod telling;

pub use study::Studied;

/// All that is measured.
#[derive(Clone, Debug)]
pub struct Results {
    /// The cases, in the order of [`case::CASES`].
    pub cases: Vec<Studied>,
    /// Recordings with one group missing.
    pub missing: Vec<missing::Missing>,
    /// Recordings without excitation.
    pub idle: Vec<idle::Idle>,
}
