//! The dynamics of 3- and 4-wheel omnidirectional robots, and the effects a plain model leaves out.
//!
//! Six folders, in reading order: what the equations compute with ([`number`]), where things are and how fast they move
//! ([`geometry`]), the robot and its motion ([`plant`]), what the plain model leaves out ([`effects`]), the loops that
//! move the robot ([`control`]), and what robot and host tell each other ([`link`]).
//!
#![doc = include_str!("notation.md")]
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod number;

pub mod geometry;

pub mod plant;

pub mod effects;

pub mod control;

pub mod link;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
