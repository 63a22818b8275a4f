//! `demo`: a robot with something to hide, recorded and diagnosed.

use std::path::{Path, PathBuf};

use omni_gap::Options;
use omni_gap::log::write_session;
use omni_gap::report::{self, estimate};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Error, Report, Session, known_effects};

use super::answer::AnswerForm;
use super::console::Console;
use super::console::wrapped;
use super::diagnose::{FILES, diagnosed};
use super::done::{DONE, Done};
use super::output_path::{self, NewFolder};

/// Record a robot whose real behaviour has an effect that its simulator lacks, and diagnose it
#[derive(Debug, clap::Args)]
pub struct Demo {
    /// Folder for the recording (DIR/session) and the report (DIR/report)
    #[arg(long, value_name = "DIR", default_value = "omni-gap-demo")]
    out: PathBuf,

    #[command(flatten)]
    form: AnswerForm,
}

/// The robot of the demo, and of whatever is shown where no robot is named.
pub(super) const ROBOT: &str = include_str!("../../robots/feup-4w/robot.toml");

/// What marks a robot file as the demo's own, which it may write over.
const MARK: &str = "# Made by `omni-gap demo`: ";

/// What the true robot has and its simulator lacks.
fn hidden() -> EffectInstance {
    EffectInstance { id: "dead_time", wheel: None, params: vec![0.35, 0.05] }
}

fn plan() -> Scenario {
    Scenario { hidden: vec![hidden()], runs: 6, duration: 3.0, rate: 200.0, seed: 2008, ..Scenario::default() }
}

impl Demo {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let (at, out) = (self.out.join("session"), self.out.join("report"));
        output_path::folder(&at, &["robot.toml"])?;
        output_path::folder(&out, &FILES)?;
        only_ours(&at)?;

        console.phase("recording a robot that is not what its file says");
        let staged = synthesize(ROBOT, &plan(), &known_effects())?;
        let folder = NewFolder::make_with_files(&at)?;
        let told = "what the simulator believes of the robot that was recorded.";
        write_session(&at, &format!("{MARK}{told}\n{}", staged.robot_text), &staged.runs)?;
        drop(staged); // what follows knows the files alone

        console.phase("reading the recordings");
        let session = Session::load(&at, None, &known_effects())?;
        let what = Options { session: Some("session".to_owned()), ..Options::default() };
        let (report, written) = diagnosed(&session, &what, &out, console)?;
        folder.keep();

        let runs = session.runs.len();
        let recorded = format!("Recorded {runs} runs of {} into {}.", session.robot.name, at.display());
        let answer = report::terminal(&report, Some(&written));
        self.form.say(console, &format!("{recorded}\n\n{answer}\n{}", unveiled(&report)), &report)?;
        Ok(DONE)
    }
}

/// Refuses to write over a session that somebody else made.
fn only_ours(session: &Path) -> Result<(), Error> {
    let robot = session.join("robot.toml");
    let ours = std::fs::read_to_string(&robot).is_ok_and(|text| text.starts_with(MARK));
    let (own, runs): (Vec<String>, Vec<String>) = (names(session), names(&session.join("runs")));
    let stranger = own.iter().find(|n| !["robot.toml", "runs"].contains(&n.as_str()));
    let foreign = runs.iter().find(|n| !(0..plan().runs).any(|k| **n == format!("run{k:02}.csv")));
    if own.is_empty() || (ours && stranger.is_none() && foreign.is_none()) {
        return Ok(());
    }
    let told = "it holds files that the demo did not make";
    Err(Error::output(session, told, "Name another folder with --out, or remove this one"))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect()
}

/// What was hidden beside what was found.
fn unveiled(report: &Report) -> String {
    let hidden = hidden();
    let card = hidden.card();
    let named = |id: &str, wheel: Option<usize>, numbers: Vec<String>| {
        let at = wheel.map_or(String::new(), |j| format!(" on wheel {j}"));
        format!("{id}{at} ({})", numbers.join(", "))
    };
    let sizes = card.params.iter().zip(&hidden.params).filter(|(p, x)| **x != p.absent);
    let sizes = sizes.map(|(p, x)| format!("{} {}", p.key, estimate(*x, None, p.unit))).collect();
    let found = report.named().into_iter().map(|w| {
        let fitted = w.parameters.iter().filter(|(_, p)| p.std.is_some());
        let numbers = fitted.map(|(key, p)| format!("{key} {}", estimate(p.value, p.std, &p.unit))).collect();
        named(&w.cause, w.wheel, numbers)
    });
    let found: Vec<String> = found.collect();
    let found = if found.is_empty() { "nothing".to_owned() } else { found.join("; ") };
    wrapped(0, &format!("What was hidden: {}.", named(card.id, hidden.wheel, sizes)))
        + &wrapped(0, &format!("What was found: {found}."))
        + &wrapped(0, "Besides, every number of the robot file was off by a draw of its stated uncertainty.")
}
