//! A session: a robot and its recordings, from files and from memory.

use std::path::{Path, PathBuf};

use omni_gap::log::Columns;
use omni_gap::{NamedSession, known_effects};
use pyo3::prelude::*;

use crate::robot::{Robot, as_toml};
use crate::table::Table;
use crate::work::{mistake, work};

/// A session that is being put together, and then asked.
#[pyclass(module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct Session {
    /// The session.
    pub session: omni_gap::Session,
    /// What reports call it.
    pub name: Option<String>,
    /// Where its runs are, for messages about all of them.
    pub place: PathBuf,
}

/// A mapping: the file, or a dictionary in its form, as JSON.
#[derive(Debug, FromPyObject)]
pub struct Mapping {
    #[pyo3(item)]
    path: Option<PathBuf>,
    #[pyo3(item)]
    json: Option<String>,
}

impl Mapping {
    /// The mapping.
    pub fn read(&self) -> Result<Columns, String> {
        let told = |why: omni_gap::Error| why.to_string();
        match (&self.path, &self.json) {
            (Some(path), _) => Columns::load(path).map_err(told),
            (None, json) => {
                let place = Path::new("columns");
                Columns::parse(&as_toml(json.as_deref().unwrap_or("{}"), place)?, place).map_err(told)
            }
        }
    }

    /// Its file.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }
}

#[pymethods]
impl Session {
    /// Reads a session folder.
    #[staticmethod]
    fn load(py: Python<'_>, folder: PathBuf, columns: Option<PathBuf>) -> PyResult<Self> {
        let name = name_of(&folder);
        let session = work(py, |_| omni_gap::Session::load(&folder, columns.as_deref(), &known_effects()))?;
        Ok(Self { session, name, place: folder.join("runs") })
    }

    /// A session of a robot, without runs.
    #[new]
    fn new(robot: &Robot, name: Option<String>) -> PyResult<Self> {
        let read = omni_gap::Session::of_robot(&robot.text, robot.place(), &known_effects());
        let mut session = read.map_err(mistake)?;
        session.files.extend(robot.path.clone());
        Ok(Self { session, name, place: PathBuf::from("runs") })
    }

    /// Adds run logs, and folders of them.
    fn add_files(&mut self, py: Python<'_>, runs: Vec<PathBuf>, columns: Option<Mapping>) -> PyResult<()> {
        if let Some(first) = runs.first() {
            self.place.clone_from(first);
        }
        let session = &mut self.session;
        work(py, move |_| {
            let read = columns.as_ref().map(Mapping::read).transpose()?;
            session.files.extend(columns.as_ref().and_then(|columns| columns.path().map(Path::to_path_buf)));
            session.add_files(&runs, read.as_ref()).map_err(|why| why.to_string())
        })
    }

    /// Adds the runs of a session folder, a run log, or a folder of them.
    fn add_any(&mut self, py: Python<'_>, path: PathBuf, columns: Option<PathBuf>) -> PyResult<()> {
        let session = &mut self.session;
        work(py, move |_| session.add_any(&path, columns.as_deref()))
    }

    /// Adds recordings in memory, and empties their tables.
    fn add_tables(&mut self, py: Python<'_>, tables: Vec<Bound<'_, Table>>, columns: Option<Mapping>) -> PyResult<()> {
        let tables = tables.iter().map(|table| table.borrow_mut().take()).collect::<PyResult<Vec<_>>>()?;
        let session = &mut self.session;
        work(py, move |_| {
            let columns = columns.as_ref().map(Mapping::read).transpose()?;
            session.add_tables(tables, columns.as_ref()).map_err(|why| why.to_string())
        })
    }

    /// The same session, called otherwise.
    fn renamed(&self, name: String) -> Self {
        Self { session: self.session.clone(), name: Some(name), place: self.place.clone() }
    }

    /// How many runs it has, held-out ones among them.
    #[getter]
    fn runs(&self) -> usize {
        self.session.runs.len() + self.session.heldout.len()
    }
}

impl Session {
    /// The same as a session that is judged beside another.
    pub fn named(&self) -> NamedSession {
        NamedSession { name: self.name.clone().unwrap_or_default(), session: self.session.clone() }
    }
}

/// What a path is called: the name of its folder or file, however it was written.
fn name_of(path: &Path) -> Option<String> {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    whole.file_name().map(|name| name.to_string_lossy().into_owned())
}
