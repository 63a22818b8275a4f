//! # Errands: what a developer can ask for

pub mod lines;
mod table;

use std::ffi::OsString;

use table::{ERRANDS, Errand, list};

/// Why an errand was not done.
#[derive(Debug, PartialEq, Eq)]
pub enum ErrandError {
    /// It was asked for in the wrong way.
    Usage(String),
    /// It was tried and failed.
    Failed(String),
}

/// Does what the arguments ask for.
pub fn perform(arguments: impl IntoIterator<Item = OsString>) -> Result<(), ErrandError> {
    let (errand, arguments) = asked(arguments)?;
    (errand.run)(&arguments).map_err(ErrandError::Failed)
}

fn asked(arguments: impl IntoIterator<Item = OsString>) -> Result<(&'static Errand, Vec<OsString>), ErrandError> {
    let usage = |what: String| ErrandError::Usage(format!("{what}\n{}", list()));
    let mut arguments = arguments.into_iter();
    let name = arguments.next().ok_or_else(|| usage("no errand named".into()))?;
    let errand = ERRANDS.iter().find(|errand| name == errand.name);
    let errand = errand.ok_or_else(|| usage(format!("no errand is called {}", name.display())))?;
    let given: Vec<OsString> = arguments.collect();
    match given.get(errand.most()) {
        Some(more) => Err(usage(format!("{} does not take {}", errand.name, more.display()))),
        None => Ok((errand, given)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real;

    fn ask(words: &[&str]) -> Result<(&'static str, Vec<OsString>), ErrandError> {
        asked(words.iter().map(OsString::from)).map(|(errand, given)| (errand.name, given))
    }

    #[test]
    fn an_unknown_errand_is_answered_with_the_list() {
        for (words, complaint) in [(&["tset"][..], "no errand is called tset"), (&[], "no errand named")] {
            let Err(ErrandError::Usage(said)) = ask(words) else { panic!("{words:?} was taken") };
            assert!(said.starts_with(complaint), "{said}");
            assert_eq!(said.lines().count(), 1 + ERRANDS.len(), "{said}");
        }
    }

    #[test]
    fn an_errand_gets_as_many_arguments_as_it_takes() {
        assert_eq!(ask(&["real", "logs"]), Ok(("real", vec!["logs".into()])));
        assert_eq!(ask(&["real"]), Ok(("real", Vec::new())));
        let many = ["bench", "run", "a set", "--name", "x"];
        assert_eq!(ask(&many).map(|(_, given)| given.len()), Ok(4));
        assert!(matches!(ask(&["test", "logs"]), Err(ErrandError::Usage(_))));
        assert!(matches!(ask(&["real", "logs", "more"]), Err(ErrandError::Usage(_))));
    }

    #[test]
    fn help_names_the_variable_that_is_read() {
        assert!(list().contains(real::VARIABLE));
    }
}
