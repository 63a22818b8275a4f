//! # Real: where the recordings of real robots are
//!
//! They are too large for this tree, so the person says where they are: as an argument, or once and for all in a
//! variable.

use std::ffi::OsString;
use std::path::PathBuf;

/// The variable that names the folder where no argument does.
pub const VARIABLE: &str = "OMNI_GAP_DATA";

/// The folder of recordings, in full; otherwise what to tell the person.
pub fn folder(argument: Option<OsString>, variable: Option<OsString>) -> Result<PathBuf, String> {
    let given = argument.or(variable).filter(|given| !given.is_empty()).map(PathBuf::from);
    let Some(folder) = given else {
        return Err(format!("no folder of recordings: name one (cargo xtask real FOLDER) or set {VARIABLE} to it"));
    };
    if !folder.is_dir() {
        return Err(format!(
            "{} is not a folder: name the one that holds the recordings (cargo xtask real FOLDER, or {VARIABLE})",
            folder.display()
        ));
    }
    // The errand runs from the top of the tree, the person may stand elsewhere.
    std::path::absolute(&folder).map_err(|why| format!("{}: {why}", folder.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_argument_goes_before_the_variable_and_is_made_absolute() {
        let found = folder(Some("src".into()), Some("no-such-folder".into())).unwrap();
        assert!(found.is_absolute() && found.ends_with("src"), "{}", found.display());
        assert!(folder(None, Some("src".into())).is_ok());
    }

    #[test]
    fn neither_given_says_both_ways() {
        for nothing in [folder(None, None), folder(None, Some("".into()))] {
            let said = nothing.unwrap_err();
            assert!(said.contains("cargo xtask real FOLDER") && said.contains(VARIABLE), "{said}");
        }
    }

    #[test]
    fn a_missing_folder_is_named() {
        let said = folder(Some("no-such-folder".into()), None).unwrap_err();
        assert!(said.starts_with("no-such-folder is not a folder"), "{said}");
        assert!(folder(Some("Cargo.toml".into()), None).is_err(), "a file is no folder");
    }
}
