//! A contestant: any command that takes a session folder and leaves a report.

use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use omni_gap::error::{Error, Result};
use rustix::process::{Pid, Signal, kill_process_group};
use serde::{Deserialize, Serialize};

use super::answer::Answer;
use super::set::{SetFolder, read, write};
use super::watch::Watch;
use crate::memory::peak_memory;

/// Who answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contestant {
    /// As the table calls it.
    pub name: String,
    /// Its command, in which `{session}` and `{out}` stand for the folders.
    pub command: Vec<String>,
    /// How long a session may take.
    pub most: Duration,
}

/// How a session ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ended {
    /// Why there is no answer to score; none where there is one.
    pub failed: Option<String>,
    /// How long it took [s]
    pub seconds: f64,
    /// The most memory that the command held, as far as was seen [MB]
    pub megabytes: f64,
}

/// Files of an answer that are kept.
const KEPT: [&str; 3] = ["report.json", "corrected_robot.toml", "refitted_robot.toml"];

/// What the scorer finds of an answer, beside it.
pub(super) const CLOSED: &str = "closed.json";

/// How often a command is looked at.
const LOOK: Duration = Duration::from_millis(10);

impl Contestant {
    /// Answers all sessions that it has not answered yet. Tells each as it ends.
    ///
    /// # Errors
    /// Where the set cannot be read, or an answer not be written; never for what the contestant does.
    pub fn run(&self, set: &SetFolder, sessions: &[String], told: &mut dyn FnMut(&str, &Ended)) -> Result<()> {
        // two at once would be seen to look at each other's sessions
        let _alone = set.alone()?;
        for session in sessions {
            let kept = set.answers(&self.name).join(session);
            if kept.join("ended.json").is_file() {
                continue;
            }
            std::fs::create_dir_all(&kept).map_err(|why| Error::output(&kept, why.to_string(), "Make room"))?;
            // what was found of an answer that stood here before
            std::fs::remove_file(kept.join(CLOSED)).ok();
            let ended = self.answers(set, session, &kept).map_err(|why| {
                Error::input(
                    &set.session(session),
                    why.to_string(),
                    "Look at the folder of the set and at the room in the temporary one",
                )
            })?;
            write(&kept.join("ended.json"), &ended)?;
            told(session, &ended);
        }
        Ok(())
    }

    /// One session, copied to where nothing else is.
    fn answers(&self, set: &SetFolder, session: &str, kept: &Path) -> std::io::Result<Ended> {
        let place = tempfile::tempdir()?;
        let (given, out) = (place.path().join("session"), place.path().join("out"));
        copy(&set.session(session), &given)?;
        std::fs::create_dir(&out)?;
        let watch = Watch::over(&forbidden(set)?)?;
        let start = Instant::now();
        let (how, megabytes) = self.ran(&given, &out);
        let seconds = start.elapsed().as_secs_f64();
        let looked = watch.opened()?;
        for file in KEPT {
            if out.join(file).is_file() {
                std::fs::copy(out.join(file), kept.join(file))?;
            }
        }
        let failed = match (looked, how) {
            (Some(place), _) => {
                Some(format!("it looked at {}", place.strip_prefix(&set.0).unwrap_or(&place).display()))
            }
            (None, Err(why)) => Some(why),
            (None, Ok(())) => match std::fs::read_to_string(kept.join("report.json")) {
                Ok(text) => Answer::parse(&text).err(),
                Err(_) => Some("it left no report.json".to_owned()),
            },
        };
        Ok(Ended { failed, seconds, megabytes })
    }

    /// Runs the command to its end, or to the end of its time; and the most memory it held [MB].
    fn ran(&self, session: &Path, out: &Path) -> (std::result::Result<(), String>, f64) {
        let filled = |word: &String| {
            word.replace("{session}", &session.to_string_lossy()).replace("{out}", &out.to_string_lossy())
        };
        let mut words = self.command.iter().map(filled);
        let Some(program) = words.next() else { return (Err("it has no command".to_owned()), 0.0) };
        let mut command = Command::new(&program);
        command.args(words).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).process_group(0);
        let mut child = match command.spawn() {
            Ok(child) => child,
            Err(why) => return (Err(format!("{program} could not be started: {why}")), 0.0),
        };
        let (start, mut megabytes) = (Instant::now(), 0.0);
        loop {
            megabytes = f64::max(megabytes, held(&child));
            match child.try_wait() {
                Ok(Some(status)) if status.success() => return (Ok(()), megabytes),
                Ok(Some(status)) => return (Err(format!("it ended with {status}")), megabytes),
                Ok(None) if start.elapsed() < self.most => std::thread::sleep(LOOK),
                Ok(None) => {
                    end(&mut child);
                    return (Err(format!("it was stopped after {} s", self.most.as_secs())), megabytes);
                }
                Err(why) => {
                    end(&mut child);
                    return (Err(why.to_string()), megabytes);
                }
            }
        }
    }

    /// How it ended with a session, if it was asked.
    pub fn ended(name: &str, set: &SetFolder, session: &str) -> Option<Ended> {
        read(&set.answers(name).join(session).join("ended.json"), "").ok()
    }
}

/// Everything of a set that no contestant may open while it answers.
fn forbidden(set: &SetFolder) -> std::io::Result<Vec<PathBuf>> {
    let mut all = vec![set.labels_folder(), set.sessions()];
    for entry in std::fs::read_dir(set.sessions())? {
        let session = entry?.path();
        let runs = session.join("runs");
        if runs.is_dir() {
            for run in std::fs::read_dir(&runs)? {
                all.push(run?.path());
            }
        }
        all.push(runs);
        all.push(session);
    }
    all.retain(|folder| folder.is_dir());
    Ok(all)
}

/// The command and all that it has started.
fn end(child: &mut Child) {
    if let Some(group) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) {
        // who is gone already needs no signal
        kill_process_group(group, Signal::KILL).ok();
    }
    child.wait().ok();
}

/// The most memory that a command has held so far, as the system tells [MB].
fn held(child: &Child) -> f64 {
    peak_memory(&child.id().to_string()).map_or(0.0, |bytes| bytes as f64 / f64::from(1 << 20))
}

fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::create_dir(to)?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &target)?;
        } else {
            std::fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}
