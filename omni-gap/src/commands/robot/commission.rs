//! `robot commission`: motor by motor, how it is wired, with a person who says which way its wheel turned.

use std::path::PathBuf;

use omni_gap::api::{RobotFile, export, known_effects};
use omni_gap::log::{with_commissioned, write_whole};
use omni_gap::wire::commission::{Guided, Person, guided};
use omni_gap::wire::robot::send;

use super::ask::Ask;
use crate::commands::cli_error::CliError;
use crate::commands::console::Console;
use crate::commands::output_path;
use crate::commands::prompt::prompt;
use crate::commands::record::run_place::text_of;

/// Which robot is commissioned, and where the result goes.
#[derive(Debug, clap::Args)]
pub struct Commission {
    /// The robot file; its parameters are sent first
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// Where the file goes with what was found; may be the same file
    #[arg(long, value_name = "ROBOT.toml")]
    out: PathBuf,

    /// This motor alone, counted from 0; may be given several times
    #[arg(long = "motor", value_name = "K")]
    motors: Vec<usize>,

    /// Ask nothing: the wheels are off the ground, and each of them turns forward
    #[arg(long)]
    yes: bool,

    #[command(flatten)]
    ask: Ask,
}

impl Commission {
    /// Does it.
    pub fn run(&self, console: &Console) -> Result<(), CliError> {
        let file = RobotFile::load(&self.robot, &known_effects())?;
        let text = text_of(&self.robot)?;
        let wheels = file.wheel.len();
        if let Some(motor) = self.motors.iter().find(|motor| **motor >= wheels) {
            let problem = format!("there is no motor {motor}: the robot has {wheels}, counted from 0");
            return Err(omni_gap::Error::input(&self.robot, problem, "Name another with --motor").into());
        }
        output_path::file(&self.out, &[])?;
        let block = export(&file, &self.robot)?;
        let mut line = self.ask.line()?;
        console.phase("sending the parameters");
        send(&mut line, &block.bytes, block.checksum)?;
        // a spinner would write over the questions
        console.end_phase();
        let motors = if self.motors.is_empty() { (0..wheels).collect() } else { self.motors.clone() };
        let mut terminal = Terminal;
        let person = (!self.yes).then_some(&mut terminal as &mut dyn Person);
        let Guided { motors, told: mut notices } = guided(&mut line, &file, &motors, person)?;
        let text = with_commissioned(&text, &motors)?;
        let block = export(&RobotFile::parse(&text, &self.out, &known_effects())?, &self.out)?;
        write_whole(&self.out, text.as_bytes())?;
        notices.push(format!("written: {}", self.out.display()));
        console.phase("sending what was found");
        let status = send(&mut line, &block.bytes, block.checksum)?;
        self.ask.say(console, &status, &notices)
    }
}

/// The person at the terminal: asked on standard error, heard on standard input.
struct Terminal;

impl Person for Terminal {
    fn answer<'a>(&mut self, question: &str, answers: &[&'a str]) -> Option<&'a str> {
        let (mut input, mut output) = (std::io::stdin().lock(), std::io::stderr());
        loop {
            let asked = format!("{question}? [{}] ", answers.join("/"));
            // by its first letters
            let line = prompt(&asked, &mut input, &mut output)?.to_lowercase();
            if let Some(known) = answers.iter().find(|known| !line.is_empty() && known.starts_with(&line)) {
                return Some(known);
            }
        }
    }
}
