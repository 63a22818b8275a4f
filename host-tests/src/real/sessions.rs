//! Which files make which session.

use std::path::{Path, PathBuf};

use omni_gap::engine::Findings;
use omni_gap::error::Result;
use omni_gap::log::Session;
use omni_gap::report::{About, Fault};
use omni_gap::{Diagnosis, Error, Options, Report, known_effects};

mod list;
pub use list::SESSIONS;

/// A session made of real recordings.
#[derive(Clone, Copy, Debug)]
pub struct RealSession {
    /// Its name for programs: that of its file in `known/`.
    pub key: &'static str,
    /// Its name.
    pub title: &'static str,
    /// What was recorded, in a line.
    pub recorded: &'static str,
    /// The folder in `examples/` with its robot file and its mapping.
    pub example: &'static str,
    /// The folder of the recordings.
    pub folder: &'static str,
    /// The recordings, in the order of the session's runs.
    pub files: &'static [&'static str],
    /// What another clock recorded of each run, from the same folder: a run is then a folder of two files. Or nothing.
    pub beside: &'static [&'static str],
    /// What is known of it from elsewhere: a file that [`Known`](super::known::Known) reads.
    pub known: &'static str,
    /// What a person thinks of the answer. The first line says of which answer: [`judged`].
    pub judgement: &'static str,
}

/// An answer to a session.
#[derive(Clone, Debug)]
pub struct Answered {
    /// The report.
    pub report: Report,
    /// The robot file with the causes written in; none where none was named.
    pub corrected_robot: Option<String>,
}

impl RealSession {
    /// Diagnoses it from a folder of recordings. Recordings that cannot be read are answered as a person sees it who is told
    /// why: the verdict is `unfit_data`.
    ///
    /// # Errors
    /// Where a file is not there.
    pub fn answered(&self, recordings: &Path) -> Result<Answered> {
        let folder = recordings.join(self.folder);
        let runs: Vec<PathBuf> = self.files.iter().map(|file| folder.join(file)).collect();
        let beside: Vec<PathBuf> = self.beside.iter().map(|file| folder.join(file)).collect();
        if let Some(missing) = runs.iter().chain(&beside).find(|path| !path.is_file()) {
            return Err(Error::input(missing, "there is no such recording", "Name the folder that holds it"));
        }
        let not_written =
            |why: std::io::Error| Error::output(&std::env::temp_dir(), why.to_string(), "Make room there");
        let together = tempfile::tempdir().map_err(not_written)?;
        let (read_from, runs) = match beside.is_empty() {
            true => (recordings, runs),
            false => (together.path(), laid_together(together.path(), &runs, &beside).map_err(not_written)?),
        };
        let answered = match self.session(&runs) {
            Ok(session) => {
                let Diagnosis { report, corrected_robot, .. } = Diagnosis::of(&session, &Options::default());
                Answered { report, corrected_robot }
            }
            Err(why) => Answered { report: refused(&why), corrected_robot: None },
        };
        Ok(Answered { report: without_place(answered.report, read_from), ..answered })
    }

    fn session(&self, runs: &[PathBuf]) -> Result<Session> {
        let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(self.example);
        let (robot, columns) = (example.join("robot.toml"), example.join("columns.toml"));
        Session::load_from(&robot, Some(&columns), runs, &known_effects())
    }
}

/// A folder for each run with its files in it.
fn laid_together(into: &Path, runs: &[PathBuf], beside: &[PathBuf]) -> std::io::Result<Vec<PathBuf>> {
    let mut folders = Vec::new();
    for files in runs.iter().zip(beside) {
        let folder = into.join(files.0.file_stem().unwrap_or_default());
        std::fs::create_dir(&folder)?;
        for file in [files.0, files.1] {
            std::fs::copy(file, folder.join(file.file_name().unwrap_or_default()))?;
        }
        folders.push(folder);
    }
    Ok(folders)
}

/// What a person is told of recordings that cannot be read.
fn refused(why: &Error) -> Report {
    let (Error::Input { fix, .. } | Error::Faulty { fix, .. } | Error::Output { fix, .. }) = why;
    let said = why.to_string();
    let what = said.strip_suffix(fix.as_str()).unwrap_or(&said).trim_end_matches(['.', ' ']).to_owned();
    let fault = Fault { code: "not_read".to_owned(), what, fix: fix.clone(), ..Fault::default() };
    Report::of(&Findings::unfit(), About { faults: vec![fault], ..About::default() })
}

/// The same without where the recordings lie on this machine, which is nobody's business.
fn without_place(mut report: Report, recordings: &Path) -> Report {
    let place = format!("{}/", recordings.display());
    let faults = report.faults.iter_mut().flat_map(|fault| [Some(&mut fault.what), fault.file.as_mut()]);
    report.notices.iter_mut().chain(faults.flatten()).for_each(|said| *said = said.replace(&place, ""));
    report
}

/// A judgement taken apart: the answer that it speaks of, and what it says.
///
/// The answer stands on the first line, after `Judged:`, as [`answer`](super::page::answer) puts it.
pub fn judged(judgement: &str) -> (&str, &str) {
    let (first, rest) = judgement.split_once('\n').unwrap_or((judgement, ""));
    (first.strip_prefix("Judged:").unwrap_or("").trim(), rest.trim())
}

#[cfg(test)]
mod tests {
    use omni_gap::Verdict;

    use super::*;

    #[test]
    fn every_judgement_says_of_which_answer_it_speaks() {
        for real in SESSIONS {
            let (answer, text) = judged(real.judgement);
            assert!(!answer.is_empty() && !text.is_empty(), "{}", real.title);
        }
        assert_eq!(judged("Judged: effect: creep\n\nYes.\n"), ("effect: creep", "Yes."));
    }

    #[test]
    fn a_run_has_one_file_beside_it_or_none_has() {
        for real in SESSIONS {
            assert!(real.beside.is_empty() || real.beside.len() == real.files.len(), "{}", real.title);
        }
    }

    #[test]
    fn a_recording_that_is_not_there_is_told_and_one_that_cannot_be_read_is_an_answer() {
        let folder = tempfile::tempdir().unwrap();
        let real = SESSIONS.iter().find(|real| real.key == "kiwi2026-exp7").unwrap();
        let told = real.answered(folder.path()).unwrap_err().to_string();
        assert!(told.contains("exp7.txt") && told.contains("no such recording"), "{told}");

        let runs = folder.path().join(real.folder);
        std::fs::create_dir_all(&runs).unwrap();
        let rows = "t, w1, w2, w3, u1, u2, u3\n0.01, 0, 0, 0, 1, 1, 1\n0.01, 0, 0, 0, 1, 1, 1\n";
        std::fs::write(runs.join(real.files[0]), rows).unwrap();
        let report = real.answered(folder.path()).unwrap().report;
        let said = &report.faults[0].what;
        assert_eq!(report.verdict, Verdict::UnfitData);
        assert!(said.contains("repeated time") && !said.contains(&*folder.path().to_string_lossy()), "{said}");
        assert!(report.faults[0].fix.starts_with("Sort the rows") && !said.contains("Sort"), "{said}");
    }
}
