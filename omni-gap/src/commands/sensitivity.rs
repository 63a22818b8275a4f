//! `sensitivity`: which numbers of a robot file the motion depends on.

use std::path::PathBuf;

use omni_gap::api::{RobotFile, StepPlan, known_effects, sensitivity};
use omni_gap::report::{sensitivity_terminal, write_sensitivity};

use super::answer::AnswerForm;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{volts, within_supply};
use super::output_path::{self, NewFolder};

/// Say which numbers of a robot file its motion depends on, axis by axis
#[derive(Debug, clap::Args)]
pub struct Sensitivity {
    /// The robot file, with the effects that it names
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// Voltage of the step on the motor that gets most [V]; 6 V, or the supply where that is less
    #[arg(long, value_name = "V", value_parser = volts)]
    voltage: Option<f64>,

    /// When to look at the speed [s]
    #[arg(long, value_name = "S", default_value_t = 1.0, value_parser = seconds)]
    time: f64,

    /// Folder for sensitivity.json and sensitivity.html; made if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

/// The files of the command.
const FILES: [&str; 2] = ["sensitivity.json", "sensitivity.html"];
/// Times that can be looked at [s]
const TIMES: (f64, f64) = (0.01, 60.0);

impl Sensitivity {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        if let Some(out) = &self.out {
            output_path::folder(out, &FILES)?;
        }
        let file = RobotFile::load(&self.robot, &known_effects())?;
        let voltage =
            within_supply(self.voltage.unwrap_or_else(|| StepPlan::usual(&file).voltage), &self.robot, &file)?;
        console.phase("driving each axis");
        let said = sensitivity(&file, &StepPlan { voltage, time: self.time });
        let mut text = sensitivity_terminal(&said);
        if let Some(out) = &self.out {
            let folder = NewFolder::make(out)?;
            let [_, page] = write_sensitivity(out, &said)?;
            folder.keep();
            text += &format!("\nwritten to {} and sensitivity.json beside it\n", page.display());
        }
        self.form.say(console, &text, &said)?;
        Ok(DONE)
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (TIMES.0..=TIMES.1).contains(&x) => Ok(x),
        _ => Err(format!("expected a time from {} to {} seconds", TIMES.0, TIMES.1)),
    }
}
