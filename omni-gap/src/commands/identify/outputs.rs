//! Where an identification goes: into a robot file, and as text or JSON to whoever asked.

use std::path::Path;

use omni_gap::Error;
use omni_gap::log::write_whole;
use serde::Serialize;

use super::super::answer::{json, say_json};
use super::super::cli_error::CliError;
use super::super::console::Console;
use super::super::output_path;

/// Where the answer goes.
#[derive(Clone, Copy, Debug)]
pub struct Outputs<'a> {
    /// The robot file.
    pub robot: &'a Path,
    /// The numbers as JSON, if they are wanted: in a file, or in place of the text.
    pub json: Option<Option<&'a Path>>,
}

impl Outputs<'_> {
    /// Refuses a file for the numbers that is the robot's, or an input.
    pub fn are_two(self, input: &Path) -> Result<(), CliError> {
        let Some(Some(json)) = self.json else { return Ok(()) };
        output_path::file(json, &[input])?;
        if json == self.robot {
            let told = "it is named by --json and by --out";
            return Err(Error::output(json, told, "Name two files").into());
        }
        Ok(())
    }

    /// Says the answer, or puts it where it is wanted.
    pub fn say(self, console: &Console, mut said: String, answer: &impl Serialize) -> Result<(), CliError> {
        match self.json {
            Some(None) => return say_json(console, answer),
            Some(Some(file)) => {
                write_whole(file, json(answer, file, "Name another place with --json")?.as_bytes())?;
                said += &format!("{:12}{}\n", "numbers", file.display());
            }
            None => {}
        }
        console.say(&said)
    }
}
