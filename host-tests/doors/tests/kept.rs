//! # What a release wrote, every later one reads
//!
//! Of every release, the files of the product's own forms are kept as it wrote them, in `kept/VERSION/`. With `BLESS=1` those of this version
//! are put there where it has none yet; what is there is never written again.

use std::fs;
use std::path::{Path, PathBuf};

use doors::{Answer, Door, seeds};
use omni_gap::log::{Session, write_session};
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Options, Report, diagnose, known_effects};

/// Forms of our own, by the door that reads them.
const FORMS: [&str; 7] = ["robot", "columns", "csv", "records", "frames", "block", "fleet"];

const REPORT: &str = "report.json";

fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("kept")
}

/// Keeps what this version writes, where nothing is kept of it.
fn keep() {
    let folder = kept().join(env!("CARGO_PKG_VERSION"));
    if folder.exists() || std::env::var_os("BLESS").is_none() {
        return;
    }
    fs::create_dir_all(&folder).expect("room for a folder");
    for form in FORMS {
        for (at, bytes) in seeds(form).iter().enumerate() {
            fs::write(folder.join(format!("{form}-{at}")), bytes).expect("room for a file");
        }
    }
    fs::write(folder.join(REPORT), report()).expect("room for a file");
}

/// A report as a program gets it.
fn report() -> String {
    let robot = std::str::from_utf8(&seeds("robot")[0]).expect("a robot file is text").to_owned();
    let plan = Scenario { runs: 3, duration: 2.0, rate: 100.0, ..Scenario::default() };
    let staged = synthesize(&robot, &plan, &known_effects()).expect("a sound stage");
    let folder = tempfile::tempdir().expect("a folder");
    write_session(folder.path(), &staged.robot_text, &staged.runs).expect("room for a session");
    let session = Session::load(folder.path(), None, &known_effects()).expect("a sound session");
    diagnose(&session, &Options::default()).to_json().expect("numbers that JSON has")
}

#[test]
fn every_form_of_every_release_is_read() {
    keep();
    let releases: Vec<PathBuf> = fs::read_dir(kept()).expect("kept files").map(|entry| entry.unwrap().path()).collect();
    assert!(
        releases.iter().any(|release| release.ends_with(env!("CARGO_PKG_VERSION"))),
        "nothing is kept of this version"
    );
    for release in releases {
        let files: Vec<PathBuf> =
            fs::read_dir(&release).expect("a folder").map(|entry| entry.unwrap().path()).collect();
        assert!(files.len() > FORMS.len(), "{}: {} files", release.display(), files.len());
        for file in files {
            let bytes = fs::read(&file).expect("a file");
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            if name == REPORT {
                let report: Report = serde_json::from_slice(&bytes).expect("a report");
                assert!(!report.which.is_empty(), "{}", file.display());
                continue;
            }
            let (form, _) = name.rsplit_once('-').expect("a form and a number");
            let answer = Door::named(form).check(&bytes);
            assert!(matches!(answer, Answer::Taken), "{}: {answer:?}", file.display());
        }
    }
}
