//! # Supply chain: what the product is made of, and whether it may be
//!
//! Licences, duplicates and sources are told by `.cargo/deny.toml`. What is known of weaknesses stands in a database that has to be fetched: a
//! machine that does not reach it says so.

use std::ffi::OsString;

use crate::line::Line;
use crate::tool;

/// Whether what the product is made of was compared with what is known of weaknesses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advisories {
    /// It was, and none is known.
    None,
    /// The database was not reached.
    NotReached,
}

/// Checks it.
///
/// # Errors
/// What to tell the person.
pub fn perform(_: &[OsString]) -> Result<(), String> {
    if checked()? == Advisories::NotReached {
        println!(
            "the database of advisories (github.com/RustSec/advisory-db) was not reached: nothing was compared with it"
        );
    }
    Ok(())
}

/// Checks it, and tells how far.
///
/// # Errors
/// What to tell the person.
pub fn checked() -> Result<Advisories, String> {
    tool::ensure(tool::SUPPLY_CHAIN)?;
    Line::of("cargo deny check licenses bans sources").announced()?;
    if Line::of("cargo deny fetch db").answer().is_none() {
        return Ok(Advisories::NotReached);
    }
    Line::of("cargo deny check --disable-fetch advisories").announced()?;
    Ok(Advisories::None)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::fs;

    use toml::{Table, Value};

    use crate::cluster;
    use crate::errands::lines;
    use crate::line::top;
    use crate::notebooks;
    use crate::python::Environment;
    use crate::wheel::package;

    #[test]
    fn every_package_is_pinned_with_the_hashes_of_its_files() {
        for Environment { requirements, .. } in [
            package::SMOKE,
            package::BUILD,
            package::TEST,
            cluster::ENVIRONMENT,
            notebooks::ENVIRONMENT,
            lines::MUJOCO,
            lines::PEERS,
        ] {
            let text = fs::read_to_string(top().join(requirements)).unwrap();
            let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
            let packages = lines.iter().filter(|line| !line.starts_with(' ')).count();
            assert!(packages > 0, "{requirements} is empty");
            for (at, line) in lines.iter().enumerate().filter(|(_, line)| !line.starts_with(' ')) {
                assert!(line.contains("==") && lines[at + 1].contains("--hash=sha256:"), "{requirements}: {line}");
            }
        }
    }

    /// The words of a list in a file.
    fn words(list: &Value) -> BTreeSet<String> {
        list.as_array().unwrap().iter().map(|word| word.as_str().unwrap().to_owned()).collect()
    }

    fn table(file: &str) -> Table {
        fs::read_to_string(top().join(file)).unwrap().parse().unwrap()
    }

    #[test]
    fn the_licences_that_are_allowed_are_those_that_an_archive_tells_of() {
        let (deny, about) = (table(".cargo/deny.toml"), table(".cargo/about.toml"));
        assert_eq!(words(&deny["licenses"]["allow"]), words(&about["accepted"]));
        let banned: Vec<&Value> = deny["bans"]["deny"].as_array().unwrap().iter().map(|one| &one["crate"]).collect();
        for exception in deny["licenses"]["exceptions"].as_array().unwrap() {
            let name = &exception["crate"];
            let told = about.get(name.as_str().unwrap()).map(|own| words(&own["accepted"]));
            let expected = (!banned.contains(&name)).then(|| words(&exception["allow"]));
            assert_eq!(told, expected, "{name}: in both files, or linked with nothing that is handed out");
        }
    }
}
