//! The files of a report, each whole or not there.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::model::Report;
use crate::engine::findings::NextExperiment;
use crate::error::{Error, Result};
use crate::log::{HeldFolder, UNFINISHED};

const NAME_ANOTHER: &str = "Name another folder with --out";
const ROOM: &str = "Free space, or name a folder you may write to with --out";

/// Where the files of a report stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// `report.json`.
    pub json: PathBuf,
    /// `report.html`.
    pub html: PathBuf,
    /// `refitted_robot.toml`, where a model was fitted.
    pub refitted: Option<PathBuf>,
    /// `corrected_robot.toml`, where causes were named.
    pub corrected: Option<PathBuf>,
    /// `next_experiment.csv`, where a script would tell apart what was not.
    pub script: Option<PathBuf>,
}

/// The files beside a report.
#[derive(Clone, Copy, Debug, Default)]
pub struct Beside<'a> {
    /// With its numbers re-fitted within their stated uncertainty; none where no model was fitted.
    pub refitted: Option<&'a str>,
    /// With the causes written in; none where none was named.
    pub corrected: Option<&'a str>,
    /// The script to play next; none where nothing is open that a script tells apart.
    pub script: Option<&'a str>,
}

/// Puts `report.json`, `report.html` and the files beside them that there are into the folder, which is made where it is not
/// there. A file of an older report that this one does not have is taken away.
///
/// An error says which path, why, and how to mend it.
pub fn write(dir: &Path, report: &Report, html: &str, beside: Beside<'_>) -> Result<Written> {
    let json = report.to_json().map_err(|why| unwritable(&why.into(), &dir.join("report.json")))?;
    let own = [
        ("refitted_robot.toml", beside.refitted),
        ("corrected_robot.toml", beside.corrected),
        (NextExperiment::FILE, beside.script),
    ];
    let there = own.iter().filter_map(|(name, text)| text.map(|text| (*name, text)));
    let files: Vec<(&str, &str)> =
        [("report.json", json.as_str()), ("report.html", html)].into_iter().chain(there).collect();
    let gone: Vec<&str> = own.iter().filter(|(_, text)| text.is_none()).map(|(name, _)| *name).collect();
    put_all(dir, &files, &gone)?;
    let place = |name: &str| dir.join(name);
    let [refitted, corrected, script] = own.map(|(name, text)| text.map(|_| place(name)));
    Ok(Written { json: place("report.json"), html: place("report.html"), refitted, corrected, script })
}

/// Puts files into the folder, which is made where it is not there, and says where they stand; the error is as for [`write()`].
pub(super) fn put<const COUNT: usize>(dir: &Path, files: [(&str, &str); COUNT]) -> Result<[PathBuf; COUNT]> {
    put_all(dir, &files, &[])?;
    Ok(files.map(|(name, _)| dir.join(name)))
}

/// As [`put`], in place of an older report, of which the files that are gone are taken away.
pub(super) fn put_all(dir: &Path, files: &[(&str, &str)], gone: &[&str]) -> Result<()> {
    std::fs::create_dir_all(dir).map_err(|why| match dir.is_file() {
        true => Error::output(dir, "it is a file, and the report needs a folder", NAME_ANOTHER),
        false => Error::output(dir, why.to_string(), ROOM),
    })?;
    let _held = HeldFolder::take(dir);
    let places: Vec<PathBuf> = files.iter().map(|(name, _)| dir.join(name)).collect();
    // All are staged before the first is put in place: a full disk then leaves an older report as it was.
    let staged: Vec<_> =
        places.iter().zip(files).map(|(path, (_, text))| stage(dir, path, text)).collect::<Result<_>>()?;
    for (path, file) in places.iter().zip(staged) {
        file.persist(path).map_err(|e| unwritable(&e.error, path))?;
    }
    for path in gone.iter().map(|name| dir.join(name)) {
        match std::fs::remove_file(&path) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(unwritable(&why, &path)),
            _ => {}
        }
    }
    Ok(())
}

/// The text in a file of the same folder that nobody reads yet.
fn stage(dir: &Path, path: &Path, text: &str) -> Result<tempfile::NamedTempFile> {
    let staged = || {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o644));
        }
        let mut file = builder.prefix(UNFINISHED).tempfile_in(dir)?;
        // its own writer tells the hidden name with every error
        file.as_file_mut().write_all(text.as_bytes())?;
        file.as_file().sync_all()?;
        Ok(file)
    };
    staged().map_err(|e: io::Error| unwritable(&e, path))
}

pub(super) fn unwritable(why: &io::Error, path: &Path) -> Error {
    Error::output(path, why.to_string(), ROOM)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn five_files_stand_in_a_folder_that_was_not_there() {
        let root = tempfile::tempdir().unwrap();
        let dir = root.path().join("deep/out");
        let robots =
            Beside { refitted: Some("name = \"y\"\n"), corrected: Some("name = \"x\"\n"), script: Some("t_s\n") };
        let written = write(&dir, &sample::effect(), "<html></html>", robots).unwrap();
        assert_eq!(
            names(&dir),
            ["corrected_robot.toml", "next_experiment.csv", "refitted_robot.toml", "report.html", "report.json"]
        );
        assert_eq!(std::fs::read_to_string(written.corrected.unwrap()).unwrap(), "name = \"x\"\n");
        let back: Report = serde_json::from_str(&std::fs::read_to_string(written.json).unwrap()).unwrap();
        assert_eq!(back, sample::effect());
    }

    #[test]
    fn a_second_report_replaces_the_first() {
        let root = tempfile::tempdir().unwrap();
        let [one, two] =
            [Some("one"), None].map(|corrected| Beside { refitted: Some("same"), corrected, script: corrected });
        write(root.path(), &sample::effect(), "one", one).unwrap();
        std::fs::write(root.path().join("notes.txt"), "mine").unwrap();
        let written = write(root.path(), &sample::no_gap(), "two", two).unwrap();
        assert_eq!(std::fs::read_to_string(root.path().join("report.html")).unwrap(), "two");
        // nothing was corrected this time, and what is not of a report stays
        assert_eq!(names(root.path()), ["notes.txt", "refitted_robot.toml", "report.html", "report.json"]);
        assert_eq!(written.corrected, None);
    }

    #[test]
    fn a_file_in_the_folders_place_is_named_with_what_to_do() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("out");
        std::fs::write(&path, "mine").unwrap();
        let error = write(&path, &sample::effect(), "", Beside::default()).unwrap_err().to_string();
        assert!(error.starts_with(path.to_str().unwrap()) && error.contains("is a file") && error.contains("--out"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    }

    #[test]
    fn a_name_that_is_taken_by_a_folder_leaves_nothing_behind() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("report.json")).unwrap();
        let error = write(root.path(), &sample::effect(), "", Beside::default()).unwrap_err().to_string();
        assert!(error.contains("report.json: cannot be written"), "{error}");
        assert_eq!(names(root.path()), ["report.json"]);
    }
}
