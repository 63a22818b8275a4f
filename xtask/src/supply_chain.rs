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
    use std::fs;

    use crate::cluster;
    use crate::errands::lines;
    use crate::line::top;
    use crate::python::Environment;
    use crate::wheel::package;

    #[test]
    fn every_package_is_pinned_with_the_hashes_of_its_files() {
        for Environment { requirements, .. } in
            [package::SMOKE, package::BUILD, package::TEST, cluster::ENVIRONMENT, lines::MUJOCO, lines::PEERS]
        {
            let text = fs::read_to_string(top().join(requirements)).unwrap();
            let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
            let packages = lines.iter().filter(|line| !line.starts_with(' ')).count();
            assert!(packages > 0, "{requirements} is empty");
            for (at, line) in lines.iter().enumerate().filter(|(_, line)| !line.starts_with(' ')) {
                assert!(line.contains("==") && lines[at + 1].contains("--hash=sha256:"), "{requirements}: {line}");
            }
        }
    }
}
