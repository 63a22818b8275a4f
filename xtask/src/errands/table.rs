//! # Table: every errand there is
//!
//! An errand is one entry of [`ERRANDS`]; the list that `help` prints is the table itself.

use std::ffi::OsString;

use super::lines;
use crate::{api, browser, cluster, dist, images, invented, notebooks, soundness, supply_chain, wheel};

/// One thing to ask for.
#[derive(Clone, Copy, Debug)]
pub struct Errand {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it takes, as `help` shows it: nothing, one argument, or any number of them where it ends in [`AND_MORE`].
    pub takes: &'static str,
    /// What it does, in a line.
    pub does: &'static str,
    /// Does it, with the words behind its name; otherwise what to tell the person.
    pub run: fn(&[OsString]) -> Result<(), String>,
}

/// How what takes any number of arguments is shown.
const AND_MORE: &str = "...]";

impl Errand {
    /// How many words it takes at most.
    pub fn most(&self) -> usize {
        match self.takes {
            "" => 0,
            takes if takes.ends_with(AND_MORE) => usize::MAX,
            _ => 1,
        }
    }
}

/// All errands, in the order of `help`.
pub const ERRANDS: &[Errand] = &[
    Errand { name: "test", takes: "", does: "run every check there is, stop at the first failure", run: lines::test },
    Errand { name: "bless", takes: "", does: "run the tests and rewrite the golden pages", run: lines::bless },
    Errand {
        name: "bench",
        takes: "[make|run|score|table ...]",
        does: "the benchmark with the effect withheld (BENCHMARK.md); with nothing more, run the benches",
        run: lines::bench,
    },
    Errand {
        name: "benchmark",
        takes: "",
        does: "diagnose every effect of the catalogue and rewrite the golden table",
        run: |_| lines::page_of("catalogue"),
    },
    Errand {
        name: "medicine",
        takes: "",
        does: "diagnose what the simulator records of every effect, beside what the self-test foretells (BLESS=1: rewrite)",
        run: |_| lines::page_of("medicine"),
    },
    Errand {
        name: "confusion",
        takes: "",
        does: "compute which cause would be taken for which, by robot and motion (BLESS=1: rewrite page and pictures)",
        run: |_| lines::page_of("confusion"),
    },
    Errand {
        name: "fleet",
        takes: "[scale]",
        does: "what pooling finds in fleets with one weak effect and in healthy ones; scale: how fast 2,000 sessions are (BLESS=1: rewrite)",
        run: lines::fleet,
    },
    Errand {
        name: "fault-injection",
        takes: "",
        does: "stage full disks, bombs, loops, changing files and kills around the command, and tell what it does (BLESS=1: record)",
        run: lines::fault_injection,
    },
    Errand {
        name: "selftest",
        takes: "",
        does: "look in simulated recordings for the sizes that the self-test foretells (BLESS=1: rewrite)",
        run: |_| lines::page_of("selftest"),
    },
    Errand {
        name: "laboratory",
        takes: "",
        does: "diagnose what a second simulator records of every cause and rewrite the golden table",
        run: |_| lines::page_of("laboratory"),
    },
    Errand {
        name: "carried",
        takes: "",
        does: "identify robots whose files carry each effect with a wrong size (BLESS=1: rewrite)",
        run: |_| lines::page_of("carried"),
    },
    Errand {
        name: "identification",
        takes: "",
        does: "identify robots whose truth is known by the thousand and rewrite the golden page (most of an hour)",
        run: |_| lines::page_of("identification"),
    },
    Errand {
        name: "mujoco",
        takes: "",
        does: "time step and fit beside MuJoCo's, which it installs under target/ (BLESS=1: rewrite the golden page)",
        run: lines::mujoco,
    },
    Errand {
        name: "mjcf",
        takes: "",
        does: "play exported models in MuJoCo, which it installs under target/, beside the product's own simulator",
        run: lines::in_mujoco,
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
        name: "notebooks",
        takes: "[NAME...]",
        does: "run the notebooks in python/notebooks and compare what they print (BLESS=1: keep it)",
        run: notebooks::perform,
    },
    Errand {
        name: "miri",
        takes: "",
        does: "run tests of the core where whatever is undefined is told",
        run: soundness::miri,
    },
    Errand {
        name: "peers",
        takes: "",
        does: "install the peers that enter the benchmark beside us under target/, and test them",
        run: lines::peers,
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
        run: |_| lines::page_of("commission"),
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
        run: lines::fuzz,
    },
    Errand {
        name: "real",
        takes: "[FOLDER]",
        does: "diagnose the recordings of real robots in FOLDER (or in OMNI_GAP_DATA)",
        run: lines::on_recordings,
    },
    Errand {
        name: "frozen",
        takes: "[FOLDER]",
        does: "compare whole reports with the frozen ones, with FOLDER real recordings' too (BLESS=1: freeze anew)",
        run: lines::frozen,
    },
    Errand {
        name: "same-answer",
        takes: "",
        does: "compare whole reports of a release build with the frozen ones, bit for bit, and of one with another library of mathematics",
        run: lines::same_answer,
    },
    Errand {
        name: "book",
        takes: "",
        does: "run the commands of every page of the book, and build it into target/book with an mdBook of its own",
        run: lines::book,
    },
    Errand {
        name: "browser",
        takes: "[PAGE.html...]",
        does: "open every kind of page in Chromium, three widths, light and dark: charts, switches, accessibility",
        run: browser::perform,
    },
    Errand {
        name: "supply-chain",
        takes: "",
        does: "check licences, duplicates and sources of all that the product is made of, and what is known of weaknesses",
        run: supply_chain::perform,
    },
    Errand {
        name: "api",
        takes: "",
        does: "compare what programs of others may call with its list (BLESS=1: rewrite), and with the last release",
        run: api::perform,
    },
    Errand {
        name: "dist",
        takes: "",
        does: "make all that is handed out of the last commit, in target/dist/out, and try it where nothing else is (BLESS=1: record)",
        run: dist::perform,
    },
    Errand {
        name: "invented",
        takes: "",
        does: "add an invented effect to a copy of the tree, test it there and print what it touches (long)",
        run: |_| invented::perform(),
    },
    Errand { name: "help", takes: "", does: "print this list", run: help },
];

/// One line an errand.
pub fn list() -> String {
    let line = |errand: &Errand| format!("  cargo xtask {:<16} {}", [errand.name, errand.takes].join(" "), errand.does);
    ERRANDS.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn help(_: &[OsString]) -> Result<(), String> {
    println!("{}", list());
    Ok(())
}
