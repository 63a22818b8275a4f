//! The dynamics of 3- and 4-wheel omnidirectional robots, and the effects a plain model leaves out.
//!
//! In reading order: the numbers ([`scalar`], [`trig`], [`root`], [`dual`], [`small`]), the geometry ([`frames`], [`shafts`],
//! [`kinematics`]), the winding ([`motor`], [`phases`]) and what a drive does with it ([`calibration`], [`halls`],
//! [`current_loop`]), the effects' pages ([`card`]), the robot ([`robot`], [`paper`]) and its motion ([`body`],
//! [`plant`], [`feedforward`]), the loop that moves it ([`reference`](mod@reference), [`headroom`], [`compensation`],
//! [`tick`]), and what robot and host tell each other ([`link`], [`command`], [`record`], [`hello`], [`faults`],
//! [`block`], [`mover`]).
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

// The numbers
pub mod scalar;

pub mod trig;

pub mod root;

pub mod dual;

pub mod small;

// The geometry
pub mod frames;

pub mod shafts;

pub mod kinematics;

// The motor
pub mod motor;

pub mod phases;

pub mod calibration;

pub mod halls;

pub mod current_loop;

// The effects
pub mod card;

pub mod seams;

pub mod effects;

pub mod active;

// The robot and its motion
pub mod robot;

pub mod observer;
pub mod paper;

pub mod body;

pub mod plant;

pub mod feedforward;

// The bytes between robot and host
mod bytes;

pub mod link;

pub mod faults;

pub mod command;

pub mod record;

pub mod hello;

pub mod block;

pub mod mover;
// The control loop
pub mod reference;

pub mod headroom;

pub mod compensation;

pub mod tick;
