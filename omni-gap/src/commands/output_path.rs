//! Where outputs go, looked at before any work is done for them.

use std::io;
use std::path::{Path, PathBuf};

use omni_gap::Error;
use omni_gap::error::Result;
use omni_gap::log::is_device;

const NAME_ANOTHER: &str = "Name another place with --out";

/// Refuses a file that could not be written, or that is one of the inputs, or lies among the files of one.
pub fn file(path: &Path, inputs: &[&Path]) -> Result<()> {
    if path.is_dir() {
        return Err(Error::output(path, "it is a folder", "Name a file with --out"));
    }
    if is_device(path) {
        return Ok(());
    }
    let same = |input: &&&Path| path.canonicalize().is_ok_and(|p| input.canonicalize().is_ok_and(|i| i == p));
    if inputs.iter().find(same).is_some() {
        return Err(Error::output(path, "it is an input and would be lost", NAME_ANOTHER));
    }
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let within = |input: &&&Path| input.is_dir() && folder.canonicalize().ok() == input.canonicalize().ok();
    if let Some(input) = inputs.iter().find(within) {
        return Err(Error::output(
            path,
            format!("it lies among the files of the run {}", input.display()),
            NAME_ANOTHER,
        ));
    }
    if folder.is_file() {
        return Err(Error::output(path, format!("{} is a file, not a folder", folder.display()), NAME_ANOTHER));
    }
    if !folder.is_dir() {
        return Err(Error::output(path, format!("there is no folder {}", folder.display()), "Make the folder first"));
    }
    try_in(folder, path)
}

/// Refuses a folder that could not be made, or in which one of the files could not be written.
pub fn folder(path: &Path, files: &[&str]) -> Result<()> {
    if let Some(taken) = files.iter().map(|name| path.join(name)).find(|file| file.is_dir()) {
        return Err(Error::output(&taken, "it is a folder", NAME_ANOTHER));
    }
    let standing = nearest_standing(path);
    if !standing.is_dir() {
        let told = if standing == path { "it is a file".into() } else { format!("{} is a file", standing.display()) };
        return Err(Error::output(path, format!("{told}, not a folder"), NAME_ANOTHER));
    }
    try_in(&standing, path)
}

/// The path itself where it stands, else the nearest folder above it that does.
fn nearest_standing(path: &Path) -> PathBuf {
    let stands = |p: &&Path| p.as_os_str().is_empty() || p.symlink_metadata().is_ok();
    match path.ancestors().find(stands) {
        Some(p) if !p.as_os_str().is_empty() => p.into(),
        _ => ".".into(),
    }
}

fn try_in(folder: &Path, output: &Path) -> Result<()> {
    let told = |why: io::Error| Error::output(output, why.to_string(), NAME_ANOTHER);
    // without a name, where the system has such files: nothing of it is left if the program is killed here
    tempfile::tempfile_in(folder).map(drop).map_err(told)
}

/// A folder that goes away again, unless it is kept.
#[derive(Debug)]
pub struct NewFolder {
    made: Option<PathBuf>,
    path: PathBuf,
    with_files: bool,
}

impl NewFolder {
    /// Makes a folder and what is missing above it, for files that are put there all or none: it goes away if it is empty, and what
    /// another program put into it meanwhile stays. Where it stood before, nothing of it will go away.
    pub fn make(path: &Path) -> Result<Self> {
        Self::new(path, false)
    }

    /// Makes a folder for files that are put there one by one, with which it goes away.
    pub fn make_with_files(path: &Path) -> Result<Self> {
        Self::new(path, true)
    }

    fn new(path: &Path, with_files: bool) -> Result<Self> {
        let missing = path.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists()).last();
        let made = Self { made: missing.map(Path::to_path_buf), path: path.into(), with_files };
        std::fs::create_dir_all(path).map_err(|why| Error::output(path, why.to_string(), NAME_ANOTHER))?;
        Ok(made)
    }

    /// All went well: the folder stays.
    pub fn keep(mut self) {
        self.made = None;
    }
}

impl Drop for NewFolder {
    fn drop(&mut self) {
        let Some(made) = &self.made else { return };
        if self.with_files {
            let _ = std::fs::remove_dir_all(made);
            return;
        }
        for folder in self.path.ancestors().take_while(|folder| folder.starts_with(made)) {
            let _ = std::fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_below_a_file_and_a_folder_in_the_files_place_are_refused() {
        let root = tempfile::tempdir().unwrap();
        let plain = root.path().join("plain");
        std::fs::write(&plain, "mine").unwrap();
        for deep in [plain.join("out"), plain.join("out/deeper"), plain.clone()] {
            let told = folder(&deep, &[]).unwrap_err().to_string();
            assert!(told.contains("is a file, not a folder") && told.contains("--out"), "{told}");
        }
        assert!(file(&plain.join("out"), &[]).unwrap_err().to_string().contains("is a file"));
        assert!(file(root.path(), &[]).unwrap_err().to_string().contains("is a folder"));
        assert!(file(&plain, &[&plain]).unwrap_err().to_string().contains("is an input"));
        std::fs::create_dir(root.path().join("report.json")).unwrap();
        assert!(folder(root.path(), &["report.json"]).is_err());
    }

    #[test]
    fn looking_leaves_nothing_behind() {
        let root = tempfile::tempdir().unwrap();
        folder(&root.path().join("a/b/c"), &["x"]).unwrap();
        file(&root.path().join("x"), &[]).unwrap();
        assert_eq!(std::fs::read_dir(root.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_new_folder_goes_away_unless_it_is_kept() {
        let root = tempfile::tempdir().unwrap();
        let deep = root.path().join("a/b");
        drop(NewFolder::make(&deep).unwrap());
        assert!(!root.path().join("a").exists());
        let failing = NewFolder::make(&deep).unwrap();
        std::fs::write(deep.join("report.json"), "another program's").unwrap();
        drop(failing);
        assert!(deep.join("report.json").is_file());
        std::fs::remove_dir_all(root.path().join("a")).unwrap();
        let failing = NewFolder::make_with_files(&deep).unwrap();
        std::fs::write(deep.join("first.csv"), "of several").unwrap();
        drop(failing);
        assert!(!root.path().join("a").exists());
        NewFolder::make(&deep).unwrap().keep();
        drop(NewFolder::make(&deep).unwrap());
        assert!(deep.is_dir());
    }
}
