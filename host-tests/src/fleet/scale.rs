//! How fast a fleet is worked through: the same sessions on one core and on all, as files, into a store.

use std::fs;
use std::path::Path;
use std::thread::available_parallelism;
use std::time::Instant;

use omni_gap::Error;
use omni_gap::engine::Knobs;
use omni_gap::fleet::{FleetOptions, Store, diagnose_fleet, find};
use omni_gap::log::write_session;
use omni_gap::report::{num, percent};

use super::kind::Kind;
use crate::peak_memory::peak_memory;

/// What was measured.
#[derive(Clone, Debug)]
pub struct Scale {
    /// Sessions.
    pub sessions: usize,
    /// Cores.
    pub cores: usize,
    /// Bytes of all sessions' files.
    pub bytes: u64,
    /// Bytes of the tables.
    pub tables: u64,
    /// Wall clock on one core [s]
    pub one_s: f64,
    /// Wall clock on all [s]
    pub all_s: f64,
    /// Wall clock where all is known already [s]
    pub known_s: f64,
    /// Largest resident memory after a tenth of the sessions, and after all [byte]; where the system tells it.
    pub memory: Option<[u64; 2]>,
}

/// Works through so many sessions, a tenth first.
///
/// # Errors
/// Where files cannot be written or read.
pub fn scale(kind: &Kind) -> Result<Scale, Error> {
    let folder =
        tempfile::tempdir().map_err(|why| Error::output(Path::new("a folder"), why.to_string(), "Free space"))?;
    let logs = folder.path().join("logs");
    for (robot, session) in kind.sessions()?.iter().enumerate() {
        let own = logs.join(format!("r{:03}/2026-11-{:02}", robot / 20, 1 + robot % 20));
        write_session(&own, &session.robot_text, &session.runs)?;
    }
    let sessions = find(std::slice::from_ref(&logs))?;
    let cores = available_parallelism().map_or(1, usize::from);
    let timed = |store: &str, jobs: usize, count: usize| -> Result<f64, Error> {
        let knobs = Knobs { equations: true, ..Knobs::default() };
        let options = FleetOptions { knobs, jobs, reports: None, progress: &|_| {}, told_to_end: &|| false };
        let begun = Instant::now();
        diagnose_fleet(&sessions[..count], &mut Store::open(&folder.path().join(store))?, &options)?;
        Ok(begun.elapsed().as_secs_f64())
    };
    timed("first", cores, sessions.len().div_ceil(10))?;
    let after_first = peak_memory("self");
    let all_s = timed("all", cores, sessions.len())?;
    let after_all = peak_memory("self");
    let known_s = timed("all", cores, sessions.len())?;
    let one_s = timed("one", 1, sessions.len())?;
    Ok(Scale {
        sessions: sessions.len(),
        cores,
        bytes: size_of(&logs),
        tables: size_of(&folder.path().join("all")),
        one_s,
        all_s,
        known_s,
        memory: after_first.zip(after_all).map(|(first, all)| [first, all]),
    })
}

/// Bytes of all files below a folder.
fn size_of(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.map(|path| if path.is_dir() { size_of(&path) } else { path.metadata().map_or(0, |m| m.len()) }).sum()
}

impl Scale {
    /// Of one core's speed times the cores, how much all reach [1]
    pub fn of_ideal(&self) -> f64 {
        self.one_s / (self.all_s * self.cores as f64)
    }

    /// The page.
    pub fn page(&self) -> String {
        let Self { sessions, cores, one_s, all_s, known_s, .. } = self;
        let n = *sessions as f64;
        let core_hours = all_s * *cores as f64 / 3600.0;
        let memory = self.memory.map_or_else(String::new, |[first, all]| {
            let mib = |bytes: u64| num(bytes as f64 / f64::from(1 << 20));
            format!(
                "| largest memory after a tenth of the sessions; after all | {} MiB; {} MiB |\n",
                mib(first),
                mib(all)
            )
        });
        format!(
            "# How fast a fleet is worked through\n\n{sessions} sessions of 600 rows as files, into a store without reports, with {cores} cores.\n\n\
             | what | |\n|---|---|\n\
             | wall clock on one core; on all | {} s; {} s |\n\
             | all, of one core's speed times the cores | {} |\n\
             | core-seconds a session | {} |\n\
             | sessions a core-hour | {} |\n\
             | bytes read a session; bytes of tables a session | {}; {} |\n\
             | wall clock where all is known already | {} s |\n\
             {memory}\
             | 10,000 robots a day, a session each | {} core-hours, {} GB read, {} GB of tables |\n",
            num(*one_s),
            num(*all_s),
            percent(self.of_ideal()),
            num(3600.0 * core_hours / n),
            num(n / core_hours),
            num(self.bytes as f64 / n),
            num(self.tables as f64 / n),
            num(*known_s),
            num(1e4 * core_hours / n),
            num(1e4 * self.bytes as f64 / n / 1e9),
            num(1e4 * self.tables as f64 / n / 1e9)
        )
    }
}
