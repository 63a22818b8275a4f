//! # Commission: how a robot's motors are wired, asked of the motors themselves
//!
//! Motor by motor, wheels off the ground, with at most 1 A in a phase:
//!
//! 1. [`sense`]: short pulses along the three outputs tell which converter sits at which output, and its sign.
//! 2. [`winding`]: a steady voltage and the rise to it tell R and L.
//! 3. [`halls`]: a vector that turns slowly forward and back tells the order of the hall codes and where their edges are.
//! 4. A person says whether the wheel turned forward; [`Found::wiring`] makes a wiring of it all.
//!
//! | wrong | seen by |
//! |---|---|
//! | order of the converters, their signs | the currents of pulses |
//! | order of the hall lines, all of them turned round | the codes under a turning vector |
//! | the halls of another motor on these pins | that other motor's codes move |
//! | the motor's leads moved on in a ring | the edges, a third of a turn on: no mistake at all |
//! | two of the motor's leads swapped | the eye alone: vector, currents and codes are those of a motor that turns the other way |
//! | the leads of another motor's wheel | the eye alone |
//!
//! The rotor comes to each vector by half an electrical turn at the most and follows it over one and a third: the wheel moves by up
//! to [`MOST_TURNED`] electrical degrees over pole pairs times gear ratio, whatever is wired wrong, because nothing that is
//! done depends on it.
//!
//! Source: the procedure is that of every servo drive's alignment run; the mean of both directions cancels friction.

mod bench;
mod connected;
mod guided;
pub mod halls;
mod motor;
pub mod sense;
pub mod winding;

pub use bench::ProbePort;
pub use connected::{Connected, connect};
pub use guided::{Guided, Person, guided};
pub use motor::{Found, MOST_TURNED, find, show, wheel_degrees};
