//! # Silence: nobody commands any more
//!
//! At 1 m/s the commands end. The robot is to open its bridges on its own, and to stay like that until the fault is
//! cleared and somebody commands again.

use model_core::geometry::frames::BodyTwist;
use model_core::link::command::Command;
use model_core::link::faults::Fault;
use model_core::link::record::OperatingState;

use super::Ride;
use crate::emulator::{Brain, Trouble};

/// Speed at which the commands end [m/s]
const SPEED: f64 = 1.0;

/// What the robot did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Silence {
    /// From the last command to open bridges [s]; infinite: never
    pub opens: f64,
    /// From there to rest [s]; infinite: not while it was watched
    pub rests: f64,
    /// True speed at the last command [m/s]
    pub speed: f64,
    /// True if the silence was told, and nothing else
    pub told: bool,
    /// True if commands alone did not close the bridges again
    pub stays: bool,
    /// True if they did once the fault was cleared
    pub drives_again: bool,
}

/// Drives, is silent, commands, clears, commands.
///
/// # Errors
/// [`Trouble`] says what became of the program.
pub fn play<B: Brain, const N: usize>(ride: &mut Ride<B, N>) -> Result<Silence, Trouble> {
    let go = BodyTwist { v: SPEED, vn: 0.0, w: 0.0 };
    ride.follow(0.8, |_| go)?;
    let speed = ride.taken.moments.last().map_or(0.0, |m| m.twist.v);
    ride.drive(go);
    let last = ride.time();
    ride.wait(1.6)?;
    let after = |from: f64, is: &dyn Fn(&super::Moment) -> bool| {
        ride.taken.moments.iter().find(|m| m.time > from && is(m)).map_or(f64::INFINITY, |m| m.time - from)
    };
    let opens = after(last, &|m| m.enabled == 0);
    // slower than any hall would tell
    let rests = after(last + opens, &|m| m.twist.to_array().iter().all(|x| x.abs() < 1e-3));
    let told = ride.taken.records.last().is_some_and(|r| r.faults.bits() == Fault::CommandSilent.bit());
    ride.follow(0.1, |_| go)?;
    let stage = |ride: &Ride<B, N>| ride.taken.records.last().map(|r| r.state);
    let stays = stage(ride) == Some(OperatingState::Faulted);
    ride.lockstep.line.command(&Command::Clear);
    ride.follow(0.3, |_| go)?;
    Ok(Silence { opens, rests, speed, told, stays, drives_again: stage(ride) == Some(OperatingState::Driving) })
}
