//! Simulates a robot of a file with and without an effect, and says how far apart the two end.
//!
//! `cargo run --release -p omni-gap --example simulate`

use std::path::Path;

use omni_gap::api::{Error, RobotFile, Run, known_effects, simulate};
use omni_gap::log::Group;

/// The program; the tests call it too.
pub fn main() -> Result<(), Error> {
    let text = include_str!("../robots/feup-4w/robot.toml");
    let robot = |text: &str| RobotFile::parse(text, Path::new("robot.toml"), &known_effects());
    let plain = robot(text)?;
    let slipping = robot(&format!("{text}\n[effects.wheel_slip]\nfriction_coefficient = 0.1\n"))?;

    // half a second of 8 V forward, sampled at 200 Hz
    let rows = 100;
    let volts = [0.0, -8.0, 0.0, 8.0].map(|u| vec![u; rows]);
    let input = Run {
        name: "forward".to_owned(),
        t_s: (0..rows).map(|row| row as f64 / 200.0).collect(),
        u: Some(Group::from_columns(volts.to_vec())),
        ..Run::default()
    };
    let ends = |robot: &RobotFile| -> Result<f64, Error> {
        let run = simulate(robot, &input, None)?;
        let x = run.pose.and_then(|pose| pose.channels[0].get(rows - 1).ok());
        Ok(x.unwrap_or(0.0))
    };
    println!("after half a second: {:.3} m, with slipping wheels {:.3} m", ends(&plain)?, ends(&slipping)?);
    Ok(())
}
