//! The command as a process: what it said, how it ended, what it took.

use std::ffi::{OsStr, OsString};
use std::io::{self, Read};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::memory::peak_memory;

/// How often a running command is looked at.
const LOOK: Duration = Duration::from_micros(200);

/// A command that runs longer has no end; none of these takes a tenth of it.
const NO_END: Duration = Duration::from_secs(600);

/// Bytes in a megabyte.
const MB: f64 = 1e6;

/// A command to be run.
#[derive(Clone, Debug)]
pub struct Asked {
    program: PathBuf,
    folder: PathBuf,
    /// What follows the program's name.
    pub words: Vec<OsString>,
    /// The memory that it may hold, beyond which it is stopped \[MB\].
    pub most_mb: f64,
    /// Where its answer goes, if not to who asked.
    answer: Option<PathBuf>,
    /// Words before the program's name, if another program starts it.
    through: Vec<OsString>,
}

/// How it ended.
#[derive(Clone, Debug)]
pub struct Ended {
    /// Its exit code; none where a signal ended it.
    pub code: Option<i32>,
    /// The signal that ended it.
    pub signal: Option<i32>,
    /// What it said on standard output.
    pub out: String,
    /// What it said on standard error.
    pub err: String,
    /// The most memory that it held, as seen while it ran \[MB\]; none where it was over too soon, or another program ran it.
    pub megabytes: Option<f64>,
    /// How long it took \[s\].
    pub seconds: f64,
    /// Why it was stopped before its end.
    pub stopped: Option<&'static str>,
}

/// A command that runs.
#[derive(Debug)]
pub struct Running {
    child: Child,
    begun: Instant,
    most_mb: f64,
    out: JoinHandle<String>,
    err: JoinHandle<String>,
}

impl Asked {
    /// What a session of some thousand rows never takes \[MB\].
    const MOST_MB: f64 = 300.0;

    /// The program with these words, run in a folder.
    pub fn new(program: &Path, folder: &Path, words: &[impl AsRef<OsStr>]) -> Self {
        let words = words.iter().map(|word| word.as_ref().to_owned()).collect();
        let (program, folder) = (program.to_owned(), folder.to_owned());
        Self { program, folder, words, most_mb: Self::MOST_MB, answer: None, through: Vec::new() }
    }

    /// As if the disk were full once a file has so many blocks.
    pub fn with_files_of(self, blocks: u32) -> Self {
        self.through(&["sh", "-c", &format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"")])
    }

    /// Started by another program with these words.
    pub fn through(self, words: &[&str]) -> Self {
        Self { through: words.iter().map(OsString::from).collect(), ..self }
    }

    /// With so much memory at the most \[MB\].
    pub fn within(self, most_mb: f64) -> Self {
        Self { most_mb, ..self }
    }

    /// With its answer going to a file or device.
    pub fn answering_to(self, place: &Path) -> Self {
        Self { answer: Some(place.to_owned()), ..self }
    }

    /// As a person would type it.
    pub fn typed(&self) -> String {
        let words = self.words.iter().map(|word| word.to_string_lossy().escape_debug().to_string());
        let answer = self.answer.iter().map(|place| format!("> {}", place.display()));
        words.chain(answer).collect::<Vec<_>>().join(" ")
    }

    fn command(&self) -> Command {
        let mut words = self.through.iter().map(OsString::as_os_str).chain([self.program.as_os_str()]);
        let mut command = Command::new(words.next().unwrap_or_default());
        command.args(words).args(&self.words);
        command
    }

    /// Starts it.
    ///
    /// # Errors
    /// Where there is no such program.
    pub fn start(&self) -> io::Result<Running> {
        let out = match &self.answer {
            Some(place) => std::fs::OpenOptions::new().write(true).open(place)?.into(),
            None => Stdio::piped(),
        };
        let mut command = self.command();
        command.current_dir(&self.folder).stdin(Stdio::null()).stdout(out).stderr(Stdio::piped());
        let begun = Instant::now();
        let mut child = command.spawn()?;
        let (out, err) = (read(child.stdout.take()), read(child.stderr.take()));
        Ok(Running { child, begun, most_mb: self.most_mb, out, err })
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// Where there is no such program.
    pub fn run(&self) -> io::Result<Ended> {
        self.start()?.end()
    }
}

/// Reads to the end beside the command's own work.
fn read(from: Option<impl Read + Send + 'static>) -> JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut from) = from {
            // what was said before an error is what was said
            from.read_to_end(&mut bytes).ok();
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

impl Running {
    /// Whether it still runs.
    ///
    /// # Errors
    /// Where the system does not tell.
    pub fn runs(&mut self) -> io::Result<bool> {
        Ok(self.child.try_wait()?.is_none())
    }

    /// Kills it.
    ///
    /// # Errors
    /// Where that is not allowed.
    pub fn kill(&mut self) -> io::Result<()> {
        self.child.kill()
    }

    /// Waits for its end.
    ///
    /// # Errors
    /// Where the system does not tell.
    pub fn end(mut self) -> io::Result<Ended> {
        let id = self.child.id().to_string();
        let (mut megabytes, mut stopped) = (None::<f64>, None);
        let status = loop {
            megabytes = peak_memory(&id).map(|bytes| bytes as f64 / MB).or(megabytes);
            if let Some(status) = self.child.try_wait()? {
                break status;
            }
            let why = [
                (megabytes.is_some_and(|held| held > self.most_mb), "it took too much memory"),
                (self.begun.elapsed() > NO_END, "it had no end"),
            ];
            if let Some((_, why)) = why.into_iter().find(|(true_of_it, _)| *true_of_it) {
                self.child.kill()?;
                stopped = Some(why);
                break self.child.wait()?;
            }
            thread::sleep(LOOK);
        };
        let seconds = self.begun.elapsed().as_secs_f64();
        let [out, err] = [self.out, self.err].map(|said| said.join().unwrap_or_default());
        Ok(Ended { code: status.code(), signal: status.signal(), out, err, megabytes, seconds, stopped })
    }
}
