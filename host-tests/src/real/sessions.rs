//! Which files make which session.

use std::path::{Path, PathBuf};

use omni_gap::error::Result;
use omni_gap::known_effects;
use omni_gap::log::Session;

/// A session made of real recordings.
#[derive(Clone, Copy, Debug)]
pub struct RealSession {
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
    /// What a person thinks of the answer. The first line says of which answer: [`judged`].
    pub judgement: &'static str,
}

/// One run every 45 degrees of travel.
const EVERY_45_DEGREES: &[&str] =
    &["exp00.csv", "exp09.csv", "exp18.csv", "exp27.csv", "exp36.csv", "exp45.csv", "exp54.csv", "exp63.csv"];

/// All sessions.
pub const SESSIONS: [RealSession; 5] = [
    RealSession {
        title: "Robotino on a table",
        recorded: "three wheels, a drive that controls speed, 0.1 m/s on a hard table, 8 runs, one every 45 degrees",
        example: "robotino",
        folder: "robotino/table",
        files: EVERY_45_DEGREES,
        judgement: include_str!("../../golden/real-judgement/robotino-table.md"),
    },
    RealSession {
        title: "Robotino on carpet, slow",
        recorded: "the same robot at 0.1 m/s on grey carpet, 8 runs, one every 45 degrees",
        example: "robotino",
        folder: "robotino/gray_0.1",
        files: EVERY_45_DEGREES,
        judgement: include_str!("../../golden/real-judgement/robotino-carpet-slow.md"),
    },
    RealSession {
        title: "Robotino on carpet, fast",
        recorded: "the same robot at 0.3 m/s on grey carpet, 12 runs, one every 30 degrees",
        example: "robotino",
        folder: "robotino/gray_0.3",
        files: &[
            "exp144.csv",
            "exp150.csv",
            "exp156.csv",
            "exp162.csv",
            "exp168.csv",
            "exp174.csv",
            "exp180.csv",
            "exp186.csv",
            "exp192.csv",
            "exp198.csv",
            "exp204.csv",
            "exp210.csv",
        ],
        judgement: include_str!("../../golden/real-judgement/robotino-carpet-fast.md"),
    },
    RealSession {
        title: "Robotino with its wheels lifted",
        recorded: "the same robot on a stand, set speeds in stairs, 3 runs, no camera",
        example: "robotino",
        folder: "robotino/motors",
        files: &[
            "data_for_identification_with_integral.csv",
            "data_for_identification_without_integral.csv",
            "validation_data.csv",
        ],
        judgement: include_str!("../../golden/real-judgement/robotino-motors.md"),
    },
    RealSession {
        title: "RoboJackets 2018",
        recorded: "four wheels, brushless motors driven by open-loop duty, 3 runs, wheel speeds only",
        example: "ssl2018",
        folder: "ssl2018",
        files: &["excite_1", "excite_2", "excite_3_vely"],
        judgement: include_str!("../../golden/real-judgement/ssl2018.md"),
    },
];

impl RealSession {
    /// Reads it from a folder of recordings.
    ///
    /// # Errors
    /// Where a file is not there or not sound.
    pub fn session(&self, recordings: &Path) -> Result<Session> {
        let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(self.example);
        let runs: Vec<PathBuf> = self.files.iter().map(|file| recordings.join(self.folder).join(file)).collect();
        let (robot, columns) = (example.join("robot.toml"), example.join("columns.toml"));
        Session::load_from(&robot, Some(&columns), &runs, &known_effects())
    }
}

/// A judgement taken apart: the answer that it speaks of, and what it says.
///
/// The answer stands on the first line, after `Judged:`, as [`answer`](super::page::answer) puts it.
pub fn judged(judgement: &str) -> (&str, &str) {
    let (first, rest) = judgement.split_once('\n').unwrap_or((judgement, ""));
    (first.strip_prefix("Judged:").unwrap_or("").trim(), rest.trim())
}

#[test]
fn every_judgement_says_of_which_answer_it_speaks() {
    for real in SESSIONS {
        let (answer, text) = judged(real.judgement);
        assert!(!answer.is_empty() && !text.is_empty(), "{}", real.title);
    }
    assert_eq!(judged("Judged: effect: creep\n\nYes.\n"), ("effect: creep", "Yes."));
}
