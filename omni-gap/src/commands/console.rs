//! What is said: answers on standard output, progress and timings on standard error.

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use omni_gap::Error;

use super::cli_error::CliError;

/// The console of one command.
#[derive(Debug)]
pub struct Console {
    quiet: bool,
    verbose: bool,
    spinner: Option<ProgressBar>,
    phase: Mutex<Option<(String, Instant)>>,
}

impl Console {
    /// A console as loud as was asked for. The spinner turns only where a person is looking.
    pub fn new(quiet: bool, verbose: bool) -> Self {
        let spinner = (!quiet && io::stderr().is_terminal()).then(|| {
            let style = ProgressStyle::with_template("{spinner} {msg} ({elapsed})");
            ProgressBar::new_spinner().with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
        });
        Self { quiet, verbose, spinner, phase: Mutex::new(None) }
    }

    /// Says an answer on standard output. A reader who has gone away has heard enough.
    pub fn say(&self, text: &str) -> Result<(), CliError> {
        self.say_while_heard(text).map(|_| ())
    }

    /// Says the next part of an answer that has no end of its own; false if the reader has gone away.
    pub fn say_while_heard(&self, text: &str) -> Result<bool, CliError> {
        if self.quiet {
            return Ok(true);
        }
        self.end_phase();
        let mut out = io::stdout().lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            Ok(()) => Ok(true),
            Err(why) if why.kind() == io::ErrorKind::BrokenPipe => Ok(false),
            Err(why) => {
                let fix = "Name a place with space left, or use --quiet";
                Err(Error::output(Path::new("standard output"), why.to_string(), fix).into())
            }
        }
    }

    /// Whether nothing but errors is said.
    pub fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Adds a line on standard error, for those who want to know more.
    pub fn more(&self, line: impl Display) {
        if self.verbose {
            self.beside_the_spinner(&line.to_string());
        }
    }

    /// Says why the command stops.
    pub fn error(&self, stop: &CliError) {
        self.end_phase();
        let _ = writeln!(io::stderr(), "omni-gap: {stop}");
    }

    /// Begins a phase of long work: the spinner names it, and its end is timed.
    pub fn phase(&self, phrase: &str) {
        self.end_phase();
        if let Some(spinner) = &self.spinner {
            spinner.set_message(phrase.to_owned());
            spinner.enable_steady_tick(Duration::from_millis(100));
        }
        self.exchange_phase(Some((phrase.to_owned(), Instant::now())));
    }

    /// Says where the phase is, where a person is looking.
    pub fn phase_is_at(&self, place: String) {
        if let Some(spinner) = &self.spinner {
            spinner.set_message(place);
        }
    }

    /// Ends the phase, if there is one.
    pub fn end_phase(&self) {
        let Some((phrase, since)) = self.exchange_phase(None) else { return };
        self.more(format!("{:7.2} s  {phrase}", since.elapsed().as_secs_f64()));
        if let Some(spinner) = &self.spinner {
            spinner.disable_steady_tick();
            spinner.finish_and_clear();
            spinner.reset();
        }
    }

    /// Puts another phase in the place of the one that was there.
    fn exchange_phase(&self, next: Option<(String, Instant)>) -> Option<(String, Instant)> {
        let mut phase = self.phase.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut phase, next)
    }

    fn beside_the_spinner(&self, line: &str) {
        let write = || {
            let _ = writeln!(io::stderr(), "{line}");
        };
        match &self.spinner {
            Some(spinner) => spinner.suspend(write),
            None => write(),
        }
    }
}

/// Words broken at spaces into lines of at most 100 characters, each indented.
pub fn wrapped(indent: usize, text: &str) -> String {
    const WIDTH: usize = 100;
    let mut lines = String::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && indent + line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines += &format!("{:indent$}{line}\n", "");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line += word;
    }
    if !line.is_empty() {
        lines += &format!("{:indent$}{line}\n", "");
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_at_spaces_and_indented() {
        let text = "word ".repeat(40);
        let lines = wrapped(4, &text);
        assert!(lines.lines().all(|l| l.chars().count() <= 100 && l.starts_with("    word")));
        assert_eq!(lines.split_whitespace().count(), 40);
        assert_eq!(wrapped(2, ""), "");
    }
}
