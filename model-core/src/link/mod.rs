//! # Link: what robot and host tell each other
//!
//! Frames on a serial line ([`framing`]); in them commands and their replies ([`command`]), a record of every turn
//! ([`record`]) with what gyro and encoders said ([`sensor_codes`]), who the robot is ([`hello`]), which of these a frame holds
//! ([`message`]) in how many bytes ([`payload`]), which faults it has ([`faults`]) and what it does about itself ([`events`]), a
//! motor that is asked how it is wired ([`probe`]), and the parameters that the robot drives with ([`block`]). All numbers are
//! little-endian.

mod bytes;
mod motors;

pub mod framing;

pub mod command;

pub mod record;

pub mod sensor_codes;

pub mod hello;

pub mod payload;

pub mod probe;

pub mod message;

pub mod faults;

pub mod events;

pub mod block;
