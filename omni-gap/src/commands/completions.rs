//! `completions`: what a shell needs to complete the commands.

use super::console::Console;
use super::done::{DONE, Done};

/// Print the completions of a shell: `omni-gap completions bash > ~/.local/share/bash-completion/completions/omni-gap`
#[derive(Debug, clap::Args)]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

impl Completions {
    /// Does it, for a program with these commands.
    pub fn run(&self, mut program: clap::Command, console: &Console) -> Done {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "omni-gap", &mut script);
        console.say(&String::from_utf8_lossy(&script))?;
        Ok(DONE)
    }
}
