//! # Install: who can bring a tool, and with which rights
//!
//! The decision is a pure function of what the machine has; [`Machine::look`] is the only part that looks.

use crate::line::Line;

/// What brings a tool.
#[derive(Clone, Copy, Debug)]
pub enum Install {
    /// A rustup command, its first word left out.
    Rustup(&'static str),
    /// Packages of Debian and Ubuntu.
    Apt(&'static str),
    /// A program of crates.io, built here.
    Crate(&'static str),
}

/// What this machine can install with.
#[derive(Clone, Copy, Debug)]
pub struct Machine {
    /// rustup is there.
    pub rustup: bool,
    /// apt-get is there.
    pub apt: bool,
    /// The user is root.
    pub root: bool,
    /// sudo is there and asks for no password.
    pub sudo: bool,
}

/// How to go about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Means {
    /// Commands to run, in order.
    Lines(Vec<Line>),
    /// Nothing that this program may run: what the person should do.
    ByHand(String),
}

impl Machine {
    /// Asks the machine.
    pub fn look() -> Self {
        let works = |text| Line::of(text).answer();
        Self {
            rustup: works("rustup --version").is_some(),
            apt: works("apt-get --version").is_some(),
            root: works("id -u").is_some_and(|id| id.trim() == "0"),
            sudo: works("sudo -n true").is_some(),
        }
    }
}

impl Install {
    /// How to go about it on this machine.
    pub fn on(self, machine: &Machine) -> Means {
        match self {
            Install::Rustup(what) if machine.rustup => Means::Lines(vec![Line::of(&format!("rustup {what}"))]),
            Install::Rustup(what) => {
                Means::ByHand(format!("install rustup (https://rustup.rs), then run: rustup {what}"))
            }
            Install::Apt(packages) => apt(packages, machine),
            Install::Crate(name) => Means::Lines(vec![Line::of(&format!("cargo install --locked {name}"))]),
        }
    }
}

fn apt(packages: &str, machine: &Machine) -> Means {
    let lines = |sudo: &str| {
        let line = |what: &str| Line::of(&format!("{sudo} apt-get {what}"));
        Means::Lines(vec![line("update"), line(&format!("install -y --no-install-recommends {packages}"))])
    };
    match machine {
        Machine { apt: false, .. } => {
            Means::ByHand(format!("install what Debian calls {packages} with this system's package manager"))
        }
        Machine { root: true, .. } => lines(""),
        Machine { sudo: true, .. } => lines("sudo -n"),
        _ => Means::ByHand(format!("run: sudo apt-get install -y --no-install-recommends {packages}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BARE: Machine = Machine { rustup: false, apt: false, root: false, sudo: false };

    fn typed(means: Means) -> String {
        match means {
            Means::Lines(lines) => lines.iter().map(Line::shown).collect::<Vec<_>>().join("; "),
            Means::ByHand(advice) => format!("by hand: {advice}"),
        }
    }

    #[test]
    fn rustup_needs_no_rights() {
        let machine = Machine { rustup: true, ..BARE };
        assert_eq!(typed(Install::Rustup("component add clippy").on(&machine)), "rustup component add clippy");
    }

    #[test]
    fn packages_are_installed_as_root_or_by_a_silent_sudo() {
        let gcc = |machine| typed(Install::Apt("gcc").on(&machine));
        assert_eq!(
            gcc(Machine { apt: true, root: true, ..BARE }),
            "apt-get update; apt-get install -y --no-install-recommends gcc"
        );
        assert_eq!(
            gcc(Machine { apt: true, sudo: true, ..BARE }),
            "sudo -n apt-get update; sudo -n apt-get install -y --no-install-recommends gcc"
        );
    }

    #[test]
    fn without_the_rights_or_the_program_the_person_is_told_what_to_do() {
        let by_hand = |install: Install, machine| typed(install.on(&machine));
        assert_eq!(
            by_hand(Install::Apt("gcc"), Machine { apt: true, ..BARE }),
            "by hand: run: sudo apt-get install -y --no-install-recommends gcc"
        );
        assert!(by_hand(Install::Apt("gcc"), BARE).contains("this system's package manager"));
        assert!(by_hand(Install::Rustup("component add clippy"), BARE).ends_with("rustup component add clippy"));
    }
}
