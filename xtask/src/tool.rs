//! # Tool: what a step needs on the machine
//!
//! A tool is one entry of [`TOOLS`]: its name, a command that tells whether it is there, and what brings it. A target
//! of the compiler or a program of the distribution is one more entry and nothing else.
//!
//! A missing tool is never a reason to leave a step out: it is installed, or the errand stops.

use crate::install::{Install, Machine, Means};
use crate::line::Line;

/// Something that the steps need.
#[derive(Clone, Copy, Debug)]
pub struct Tool {
    /// What people call it.
    pub name: &'static str,
    /// The command that tells whether it is there.
    pub probe: Probe,
    /// What brings it.
    pub installs: Install,
}

/// A command, and a word that its answer must hold; the empty word where success is answer enough.
#[derive(Clone, Copy, Debug)]
pub struct Probe(pub &'static str, pub &'static str);

/// Everything that `cargo xtask test` needs besides cargo.
///
/// The linker is listed for whoever runs a copy of this program built elsewhere: without one, cargo stops before it.
pub const TOOLS: &[Tool] = &[
    Tool {
        name: "rustfmt",
        probe: Probe("cargo fmt --version", "rustfmt"),
        installs: Install::Rustup("component add rustfmt"),
    },
    Tool {
        name: "clippy",
        probe: Probe("cargo clippy --version", "clippy"),
        installs: Install::Rustup("component add clippy"),
    },
    Tool { name: "a C linker (cc)", probe: LINKER, installs: Install::Apt("gcc libc6-dev") },
    // what the emulator of the core is built with
    Tool { name: "cmake", probe: Probe("cmake --version", "cmake"), installs: Install::Apt("cmake") },
    Tool { name: "make", probe: Probe("make --version", "Make"), installs: Install::Apt("make") },
    Tool {
        name: "the chip's target (thumbv7em-none-eabihf)",
        probe: Probe("rustup target list --installed", "thumbv7em-none-eabihf"),
        installs: Install::Rustup("target add thumbv7em-none-eabihf"),
    },
    Tool {
        name: "qemu-system-arm",
        probe: Probe("qemu-system-arm --version", "QEMU"),
        installs: Install::Apt("qemu-system-arm"),
    },
];

/// The compiler of tomorrow, for tools that ask it for more than it promises.
const NIGHTLY: Tool = Tool {
    name: "a nightly compiler",
    probe: Probe("rustup toolchain list", "nightly"),
    installs: Install::Rustup("toolchain install nightly --profile minimal"),
};

/// What a fuzzer is built with.
pub const FUZZERS: &[Tool] = &[
    NIGHTLY,
    Tool {
        name: "cargo-fuzz",
        probe: Probe("cargo fuzz --version", "cargo-fuzz"),
        installs: Install::Crate("cargo-fuzz"),
    },
];

/// What executes tests and tells of what is undefined.
pub const MIRI: &[Tool] = &[
    NIGHTLY,
    Tool {
        name: "Miri",
        probe: Probe("cargo +nightly miri --version", "miri"),
        installs: Install::Rustup("component add --toolchain nightly miri rust-src"),
    },
];

/// What tells what the product is made of.
pub const SUPPLY_CHAIN: &[Tool] = &[Tool {
    name: "cargo-deny",
    probe: Probe("cargo deny --version", "cargo-deny"),
    installs: Install::Crate("cargo-deny"),
}];

/// A C library with a library of mathematics of its own, and what builds for it.
pub const OTHER_LIBRARY: &[Tool] = &[
    Tool { name: "musl", probe: Probe("musl-gcc --version", "gcc"), installs: Install::Apt("musl-tools") },
    Tool {
        name: "its target (x86_64-unknown-linux-musl)",
        probe: Probe("rustup target list --installed", "x86_64-unknown-linux-musl"),
        installs: Install::Rustup("target add x86_64-unknown-linux-musl"),
    },
];

/// What lists what programs of others may call, and compares it.
pub const API: &[Tool] = &[
    NIGHTLY,
    Tool {
        name: "cargo-public-api",
        probe: Probe("cargo public-api --version", "cargo-public-api"),
        installs: Install::Crate("cargo-public-api"),
    },
    Tool {
        name: "cargo-semver-checks",
        probe: Probe("cargo semver-checks --version", "cargo-semver-checks"),
        installs: Install::Crate("cargo-semver-checks"),
    },
];

/// What tells of all that is handed out what is in it.
pub const NOTICES: &[Tool] = &[
    Tool {
        name: "cargo-about",
        probe: Probe("cargo about --version", "cargo-about"),
        installs: Install::Crate("cargo-about --features cli"),
    },
    Tool {
        name: "cargo-cyclonedx",
        probe: Probe("cargo cyclonedx --version", "cargo-cyclonedx"),
        installs: Install::Crate("cargo-cyclonedx"),
    },
];

/// Off Unix the linker is not called `cc`, and that this program was built is proof enough of it.
const LINKER: Probe = if cfg!(unix) { Probe("cc --version", "") } else { Probe("cargo --version", "") };

impl Tool {
    fn is_there(&self) -> bool {
        Line::of(self.probe.0).answer().is_some_and(|said| said.contains(self.probe.1))
    }
}

/// Sees to it that every tool is there, installing what can be installed; otherwise what to tell the person.
pub fn ensure(tools: &[Tool]) -> Result<(), String> {
    let missing: Vec<&Tool> = tools.iter().filter(|tool| !tool.is_there()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let machine = Machine::look();
    for tool in missing {
        bring(tool, tool.installs.on(&machine), Line::succeeds, Tool::is_there)?;
    }
    Ok(())
}

/// Installs one missing tool by the given means, and looks again.
fn bring(tool: &Tool, means: Means, run: impl Fn(&Line) -> bool, there: impl Fn(&Tool) -> bool) -> Result<(), String> {
    let by_hand = |what: &str| Err(format!("{} is missing; {what}", tool.name));
    match means {
        Means::ByHand(advice) => by_hand(&advice),
        Means::Lines(lines) => {
            for line in &lines {
                println!("installing {}: {}", tool.name, line.shown());
                // Their exit codes decide nothing (an update may complain of a source that is not needed): the probe does.
                run(line);
            }
            let typed = lines.iter().map(Line::shown).collect::<Vec<_>>().join(" && ");
            if there(tool) { Ok(()) } else { by_hand(&format!("installing it did not help. Run: {typed}")) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    const NOTHING: Tool = Tool {
        name: "nothing",
        probe: Probe("no-such-program-anywhere", ""),
        installs: Install::Rustup("component add nothing"),
    };

    #[test]
    fn a_probe_wants_success_and_its_word() {
        assert!(Tool { probe: Probe("cargo --version", "cargo"), ..NOTHING }.is_there());
        assert!(!Tool { probe: Probe("cargo --version", "no such word"), ..NOTHING }.is_there());
        assert!(!NOTHING.is_there());
    }

    #[test]
    fn what_cannot_be_installed_stops_with_the_command() {
        let said = bring(&NOTHING, Means::ByHand("run: rustup x".into()), |_| true, |_| true).unwrap_err();
        assert_eq!(said, "nothing is missing; run: rustup x");
    }

    #[test]
    fn an_installation_counts_only_if_the_tool_is_there_afterwards() {
        let ran = Cell::new(0);
        let means = || Means::Lines(vec![Line::of("apt-get update"), Line::of("apt-get install -y nothing")]);
        let run = |_: &Line| {
            ran.set(ran.get() + 1);
            true
        };
        assert_eq!(bring(&NOTHING, means(), run, |_| true), Ok(()));
        assert_eq!(ran.get(), 2);
        let said = bring(&NOTHING, means(), run, |_| false).unwrap_err();
        assert!(said.ends_with("Run: apt-get update && apt-get install -y nothing"), "{said}");
    }
}
