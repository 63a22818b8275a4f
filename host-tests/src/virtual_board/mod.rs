//! # The virtual board: what a robot's electronics see, without the robot
//!
//! Everything between the duties that a program writes and the codes that it reads, in f64, one PWM period of 50 µs a
//! step:
//!
//! ```text
//! compare counts ─ bridge ─ [`machine`] ─ current ─ plant of the core ─ wheel speed
//!                    │          │                                          │
//!                [`battery`]  [`adc`] ─ codes ─────────────────────── [`halls`]
//! ```
//!
//! The windings are solved here and share no line with the robot's code; body, wheels and their effects are the core's
//! plant, driven by the mean current of each motor; on a [`stand`] the wheels turn in the air. [`board`] puts it together,
//! [`instants`] says when it samples, [`wiring`] which lead is soldered where, [`faults`] is what can go wrong with it,
//! [`motion_sensors`] are the gyro and the encoders of a board that has them.

pub mod adc;
pub mod battery;
pub mod board;
pub mod faults;
pub mod halls;
pub mod instants;
pub mod machine;
pub mod motion_sensors;
mod motor;
mod setup;
pub mod stand;
pub mod wiring;

pub use board::{Outputs, VirtualBoard};
pub use faults::InjectedFault;
pub use instants::Instants;
pub use setup::BoardSetup;
pub use stand::Stand;
pub use wiring::BoardWiring;
