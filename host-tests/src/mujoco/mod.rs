//! # MuJoCo: this plant beside MuJoCo's, in one run on one machine
//!
//! ```text
//! robot file ─ numbers ─┬─ worker ── MuJoCo's model of it (host-tests/mujoco/)
//!                       └─ the plant
//! motion      both are driven alike: is it the same robot?
//! steps       turn by turn, so that whatever else the machine does falls on both
//! fits        the same recordings, the same free numbers, the same start
//! page        the ratios, and what each side has and lacks
//! ```

use std::path::Path;

mod fits;
mod median;
mod motion;
mod page;
mod steps;
mod worker;

use worker::Worker;

/// Does it all: the page, or why the two sides cannot be compared.
///
/// # Errors
/// Where MuJoCo's side cannot be asked, the robots differ, or a fit does not arrive at the truth.
pub fn compared(python: &Path) -> Result<String, String> {
    let (mut worker, versions) = Worker::begin(python)?;
    println!("the same motion on both sides");
    let motions = motion::compared(&mut worker)?;
    println!("steps, turn by turn");
    let steps = steps::measured(&mut worker)?;
    println!("fits, turn by turn");
    let fits = fits::measured(&mut worker)?;
    Ok(page::page(&versions, &motions, &steps, &fits))
}
