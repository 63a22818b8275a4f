//! `map`: a mapping for foreign logs, proposed.

use std::fmt::Write;
use std::path::PathBuf;

use omni_gap::known_effects;
use omni_gap::log::{RobotFile, write_whole};
use omni_gap::proposal::{Proposal, propose};

use super::answer::{AnswerForm, MappingProposed, SCHEMA};
use super::console::{Console, wrapped};
use super::done::{DONE, Done};
use super::output_path;

/// Look at foreign logs and propose a mapping, columns.toml: which column is what, in which unit, with which sign, and why
#[derive(Debug, clap::Args)]
pub struct Map {
    /// Logs of one layout: text with any separator, Parquet, MCAP, ROS bags, game logs of SSL-Vision; or folders whose files make a run each
    #[arg(value_name = "LOG", required = true)]
    logs: Vec<PathBuf>,

    /// The robot file: its wheels tell which column is which
    #[arg(long, value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// The mapping to write; without it, it is printed
    #[arg(long, value_name = "COLUMNS.toml")]
    out: Option<PathBuf>,

    /// Take the best guess where the logs do not decide; without it such lines stand in the mapping as comments
    #[arg(long)]
    yes: bool,

    #[command(flatten)]
    form: AnswerForm,
}

impl Map {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        if let Some(out) = &self.out {
            let inputs: Vec<_> = self.logs.iter().chain([&self.robot]).map(PathBuf::as_path).collect();
            output_path::file(out, &inputs)?;
        }
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        console.phase("looking at the logs");
        let proposal = propose(&self.logs, &robot)?;
        let text = proposal.text(self.yes);
        match &self.out {
            None => self.form.say(console, &text, &self.answer(&proposal))?,
            Some(out) => {
                write_whole(out, text.as_bytes())?;
                let said = summary(&proposal, self.yes) + &format!("\nwritten to {}\n", out.display());
                self.form.say(console, &said, &self.answer(&proposal))?;
            }
        }
        Ok(DONE)
    }

    fn answer<'a>(&self, proposal: &'a Proposal) -> MappingProposed<'a> {
        MappingProposed { schema: SCHEMA, file: self.out.clone(), proposal }
    }
}

fn summary(proposal: &Proposal, with_guesses: bool) -> String {
    let mut text = String::new();
    let wide = proposal.lines.iter().map(|line| line.column.len()).max().unwrap_or(0);
    for line in &proposal.lines {
        let _ = writeln!(text, "{:6}  {:wide$}  {}", line.certainty, line.column, line.rule);
    }
    for note in &proposal.notes {
        text += &wrapped(0, &format!("note: {note}"));
    }
    let guesses: Vec<&str> = proposal.guesses().map(|line| line.column.as_str()).collect();
    if !guesses.is_empty() {
        let what = match with_guesses {
            true => "are guesses, and taken: check them",
            false => {
                "cannot be known from these logs: their lines are comments. Correct and uncomment them, or take all with --yes"
            }
        };
        text += &wrapped(0, &format!("{} {what}", guesses.join(", ")));
    }
    text
}
