//! `identify`: the best nominal numbers, and how sure they are.

mod by_experiment;
mod outputs;

use std::path::PathBuf;

use omni_gap::api::{self, FitRemark, Identification};
use omni_gap::identify::Asked;
use omni_gap::log::write_whole;
use omni_gap::report::num;

use super::answer::{NumbersFitted, SCHEMA};
use super::console::Console;
use super::done::{DONE, Done};
use super::given::GivenSession;
use super::output_path;
use outputs::Outputs;

/// Fit the robot file's numbers, and those of the effects in it, to the recordings
#[derive(Debug, clap::Args)]
pub struct Identify {
    #[command(flatten)]
    session: GivenSession,

    /// The robot file to write, with the fitted numbers in the place of the nominal ones
    #[arg(long, value_name = "ROBOT.toml")]
    out: PathBuf,

    /// Instead, ask the paper's experiments, runs told by their names, and fit the model to them from scratch: 1 (spin),
    /// 2 (coast), motor, 3 (step), or all
    #[arg(long, value_name = "WHICH", value_parser = by_experiment::asked)]
    experiment: Option<Asked>,

    /// All numbers as JSON: into FILE beside the text, or printed in its place; `omni-gap schema` tells the form
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    json: Option<Option<PathBuf>>,
}

impl Identify {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        output_path::file(&self.out, &[&self.session.robot_path()])?;
        self.outputs().are_two(&self.session.robot_path())?;
        if let Some(asked) = self.experiment {
            return by_experiment::run(asked, &self.session, self.outputs(), console);
        }
        let session = self.session.load(console)?;
        console.phase("fitting the numbers of the robot file");
        let found = api::identify(&session)?;
        write_whole(&self.out, found.robot_text.as_bytes())?;
        let answer = NumbersFitted { schema: SCHEMA, file: self.out.clone(), found: &found };
        let said = format!("{}\nwritten to {}\n", table(&found), self.out.display());
        self.outputs().say(console, said, &answer)?;
        Ok(DONE)
    }

    fn outputs(&self) -> Outputs<'_> {
        Outputs { robot: &self.out, json: self.json.as_ref().map(Option::as_deref) }
    }
}

fn table(found: &Identification) -> String {
    let mut page = format!(
        "{:28}{:>11}{:>9}{:>12}{:>9}{:>9}  {}\n",
        "parameter", "nominal", "stated", "fitted", "±", "change", "unit"
    );
    for number in &found.numbers {
        page += &format!(
            "{:28}{:>11}{:>9}{:>12}{:>9}{:>9}  {}{}\n",
            number.key,
            num(number.nominal),
            format!("{:.1} %", 100.0 * number.stated_relative),
            figures(number.fitted),
            format!("{:.1} %", 100.0 * number.relative_std),
            format!("{:+.1} %", 100.0 * (number.factor - 1.0)),
            number.unit,
            remark(number.remark),
        );
    }
    if !found.effects.is_empty() {
        page += &format!("\n{:44}{:>11}{:>12}{:>12}  {}\n", "effect of the file", "nominal", "fitted", "±", "unit");
    }
    for number in &found.effects {
        let place = number.wheel.map_or(String::new(), |wheel| format!(" on wheel {wheel}"));
        page += &format!(
            "{:44}{:>11}{:>12}{:>12}  {}{}\n",
            format!("{}.{}{place}", number.effect, number.key),
            num(number.nominal),
            figures(number.fitted),
            number.std.map_or_else(|| "–".to_owned(), num),
            number.unit,
            remark(number.remark),
        );
    }
    let Identification { error_sigma, samples, runs, .. } = found;
    let more = if found.lacks_something { ", more than noise: the model lacks something, try diagnose" } else { "" };
    page + &format!("\nfit error {error_sigma:.2} σ over {samples} samples of {runs} run(s){more}\n")
}

fn remark(remark: FitRemark) -> &'static str {
    match remark {
        FitRemark::Fitted => "",
        FitRemark::AtBound => "  at its bound: the recordings cannot tell it",
        FitRemark::FarBeyondStated => "  far beyond what is stated: try diagnose",
        FitRemark::NoSurerThanStated => "  no surer than stated",
        FitRemark::NotTold => "  the recordings tell nothing of it",
    }
}

/// A fitted number with four figures, one more than the nominal one beside it.
fn figures(x: f64) -> String {
    let digits = if x == 0.0 { 0 } else { (3 - x.abs().log10().floor() as i32).clamp(0, 8) };
    format!("{x:.*}", digits as usize)
}
