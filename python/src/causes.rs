//! Names of causes.

use omni_gap::cause_ids;
use omni_gap::log::nearest;
use pyo3::prelude::*;

use crate::work::mistake;

/// The names, if each is one of the catalogue's.
#[pyfunction]
pub fn causes(names: Vec<String>) -> PyResult<Vec<String>> {
    let Some(other) = names.iter().find(|name| !cause_ids().any(|id| id == name.as_str())) else { return Ok(names) };
    let fix = match nearest(other, cause_ids()) {
        Some(near) => format!("Did you mean `{near}`?"),
        None => "`omni-gap explain` lists all names".to_owned(),
    };
    Err(mistake(format!("`{other}` is neither an effect nor a parameter. {fix}")))
}
