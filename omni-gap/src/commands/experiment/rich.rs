//! `experiment --rich`: scripts whose recordings show as many causes as they can.

use omni_gap::api::{PlannedRich, RobotFile, rehearse_rich, rich};
use omni_gap::log::Run;
use omni_gap::report::{RichInstructions, rich_instructions};
use omni_gap::simulate::{Emphasis, RichPlan};

use super::super::cli_error::CliError;
use super::super::console::Console;
use super::{Experiments, field, lowered_in_words};

impl Experiments {
    /// Writes them, and says so.
    pub(super) fn rich_written(&self, file: &RobotFile, console: &Console) -> Result<String, CliError> {
        console.phase("looking for ways over the floor");
        let plan = RichPlan {
            rate: self.rows_a_second(),
            voltage: self.voltage(file)?,
            field: field(file),
            scripts: self.scripts.into(),
            duration: self.duration,
            emphasis: Emphasis::Everything,
        };
        let all = rich(file, &plan);
        let notes: Vec<String> = all.lowered.iter().map(lowered_in_words).collect();
        self.moves(&all.held, all.plan.voltage, &notes)?;
        let runs: Vec<&Run> = all.scripts.iter().map(|script| &script.run).collect();
        let page = self.rich_page(file, &all, notes.clone());
        self.write(&runs, &page, |sensing| rehearse_rich(file, &plan, sensing, self.seed), console)?;
        let seconds = all.scripts.iter().map(|script| script.seconds).sum();
        let text = self.told((all.scripts.len(), all.plan.voltage, seconds), &notes);
        let then = format!("omni-gap diagnose {} --out report", self.at("session"));
        let played = self.rehearse.is_some();
        let first = if played { String::new() } else { format!("record them as {} says, then ", self.at("README.md")) };
        Ok(format!("{text}next: {first}{then}\n"))
    }

    fn rich_page(&self, file: &RobotFile, all: &PlannedRich, notes: Vec<String>) -> String {
        rich_instructions(&RichInstructions {
            robot: file.name.clone(),
            wheels: file.wheel.len(),
            folder: self.out.display().to_string(),
            voltage: all.plan.voltage,
            notes,
            rate: all.plan.rate,
            field: all.plan.field,
            scripts: all.scripts.iter().map(|s| (s.run.name.clone(), s.seconds, s.floor)).collect(),
            rehearsed: self.rehearse.is_some(),
        })
    }
}
