//! # The compiled part of the Python package `omni_gap`
//!
//! Thin: it takes what the package's Python files have put into order, calls [`omni_gap::api`] with the interpreter's lock
//! released, and hands back texts, bytes and numbers. What a person sees, with its shapes and units, is written in Python, in
//! `python/omni_gap/`.

// A unit in brackets, [V], is not a link.
#![allow(rustdoc::broken_intra_doc_links)]
// The macros of PyO3 make the unsafe code of the binding; the lint would be silent about it alone where it says so.
#![warn(missing_docs)]

mod arrow;
mod causes;
mod checked;
mod compared;
mod designed;
mod diagnosed;
mod fleet;
mod identified;
mod plants;
mod robot;
mod run;
mod selftested;
mod session;
mod signals;
mod table;
mod work;

use pyo3::prelude::*;

/// The compiled part of `omni_gap`; use that package, this module may change without notice.
#[pymodule]
mod _omni_gap {
    #[pymodule_export]
    use super::causes::causes;
    #[pymodule_export]
    use super::checked::check;
    #[pymodule_export]
    use super::compared::{Compared, compare};
    #[pymodule_export]
    use super::designed::{Designed, next};
    #[pymodule_export]
    use super::diagnosed::{Diagnosed, diagnose};
    #[pymodule_export]
    use super::fleet::{FleetAnswer, FleetStore, FleetTold, fleet_answer, fleet_find, fleet_told, fleet_unreadable};
    #[pymodule_export]
    use super::identified::{Identified, identify};
    #[pymodule_export]
    use super::plants::Plants;
    #[pymodule_export]
    use super::robot::Robot;
    #[pymodule_export]
    use super::run::{Run, predict, simulate};
    #[pymodule_export]
    use super::selftested::{Selftested, selftest};
    #[pymodule_export]
    use super::session::Session;
    #[pymodule_export]
    use super::table::Table;
    #[pymodule_export]
    use super::work::OmniGapError;
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
