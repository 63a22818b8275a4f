//! `explain`: the page of an effect or of a parameter, for a person.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use model_core::effects::card::{Card, Role, Scope};
use model_core::effects::nominal::{NOMINAL, NominalCard};
use omni_gap::known_effects;
use omni_gap::log::{FORMATS, RobotFile, write_whole};
use omni_gap::report::{effect_picture, num, shown_in};
use omni_gap::simulate::{NOMINAL_KEYS, effect_shown};

use super::answer::{AnswerForm, Entry, Explained, SCHEMA};
use super::causes::{cards, unknown};
use super::cli_error::CliError;
use super::console::Console;
use super::console::wrapped;
use super::demo::ROBOT;
use super::done::{DONE, Done};
use super::output_path;

/// Explain an effect or a parameter that can be the cause of a gap, or a form of files; without a name, list all
#[derive(Debug, clap::Args)]
pub struct Explain {
    /// The id of an effect or a parameter, or `robot`, `runs` or `columns`
    #[arg(value_name = "NAME")]
    name: Option<String>,

    /// Where to draw what the effect does to a short drive: the signal in which it shows most, without it and with it
    #[arg(long, value_name = "PICTURE.svg", requires = "name")]
    out: Option<PathBuf>,

    /// The robot of the picture; without it the paper's on four wheels
    #[arg(long, value_name = "ROBOT.toml", requires = "out")]
    robot: Option<PathBuf>,

    #[command(flatten)]
    form: AnswerForm,
}

impl Explain {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let page = self.name.as_deref().map_or_else(|| Ok(list()), |name| self.page(name))?;
        let asked = |entry: &Entry| self.name.as_deref().is_none_or(|name| name == entry.id);
        let page_asked_for = self.name.is_some().then(|| page.clone());
        let answer = Explained { schema: SCHEMA, entries: entries().filter(asked).collect(), page: page_asked_for };
        self.form.say(console, &page, &answer)?;
        Ok(DONE)
    }

    fn page(&self, name: &str) -> Result<String, CliError> {
        if let Some(card) = cards().find(|card| card.id == name) {
            return Ok(effect(card) + &self.drawn(card)?);
        }
        let parameter =
            NOMINAL.iter().find(|parameter| parameter.id == name).map(|parameter| parameter_page(parameter));
        let of_format = || FORMATS.iter().find(|format| format.name == name).map(|format| format.text.to_owned());
        match parameter.or_else(of_format) {
            Some(_) if self.out.is_some() => Err(CliError::Unclear(NO_PICTURE)),
            Some(page) => Ok(page),
            None => Err(unknown(name, FORMATS.iter().map(|format| format.name))),
        }
    }

    /// Draws the effect where that is asked for, and says so.
    fn drawn(&self, card: &'static Card) -> Result<String, CliError> {
        let Some(out) = &self.out else { return Ok(String::new()) };
        output_path::file(out, &self.robot.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
        let robot = match &self.robot {
            Some(path) => RobotFile::load(path, &known_effects())?,
            None => RobotFile::parse(ROBOT, Path::new("robot.toml"), &known_effects())?,
        };
        write_whole(out, effect_picture(&effect_shown(&robot, card)).as_bytes())?;
        Ok(format!("\nwritten to {}\n", out.display()))
    }
}

/// Kinds of what has a page.
const EFFECT: &str = "effect";
const PARAMETER: &str = "parameter";
const FILE: &str = "file";

/// Everything that has a page.
fn entries() -> impl Iterator<Item = Entry> {
    let effect =
        |card: &'static Card| Entry { id: card.id, title: card.title, kind: EFFECT, stage: Some(card.stage().name()) };
    let parameters = NOMINAL.iter().map(|card| Entry { id: card.id, title: card.title, kind: PARAMETER, stage: None });
    let files = FORMATS.iter().map(|form| Entry { id: form.name, title: form.title, kind: FILE, stage: None });
    cards().map(effect).chain(parameters).chain(files)
}

const NO_PICTURE: &str = "pictures are drawn of effects, and this is none: leave out --out, or \
    name an effect of the list that `omni-gap explain` prints.";

fn list() -> String {
    let width = entries().filter(|entry| entry.kind != FILE).map(|entry| entry.id.len()).max().unwrap_or(0) + 2;
    let of = |kind: &'static str| entries().filter(move |entry| entry.kind == kind);
    let mut page = String::new();
    for (heading, kind) in [
        ("Effects that a simulator may lack:", EFFECT),
        ("\nParameters that a robot file may have wrong:", PARAMETER),
        ("\nForms of files:", FILE),
    ] {
        let _ = writeln!(page, "{heading}");
        for Entry { id, title, stage, .. } in of(kind) {
            let stage = stage.map(|stage| format!(" ({stage})")).unwrap_or_default();
            let _ = writeln!(page, "  {id:width$}{title}{stage}");
        }
    }
    page + "\n`omni-gap explain NAME` tells more of each.\n"
}

fn effect(card: &Card) -> String {
    let mut page = format!("{}: {} ({} stage)\n\n", card.id, card.title, card.stage().name());
    page += &wrapped(0, card.summary);
    let _ = write!(page, "\n    {}\n\nParameters\n", card.equation);
    for p in card.params {
        let role = match p.role {
            Role::Size => "sizes the effect",
            Role::Shape => "shapes the effect",
            Role::Fixed => "shapes the effect too weakly to be fitted; held at its typical value",
        };
        let unit = if p.unit == "1" { String::new() } else { format!(" [{}]", p.unit) };
        let _ = writeln!(page, "  {}: {}{unit}, {role}", p.key, p.symbol);
        let (low, high) = p.within;
        let [absent, typical, low, high] = [p.absent, p.typical, low, high].map(num);
        let _ = match p.role {
            Role::Size => writeln!(page, "      absent {absent}, typical {typical}, from {low} to {high}"),
            Role::Shape | Role::Fixed => {
                writeln!(page, "      {typical} unless the file says otherwise, from {low} to {high}")
            }
        };
    }
    page += "\nWhere it shows\n";
    page += &wrapped(2, &shown_in(card));
    page += "\nHow it shows\n";
    page += &wrapped(2, card.signature);
    page += "\nWhat it can be mistaken for\n";
    for alike in card.look_alikes {
        page += &wrapped(2, &format!("{}: {}", alike.with, alike.settled_by));
    }
    page += "\nSource\n";
    page += &wrapped(2, card.source);
    page += "\nTo have it in a robot file (typical sizes)\n";
    page + &table(card)
}

/// The table that adds an effect to a robot file.
fn table(card: &Card) -> String {
    let (head, wheel) = match card.scope {
        Scope::OneWheel => (format!("[[effects.{}]]", card.id), "wheel = 0\n"),
        Scope::Robot | Scope::Wheels => (format!("[effects.{}]", card.id), ""),
    };
    let mut toml = format!("{head}\n{wheel}");
    for p in card.params {
        let _ = writeln!(toml, "{} = {:?}", p.key, p.typical);
    }
    let indented: String = toml.lines().map(|line| format!("  {line}\n")).collect();
    match card.scope {
        Scope::Wheels => {
            indented + &format!("  (on every wheel; for one wheel write [[effects.{}]] and wheel = 0)\n", card.id)
        }
        Scope::Robot | Scope::OneWheel => indented,
    }
}

fn parameter_page(parameter: &NominalCard) -> String {
    let mut page = format!("{}: {} (a parameter of the robot file)\n\n", parameter.id, parameter.title);
    page += &wrapped(0, parameter.summary);
    page += "\nIn the robot file\n";
    for key in NOMINAL_KEYS.iter().filter(|k| k.factors.iter().any(|p| p.cause() == parameter.id)) {
        let table = if key.table == "wheel" { "[[wheel]]".to_owned() } else { format!("[{}]", key.table) };
        let _ = writeln!(page, "  {table} {} [{}]", key.key, key.unit);
    }
    page += "\nHow to measure it\n";
    page += &wrapped(2, parameter.measured_by);
    let alike: Vec<&str> =
        cards().filter(|c| c.look_alikes.iter().any(|l| l.with == parameter.id)).map(|c| c.id).collect();
    if !alike.is_empty() {
        page += "\nEffects that it can be mistaken for\n";
        page += &wrapped(2, &alike.join(", "));
    }
    page
}
