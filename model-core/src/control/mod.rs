//! # Control: from a wanted motion to switched bridges
//!
//! Two loops. At 20 kHz a motor's currents: three phases seen as one DC-equivalent motor ([`phases`]), codes of the
//! converter as amperes and volts ([`calibration`]), the rotor's angle from its halls ([`halls`], and
//! [`hall_tracker`] where their places are known), which lead is which ([`wiring`]), the [`current_loop`]. At 1 kHz the robot's motion: wheel speeds from hall edges ([`observer`]), the body's turning by a gyro ([`heading`]), what is
//! wanted between two commands ([`interpolator`]), a limited [`reference`](mod@reference), the volts that it takes ([`feedforward`]), whether there is room for them
//! ([`headroom`]), effects undone ([`compensation`]), all of it in the [`motion_controller`], for a robot of three
//! wheels or of four in [`drive`].

// 20 kHz: the currents of a motor
pub mod phases;

pub mod calibration;

pub mod current_sum;

pub mod halls;

pub mod wiring;

pub mod hall_tracker;

pub mod current_loop;

// 1 kHz: the motion of the robot
pub mod observer;

pub mod heading;

pub mod interpolator;

pub mod reference;

pub mod thermal;

pub mod braking;

pub mod headroom;

pub mod compensation;

pub mod feedforward;

pub mod motion_controller;

pub mod drive;
