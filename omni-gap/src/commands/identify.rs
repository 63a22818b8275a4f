//! `identify`: the best nominal numbers, and how sure they are.

mod by_experiment;

use std::path::PathBuf;

use omni_gap::check::check;
use omni_gap::identify::{Asked, Fit, FitSettings, Prior, Shots, WINDOW_S, Windows, fit_tempered, nominal_free};
use omni_gap::log::{RobotFile, corrected, write_whole};
use omni_gap::report::num;
use omni_gap::simulate::{Model, NOMINAL_KEYS, Recorded, Slot, supply_seen};
use omni_gap::{Error, Session};

use super::given::GivenSession;
use super::{DONE, Done, Stop, Voice, place};

/// Fit the robot file's numbers to the recordings, within their stated uncertainty
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

    /// With --experiment: a file for all numbers, in JSON
    #[arg(long, value_name = "FILE", requires = "experiment")]
    json: Option<PathBuf>,
}

/// A fit with a larger error per sample leaves something unexplained [σ]
const MORE_THAN_NOISE: f64 = 1.2;

impl Identify {
    /// Does it.
    pub fn run(&self, voice: &Voice) -> Done {
        place::file(&self.out, &[&self.session.robot_path()])?;
        if let Some(asked) = self.experiment {
            return by_experiment::run(asked, self, voice);
        }
        let session = self.session.load(voice)?;
        refuse_faulty(&session)?;
        voice.phase("fitting the numbers of the robot file");
        let (text, table) = match session.robot.wheel.len() {
            3 => fitted::<3>(&session, &self.session.robot_path()),
            _ => fitted::<4>(&session, &self.session.robot_path()),
        }?;
        write_whole(&self.out, text.as_bytes())?;
        voice.say(&format!("{table}\nwritten to {}\n", self.out.display()))?;
        Ok(DONE)
    }
}

fn refuse_faulty(session: &Session) -> Result<(), Stop> {
    let Some(fault) = check(session).into_iter().find(|f| f.fatal) else { return Ok(()) };
    let place = format!("lines {} to {}: {}", fault.lines.0, fault.lines.1, fault.sentence);
    Err(Stop::Faulty { file: fault.file, sentence: place, mend: fault.mend })
}

/// The robot file with the fitted numbers, and the table that says what became of each.
fn fitted<const N: usize>(session: &Session, robot: &std::path::Path) -> Result<(String, String), Stop> {
    let runs: Vec<Recorded<N>> = session.runs.iter().filter_map(|r| Recorded::new(r, &session.robot)).collect();
    if runs.is_empty() {
        let told = "no run has a voltage, a signed current, a wheel speed or a commanded speed to drive the model with";
        return Err(Error::input(robot, told, "Log at least one of u, i, w or wset for every wheel").into());
    }
    let model = Model::<N>::nominal(&session.robot, supply_seen(&runs));
    let windows: Vec<Windows> = runs.iter().map(|r| Windows::new(r, WINDOW_S)).collect();
    let runs: Vec<&Recorded<N>> = runs.iter().collect();
    let settings = FitSettings::default();
    let fit = fit_tempered(
        model,
        Shots { runs: &runs, windows: &windows },
        None,
        &nominal_free(&settings),
        &Prior::stated(&session.robot),
        &settings,
    );
    let changes: Vec<_> =
        NOMINAL_KEYS.iter().flat_map(|key| key.scaled(&session.robot, key.factor(&fit.model.factor))).collect();
    let text = corrected(&session.robot_text, &changes)?;
    Ok((text, table(&fit, &session.robot, runs.len())))
}

fn table<const N: usize>(fit: &Fit<N>, robot: &RobotFile, runs: usize) -> String {
    let mut page = format!(
        "{:28}{:>11}{:>9}{:>12}{:>9}{:>9}  {}\n",
        "parameter", "nominal", "stated", "fitted", "±", "change", "unit"
    );
    for key in &NOMINAL_KEYS {
        let nominal = key.value(robot);
        let factor = key.factor(&fit.model.factor);
        let stated = robot.relative_uncertainty(key.key).unwrap_or(0.0);
        let fitted = nominal * factor;
        let std = fit.relative_std(key).unwrap_or(0.0);
        let bound = key.factors.iter().any(|p| fit.free.iter().any(|f| f.slot == Slot::Nominal(*p) && fit.at_bound(f)));
        let note = if bound {
            "  at its bound: the recordings cannot tell it"
        } else if stated > 0.0 && factor.ln().abs() > 3.0 * stated {
            "  far beyond what is stated: try diagnose"
        } else if stated > 0.0 && std > 0.9 * stated {
            "  no surer than stated"
        } else {
            ""
        };
        page += &format!(
            "{:28}{:>11}{:>9}{:>12}{:>9}{:>9}  {}{note}\n",
            key.key,
            num(nominal),
            format!("{:.1} %", 100.0 * stated),
            figures(fitted),
            format!("{:.1} %", 100.0 * std),
            format!("{:+.1} %", 100.0 * (factor - 1.0)),
            key.unit,
        );
    }
    let error = (fit.cost / fit.samples.max(1) as f64).sqrt();
    let more = if error > MORE_THAN_NOISE { ", more than noise: the model lacks something, try diagnose" } else { "" };
    page + &format!("\nfit error {error:.2} σ over {} samples of {runs} run(s){more}\n", fit.samples)
}

/// A fitted number with four figures, one more than the nominal one beside it.
fn figures(x: f64) -> String {
    let digits = if x == 0.0 { 0 } else { (3 - x.abs().log10().floor() as i32).clamp(0, 8) };
    format!("{x:.*}", digits as usize)
}
