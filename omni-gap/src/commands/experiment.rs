//! `experiment`: the paper's experiments, or a rich excitation, as scripts that a robot can play and a page that says how.

mod rich;

use std::path::{Path, PathBuf};

use omni_gap::api::{Error, PlannedExperiments, RobotFile, experiments, known_effects, rehearse};
use omni_gap::log::{Change, Run, SensorsFile, corrected, write_whole, write_whole_with};
use omni_gap::report::{Instructions, ScriptSaid, instructions, num};
use omni_gap::simulate::{Experiment, Lowered, Plan, Sensing, USUAL_FIELD, usual_voltage};
use omni_gap::simulate_experiments::drag_a_load;

use super::answer::{AnswerForm, FilesWritten};
use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given::{volts, within_supply};
use super::output_path::{self, NewFolder};

/// Write the scripts of the experiments that tell a robot's parameters, and how to do them
#[derive(Debug, clap::Args)]
pub struct Experiments {
    /// The robot file, with mass and geometry measured and the rest as far as it is known
    #[arg(value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// Folder for README.md, scripts/ and session/; made if need be
    #[arg(long, value_name = "DIR")]
    out: PathBuf,

    /// Largest voltage on a motor [V]; 8 V, or two thirds of [supply]; less where [limits] asks for it
    #[arg(long, value_name = "V", value_parser = volts)]
    voltage: Option<f64>,

    /// Rows a second in the scripts [1/s]; 100, or those of the recordings that are rehearsed
    #[arg(long, value_name = "HZ", value_parser = hertz, conflicts_with = "rehearse")]
    rate: Option<f64>,

    /// How often coast-downs and steps are repeated
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=20))]
    repeats: u8,

    /// Runs of the motor experiment, each with more to drag
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(2..=10))]
    loads: u8,

    /// Only these experiments, with commas between them: spin (1), coast (2), motor, step (3)
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = experiment)]
    only: Vec<Experiment>,

    /// In place of them, scripts whose recordings show as many causes as they can: for `diagnose`
    #[arg(long, conflicts_with_all = ["only", "repeats", "loads"])]
    rich: bool,

    /// Rich scripts
    #[arg(long, value_name = "N", default_value_t = 6, requires = "rich", value_parser = clap::value_parser!(u8).range(1..=50))]
    scripts: u8,

    /// Length of each rich script [s]
    #[arg(long, value_name = "S", default_value_t = 10.0, requires = "rich", value_parser = length)]
    duration: f64,

    /// Also play them on a robot that is just what its file says, measured so: paper, modern or halls
    #[arg(long, value_name = "SENSING", value_parser = sensing)]
    rehearse: Option<Sensing>,

    /// Seed of the noise of a rehearsal; the same seed gives the same files
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    #[command(flatten)]
    form: AnswerForm,
}

/// Rows a second where nothing else is asked [1/s]
const USUAL_RATE: f64 = 100.0;
/// Rates that a ramp of 0.3 s can be written at [1/s]
const RATES: (f64, f64) = (10.0, 10_000.0);
/// Lengths of a rich script: every kind of piece has room in the shortest [s]
const LENGTHS: (f64, f64) = (8.0, 120.0);
/// What is made in the folder.
const MADE: [&str; 3] = ["README.md", "scripts", "session"];

impl Experiments {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        output_path::folder(&self.out, &[])?;
        if let Some(there) = MADE.iter().map(|name| self.out.join(name)).find(|path| path.exists()) {
            let fix = "Name another folder with --out, or move it away";
            return Err(Error::output(&there, "it is there already", fix).into());
        }
        let file = RobotFile::load(&self.robot, &known_effects())?;
        let said = if self.rich { self.rich_written(&file, console)? } else { self.paper_written(&file, console)? };
        let files = MADE.iter().map(|name| self.out.join(name)).collect();
        self.form.say(console, &said, &FilesWritten::of(files))?;
        Ok(DONE)
    }

    fn plan(&self, file: &RobotFile) -> Result<Plan, CliError> {
        Ok(Plan {
            rate: self.rows_a_second(),
            voltage: self.voltage(file)?,
            field: field(file),
            repeats: self.repeats.into(),
            loads: self.loads.into(),
        })
    }

    fn rows_a_second(&self) -> f64 {
        self.rate.unwrap_or_else(|| self.rehearse.map_or(USUAL_RATE, Sensing::rate))
    }

    fn voltage(&self, file: &RobotFile) -> Result<f64, CliError> {
        within_supply(self.voltage.unwrap_or_else(|| usual_voltage(file)), &self.robot, file)
    }

    /// The experiments that are wanted, in the order in which they are done.
    fn wanted(&self) -> Vec<Experiment> {
        Experiment::ALL.into_iter().filter(|e| self.only.is_empty() || self.only.contains(e)).collect()
    }

    fn paper_written(&self, file: &RobotFile, console: &Console) -> Result<String, CliError> {
        console.phase("planning the experiments");
        let all = experiments(file, &self.plan(file)?, &self.wanted());
        let notes: Vec<String> = all.lowered.iter().map(lowered_in_words).collect();
        self.moves(&all.held, all.plan.voltage, &notes)?;
        let runs: Vec<&Run> = all.scripts.iter().map(|script| &script.run).collect();
        let page = self.page(file, &all, notes.clone());
        let played = |sensing| rehearse(file, &all.plan, &self.wanted(), sensing, self.seed);
        self.write(&runs, &page, played, console)?;
        Ok(self.said(&all, &notes))
    }

    /// That half of the largest voltage moves the robot along every axis but those that are held.
    fn moves(&self, held: &[&str], voltage: f64, notes: &[String]) -> Result<(), CliError> {
        let Some(axis) = held.first() else { return Ok(()) };
        let told = format!(
            "at {} V, half of what the scripts ask for, it does not move along {axis}: the friction of the file holds it. {}",
            num(0.5 * voltage),
            notes.join(" ")
        );
        let fix = "Ask for more with --voltage, widen [limits], or correct [friction]";
        Err(Error::input(&self.robot, told.trim().trim_end_matches('.'), fix).into())
    }

    /// The scripts, the page, and the session: the robot file, and where it is rehearsed the recordings.
    fn write(
        &self,
        scripts: &[&Run],
        page: &str,
        played: impl FnOnce(Sensing) -> Vec<Run>,
        console: &Console,
    ) -> Result<(), CliError> {
        let folder = NewFolder::make_with_files(&self.out)?;
        let inner = [
            NewFolder::make_with_files(&self.out.join("scripts"))?,
            NewFolder::make_with_files(&self.out.join("session/runs"))?,
        ];
        for script in scripts {
            write_run(&self.out.join(format!("scripts/{}.csv", script.name)), script)?;
        }
        let mut text = std::fs::read_to_string(&self.robot).map_err(|why| {
            Error::input(&self.robot, format!("cannot be read: {why}"), "Check the file's permissions")
        })?;
        if let Some(sensing) = self.rehearse {
            console.phase("rehearsing them");
            for run in played(sensing) {
                write_run(&self.out.join(format!("session/runs/{}.csv", run.name)), &run)?;
            }
            text = corrected(&text, &sensors(&sensing.recording().sensors))?;
        }
        write_whole(&self.out.join("session/robot.toml"), text.as_bytes())?;
        write_whole(&self.out.join("README.md"), page.as_bytes())?;
        folder.keep();
        inner.into_iter().for_each(NewFolder::keep);
        Ok(())
    }

    fn page(&self, file: &RobotFile, all: &PlannedExperiments, notes: Vec<String>) -> String {
        let said = all.scripts.iter().map(|script| ScriptSaid {
            name: script.name.clone(),
            experiment: script.experiment,
            seconds: script.seconds,
            floor: script.floor,
        });
        instructions(&Instructions {
            robot: file.name.clone(),
            wheels: file.wheel.len(),
            folder: self.out.display().to_string(),
            voltage: all.plan.voltage,
            notes,
            rate: all.plan.rate,
            scripts: said.collect(),
            drag: drag_a_load(file, &all.plan),
            rehearsed: self.rehearse.is_some(),
        })
    }

    fn said(&self, all: &PlannedExperiments, notes: &[String]) -> String {
        let seconds: f64 = all.scripts.iter().map(|script| script.seconds).sum();
        let text = self.told((all.scripts.len(), all.plan.voltage, seconds), notes);
        let which = if self.only.is_empty() { "all".to_owned() } else { said_as(&self.wanted()) };
        text + &match self.rehearse {
            Some(_) => {
                format!("next: omni-gap identify {} --experiment {which} --out identified.toml\n", self.at("session"))
            }
            None => format!("next: read {}; it says how to play them and what to record\n", self.at("README.md")),
        }
    }

    /// What was written: so many scripts of so many volts and seconds together.
    fn told(&self, (scripts, voltage, seconds): (usize, f64, f64), notes: &[String]) -> String {
        let (volts, minutes) = (num(voltage), (seconds / 60.0).ceil());
        let written = self.at("scripts");
        let mut text =
            format!("{scripts} scripts of up to {volts} V, {minutes:.0} minute(s) of driving, written to {written}\n");
        for note in notes {
            text += &format!("{note}\n");
        }
        if let Some(sensing) = self.rehearse {
            text += &format!(
                "played by a robot that is just what its file says, measured as `{}`, into {}\n",
                sensing.word(),
                self.at("session")
            );
        }
        text
    }

    fn at(&self, name: &str) -> String {
        self.out.join(name).display().to_string()
    }
}

fn write_run(path: &Path, run: &Run) -> Result<(), Error> {
    write_whole_with(path, |out| run.write_csv(out))
}

/// Side of the free floor [m]
fn field(file: &RobotFile) -> f64 {
    file.limits.and_then(|limits| limits.field_m).unwrap_or(USUAL_FIELD)
}

/// What `identify --experiment` is to be asked.
fn said_as(wanted: &[Experiment]) -> String {
    if let [one] = wanted { one.word().to_owned() } else { "all".to_owned() }
}

/// "The voltage is 4.31 V in place of 8.00 V: [limits] current_A = 1 …"
fn lowered_in_words(lowered: &Lowered) -> String {
    let (unit, why) = match lowered.key {
        "current_A" => ("A", "a motor that is held still draws no more than"),
        "speed_m_s" => ("m/s", "the robot gets no faster than"),
        _ => ("m", "every script stays on a floor of"),
    };
    let [from, to] = [lowered.from, lowered.to].map(num);
    format!("The voltage is {to} V in place of {from} V, so that {why} {} = {} {unit}.", lowered.key, lowered.limit)
}

/// The changes that state these sensors in a robot file.
fn sensors(sensors: &SensorsFile) -> [Change; 4] {
    [
        ("current_noise_A", sensors.current_noise_a),
        ("wheel_speed_noise_rad_s", sensors.wheel_speed_noise_rad_s),
        ("position_noise_m", sensors.position_noise_m),
        ("heading_noise_rad", sensors.heading_noise_rad),
    ]
    .map(|(key, value)| Change::Number { path: format!("sensors.{key}"), value })
}

fn hertz(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (RATES.0..=RATES.1).contains(&x) => Ok(x),
        _ => Err(format!("expected rows a second, from {} to {}", RATES.0, RATES.1)),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (LENGTHS.0..=LENGTHS.1).contains(&x) => Ok(x),
        _ => Err(format!("expected seconds, from {} to {}", LENGTHS.0, LENGTHS.1)),
    }
}

/// An experiment by its word or its number.
pub fn experiment(text: &str) -> Result<Experiment, String> {
    let told = || "expected spin (or 1), coast (or 2), motor, or step (or 3)".to_owned();
    Experiment::named(text.trim()).ok_or_else(told)
}

fn sensing(text: &str) -> Result<Sensing, String> {
    let known = Sensing::ALL.map(Sensing::word).join(", ");
    Sensing::ALL.into_iter().find(|s| s.word() == text).ok_or_else(|| format!("expected one of {known}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_told_with_its_unit() {
        let told = lowered_in_words(&Lowered { key: "current_A", limit: 1.0, from: 8.0, to: 4.3111 });
        assert_eq!(
            told,
            "The voltage is 4.31 V in place of 8.00 V, so that a motor that is held still draws no more than current_A = 1 A."
        );
    }

    #[test]
    fn an_experiment_is_known_by_word_and_number() {
        assert_eq!(experiment("2"), Ok(Experiment::Coast));
        assert!(experiment("jump").unwrap_err().contains("spin (or 1)"));
    }
}
