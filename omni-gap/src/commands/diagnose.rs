//! `diagnose`: where the gap lies, what causes it, how far it shrinks.

use std::path::{Path, PathBuf};

use omni_gap::api::inputs;
use omni_gap::engine::Knobs;
use omni_gap::report::design::script_csv;
use omni_gap::report::{self, Beside, NextExperiment, Written};
use omni_gap::simulate::HORIZON_S;
use omni_gap::{Diagnosis, Options, Report, Session};

use super::answer::AnswerForm;
use super::causes::all_known;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{GivenAlso, GivenSession, seconds};
use super::output_path::{self, NewFolder};

/// Say where the gap lies, which cause it has and how far it shrinks
#[derive(Debug, clap::Args)]
pub struct Diagnose {
    #[command(flatten)]
    session: GivenSession,

    #[command(flatten)]
    also: GivenAlso,

    /// Folder for report.json, report.html, refitted_robot.toml and, where a cause is named, corrected_robot.toml, where a script would
    /// settle what is open, next_experiment.csv; made if need be
    #[arg(long, value_name = "DIR", default_value = "omni-gap-report")]
    out: PathBuf,

    /// Time between restarts of the free runs that measure the gap [s]
    #[arg(long, value_name = "S", default_value_t = HORIZON_S, value_parser = seconds)]
    horizon: f64,

    /// Causes to leave out, as if the catalogue did not have them: what would be answered then
    #[arg(long, value_name = "ID,ID", value_delimiter = ',')]
    without: Vec<String>,

    /// Rows that the answer rests on, at the most: of longer recordings pieces that meet what the whole meets [default: 60000]
    #[arg(long, value_name = "ROWS", value_parser = clap::value_parser!(u32).range(1000..))]
    max_rows: Option<u32>,

    /// Exit with 0 no gap, 10 parameter, 20 effect, 30 unknown, 40 unfit data
    #[arg(long)]
    exit_code: bool,

    #[command(flatten)]
    form: AnswerForm,
}

/// The files of a report.
pub const FILES: [&str; 5] =
    ["report.json", "report.html", "refitted_robot.toml", "corrected_robot.toml", NextExperiment::FILE];

impl Diagnose {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        all_known(&self.without)?;
        output_path::folder(&self.out, &FILES)?;
        let session = self.session.load(console)?;
        let mut knobs = Knobs::default();
        knobs.measure.horizon_s = self.horizon;
        knobs.screen.without.clone_from(&self.without);
        knobs.layout.excerpt.most_rows = self.max_rows.map_or(knobs.layout.excerpt.most_rows, |rows| rows as usize);
        let also = self.also.load(&self.session.robot_path(), self.session.columns())?;
        let what = Options { session: self.session.name(), also: &also, knobs, ..Options::default() };
        let (report, written) = diagnosed(&session, &what, &self.out, console)?;
        self.form.say(console, &report::terminal(&report, Some(&written)), &report)?;
        Ok(if self.exit_code { report.verdict.exit_code() } else { DONE })
    }
}

/// Diagnoses a session and writes the report's files.
pub fn diagnosed(
    session: &Session,
    what: &Options<'_>,
    out: &Path,
    console: &Console,
) -> Result<(Report, Written), CliError> {
    let progress = |phrase: &str| console.phase(phrase);
    let inputs = inputs([session].into_iter().chain(what.also.iter().map(|more| &more.session)))?;
    let mut diagnosis = Diagnosis::of(session, &Options { progress: &progress, ..what.clone() });
    diagnosis.report.inputs = inputs;
    let page = report::html(&diagnosis.report, &diagnosis.pictures);
    let folder = NewFolder::make(out)?;
    let script = diagnosis.next_run.as_ref().map(script_csv);
    let beside = Beside {
        refitted: diagnosis.refitted_robot.as_deref(),
        corrected: diagnosis.corrected_robot.as_deref(),
        script: script.as_deref(),
    };
    let written = report::write(out, &diagnosis.report, &page, beside)?;
    folder.keep();
    console.end_phase();
    Ok((diagnosis.report, written))
}
