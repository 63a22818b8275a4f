//! `check`.

use omni_gap::api::check_and_informativity;
use omni_gap::check::Fault;
use omni_gap::identify::Informativity;
use omni_gap::report::informativity_terminal;
use pyo3::prelude::*;
use serde::Serialize;

use crate::session::Session;
use crate::work::work;

/// The version of the form below.
const SCHEMA: u32 = 1;

/// What the command answers with `--json`.
#[derive(Serialize)]
struct Checked<'a> {
    schema: u32,
    runs: usize,
    usable: bool,
    faults: &'a [Fault],
    informativity: Option<&'a Informativity>,
    notices: &'a [String],
}

/// Checks the recordings of a session: the answer as JSON, and what they can tell, in words.
#[pyfunction]
pub fn check(py: Python<'_>, session: PyRef<'_, Session>) -> PyResult<(String, String)> {
    let session = &session.session;
    work(py, move |_| {
        let (faults, told) = check_and_informativity(session);
        let answer = Checked {
            schema: SCHEMA,
            runs: session.runs.len() + session.heldout.len(),
            usable: !faults.iter().any(|fault| fault.fatal),
            faults: &faults,
            informativity: told.as_ref(),
            notices: &session.notices,
        };
        let words = told.as_ref().map(informativity_terminal).unwrap_or_default();
        serde_json::to_string(&answer).map(|json| (json, words))
    })
}
