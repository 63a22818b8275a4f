//! # The proof
//!
//! No product code lives here. The rooms, in reading order:
//!
//! - [`paper`]: the paper's two robots, typed in once;
//! - [`matrices`]: A, B and K of `dx/dt = A·x + B·u + K·sign(x)`, as printed and as derived from virtual work;
//!
//! The paper is Oliveira, Sousa, Moreira and Costa, *Dynamical Models for Omni-directional Robots with 3 and 4 Wheels*
//! (ICINCO 2008). Nothing in this library depends on the core: two implementations that agree prove something only if
//! they share no line.

// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod matrices;
pub mod paper;
