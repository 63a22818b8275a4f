//! # Cluster: sessions in an object store and on the nodes of a cluster, from Python
//!
//! The smoke test puts some sessions into an object store and answers them on one node; the long errand answers two thousand on three
//! nodes of which one is killed. Everything runs on this machine, in an environment of its own.

use std::ffi::OsString;
use std::fs;

use crate::folder::told;
use crate::line::{Line, top};
use crate::python::Environment;
use crate::wheel::{PACKAGE, dev_package, long_or_short, put_together, record};

/// Ray, Dask, and a server with the interface of S3.
pub const ENVIRONMENT: Environment =
    Environment { folder: "target/python/cluster", requirements: "python/requirements/cluster.txt" };

/// Where the package is put together from the extension of a release build.
const RELEASED: &str = "target/python/released";

/// Sessions of the long errand.
const SESSIONS: &str = "2000";

/// Its page.
const PAGE: &str = "host-tests/golden/cluster.md";

/// Does it: the smoke test where it is asked for, else all of it.
///
/// # Errors
/// What to tell the person.
pub fn perform(words: &[OsString]) -> Result<(), String> {
    long_or_short("cluster", words, whole, smoke)
}

fn smoke() -> Result<(), String> {
    let python = ENVIRONMENT.ensure()?;
    dev_package()?;
    Line::of("").word(python).word("python/cluster/smoke.py").env("PYTHONPATH", PACKAGE).announced()
}

fn whole() -> Result<(), String> {
    let python = ENVIRONMENT.ensure()?;
    Line::of("cargo build --release -p omni-gap-python").announced()?;
    put_together("release", RELEASED)?;
    let python = |words: &str| {
        let line = words.split(' ').fold(Line::of("").word(&python), Line::word);
        line.env("PYTHONPATH", RELEASED)
    };
    python("-m pytest python/cluster -q -W default").announced()?;
    let page = "target/python/cluster.md";
    python("python/cluster/scale.py").word(SESSIONS).word(page).announced()?;
    let text = told(page, fs::read_to_string(top().join(page)))?;
    record(PAGE, &text, "cargo xtask cluster")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_it_does_not_take_is_named_with_what_it_does() {
        let said = perform(&[OsString::from("ray")]).unwrap_err();
        assert_eq!(said, "cluster does not take ray; `smoke` is its short form");
    }
}
