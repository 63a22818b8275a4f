//! `fleet`: sessions, the answer of each as bytes, and the tables that they are put into.

use std::path::{Path, PathBuf};

use omni_gap::Error;
use omni_gap::engine::Knobs;
use omni_gap::error::Result;
use omni_gap::fleet::{Folder, FoundSession, SessionAnswer, Storage, Store, answer_session, find, fleet_report};
use omni_gap::pooling::PoolingKnobs;
use omni_gap::report::fleet as report;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::work::{mistake, work};

/// The sessions below folders: name, folder, and the folder below which it was found.
#[pyfunction]
pub fn fleet_find(py: Python<'_>, folders: Vec<PathBuf>) -> PyResult<Vec<(String, PathBuf, PathBuf)>> {
    let found = work(py, |_| find(&folders))?;
    Ok(found.into_iter().map(|session| (session.name, session.path, session.root)).collect())
}

/// The answer of a session, or why it could not be read.
#[pyclass(frozen, module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct FleetAnswer(SessionAnswer);

#[pymethods]
impl FleetAnswer {
    /// Of the files of [`FleetAnswer::tables`].
    #[staticmethod]
    fn of(py: Python<'_>, sessions: Vec<u8>, causes: Vec<u8>, equations: Vec<u8>) -> PyResult<Self> {
        work(py, |_| SessionAnswer::of_parquet([sessions, causes, equations])).map(Self)
    }

    /// The session's row in the table `sessions`, as JSON.
    fn row(&self) -> PyResult<String> {
        serde_json::to_string(self.0.session()).map_err(mistake)
    }

    /// Its rows as Parquet files, of the tables `sessions`, `causes` and `equations`.
    fn tables<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyBytes>; 3]> {
        Ok(work(py, |_| self.0.to_parquet())?.map(|bytes| PyBytes::new(py, &bytes)))
    }
}

/// Answers the session in `folder`, on one thread; none where it is as it was when the answer of the key `held` was made.
#[pyfunction]
pub fn fleet_answer(
    py: Python<'_>,
    session: (String, PathBuf, PathBuf),
    held: Option<String>,
    reports: Option<PathBuf>,
) -> PyResult<Option<FleetAnswer>> {
    let (name, folder, root) = session;
    work(py, |_| {
        let found = FoundSession::at(&folder, &root, name);
        let knobs = Knobs { equations: true, ..Knobs::default() };
        answer_session(&found, held.as_deref(), &knobs, reports.as_deref()).map(|answer| answer.map(FleetAnswer))
    })
}

/// The answer of a session that could not be read, and why.
#[pyfunction]
pub fn fleet_unreadable(session: (String, PathBuf, PathBuf), why: &str) -> FleetAnswer {
    let (name, folder, root) = session;
    FleetAnswer(SessionAnswer::unreadable(&FoundSession::at(&folder, &root, name), why))
}

/// The tables of a fleet, to write to as the only one.
#[pyclass(module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct FleetStore {
    store: Option<Store>,
}

#[pymethods]
impl FleetStore {
    /// Of a folder, or of an object with the methods `place`, `files`, `read`, `write` and `remove` of files by name.
    #[new]
    fn new(py: Python<'_>, place: Place) -> PyResult<Self> {
        let store = work(py, |_| match place {
            Place::Folder(folder) => Store::open(&folder),
            Place::Files(files) => Store::of(Box::new(Files(files))),
        })?;
        Ok(Self { store: Some(store) })
    }

    /// The key of the answer that it holds of a session.
    fn key(&mut self, session: &str) -> PyResult<Option<String>> {
        Ok(self.open()?.session(session).map(|row| row.key.clone()))
    }

    /// Takes an answer up, in place of what it holds of the same session.
    fn put(&mut self, py: Python<'_>, answer: &FleetAnswer) -> PyResult<()> {
        let store = self.open()?;
        work(py, |_| store.put(answer.0.clone()))
    }

    /// Writes what waits, and lets others write.
    fn close(&mut self, py: Python<'_>) -> PyResult<()> {
        match self.store.take() {
            Some(mut store) => work(py, move |_| store.flush()),
            None => Ok(()),
        }
    }
}

impl FleetStore {
    fn open(&mut self) -> PyResult<&mut Store> {
        self.store.as_mut().ok_or_else(|| mistake("this store is closed: open it again"))
    }
}

/// What the robots of a store tell together.
#[pyclass(module = "omni_gap._omni_gap")]
#[derive(Debug)]
pub struct FleetTold {
    json: String,
    html: String,
    text: String,
}

#[pymethods]
impl FleetTold {
    /// What `fleet.json` holds.
    fn json(&self) -> &str {
        &self.json
    }

    /// The page.
    fn html(&self) -> &str {
        &self.html
    }

    /// What the command says.
    fn text(&self) -> &str {
        &self.text
    }
}

/// Pools what a store holds.
#[pyfunction]
pub fn fleet_told(py: Python<'_>, place: Place) -> PyResult<FleetTold> {
    work(py, |_| {
        let storage: &dyn Storage = match place {
            Place::Folder(folder) => &Folder::to_read(&folder),
            Place::Files(files) => &Files(files),
        };
        let told = fleet_report(storage, &PoolingKnobs::default()).map_err(|why| why.to_string())?;
        let json = told.to_json().map_err(|why| why.to_string())?;
        Ok::<_, String>(FleetTold { json, html: report::html(&told), text: report::terminal(&told, None) })
    })
}

/// Where tables are kept.
#[derive(Debug, FromPyObject)]
pub enum Place {
    /// In a folder.
    #[pyo3(transparent)]
    Folder(PathBuf),
    /// In files by name, of an object of Python.
    #[pyo3(transparent)]
    Files(Py<PyAny>),
}

/// Files by name, of an object of Python.
struct Files(Py<PyAny>);

impl Files {
    fn call<T>(&self, method: &str, name: &str, ask: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>) -> Result<T> {
        Python::attach(|py| ask(self.0.bind(py))).map_err(|why| {
            let fix = "See that the place can be reached, and written to by you";
            Error::output(&self.place(name), format!("{method}: {why}"), fix)
        })
    }
}

impl Storage for Files {
    fn place(&self, name: &str) -> PathBuf {
        let told = Python::attach(|py| self.0.bind(py).call_method1("place", (name,))?.extract::<String>());
        PathBuf::from(told.unwrap_or_else(|_| Path::new("?").join(name).display().to_string()))
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        self.call("list", folder, |files| files.call_method1("files", (folder,))?.extract())
    }

    fn read(&self, name: &str) -> Result<Option<Vec<u8>>> {
        self.call("read", name, |files| files.call_method1("read", (name,))?.extract())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<()> {
        self.call("write", name, |files| files.call_method1("write", (name, PyBytes::new(files.py(), bytes))).map(drop))
    }

    fn remove(&self, name: &str) -> Result<()> {
        self.call("remove", name, |files| files.call_method1("remove", (name,)).map(drop))
    }
}
