//! # Python: an environment of its own under `target/`, with pinned packages
//!
//! It is there if the list of packages that was installed last is the list that is asked for now.

use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::{removed, told};
use crate::install::Install;
use crate::line::{Line, top};
use crate::tool::{Probe, Tool, ensure};

/// A Python that can make an environment: on Debian and Ubuntu, that part is a package of its own.
const PYTHON: &[Tool] = &[Tool {
    name: "Python with venv and pip",
    probe: Probe("python3 -m ensurepip --version", "pip"),
    installs: Install::Apt("python3 python3-venv"),
}];

/// The name that the list of what was installed has in the environment.
const INSTALLED: &str = "requirements.txt";

/// An environment: where it is, and the list of its packages, both from the top of the tree.
#[derive(Clone, Copy, Debug)]
pub struct Environment {
    /// Its folder.
    pub folder: &'static str,
    /// The packages, all of them, each with its version.
    pub requirements: &'static str,
}

impl Environment {
    /// Sees to it that it is there; its interpreter, from the top of the tree.
    ///
    /// # Errors
    /// What to tell the person.
    pub fn ensure(self) -> Result<PathBuf, String> {
        let python = Path::new(self.folder).join(INTERPRETER);
        let read = |path: PathBuf| fs::read_to_string(path).ok();
        let asked = read(top().join(self.requirements)).ok_or_else(|| format!("{} is missing", self.requirements))?;
        let installed = top().join(self.folder).join(INSTALLED);
        if read(installed.clone()).is_some_and(|installed| installed == asked) && top().join(&python).is_file() {
            return Ok(python);
        }
        ensure(PYTHON)?;
        for line in self.lines(&python) {
            println!("{}", line.shown());
            if !line.succeeds() {
                return Err(self.advice(&line));
            }
        }
        told(&installed.display().to_string(), fs::write(&installed, asked))?;
        Ok(python)
    }

    /// The same, made anew: nothing is in it but its packages.
    ///
    /// # Errors
    /// What to tell the person.
    pub fn renewed(self) -> Result<PathBuf, String> {
        removed(&top().join(self.folder))?;
        self.ensure()
    }

    /// Installs its packages in another environment.
    ///
    /// # Errors
    /// What to tell the person.
    pub fn add_to(self, python: &Path) -> Result<(), String> {
        let [_, filled] = self.lines(python);
        filled.announced().map_err(|_| self.advice(&filled))
    }

    /// What makes it.
    fn lines(self, python: &Path) -> [Line; 2] {
        let pip = "-m pip install --quiet --disable-pip-version-check --no-deps --only-binary :all: --requirement";
        let words = pip.split(' ').fold(Line::of("").word(python), Line::word);
        [Line::of("python3 -m venv --clear").word(self.folder), words.word(self.requirements)]
    }

    /// What to do where one of these lines failed.
    fn advice(self, failed: &Line) -> String {
        format!(
            "failed: {}\nthe packages of {} need Python 3.11 or newer, 64 bits, and a network that reaches PyPI (its mirror, \
             where PIP_INDEX_URL names one); mend that and ask again",
            failed.shown(),
            self.requirements
        )
    }
}

/// Where an environment keeps its interpreter.
const INTERPRETER: &str = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };

#[cfg(test)]
mod tests {
    use super::*;

    const SOME: Environment = Environment { folder: "target/some", requirements: "some/list.txt" };

    #[test]
    fn it_is_made_anew_and_gets_the_list_and_nothing_else() {
        let [made, filled] = SOME.lines(Path::new("target/some/bin/python")).map(|line| line.shown());
        assert_eq!(made, "python3 -m venv --clear target/some");
        assert!(filled.starts_with("target/some/bin/python -m pip install "), "{filled}");
        assert!(filled.contains(" --no-deps ") && filled.ends_with(" --requirement some/list.txt"), "{filled}");
    }

    #[test]
    fn a_missing_list_is_named() {
        assert_eq!(SOME.ensure().unwrap_err(), "some/list.txt is missing");
    }

    #[test]
    fn a_failure_says_what_is_needed() {
        let said = SOME.advice(&Line::of("pip install"));
        assert!(
            said.starts_with("failed: pip install\n") && said.contains("PyPI") && said.contains("Python 3.11"),
            "{said}"
        );
    }
}
