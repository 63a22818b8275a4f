//! # Steps: every check there is, in order
//!
//! A check is one entry of [`STEPS`]. They run one after the other, each announced with its exact command, and the first
//! failure ends the run: what takes seconds stands before what takes minutes.

use std::time::{Duration, Instant};

use crate::line::Line;
use crate::wheel;

/// One check.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// What it looks at, in a word or two.
    pub name: &'static str,
    /// Its command.
    pub command: &'static str,
    /// The variables that the command needs.
    pub env: &'static [(&'static str, &'static str)],
}

/// The images for the emulator.
pub const EMULATED_IMAGES: &str =
    "cargo build --profile firmware -p firmware --bins --features emulated --target thumbv7em-none-eabihf";

/// The image for the board. In a folder of its own: it has the name of the emulator's.
pub const BOARD_IMAGE: &str = "cargo build --profile firmware -p firmware --bin firmware --features f405 \
                               --target thumbv7em-none-eabihf --target-dir target/f405";

/// The image of the board, checked: sizes, symbols, reach, stack.
pub const CHECK_IMAGE: &str =
    "cargo run -p host-tests --bin image -- target/f405/thumbv7em-none-eabihf/firmware/firmware";

/// The tests for a board, compiled: their runner is a probe, and the model of the chip.
pub const BOARD_TESTS: &str = "cargo test --no-run --profile firmware -p firmware --test hil --test hil_parity --test by_hand \
                               --features f405 --target thumbv7em-none-eabihf --target-dir target/f405";

/// The image of the board, executed on a model of its chip.
pub const CHIP: &str = "cargo run -p chip --bin chip -- target/f405/thumbv7em-none-eabihf/firmware/firmware \
                        target/f405/thumbv7em-none-eabihf/firmware/deps";

/// All programs, with the features that the tests are built with: after them, little is left to build.
const PROGRAMS: &str = "cargo build --workspace --bins --test walls";

/// Bits and instructions, told by two images.
pub const EMULATE: &str = "cargo run -p host-tests --bin emulated -- target/thumbv7em-none-eabihf/firmware";

/// What a person types on the first morning, and the robot without a board that it is typed at.
pub const MORNING: [&str; 2] = [
    "cargo build -p omni-gap -p host-tests --bin omni-gap --bin robot",
    "cargo run -p host-tests --bin morning -- target/thumbv7em-none-eabihf/firmware/firmware",
];

/// The image in the loop: how it drives, what it does about faults, and the loop closed on the gap.
pub const IN_LOOP: [&str; 3] = [
    "cargo run -p host-tests --bin pil -- target/thumbv7em-none-eabihf/firmware/firmware",
    "cargo run -p host-tests --bin faults -- target/thumbv7em-none-eabihf/firmware/firmware",
    "cargo run -p host-tests --bin gap -- target/thumbv7em-none-eabihf/firmware/firmware",
];

/// The last of these for two of its effects: all of them take some ten minutes.
const GAP: &str =
    "cargo run -p host-tests --bin gap -- target/thumbv7em-none-eabihf/firmware/firmware coriolis dead_time";

/// The image on a slow processor.
pub const MARGIN: &str =
    "cargo run --release -p host-tests --bin margin -- target/thumbv7em-none-eabihf/firmware/firmware";

/// Many seeds in software, a modern robot among them, and some rides of it in the image.
pub const MODERN: &str =
    "cargo run --release -p host-tests --bin modern -- target/thumbv7em-none-eabihf/firmware/firmware";

/// A robot without a board: the image on a network address.
pub const ROBOT: &str =
    "cargo run --release -p host-tests --bin robot -- target/thumbv7em-none-eabihf/firmware/firmware";

/// All checks. Tests on the source tree itself (the walls between the rooms) are tests like any other.
pub const STEPS: &[Step] = &[
    Step { name: "format", command: "cargo fmt --all --check", env: &[] },
    Step { name: "lints", command: "cargo clippy --workspace --all-targets -- -D warnings", env: &[] },
    Step {
        name: "lints, emulated",
        command: "cargo clippy -p firmware --bins --features emulated --target thumbv7em-none-eabihf -- -D warnings",
        env: &[],
    },
    Step {
        name: "lints, board",
        command: "cargo clippy -p firmware --bins --test hil --test hil_parity --test by_hand --features f405 \
                  --target thumbv7em-none-eabihf -- -D warnings",
        env: &[],
    },
    Step { name: "docs", command: "cargo doc --workspace --no-deps", env: &[("RUSTDOCFLAGS", "-D warnings")] },
    Step { name: "tests", command: "cargo test --workspace", env: &[] },
    Step { name: "programs", command: PROGRAMS, env: &[] },
    Step { name: "python", command: "cargo xtask python smoke", env: &[] },
    Step { name: "cluster", command: "cargo xtask cluster smoke", env: &[] },
    Step { name: "withheld", command: "cargo run -p host-tests --bin bench -- check", env: &[] },
    Step { name: "notebooks", command: "cargo xtask notebooks", env: &[] },
    Step { name: "emulated images", command: EMULATED_IMAGES, env: &[] },
    Step { name: "board image", command: BOARD_IMAGE, env: &[] },
    Step { name: "board tests", command: BOARD_TESTS, env: &[] },
    Step { name: "image", command: CHECK_IMAGE, env: &[] },
    Step { name: "chip", command: CHIP, env: &[] },
    Step { name: "emulator", command: EMULATE, env: &[] },
    Step { name: "in the loop", command: IN_LOOP[0], env: &[] },
    Step { name: "faults", command: IN_LOOP[1], env: &[] },
    Step { name: "gap", command: GAP, env: &[] },
    Step { name: "morning", command: MORNING[1], env: &[] },
];

impl Step {
    fn line(&self) -> Line {
        let line = as_built(self.command).unwrap_or_else(|| Line::of(self.command));
        self.env.iter().fold(line, |line, (name, value)| line.env(name, value))
    }
}

/// The same program as [`PROGRAMS`] has built it. `cargo run -p` selects one package, whose dependencies have fewer
/// features than those of the whole workspace, and would compile all of them a second time.
fn as_built(command: &str) -> Option<Line> {
    let (_, program) = command.strip_prefix("cargo run -p ")?.split_once(" --bin ")?;
    let (name, arguments) = program.split_once(" -- ")?;
    Some(arguments.split(' ').fold(Line::of("").word(wheel::built().join("debug").join(name)), Line::word))
}

/// What a run came to.
#[derive(Debug)]
pub struct Outcome {
    /// The steps that ran, in order, with the time that each took; the last one is the failed one, if any.
    pub times: Vec<(&'static str, Duration)>,
    /// The command of the step that failed.
    pub failed: Option<String>,
}

/// Runs the steps with `run`, up to the first that fails.
pub fn run(steps: &[Step], run: impl Fn(&Line) -> bool) -> Outcome {
    let mut times = Vec::new();
    for (k, step) in steps.iter().enumerate() {
        let line = step.line();
        println!("[{}/{}] {}: {}", k + 1, steps.len(), step.name, line.shown());
        let start = Instant::now();
        let passed = run(&line);
        times.push((step.name, start.elapsed()));
        if !passed {
            return Outcome { times, failed: Some(line.shown()) };
        }
    }
    Outcome { times, failed: None }
}

impl Outcome {
    /// The time of each step, then what to do about a failure, then the count.
    pub fn summary(&self) -> String {
        let failed = usize::from(self.failed.is_some());
        let mut text = String::new();
        for (name, time) in &self.times {
            text += &format!("{name:>15} {:8.1} s\n", time.as_secs_f64());
        }
        if let Some(command) = &self.failed {
            text += &format!("to run the failed step again: {command}\n");
        }
        text + &format!("{} passed, {failed} failed", self.times.len() - failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO_OF_THREE: &[Step] = &[
        Step { name: "first", command: "a", env: &[] },
        Step { name: "second", command: "b --all", env: &[("X", "1 2")] },
        Step { name: "third", command: "c", env: &[] },
    ];

    #[test]
    fn the_first_failure_ends_the_run_and_names_its_command() {
        let outcome = run(TWO_OF_THREE, |line| !line.shown().contains("--all"));
        assert_eq!(outcome.times.len(), 2, "the third step must not run");
        let told = outcome.summary();
        assert!(told.contains("to run the failed step again: X='1 2' b --all\n"), "{told}");
        assert!(told.ends_with("\n1 passed, 1 failed"), "{told}");
    }

    #[test]
    fn success_ends_in_the_count_and_times_every_step() {
        let told = run(TWO_OF_THREE, |_| true).summary();
        assert_eq!(told.lines().last(), Some("3 passed, 0 failed"));
        assert_eq!(told.lines().count(), 4, "{told}");
    }

    #[test]
    fn no_program_is_compiled_a_second_time() {
        let shown: Vec<String> = STEPS.iter().map(|step| step.line().shown()).collect();
        assert!(!shown.iter().any(|line| line.starts_with("cargo run -p")), "{shown:?}");
        assert!(!shown.iter().any(|line| line.contains("--release")), "{shown:?}");
        let place = |of: &str| shown.iter().position(|line| line.starts_with(of)).expect(of);
        assert!(place(PROGRAMS) < place("target/debug/"), "{shown:?}");
        assert_eq!(
            shown.last().map(String::as_str),
            Some("target/debug/morning target/thumbv7em-none-eabihf/firmware/firmware")
        );
    }

    #[test]
    fn warnings_of_the_docs_are_errors() {
        let shown: Vec<String> = STEPS.iter().map(|step| step.line().shown()).collect();
        assert!(shown.contains(&"RUSTDOCFLAGS='-D warnings' cargo doc --workspace --no-deps".into()), "{shown:?}");
    }
}
