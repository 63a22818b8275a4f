//! # Commands: one file a verb
//!
//! [`answer`] is what is answered, in words or as JSON, [`causes`] knows their names, [`cli_error`] is why a command ends early, [`console`] says things on the terminal, [`given`] reads what the command line
//! names, [`output_path`] looks at outputs before any work is done for them. Bad input ends with one message on standard error
//! and exit code 2; what a command writes is whole or not there.

mod answer;
mod causes;
mod check;
mod cli_error;
mod compare;
mod completions;
mod console;
mod convert;
mod demo;
mod diagnose;
mod done;
mod examples;
mod experiment;
mod explain;
mod export;
mod fleet;
mod given;
mod identify;
mod man;
mod map;
mod new;
mod next;
mod output_path;
mod predict;
mod prompt;
mod record;
mod robot;
mod schema;
mod selftest;
mod sensitivity;
mod simulate;
mod told_to_end;
mod validate;
mod watch;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use console::Console;

/// Tells why an omnidirectional robot does not do what its simulator says.
#[derive(Debug, Parser)]
#[command(name = "omni-gap", version, arg_required_else_help = true, max_term_width = 100)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Say more on standard error: what is done, how long it takes, what was left out
    #[arg(long, short, global = true)]
    verbose: bool,

    /// Say nothing but errors; files are still written
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Demo(demo::Demo),
    Diagnose(diagnose::Diagnose),
    Compare(compare::Compare),
    Fleet(fleet::Fleet),
    Next(next::Next),
    Check(check::Check),
    New(new::New),
    Map(map::Map),
    Experiment(experiment::Experiments),
    Identify(identify::Identify),
    Predict(predict::Predict),
    Validate(validate::Validate),
    Simulate(simulate::Simulate),
    Sensitivity(sensitivity::Sensitivity),
    Selftest(selftest::Selftest),
    Explain(explain::Explain),
    Export(export::Export),
    Record(record::Record),
    Robot(robot::Robot),
    Watch(watch::WatchRobot),
    Convert(convert::Convert),
    Completions(completions::Completions),
    Man(man::Man),
    Schema(schema::SchemaOf),
}

/// Exit code for input that cannot be used.
const BAD_INPUT: u8 = 2;

impl Cli {
    /// What the command line asks for; ends the program where it asks for help, or cannot be understood.
    pub fn asked() -> Cli {
        let mut program = Cli::program();
        Cli::from_arg_matches(&program.get_matches_mut()).unwrap_or_else(|why| why.format(&mut program).exit())
    }

    /// The program with the examples of its commands.
    fn program() -> clap::Command {
        examples::with_examples(Cli::command())
    }

    /// Does what was asked and returns the exit code.
    pub fn run(self) -> u8 {
        let console = Console::new(self.quiet, self.verbose);
        let done = match &self.command {
            Command::Demo(c) => c.run(&console),
            Command::Diagnose(c) => c.run(&console),
            Command::Compare(c) => c.run(&console),
            Command::Fleet(c) => c.run(&console),
            Command::Next(c) => c.run(&console),
            Command::Check(c) => c.run(&console),
            Command::New(c) => c.run(&console),
            Command::Map(c) => c.run(&console),
            Command::Experiment(c) => c.run(&console),
            Command::Identify(c) => c.run(&console),
            Command::Predict(c) => c.run(&console),
            Command::Validate(c) => c.run(&console),
            Command::Simulate(c) => c.run(&console),
            Command::Sensitivity(c) => c.run(&console),
            Command::Selftest(c) => c.run(&console),
            Command::Explain(c) => c.run(&console),
            Command::Export(c) => c.run(&console),
            Command::Record(c) => c.run(&console),
            Command::Robot(c) => c.run(&console),
            Command::Watch(c) => c.run(&console),
            Command::Convert(c) => c.run(&console),
            Command::Completions(c) => c.run(Cli::program(), &console),
            Command::Man(c) => c.run(Cli::program(), &console),
            Command::Schema(c) => c.run(&console),
        };
        console.end_phase();
        match done {
            Ok(code) => code,
            Err(stop) => {
                console.error(&stop);
                BAD_INPUT
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_sound() {
        super::Cli::command().debug_assert();
    }
}
