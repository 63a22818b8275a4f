//! `check`: faults of the recordings, and what they can tell, before anything is fitted.

use std::path::Path;

use omni_gap::Verdict;
use omni_gap::api::check_and_informativity;
use omni_gap::check::Fault;
use omni_gap::report::informativity_terminal;

use super::answer::{AnswerForm, RunsChecked, SCHEMA};
use super::console::Console;
use super::console::wrapped;
use super::done::{DONE, Done};
use super::given::GivenSession;

/// Look for faults of the recordings, say how to mend them, and what the recordings can tell
#[derive(Debug, clap::Args)]
pub struct Check {
    #[command(flatten)]
    session: GivenSession,

    /// Exit with 40 where a fault makes the recordings unfit for a diagnosis
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    form: AnswerForm,
}

impl Check {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let session = self.session.load(console)?;
        console.phase("checking the recordings");
        let (faults, told) = check_and_informativity(&session);
        let mut page: String = faults.iter().map(summary).collect();
        for notice in &session.notices {
            page += &wrapped(0, &format!("notice: {notice}"));
        }
        let fatal = faults.iter().filter(|f| f.fatal).count();
        let runs = session.runs.len() + session.heldout.len();
        page += &match (faults.len(), fatal) {
            (0, _) => format!("{runs} run(s) checked: no fault found.\n"),
            (n, 0) => format!("{runs} run(s) checked: {n} fault(s), none of which forbids a diagnosis.\n"),
            (n, _) => format!("{runs} run(s) checked: {n} fault(s), {fatal} to be mended before a diagnosis.\n"),
        };
        if let Some(told) = &told {
            page += &format!("\n{}", informativity_terminal(told));
        }
        let (informativity, notices) = (told.as_ref(), session.notices.as_slice());
        let runs_checked =
            RunsChecked { schema: SCHEMA, runs, usable: fatal == 0, faults: &faults, informativity, notices };
        self.form.say(console, &page, &runs_checked)?;
        Ok(if fatal > 0 && self.exit_code { Verdict::UnfitData.exit_code() } else { DONE })
    }
}

/// "fault: runs/run02.csv, lines 317 to 400, w1_rad_s: …"
fn summary(fault: &Fault) -> String {
    let word = if fault.fatal { "fault" } else { "slight fault" };
    let lines = fault.lines_in_words();
    let file = if fault.file == Path::new("") { fault.run.clone() } else { fault.file.display().to_string() };
    let signal = if fault.signal.is_empty() { String::new() } else { format!(", {}", fault.signal) };
    let head = format!("{word}: {file}, {lines}{signal} [{}]: {}", fault.code, fault.sentence);
    wrapped(0, &head) + &wrapped(4, &format!("To mend it: {}", fault.fix))
}
