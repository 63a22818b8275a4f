//! `fleet`: every session below some folders, and what many robots tell together.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::thread::available_parallelism;

use omni_gap::Error;
use omni_gap::engine::Knobs;
use omni_gap::fleet::{FleetOptions, FleetTally, Folder, Store, diagnose_fleet, find, fleet_report};
use omni_gap::pooling::PoolingKnobs;
use omni_gap::report::fleet as report;
use schemars::JsonSchema;
use serde::Serialize;

use super::answer::AnswerForm;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::output_path;
use super::told_to_end::{Also, told_to_end};

/// Diagnose every session below folders, keep the answers as tables, and say what many robots tell together
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Fleet {
    #[command(subcommand)]
    verb: Option<Verb>,

    /// Folders; every folder below them with robot.toml and runs/ is a session, FOLDER/ROBOT/…/SESSION
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,

    /// Folder for the tables and reports, made if need be; asked again, only what is new or changed is done
    #[arg(long, value_name = "STORE", default_value = "omni-gap-fleet")]
    out: PathBuf,

    /// Sessions worked at at a time [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,

    /// Keep no report of each session, only the tables
    #[arg(long)]
    no_reports: bool,

    #[command(flatten)]
    form: AnswerForm,
}

#[derive(Debug, clap::Subcommand)]
enum Verb {
    /// Say what the robots of a store tell together: shared causes, robots that stand out, changes
    Report(FleetReport),
}

/// What the robots of a store tell together.
#[derive(Debug, clap::Args)]
pub struct FleetReport {
    /// The folder that `omni-gap fleet` made; fleet.json and fleet.html are put into it
    #[arg(value_name = "STORE", default_value = "omni-gap-fleet")]
    store: PathBuf,

    #[command(flatten)]
    form: AnswerForm,
}

/// What was done for a fleet.
#[derive(Debug, JsonSchema, Serialize)]
pub struct FleetDone {
    /// Version of this form.
    schema: u32,
    /// How many sessions.
    #[serde(flatten)]
    tally: FleetTally,
    /// Where the tables are.
    store: PathBuf,
}

impl Fleet {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        match &self.verb {
            Some(Verb::Report(asked)) => asked.run(console),
            None => self.diagnose(console),
        }
    }

    fn diagnose(&self, console: &Console) -> Done {
        output_path::folder(&self.out, &[])?;
        console.phase("looking for sessions");
        let mut sessions = find(&self.folders)?;
        // a store that lies among the sessions holds none
        if let Ok(store) = self.out.canonicalize() {
            sessions.retain(|session| !session.path.canonicalize().is_ok_and(|path| path.starts_with(&store)));
        }
        let ended =
            told_to_end(Also::CtrlC).map_err(|why| Error::output(&self.out, why.to_string(), "Try it again"))?;
        let mut store = Store::open(&self.out)?;
        console.phase(&format!("diagnosing {} sessions", sessions.len()));
        let options = FleetOptions {
            knobs: Knobs { equations: true, ..Knobs::default() },
            jobs: self.jobs.map_or_else(|| available_parallelism().map_or(1, usize::from), usize::from),
            reports: (!self.no_reports).then_some(&*self.out),
            progress: &|phrase| console.phase_is_at(phrase.to_owned()),
            told_to_end: &|| ended.load(Ordering::Relaxed),
        };
        let tally = diagnose_fleet(&sessions, &mut store, &options)?;
        console.end_phase();
        let done = FleetDone { schema: super::answer::SCHEMA, tally, store: self.out.clone() };
        self.form.say(console, &said(&tally, &self.out), &done)?;
        Ok(DONE)
    }
}

fn said(tally: &FleetTally, store: &Path) -> String {
    let FleetTally { sessions, done, kept, failed, left } = tally;
    let mut said = format!("{sessions} sessions: {done} diagnosed now, {kept} known already");
    if *failed > 0 {
        said += &format!("; {failed} of them without an answer, their rows say why");
    }
    if *left > 0 {
        said += &format!(", {left} left: the same command goes on with them");
    }
    let place = store.display();
    said + &format!(
        ".\nTables: {place}/{{sessions,causes,equations}}\nWhat they tell together: omni-gap fleet report {place}\n"
    )
}

impl FleetReport {
    fn run(&self, console: &Console) -> Done {
        output_path::folder(&self.store, &report::FILES)?;
        console.phase("reading the tables and pooling them");
        let fleet = fleet_report(&Folder::to_read(&self.store), &PoolingKnobs::default())?;
        let written = report::write(&self.store, &fleet, &report::html(&fleet)).map_err(CliError::from)?;
        console.end_phase();
        self.form.say(console, &report::terminal(&fleet, Some(&written)), &fleet)?;
        Ok(DONE)
    }
}
