//! `validate`: a model laid over what was measured, run by run.

use std::path::{Path, PathBuf};

use omni_gap::Error;
use omni_gap::check::check;
use omni_gap::localise::validation::{HORIZONS_S, Validated, validate};
use omni_gap::log::write_whole;
use omni_gap::report::validation as report;

use super::answer::AnswerForm;
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{GivenSession, seconds};
use super::output_path::{self, NewFolder};

/// Simulate every run from its start and say how well it fits what was measured
#[derive(Debug, clap::Args)]
pub struct Validate {
    #[command(flatten)]
    session: GivenSession,

    /// Times between restarts of the horizon curve, with commas between them [s]
    #[arg(long, value_name = "S,...", value_delimiter = ',', default_values_t = HORIZONS_S, value_parser = seconds)]
    horizon: Vec<f64>,

    /// Folder for validation.json and validation.html, made if need be; without it only the table is said
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

/// The files of a validation.
const FILES: [&str; 2] = ["validation.json", "validation.html"];

impl Validate {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        if let Some(out) = &self.out {
            output_path::folder(out, &FILES)?;
        }
        let session = self.session.load(console)?;
        console.phase("simulating every run");
        let mut validated = validate(&session, &self.horizon)?;
        validated.validation.session = self.session.name();
        let fatal = check(&session).iter().filter(|f| f.fatal).count();
        if fatal > 0 {
            let told =
                format!("the recordings have {fatal} fault(s) that spoil a comparison: `omni-gap check` names them");
            validated.validation.notices.insert(0, told);
        }
        let mut said = report::terminal(&validated.validation);
        if let Some(out) = &self.out {
            for file in written(out, &validated)? {
                said += &format!("{:12}{}\n", "file", file.display());
            }
        }
        self.form.say(console, &said, &validated.validation)?;
        Ok(DONE)
    }
}

/// Puts the files into the folder, each whole; a folder that was made for them goes away again where that fails.
fn written(out: &Path, validated: &Validated) -> Result<[PathBuf; 2], CliError> {
    let folder = NewFolder::make_with_files(out)?;
    let [json, html] = FILES.map(|name| out.join(name));
    let text = validated.validation.to_json();
    let text = text.map_err(|why| Error::output(&json, why.to_string(), "Name another place with --out"))?;
    write_whole(&html, report::html(&validated.validation, &validated.traces).as_bytes())?;
    write_whole(&json, text.as_bytes())?;
    folder.keep();
    Ok([html, json])
}
