//! # Doors: everything that reads bytes which somebody else wrote
//!
//! A door is one reader, given nothing but bytes. Whatever they are, it answers or refuses, and says why in one message;
//! it neither panics nor waits nor takes memory without end. `tests/replay.rs` holds every door to that with sound files,
//! each spoiled in some thousand ways, and with whatever once broke one (`regressions/`); the programs in `fuzz/` look for
//! more with a fuzzer that is led by what code the bytes reach.

mod answer;
mod files;
mod seeds;
mod wire;

pub use answer::Answer;
pub use seeds::seeds;

/// One reader.
#[derive(Clone, Copy, Debug)]
pub struct Door {
    /// Its name, which is that of its program in `fuzz/`.
    pub name: &'static str,
    /// What is told of bytes.
    pub open: fn(&[u8]) -> Answer,
}

/// All of them.
pub const DOORS: &[Door] = &[
    Door { name: "robot", open: files::robot },
    Door { name: "columns", open: files::columns },
    Door { name: "csv", open: files::csv },
    Door { name: "parquet", open: files::parquet },
    Door { name: "mcap", open: files::mcap },
    Door { name: "bag", open: files::bag },
    Door { name: "sqlite", open: files::sqlite },
    Door { name: "vision", open: files::vision },
    Door { name: "records", open: files::records },
    Door { name: "payloads", open: files::payloads },
    Door { name: "fleet", open: files::fleet },
    Door { name: "frames", open: wire::frames },
    Door { name: "block", open: wire::block },
];

impl Door {
    /// The one with this name.
    ///
    /// # Panics
    /// Where there is none.
    pub fn named(name: &str) -> &'static Door {
        DOORS.iter().find(|door| door.name == name).unwrap_or_else(|| panic!("there is no door {name}"))
    }

    /// Opens it with bytes, and holds a refusal to what a person can use: words, in one line.
    ///
    /// # Panics
    /// Where a refusal says nothing, or more than a screen holds.
    pub fn check(&self, bytes: &[u8]) -> Answer {
        let answer = (self.open)(bytes);
        if let Answer::Refused(why) = &answer {
            assert!(why.trim().len() > 10 && why.chars().count() < MOST_SAID, "{}: {why:?}", self.name);
            assert!(!why.chars().any(char::is_control), "{}: {why:?}", self.name);
        }
        answer
    }
}

/// Characters that a refusal has at the most.
const MOST_SAID: usize = 1500;
