//! A robot file, or a dictionary in its form.

use std::path::{Path, PathBuf};

use omni_gap::log::RobotFile;
use omni_gap::{Session, known_effects};
use pyo3::prelude::*;

use crate::work::{mistake, work};

/// What a dictionary is called in messages.
const IN_MEMORY: &str = "robot";

/// A robot file that was read.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Robot {
    /// The robot.
    pub file: RobotFile,
    /// The text of its file.
    pub text: String,
    /// Its file; none where it came from memory.
    pub path: Option<PathBuf>,
}

#[pymethods]
impl Robot {
    /// Reads a robot file; `effects`, as JSON, take the place of those in it that have their names.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, effects: Option<&str>) -> PyResult<Self> {
        work(py, |_| {
            let told = |why: omni_gap::Error| why.to_string();
            let Session { robot, robot_text, .. } =
                Session::load_from(&path, None, &[], &known_effects()).map_err(told)?;
            if effects.is_none() {
                return Ok(Self { file: robot, text: robot_text, path: Some(path) });
            }
            let text = with_effects(robot_text, effects, &path)?;
            let file = parsed(&text, &path)?;
            Ok::<_, String>(Self { file, text, path: None })
        })
    }

    /// Reads a dictionary in the form of a robot file, as JSON.
    #[staticmethod]
    fn of_json(json: &str, effects: Option<&str>) -> PyResult<Self> {
        let place = Path::new(IN_MEMORY);
        let text = as_toml(json, place).and_then(|text| with_effects(text, effects, place)).map_err(mistake)?;
        let file = parsed(&text, place).map_err(mistake)?;
        Ok(Self { file, text, path: None })
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    /// How many wheels it has.
    #[getter]
    fn wheels(&self) -> usize {
        self.file.wheel.len()
    }

    /// The text of its file, in TOML.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }
}

impl Robot {
    /// Where it stands, for messages.
    pub fn place(&self) -> &Path {
        self.path.as_deref().unwrap_or(Path::new(IN_MEMORY))
    }
}

/// Reads a text that nobody wrote: its lines are none to name.
fn parsed(text: &str, place: &Path) -> Result<RobotFile, String> {
    RobotFile::parse(text, place, &known_effects()).map_err(|mut why| {
        if let omni_gap::Error::Input { line, .. } = &mut why {
            *line = None;
        }
        why.to_string()
    })
}

/// A dictionary as the text of a TOML file.
pub fn as_toml(json: &str, place: &Path) -> Result<String, String> {
    let told = |why: &dyn std::fmt::Display| {
        format!("{}: it has no form in TOML: {why}. Give numbers, texts, lists and dictionaries", place.display())
    };
    let value: toml::Value = serde_json::from_str(json).map_err(|why| told(&why))?;
    toml::to_string(&value).map_err(|why| told(&why))
}

fn with_effects(text: String, effects: Option<&str>, place: &Path) -> Result<String, String> {
    let Some(effects) = effects else { return Ok(text) };
    let told = |why: &dyn std::fmt::Display| format!("{}: {why}", place.display());
    let mut file: toml::Table = text.parse().map_err(|why| told(&why))?;
    let added: toml::Table = serde_json::from_str(effects)
        .map_err(|why| format!("effects: {why}. Give {{id: {{parameter: number}}}}, as [effects.id] has them"))?;
    let there = file.entry("effects").or_insert_with(|| toml::Value::Table(toml::Table::new()));
    if let toml::Value::Table(there) = there {
        there.extend(added);
    }
    toml::to_string(&file).map_err(|why| told(&why))
}

/// Refuses a voltage [V] that a robot's supply does not give.
pub fn within_supply(voltage: f64, file: &RobotFile, place: &Path) -> PyResult<()> {
    match file.supply {
        Some(supply) if voltage > supply.voltage_v => Err(mistake(format!(
            "{}: its supply gives {} V, voltage_V asks for {voltage} V. Ask for no more than the supply gives",
            place.display(),
            supply.voltage_v
        ))),
        _ => Ok(()),
    }
}
