//! A folder to work in, a small session in it, and the command.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use omni_gap::known_effects;
use omni_gap::log::write_session;
use omni_gap::synthesize::{Scenario, synthesize};

/// The robot of all tests here.
pub const ROBOT: &str = include_str!("../../robots/feup-4w/robot.toml");

/// A folder that goes away with the test.
pub struct Bench(tempfile::TempDir);

/// What the command said and how it ended.
pub struct Said {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl From<Output> for Said {
    fn from(output: Output) -> Said {
        let text = |bytes| String::from_utf8(bytes).expect("the command speaks UTF-8");
        Said { code: output.status.code().expect("it ended"), out: text(output.stdout), err: text(output.stderr) }
    }
}

impl Bench {
    /// An empty folder.
    pub fn empty() -> Bench {
        Bench(tempfile::tempdir().expect("a folder"))
    }

    /// A folder with a small session in `session`.
    pub fn with_session() -> Bench {
        let bench = Bench::empty();
        let plan = Scenario { runs: 3, duration: 2.0, rate: 100.0, ..Scenario::default() };
        let staged = synthesize(ROBOT, &plan, &known_effects()).expect("a sound stage");
        write_session(&bench.at("session"), &staged.robot_text, &staged.runs).expect("room for a session");
        bench
    }

    /// A path in the folder.
    pub fn at(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    /// The text of a file.
    pub fn read(&self, path: &str) -> String {
        std::fs::read_to_string(self.at(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
    }

    /// Writes a file and the folders above it.
    pub fn write(&self, path: &str, text: &str) {
        let path = self.at(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// Changes the text of a file, which must hold what is to be replaced.
    pub fn change(&self, path: &str, from: &str, to: &str) {
        let text = self.read(path);
        assert!(text.contains(from), "{path} lacks {from}");
        self.write(path, &text.replacen(from, to, 1));
    }

    /// Changes one field of a run: line from 1, column by name.
    pub fn set_field(&self, path: &str, line: usize, column: &str, to: &str) {
        let text = self.read(path);
        let at = text.lines().next().unwrap().split(',').position(|name| name == column).expect("the column");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut fields: Vec<&str> = lines[line - 1].split(',').collect();
        fields[at] = to;
        lines[line - 1] = fields.join(",");
        self.write(path, &(lines.join("\n") + "\n"));
    }

    /// Every file and folder, by path.
    pub fn all(&self) -> Vec<String> {
        let mut found = Vec::new();
        below(self.0.path(), &mut found);
        found.sort();
        found
    }

    /// The command, to be run in the folder.
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_omni-gap"));
        command.args(args).current_dir(self.0.path());
        command
    }

    /// Runs it.
    pub fn run(&self, args: &[&str]) -> Said {
        self.command(args).output().expect("the command starts").into()
    }

    /// Runs it, and it must do what was asked.
    pub fn done(&self, args: &[&str]) -> Said {
        let said = self.run(args);
        assert_eq!(said.code, 0, "{args:?}: {}", said.err);
        said
    }
}

/// The command refuses, says all of this in one message, and leaves the folder as it was.
#[track_caller]
pub fn refused(bench: &Bench, args: &[&str], says: &[&str]) {
    let before = bench.all();
    let said = bench.run(args);
    assert_eq!(said.code, 2, "{args:?} said {}{}", said.out, said.err);
    assert_eq!(said.out, "");
    assert_eq!(said.err.trim_end().lines().count(), 1, "one message: {}", said.err);
    for part in says {
        assert!(said.err.contains(part), "{args:?}: {part:?} is not in {:?}", said.err);
    }
    assert_eq!(bench.all(), before, "{args:?} left something behind");
}

fn below(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        found.push(path.display().to_string());
        if path.is_dir() {
            below(&path, found);
        }
    }
}

/// A run as columns of fields: the header, then the rows.
pub fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().unwrap_or_default(), lines.collect())
}
