//! Work without the interpreter's lock, and what becomes of mistakes, panics and Ctrl-C in it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use omni_gap::vocabulary::Progress;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

create_exception!(
    omni_gap,
    OmniGapError,
    PyValueError,
    "Input that cannot be used, told in one message: where it stands, what was found, what was expected, how to mend it."
);

/// A mistake as Python has it.
pub fn mistake(why: impl std::fmt::Display) -> PyErr {
    OmniGapError::new_err(why.to_string())
}

/// That Python has raised something while the work went on, as after Ctrl-C.
struct Raised(PyErr);

/// Does the work with the lock released. It is told what to call between its phases: there Ctrl-C ends it.
///
/// # Errors
/// What the work says, as an [`OmniGapError`]; what a signal's handler raised; a panic, as an [`OmniGapError`] that says so.
pub fn work<T: Send, E: std::fmt::Display>(
    py: Python<'_>,
    work: impl FnOnce(Progress<'_>) -> Result<T, E> + Send,
) -> PyResult<T> {
    let between = |_: &str| {
        // unwinds through the library, which holds nothing that would not be dropped
        Python::attach(|py| py.check_signals()).unwrap_or_else(|raised| resume_unwind(Box::new(Raised(raised))));
    };
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(|| work(&between).map_err(|why| why.to_string()))));
    match done {
        Ok(done) => {
            py.check_signals()?;
            done.map_err(mistake)
        }
        Err(panic) => Err(told(panic)),
    }
}

fn told(panic: Box<dyn Any + Send>) -> PyErr {
    let panic = match panic.downcast::<Raised>() {
        Ok(raised) => return raised.0,
        Err(panic) => panic,
    };
    let said = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    mistake(format!(
        "a mistake in omni-gap itself: {}. Tell its makers, with what was asked",
        said.unwrap_or("it does not say which")
    ))
}
