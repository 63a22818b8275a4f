//! # The proof
//!
//! No product code lives here. The rooms, in reading order:
//!
//! - [`paper`]: the paper's two robots, typed in once;
//! - [`generic_robot`]: any robot, as a list of wheels;
//! - [`matrices`]: A, B and K of `dx/dt = A·x + B·u + K·sign(x)`, as printed and as derived from virtual work;
//! - [`flow`]: the exact solution between two sign changes, and when the next one comes;
//! - [`mod@reference`]: the f64 robot that every other implementation is measured against;
//! - [`excitation`]: seeded robots, and voltage sequences that start, stop, reverse and rest;
//! - [`printed`]: every figure that the paper prints, beside what comes out when it is computed;
//! - [`paper_source`]: the paper's robots as Rust, from their robot files;
//! - [`catalogue`]: the benchmark of the diagnosis, on recordings whose truth is known;
//! - [`confusion`]: which cause would be taken for which, on three robots and with two kinds of motion;
//! - [`verified`]: the sizes that the self-test foretells, found in simulated recordings of three robots;
//! - [`carried`]: effects that a robot file carries with a wrong size, and what `identify` makes of it;
//! - [`laboratory`]: every cause, recorded by a simulator that shares no line with the one that judges;
//! - `withheld`: the benchmark that others can enter, on recordings whose labels nobody is given (on Linux);
//! - `fault_injection`: faults of the world around the program, and what it does then (on Linux);
//! - [`memory`]: what a process holds;
//! - [`frozen`]: whole reports that stay as they are while walls move;
//! - [`identification`]: the identification of robots whose truth is known, over many seeds;
//! - [`pairs`]: two sessions that differ in one thing or in nothing, and what `compare` says of them;
//! - [`real`]: what the diagnosis says of recordings of real robots;
//! - [`virtual_board`]: what the robot's electronics see, without the robot;
//! - [`emulator`]: the robot's image in QEMU, driving a virtual board;
//! - [`golden`]: pages that a program makes and is held to;
//! - [`costs`]: instructions of the control path, as the emulator counts them;
//! - [`in_loop`]: the robot's program, a robot that is not what it believes, and somebody who commands it;
//! - [`fleet`]: many robots of a kind, and what pooling says of them;
//! - [`plant_cases`] and [`fit_case`]: what step and fit are timed with;
//! - [`mod@mujoco`]: both beside MuJoCo's, in one run;
//! - [`image`]: sizes, symbols, reach and stack of the firmware's image.
//!
//! The paper is Oliveira, Sousa, Moreira and Costa, *Dynamical Models for Omni-directional Robots with 3 and 4 Wheels*
//! (ICINCO 2008). Nothing in the first six rooms depends on the core: two implementations that agree prove something only
//! if they share no line.

// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod carried;
pub mod catalogue;
pub mod confusion;
pub mod costs;
pub mod designs;
pub mod emulator;
pub mod excitation;
#[cfg(target_os = "linux")]
pub mod fault_injection;
pub mod fit_case;
pub mod fleet;
pub mod flow;
pub mod frozen;
pub mod generic_robot;
pub mod golden;
pub mod identification;
pub mod image;
pub mod in_loop;
pub mod laboratory;
pub mod matrices;
pub mod memory;
pub mod morning;
pub mod mujoco;
pub mod pairs;
pub mod paper;
pub mod paper_source;
pub mod plant_cases;
pub mod printed;
pub mod real;
pub mod reference;
pub mod verified;
pub mod virtual_board;
#[cfg(target_os = "linux")]
pub mod withheld;
