//! # Plant: the robot that the equations describe, and its motion
//!
//! A [`robot`] has a [`winding`] on every wheel; the paper's own two are in [`paper`]. The [`Plant`]
//! puts them together with the effects of [`effects`](crate::effects), and takes one step of Δt along the signal path:
//!
//! ```text
//! command ─ bridge ─ winding ─ gear ─ contact ─ body ─ pose
//!             │         └ current           └ wheel speed   └ sensors → reading
//!           battery
//! ```
//!
//! The plant is a chain of seams in signal order. At each seam it describes the element as the robot's parameters say,
//! lets the effects that act there change the description ([`seams`](crate::effects::seams)), and then solves what is
//! described:
//!
//! 1. contact: rows, radii, loads (`support.rs`), and whether a wheel rolls rigidly;
//! 2. battery and bridge: voltages, solved together with the currents that they depend on (`electric.rs`);
//! 3. winding, shaft and gear: current, torque, and the dry friction that each shaft can hold; a rotor whose shaft yields
//!    moves on its own (`shaft.rs`);
//! 4. traction: a wheel that creeps or slips turns faster than the floor passes by (`traction.rs`), one with inertia in two
//!    stages (`spin.rs`);
//! 5. body: all forces, one linearly implicit step, dry friction spent once (`body.rs`), at a reversal within the step for
//!    each part of it (`reversal.rs`);
//! 6. pose (eq. 1), reading, and the memory of effects.
//!
//! The command is held over the step. Error: second order in Δt, at a reversal too; first order where an effect's own
//! friction depends on the speed, or the bus on the currents, as both are taken at the step's beginning, and where two
//! directions come to rest in one step, as neither's instant is looked at again.
//! `host-tests/tests/proof/integration.rs` holds it to figures against steps a hundred times smaller.

// The robot
pub mod winding;

pub mod robot;

pub mod paper;

// Its step
mod state;
pub use state::{Input, Reading, State};

mod model;
pub use model::Plant;

mod support;

mod command;

mod source;

mod axis;

mod body;

mod reversal;

mod dry_friction;

mod step;

mod fixed_point;

mod bridge;

mod electric;

mod shaft;

mod wheel;

mod traction;

mod spin;

mod forces;

mod speed_driven;

mod batch;
pub use batch::{Batch, BatchReading, BatchState};

mod sensing;
