//! `next`: what to record or measure so that what is open is settled.

use std::path::PathBuf;

use omni_gap::api::{DesignKnobs, design_report, next};
use omni_gap::engine::Knobs;
use omni_gap::report::design::{self as report, DesignReport, FILES};
use omni_gap::{Options, Session};

use super::answer::AnswerForm;
use super::causes::all_known;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{GivenAlso, GivenSession, metres, seconds, volts, within_supply};
use super::output_path::{self, NewFolder};

/// Say what to record or measure next, so that what a diagnosis leaves open is settled
#[derive(Debug, clap::Args)]
pub struct Next {
    #[command(flatten)]
    session: GivenSession,

    #[command(flatten)]
    also: GivenAlso,

    /// Folder for next.json, next.html and next_experiment.csv, the input to play; made if need be
    #[arg(long, value_name = "DIR", default_value = "omni-gap-next")]
    out: PathBuf,

    /// Length of the script [s]
    #[arg(long, value_name = "S", default_value_t = DesignKnobs::default().duration, value_parser = seconds)]
    duration: f64,

    /// Largest voltage on a motor [V]; no more than the recordings have seen, unless more is asked for
    #[arg(long, value_name = "V", value_parser = volts)]
    voltage: Option<f64>,

    /// Side of the free floor [m]; that of [limits], or 3 m
    #[arg(long, value_name = "M", value_parser = metres)]
    field: Option<f64>,

    /// Causes to leave out, as if the catalogue did not have them
    #[arg(long, value_name = "ID,ID", value_delimiter = ',')]
    without: Vec<String>,

    #[command(flatten)]
    form: AnswerForm,
}

/// Lengths of a script that has room for its pieces, and that nobody waits for in vain [s]
const LENGTHS: std::ops::RangeInclusive<f64> = 5.0..=120.0;

impl Next {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        all_known(&self.without)?;
        if !LENGTHS.contains(&self.duration) {
            return Err(CliError::Unclear("a script takes from 5 to 120 s: choose --duration within."));
        }
        output_path::folder(&self.out, &FILES)?;
        let session = self.session.load(console)?;
        let (report, designed) = self.designed(&session, console)?;
        let script = designed.as_ref();
        let page = report::html(&report, script);
        let folder = NewFolder::make(&self.out)?;
        let written = report::write(&self.out, &report, &page, script)?;
        folder.keep();
        console.end_phase();
        self.form.say(console, &report::terminal(&report, &written), &report)?;
        Ok(DONE)
    }

    fn designed(
        &self,
        session: &Session,
        console: &Console,
    ) -> Result<(DesignReport, Option<omni_gap::log::Run>), CliError> {
        if let Some(voltage) = self.voltage {
            within_supply(voltage, &self.session.robot_path(), &session.robot)?;
        }
        let mut engine = Knobs::default();
        engine.screen.without.clone_from(&self.without);
        let mut knobs =
            DesignKnobs { duration: self.duration, voltage: self.voltage, field: self.field, ..DesignKnobs::default() };
        knobs.selftest.engine = engine.clone();
        let progress = |phrase: &str| console.phase(phrase);
        let also = self.also.load(&self.session.robot_path(), self.session.columns())?;
        let options = Options { session: self.session.name(), also: &also, knobs: engine, progress: &progress };
        let (diagnosis, designed) = next(session, &options, &knobs);
        Ok(design_report(diagnosis, designed))
    }
}
