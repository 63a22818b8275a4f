//! `schema`: the form of what a command answers as JSON.

use omni_gap::api::{SelfTest, Sensitivity};
use omni_gap::report::Report;
use omni_gap::report::comparison::ComparisonReport;
use omni_gap::report::design::DesignReport;
use omni_gap::report::fleet::FleetReport;
use schemars::{Schema, schema_for};

use super::answer::{
    BlockWritten, Explained, FilesWritten, MappingProposed, NumbersFitted, RunWritten, RunsChecked, say_json,
};
use super::console::Console;
use super::done::{DONE, Done};
use super::fleet::FleetDone;
use super::robot::{GyroCalibrated, RobotAnswered};
use super::watch::Line;

/// Print the JSON Schema of a command's --json answer, and of the file of the same content that it leaves
#[derive(Debug, clap::Args)]
pub struct SchemaOf {
    /// The command
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(FORMS.iter().map(|form| form.0)))]
    command: String,
}

/// What tells the form of an answer.
type FormOf = fn() -> Schema;

/// The form of each command's answer.
const FORMS: [(&str, FormOf); 26] = [
    ("diagnose", || schema_for!(Report)),
    ("demo", || schema_for!(Report)),
    ("compare", || schema_for!(ComparisonReport)),
    ("fleet", || schema_for!(FleetDone)),
    ("fleet-report", || schema_for!(FleetReport)),
    ("next", || schema_for!(DesignReport)),
    ("check", || schema_for!(RunsChecked<'static>)),
    ("new", || schema_for!(FilesWritten)),
    ("man", || schema_for!(FilesWritten)),
    ("map", || schema_for!(MappingProposed<'static>)),
    ("experiment", || schema_for!(FilesWritten)),
    ("identify", || schema_for!(NumbersFitted<'static>)),
    ("identify-experiment", || schema_for!(omni_gap::identify::Answer)),
    ("predict", || schema_for!(RunWritten)),
    ("validate", || schema_for!(omni_gap::localise::validation::Validation)),
    ("simulate", || schema_for!(RunWritten)),
    ("sensitivity", || schema_for!(Sensitivity)),
    ("selftest", || schema_for!(SelfTest)),
    ("explain", || schema_for!(Explained)),
    ("export", || schema_for!(BlockWritten)),
    ("export-mjcf", || schema_for!(FilesWritten)),
    ("record", || schema_for!(RunWritten)),
    ("robot", || schema_for!(RobotAnswered<'static>)),
    ("robot-gyro", || schema_for!(GyroCalibrated)),
    ("watch", || schema_for!(Line<'static>)),
    ("convert", || schema_for!(RunWritten)),
];

impl SchemaOf {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        if let Some((_, schema)) = FORMS.iter().find(|form| form.0 == self.command) {
            say_json(console, &schema())?;
        }
        Ok(DONE)
    }
}
