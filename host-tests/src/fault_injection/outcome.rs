//! What a fault led to, beside what is promised.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use super::process::{Asked, Ended};
use super::scene::Scene;
use super::whole::amiss;

/// Exit code for what cannot be used.
const BAD_INPUT: i32 = 2;

/// What came of a fault.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What was asked, as a person types it.
    pub command: String,
    /// What happened, for the page.
    pub happens: String,
    /// The most memory \[MB\]; none where nothing ran.
    pub megabytes: Option<f64>,
    /// How long it took \[s\]; none where nothing ran.
    pub seconds: Option<f64>,
    /// Promises that were not kept.
    pub broken: Vec<String>,
}

impl Outcome {
    /// Of a fault that this machine does not let happen.
    pub fn not_staged(why: &str) -> Self {
        let happens = format!("not staged here: {why}");
        Self { command: "–".to_owned(), happens, megabytes: None, seconds: None, broken: Vec::new() }
    }

    /// Of one run, or of several that came to the same end.
    pub fn of(scene: &Scene, asked: &Asked, ended: &Ended, broken: Vec<String>) -> Self {
        let how = match (ended.code, ended.signal) {
            (Some(code), _) => format!("exit code {code}"),
            (None, signal) => format!("ended by signal {}", signal.unwrap_or_default()),
        };
        let said = if ended.code == Some(0) { &ended.out } else { &ended.err };
        let said = scene.shortened(said);
        let said = said.strip_prefix("omni-gap: ").unwrap_or(&said).trim();
        let first = said.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
        Self {
            command: scene.shortened(&asked.typed()),
            happens: format!("{how}: {first}"),
            megabytes: ended.megabytes,
            seconds: Some(ended.seconds),
            broken: broken.iter().map(|promise| scene.shortened(promise)).collect(),
        }
    }

    /// The same, with what a person should know beside it.
    pub fn noting(mut self, note: &str) -> Self {
        self.happens += &format!(" ({note})");
        self
    }

    /// The same, with a promise that holds or not.
    pub fn promising(mut self, holds: bool, promise: &str) -> Self {
        if !holds {
            self.broken.push(promise.to_owned());
        }
        self
    }
}

/// Runs a command that has to refuse: exit code 2, one message with all of `says` in it, everything as it was.
///
/// # Errors
/// Where it cannot be run.
pub fn refused(scene: &Scene, asked: &Asked, says: &[&str]) -> io::Result<Outcome> {
    let before = scene.all();
    let outcome = refused_on_the_way(scene, asked, says)?;
    let after = scene.all();
    let changed: Vec<&PathBuf> = before.symmetric_difference(&after).collect();
    Ok(outcome.promising(changed.is_empty(), &format!("everything is as it was, but for {changed:?}")))
}

/// As [`refused`], of work that keeps what it has done so far.
///
/// # Errors
/// Where it cannot be run.
pub fn refused_on_the_way(scene: &Scene, asked: &Asked, says: &[&str]) -> io::Result<Outcome> {
    Ok(refusal(scene, asked, &asked.run()?, says))
}

/// What came of a run that had to end with exit code 2 and one message with all of `says` in it.
pub fn refusal(scene: &Scene, asked: &Asked, ended: &Ended, says: &[&str]) -> Outcome {
    let mut broken = unkept(ended);
    if ended.code != Some(BAD_INPUT) {
        broken.push(format!("exit code {:?}, expected {BAD_INPUT}", ended.code));
    }
    if ended.err.trim_end().lines().count() != 1 {
        broken.push(format!("expected one message: {:?}", ended.err));
    }
    let unsaid = says.iter().filter(|part| !ended.err.contains(**part));
    broken.extend(unsaid.map(|part| format!("{part:?} is not said in {:?}", ended.err)));
    Outcome::of(scene, asked, ended, broken)
}

/// Runs a command that has to do what is asked in spite of all: exit code 0, no complaint, and whatever is new is whole.
///
/// # Errors
/// Where it cannot be run.
pub fn answered(scene: &Scene, asked: &Asked) -> io::Result<Outcome> {
    let before = scene.all();
    let ended = asked.run()?;
    let mut broken = unkept(&ended);
    if ended.code != Some(0) || !ended.err.is_empty() {
        broken.push(format!("exit code {:?}, expected 0 and no complaint: {:?}", ended.code, ended.err));
    }
    broken.extend(half_written(&scene.all(), &before));
    Ok(Outcome::of(scene, asked, &ended, broken))
}

/// What holds of every run, whatever it is asked.
pub fn unkept(ended: &Ended) -> Vec<String> {
    let cries = ["panicked", "backtrace", "overflowed", "memory allocation"];
    let cried = cries.iter().filter(|cry| ended.err.contains(**cry)).map(|cry| format!("{cry}: {:?}", ended.err));
    let signal = ended.signal.map(|signal| format!("signal {signal} ended it"));
    cried.chain(signal).chain(ended.stopped.map(str::to_owned)).collect()
}

/// What is half-written of what is new.
pub fn half_written(now: &BTreeSet<PathBuf>, before: &BTreeSet<PathBuf>) -> Vec<String> {
    now.difference(before).filter_map(|path| amiss(path)).collect()
}

/// What is half-written in a folder.
pub fn half_written_in(folder: &Path) -> Vec<String> {
    let mut all = BTreeSet::new();
    super::scene::below(folder, &mut all);
    half_written(&all, &BTreeSet::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene whose program is the shell: it does what it is told.
    fn scene() -> Scene {
        Scene::new(Path::new("/bin/sh")).unwrap()
    }

    #[test]
    fn a_refusal_is_exit_code_2_one_message_and_nothing_else() {
        let refusal = |script: &str| {
            let scene = scene();
            refused(&scene, &scene.asked(&["-c", script]), &["why"]).unwrap().broken
        };
        assert_eq!(refusal("echo why >&2; exit 2"), [""; 0]);
        for not in [
            "echo why >&2",
            "echo why >&2; exit 101",
            "echo so >&2; exit 2",
            "echo why >&2; echo again >&2; exit 2",
            "echo panicked: why >&2; exit 2",
            "echo why >&2; kill -9 $$",
        ] {
            assert!(!refusal(not).is_empty(), "{not}");
        }
        let scene = scene();
        let leaves = scene.asked(&["-c", "echo why >&2; touch left; exit 2"]);
        assert_eq!(refused(&scene, &leaves, &["why"]).unwrap().broken.len(), 1);
    }

    #[test]
    fn an_answer_is_exit_code_0_no_complaint_and_whole_files() {
        let answer = |script: &str| {
            let scene = scene();
            answered(&scene, &scene.asked(&["-c", script])).unwrap().broken
        };
        assert_eq!(answer("echo '{}' > a.json"), [""; 0]);
        for not in ["exit 2", "echo careful >&2", "echo '{' > a.json", "touch .omni-gap-1", "kill -9 $$"] {
            assert!(!answer(not).is_empty(), "{not}");
        }
    }

    #[test]
    fn what_takes_too_much_memory_is_stopped() {
        let scene = scene();
        let asked = scene.asked(&["-c", "exec tail /dev/zero"]).within(50.0);
        let broken = answered(&scene, &asked).unwrap().broken;
        assert!(broken.iter().any(|why| why.contains("too much memory")), "{broken:?}");
    }
}
