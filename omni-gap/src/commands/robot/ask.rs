//! Which robot is asked, and how it is answered.

use model_core::link::record::OperatingState;
use omni_gap::error::Result;
use omni_gap::wire::line::Line;
use omni_gap::wire::source::Source;
use omni_gap::wire::status::Status;
use schemars::JsonSchema;
use serde::Serialize;

use crate::commands::answer::{AnswerForm, SCHEMA};
use crate::commands::cli_error::CliError;
use crate::commands::console::{Console, wrapped};

/// Which robot, and how it is answered.
#[derive(Debug, clap::Args)]
pub struct Ask {
    /// Where the robot is
    #[arg(long, value_name = "tcp:HOST:PORT | DEVICE")]
    pub to: String,

    /// Speed of a serial line
    #[arg(long, value_name = "BAUD", default_value_t = 2_000_000)]
    pub baud: u32,

    /// In which form.
    #[command(flatten)]
    pub form: AnswerForm,
}

/// How a robot is, after what it was asked to do.
#[derive(Debug, JsonSchema, Serialize)]
pub struct RobotAnswered<'a> {
    /// Version of this form.
    pub schema: u32,
    /// How the robot is.
    #[serde(flatten)]
    pub status: &'a Status,
    /// What a person should know.
    pub notices: &'a [String],
}

impl Ask {
    /// Opens the line.
    pub fn line(&self) -> Result<Line> {
        Line::open(&Source::named(&self.to), self.baud)
    }

    /// Opens the line, does it, and says how the robot is then.
    pub fn answer(
        &self,
        console: &Console,
        phase: &str,
        act: impl FnOnce(&mut Line) -> Result<Status>,
    ) -> std::result::Result<(), CliError> {
        let mut line = self.line()?;
        console.phase(phase);
        let status = act(&mut line)?;
        self.say(console, &status, &[])
    }

    /// Says how the robot is, and what a person should know.
    pub fn say(&self, console: &Console, status: &Status, notices: &[String]) -> std::result::Result<(), CliError> {
        console.end_phase();
        let text: String = notices.iter().map(|notice| wrapped(2, notice)).collect();
        self.form.say(console, &(told(status) + &text), &RobotAnswered { schema: SCHEMA, status, notices })
    }
}

/// How a robot is, in words.
fn told(status: &Status) -> String {
    let driven: Vec<String> = status.driven.iter().map(usize::to_string).collect();
    let bridges =
        if driven.is_empty() { "bridges open".into() } else { format!("motors {} driven", driven.join(", ")) };
    let bus = status.bus_v.map_or(String::new(), |volts| format!(", bus {volts:.1} V"));
    let mut text = format!("{}: {bridges}{bus}\n", status.state.name());
    for fault in &status.faults {
        text += &wrapped(2, &format!("fault: {fault}"));
    }
    for event in &status.events {
        text += &wrapped(2, event);
    }
    text += &match status.identity {
        Some(who) => format!("  parameters {:08x}, firmware {}, {} wheels\n", who.checksum, who.firmware, who.wheels),
        None if status.state == OperatingState::Asleep => {
            "  without parameters: `omni-gap robot send ROBOT.toml`\n".into()
        }
        None => "  it did not say with which parameters\n".into(),
    };
    text
}
