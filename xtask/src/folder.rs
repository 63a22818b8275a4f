//! # Folder: emptied, copied, and what is in it

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Takes a folder away, with all that is in it, if it is there.
///
/// # Errors
/// What to tell the person.
pub fn removed(folder: &Path) -> Result<(), String> {
    let gone = if folder.is_dir() { fs::remove_dir_all(folder) } else { Ok(()) };
    told(&folder.display().to_string(), gone)
}

/// Makes a folder that is empty.
///
/// # Errors
/// What to tell the person.
pub fn fresh(folder: &Path) -> Result<(), String> {
    removed(folder)?;
    told(&folder.display().to_string(), fs::create_dir_all(folder))
}

/// Copies those files of a folder that are wanted, each to the same place below the other.
///
/// # Errors
/// What to tell the person.
pub fn copied(from: &Path, to: &Path, wanted: fn(&Path) -> bool) -> Result<(), String> {
    let shown = from.display().to_string();
    for file in told(&shown, files(from))?.into_iter().filter(|file| wanted(file)) {
        let copy = to.join(file.strip_prefix(from).unwrap_or(&file));
        told(&shown, fs::create_dir_all(copy.parent().unwrap_or(to)))?;
        told(&shown, fs::copy(&file, copy))?;
    }
    Ok(())
}

/// All files below a folder, in the order of their paths.
///
/// # Errors
/// Where a folder cannot be read.
pub fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => found.extend(files(&path)?),
            false => found.push(path),
        }
    }
    found.sort();
    Ok(found)
}

/// What to tell the person of something that cannot be read or written.
///
/// # Errors
/// That.
pub fn told<T>(what: &str, done: io::Result<T>) -> Result<T, String> {
    done.map_err(|why| format!("{what}: {why}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wanted_is_copied_and_what_was_there_is_gone() {
        let at = std::env::temp_dir().join(format!("omni-gap-folder-{}", std::process::id()));
        fresh(&at.join("from/within")).unwrap();
        for file in ["from/a.py", "from/a.pyc", "from/within/b.py"] {
            fs::write(at.join(file), file).unwrap();
        }
        let python = |file: &Path| file.extension().is_some_and(|suffix| suffix == "py");
        fresh(&at.join("to")).unwrap();
        copied(&at.join("from"), &at.join("to"), python).unwrap();
        assert_eq!(files(&at.join("to")).unwrap(), [at.join("to/a.py"), at.join("to/within/b.py")]);
        fresh(&at.join("to")).unwrap();
        assert_eq!(files(&at.join("to")).unwrap(), Vec::<PathBuf>::new());
        removed(&at).unwrap();
        removed(&at).unwrap();
        assert!(!at.exists());
    }

    #[test]
    fn a_folder_that_is_not_there_is_named() {
        let said = copied(Path::new("no-such"), Path::new("nowhere"), |_| true).unwrap_err();
        assert!(said.starts_with("no-such: "), "{said}");
    }
}
