//! # Errands: what a developer can ask for
//!
//! An errand is one entry of [`ERRANDS`]; the list that `help` prints is the table itself.

use std::ffi::OsString;

use crate::line::Line;
use crate::python::Environment;
use crate::{browser, cluster, images, invented, mjcf, real, steps, tool, wheel};

/// One thing to ask for.
#[derive(Clone, Copy, Debug)]
pub struct Errand {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it takes, as `help` shows it: nothing, one argument, or any number of them where it ends in [`AND_MORE`].
    pub takes: &'static str,
    /// What it does, in a line.
    pub does: &'static str,
    run: fn(&[OsString]) -> Result<(), String>,
}

/// How what takes any number of arguments is shown.
const AND_MORE: &str = "...]";

/// All errands, in the order of `help`.
pub const ERRANDS: &[Errand] = &[
    Errand { name: "test", takes: "", does: "run every check there is, stop at the first failure", run: test },
    Errand { name: "bless", takes: "", does: "run the tests and rewrite the golden pages", run: bless },
    Errand {
        name: "bench",
        takes: "[make|run|score|table ...]",
        does: "the benchmark with the effect withheld (BENCHMARK.md); with nothing more, run the benches",
        run: bench,
    },
    Errand {
        name: "benchmark",
        takes: "",
        does: "diagnose every effect of the catalogue and rewrite the golden table",
        run: |_| page_of("catalogue"),
    },
    Errand {
        name: "medicine",
        takes: "",
        does: "diagnose what the simulator records of every effect, beside what the self-test foretells (BLESS=1: rewrite)",
        run: |_| page_of("medicine"),
    },
    Errand {
        name: "confusion",
        takes: "",
        does: "compute which cause would be taken for which, by robot and motion (BLESS=1: rewrite page and pictures)",
        run: |_| page_of("confusion"),
    },
    Errand {
        name: "fleet",
        takes: "[scale]",
        does: "what pooling finds in fleets with one weak effect and in healthy ones; scale: how fast 2,000 sessions are (BLESS=1: rewrite)",
        run: fleet,
    },
    Errand {
        name: "fault-injection",
        takes: "",
        does: "stage full disks, bombs, loops, changing files and kills around the command, and tell what it does (BLESS=1: record)",
        run: fault_injection,
    },
    Errand {
        name: "selftest",
        takes: "",
        does: "look in simulated recordings for the sizes that the self-test foretells (BLESS=1: rewrite)",
        run: |_| page_of("selftest"),
    },
    Errand {
        name: "laboratory",
        takes: "",
        does: "diagnose what a second simulator records of every cause and rewrite the golden table",
        run: |_| page_of("laboratory"),
    },
    Errand {
        name: "carried",
        takes: "",
        does: "identify robots whose files carry each effect with a wrong size (BLESS=1: rewrite)",
        run: |_| page_of("carried"),
    },
    Errand {
        name: "identification",
        takes: "",
        does: "identify robots whose truth is known by the thousand and rewrite the golden page (most of an hour)",
        run: |_| page_of("identification"),
    },
    Errand {
        name: "mujoco",
        takes: "",
        does: "time step and fit beside MuJoCo's, which it installs under target/ (BLESS=1: rewrite the golden page)",
        run: mujoco,
    },
    Errand {
        name: "mjcf",
        takes: "",
        does: "play exported models in MuJoCo, which it installs under target/, beside the product's own simulator",
        run: in_mujoco,
    },
    Errand {
        name: "python",
        takes: "[smoke]",
        does: "build sdist and wheel of the Python package, test them, time steps beside MuJoCo's (BLESS=1: rewrite the page)",
        run: wheel::perform,
    },
    Errand {
        name: "cluster",
        takes: "[smoke]",
        does: "answer 2,000 sessions on a cluster that loses a node, and some in an object store (BLESS=1: rewrite the page)",
        run: cluster::perform,
    },
    Errand {
        name: "peers",
        takes: "",
        does: "install the peers that enter the benchmark beside us under target/, and test them",
        run: peers,
    },
    Errand {
        name: "pil",
        takes: "",
        does: "build the image and run it in QEMU in the loop with a robot: scenarios, faults, the gap (BLESS=1: rewrite)",
        run: images::pil,
    },
    Errand {
        name: "robot",
        takes: "[HOST:PORT|pty]",
        does: "a robot without a board at tcp:127.0.0.1:7000: the image in QEMU, with a virtual board; until Ctrl-C",
        run: images::robot,
    },
    Errand {
        name: "commission",
        takes: "",
        does: "commission motors of 48 wirings on 8 seeds over the link of the firmware's program (BLESS=1: rewrite)",
        run: |_| page_of("commission"),
    },
    Errand {
        name: "margin",
        takes: "",
        does: "play every ride and fault in QEMU with instructions 8 and 16 times as slow (BLESS=1: rewrite)",
        run: images::margin,
    },
    Errand {
        name: "modern",
        takes: "",
        does: "ride a modern robot on 64 seeds (BLESS=1: rewrite)",
        run: images::modern,
    },
    Errand {
        name: "morning",
        takes: "",
        does: "type what HARDWARE.md has for the first morning, at the image in QEMU",
        run: images::morning,
    },
    Errand {
        name: "emulate",
        takes: "",
        does: "build the images and compare their bits and instructions (BLESS=1: rewrite)",
        run: images::emulate,
    },
    Errand {
        name: "image",
        takes: "",
        does: "build the board's image and check its sizes, symbols and stack (BLESS=1: rewrite)",
        run: images::image,
    },
    Errand {
        name: "chip",
        takes: "",
        does: "run the board's image on a model of its chip (BLESS=1: rewrite)",
        run: images::chip,
    },
    Errand {
        name: "fuzz",
        takes: "[SECONDS...]",
        does: "let a fuzzer look for bytes that break a reader, SECONDS each or 900, of doors named behind (BLESS=1: record)",
        run: fuzz,
    },
    Errand {
        name: "real",
        takes: "[FOLDER]",
        does: "diagnose the recordings of real robots in FOLDER (or in OMNI_GAP_DATA)",
        run: on_recordings,
    },
    Errand {
        name: "frozen",
        takes: "[FOLDER]",
        does: "compare whole reports with the frozen ones, with FOLDER real recordings' too (BLESS=1: freeze anew)",
        run: frozen,
    },
    Errand {
        name: "book",
        takes: "",
        does: "run the commands of every page of the book, and build it into target/book with an mdBook of its own",
        run: book,
    },
    Errand {
        name: "browser",
        takes: "[PAGE.html...]",
        does: "open every kind of page in Chromium, three widths, light and dark: charts, switches, accessibility",
        run: in_browser,
    },
    Errand {
        name: "invented",
        takes: "",
        does: "add an invented effect to a copy of the tree, test it there and print what it touches (long)",
        run: invented,
    },
    Errand { name: "help", takes: "", does: "print this list", run: help },
];

/// What the comparison with MuJoCo runs on.
const MUJOCO: Environment =
    Environment { folder: "target/mujoco-venv", requirements: "host-tests/mujoco/requirements.txt" };

/// What the benchmark's peers run on.
const PEERS: Environment =
    Environment { folder: "target/peers-venv", requirements: "host-tests/peers/requirements.txt" };

/// Why an errand was not done.
#[derive(Debug, PartialEq, Eq)]
pub enum ErrandError {
    /// It was asked for in the wrong way.
    Usage(String),
    /// It was tried and failed.
    Failed(String),
}

/// Does what the arguments ask for.
pub fn perform(arguments: impl IntoIterator<Item = OsString>) -> Result<(), ErrandError> {
    let (errand, arguments) = asked(arguments)?;
    (errand.run)(&arguments).map_err(ErrandError::Failed)
}

fn asked(arguments: impl IntoIterator<Item = OsString>) -> Result<(&'static Errand, Vec<OsString>), ErrandError> {
    let usage = |what: String| ErrandError::Usage(format!("{what}\n{}", list()));
    let mut arguments = arguments.into_iter();
    let name = arguments.next().ok_or_else(|| usage("no errand named".into()))?;
    let errand = ERRANDS.iter().find(|errand| name == errand.name);
    let errand = errand.ok_or_else(|| usage(format!("no errand is called {}", name.display())))?;
    let most = match errand.takes {
        "" => 0,
        takes if takes.ends_with(AND_MORE) => usize::MAX,
        _ => 1,
    };
    let given: Vec<OsString> = arguments.collect();
    match given.get(most) {
        Some(more) => Err(usage(format!("{} does not take {}", errand.name, more.display()))),
        None => Ok((errand, given)),
    }
}

/// One line an errand.
fn list() -> String {
    let line = |errand: &Errand| format!("  cargo xtask {:<16} {}", [errand.name, errand.takes].join(" "), errand.does);
    ERRANDS.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn test(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    let outcome = steps::run(steps::STEPS, Line::succeeds);
    if outcome.failed.is_some() {
        return Err(outcome.summary());
    }
    println!("{}", outcome.summary());
    Ok(())
}

fn bless(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    Line::of("cargo test --workspace").env("BLESS", "1").announced()?;
    println!("golden pages rewritten where they differed; read the difference before you commit it: git diff");
    Ok(())
}

fn bench(words: &[OsString]) -> Result<(), String> {
    if words.is_empty() {
        return Line::of("cargo bench -p host-tests").announced();
    }
    let line = Line::of("cargo run --release -p host-tests --bin bench --");
    words.iter().fold(line, Line::word).announced()
}

/// Runs the program that makes a page.
fn page_of(program: &str) -> Result<(), String> {
    Line::of("cargo run --release -p host-tests --bin").word(program).announced()
}

fn fleet(asked: &[OsString]) -> Result<(), String> {
    asked.iter().fold(Line::of("cargo run --release -p host-tests --bin fleet --"), Line::word).announced()
}

/// In the build of the tests: what overflows ends a program there.
fn fault_injection(_: &[OsString]) -> Result<(), String> {
    Line::of("cargo build --workspace --bin omni-gap --bin fault_injection --test walls").announced()?;
    Line::of("").word(wheel::built().join("debug/fault_injection")).announced()
}

fn mujoco(_: &[OsString]) -> Result<(), String> {
    let python = MUJOCO.ensure()?;
    Line::of("cargo run --release -p host-tests --bin mujoco --").word(python).announced()
}

fn in_mujoco(_: &[OsString]) -> Result<(), String> {
    mjcf::perform(&MUJOCO.ensure()?)
}

fn peers(_: &[OsString]) -> Result<(), String> {
    let python = PEERS.ensure()?;
    Line::of("cargo build --release -p omni-gap").announced()?;
    let tests = "-m pytest host-tests/peers".split(' ');
    tests.fold(Line::of("").word(python), Line::word).env("PYTHONPATH", "host-tests").announced()
}

fn fuzz(words: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::FUZZERS)?;
    words.iter().fold(Line::of("cargo run --release -p host-tests --bin fuzz --"), Line::word).announced()
}

fn on_recordings(given: &[OsString]) -> Result<(), String> {
    let folder = real::folder(given.first().cloned(), std::env::var_os(real::VARIABLE))?;
    Line::of("cargo run --release -p host-tests --bin real --").word(folder).announced()
}

fn frozen(given: &[OsString]) -> Result<(), String> {
    let line = Line::of("cargo run --release -p host-tests --bin frozen --");
    let variable = std::env::var_os(real::VARIABLE);
    let line = match !given.is_empty() || variable.is_some() {
        true => line.word(real::folder(given.first().cloned(), variable)?),
        false => line,
    };
    line.announced()
}

fn book(_: &[OsString]) -> Result<(), String> {
    Line::of("cargo test --release -p omni-gap --test book").env("OMNI_GAP_BOOK", "all").announced()?;
    Line::of("cargo install mdbook --locked --version ^0.5 --root target/mdbook").announced()?;
    Line::of("target/mdbook/bin/mdbook build book --dest-dir target/book").announced()
}

fn in_browser(further: &[OsString]) -> Result<(), String> {
    browser::perform(further)
}

fn invented(_: &[OsString]) -> Result<(), String> {
    invented::perform()
}

fn help(_: &[OsString]) -> Result<(), String> {
    println!("{}", list());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(words: &[&str]) -> Result<(&'static str, Vec<OsString>), ErrandError> {
        asked(words.iter().map(OsString::from)).map(|(errand, given)| (errand.name, given))
    }

    #[test]
    fn an_unknown_errand_is_answered_with_the_list() {
        for (words, complaint) in [(&["tset"][..], "no errand is called tset"), (&[], "no errand named")] {
            let Err(ErrandError::Usage(said)) = ask(words) else { panic!("{words:?} was taken") };
            assert!(said.starts_with(complaint), "{said}");
            assert_eq!(said.lines().count(), 1 + ERRANDS.len(), "{said}");
        }
    }

    #[test]
    fn an_errand_gets_as_many_arguments_as_it_takes() {
        assert_eq!(ask(&["real", "logs"]), Ok(("real", vec!["logs".into()])));
        assert_eq!(ask(&["real"]), Ok(("real", Vec::new())));
        let many = ["bench", "run", "a set", "--name", "x"];
        assert_eq!(ask(&many).map(|(_, given)| given.len()), Ok(4));
        assert!(matches!(ask(&["test", "logs"]), Err(ErrandError::Usage(_))));
        assert!(matches!(ask(&["real", "logs", "more"]), Err(ErrandError::Usage(_))));
    }

    #[test]
    fn help_names_the_variable_that_is_read() {
        assert!(list().contains(real::VARIABLE));
    }
}
