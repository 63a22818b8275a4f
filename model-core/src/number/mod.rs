//! # Number: what the equations compute with
//!
//! One trait, [`Real`](scalar::Real), for four kinds of number: `f32` on the robot, `f64` on the host,
//! [`Dual`](dual::Dual) where a derivative is wanted, and lanes for several robots side by side. Sine, cosine and square root are written here, so that every
//! machine computes the same bits; vectors and matrices of three are arrays.

pub mod scalar;

pub mod trig;

pub mod exponential;

pub mod root;

pub(crate) mod decay;

pub mod dual;

pub(crate) mod lanes;

pub mod linalg;
