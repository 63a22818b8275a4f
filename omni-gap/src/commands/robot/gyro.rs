//! `robot gyro`: what a count of the gyro is worth, from a recording of turns by hand.

use std::path::PathBuf;

use omni_gap::Error;
use omni_gap::error::InputKind;
use omni_gap::identify::{GyroScale, HandTurned, MOST_TURNS, gyro_scale};
use schemars::JsonSchema;
use serde::Serialize;

use crate::commands::answer::{AnswerForm, SCHEMA};
use crate::commands::cli_error::CliError;
use crate::commands::console::Console;
use crate::commands::given::robot_and_run;

/// Which recording, and what was done in it.
#[derive(Debug, clap::Args)]
pub struct Gyro {
    /// The robot file that the robot had when it was recorded
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The recording: at rest on the mark, turned, at rest on the mark; two seconds of rest each
    #[arg(value_name = "RUN")]
    run: PathBuf,

    /// Whole turns; to the right below zero
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = turns)]
    turns: i32,

    /// How well the robot came back to its mark [°]
    #[arg(long, value_name = "DEG", default_value_t = 1.0, value_parser = degrees)]
    within: f64,

    /// In which form.
    #[command(flatten)]
    form: AnswerForm,
}

/// What the gyro's scale is.
#[derive(Debug, JsonSchema, Serialize)]
pub struct GyroCalibrated {
    /// Version of this form.
    pub schema: u32,
    /// What was found.
    #[serde(flatten)]
    pub found: GyroScale,
}

impl Gyro {
    /// Does it.
    pub fn run(&self, console: &Console) -> Result<(), CliError> {
        let given = robot_and_run(&self.robot, &self.run, None, console)?;
        let Some(before) = given.robot.controller.and_then(|controller| controller.gyro_rad_s_per_count) else {
            let problem = "[controller] has no `gyro_rad_s_per_count`: the robot has no gyro";
            let fix =
                "Write what its data sheet says, 0.001065 for a BMI088, send the file to the robot, and record it";
            return Err(Error::input(&self.robot, problem, fix).of_kind(InputKind::Missing).into());
        };
        let did = HandTurned { turns: self.turns, within: self.within.to_radians() };
        let found = gyro_scale(&given.run, before, did)?;
        self.form.say(console, &told(&found, self.turns), &GyroCalibrated { schema: SCHEMA, found })
    }
}

fn told(found: &GyroScale, turns: i32) -> String {
    let GyroScale { turns_told, bias_rad_s: [first, last], bias_std_rad_s, gyro_rad_s_per_count, .. } = *found;
    let std = found.std_rad_s_per_count;
    let relative = 100.0 * std / gyro_rad_s_per_count.abs();
    let line = if found.differs {
        format!("gyro_rad_s_per_count = {gyro_rad_s_per_count:.9}")
    } else {
        "as it is: no other scale is shown".to_owned()
    };
    format!(
        "turns       {turns}; the gyro told {turns_told:.3}\n\
         at rest     {first:.5} rad/s before, {last:.5} after, ± {bias_std_rad_s:.5}\n\
         scale       {gyro_rad_s_per_count:.9} ± {std:.9} rad/s per count, {:+.2} ± {relative:.2} %\n\
         robot.toml  {line}\n",
        100.0 * found.change,
    )
}

fn turns(text: &str) -> Result<i32, String> {
    match text.parse::<i32>() {
        Ok(n) if n != 0 && n.abs() <= MOST_TURNS => Ok(n),
        _ => Err(format!("expected a whole number of turns, 1 to {MOST_TURNS}, below zero to the right")),
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 && x < 180.0 => Ok(x),
        _ => Err("expected an angle above zero, in degrees, such as 1".to_owned()),
    }
}
