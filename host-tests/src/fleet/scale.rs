//! How fast a fleet is worked through: the same sessions on one core and on all, as files, into a store.

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::thread::available_parallelism;
use std::time::Instant;

use omni_gap::Error;
use omni_gap::engine::Knobs;
use omni_gap::fleet::{FleetOptions, FoundSession, Store, diagnose_fleet, find};
use omni_gap::log::write_session;
use omni_gap::report::{num, percent};

use super::kind::Kind;
use crate::memory::{forget_peak, held_memory, peak_memory};

/// What was measured.
#[derive(Clone, Debug)]
pub struct Scale {
    /// Sessions.
    pub sessions: usize,
    /// Rows of each.
    pub rows: usize,
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
    /// Resident memory when a tenth, a half and all of the sessions are done, on all cores [byte]; where the system tells it.
    pub held: Vec<u64>,
    /// The most of it, up to then [byte]
    pub most: Option<u64>,
}

/// Parts of the sessions after which memory is looked at.
const LOOKED_AFTER: [f64; 3] = [0.1, 0.5, 1.0];

impl Scale {
    /// Works through the sessions of a kind.
    ///
    /// # Errors
    /// Where files cannot be written or read.
    pub fn of(kind: &Kind) -> Result<Self, Error> {
        let folder =
            tempfile::tempdir().map_err(|why| Error::output(Path::new("a folder"), why.to_string(), "Free space"))?;
        let logs = folder.path().join("logs");
        let sessions = staged(kind, &logs)?;
        let cores = available_parallelism().map_or(1, usize::from);
        let looks = LOOKED_AFTER.map(|part| (part * sessions.len() as f64).ceil() as usize);
        let (done, held) = (Mutex::new(0), Mutex::new(Vec::new()));
        let looked = |_: &str| {
            let Ok(mut done) = done.lock() else { return };
            *done += 1;
            if looks.contains(&done) {
                held.lock().into_iter().for_each(|mut held| held.extend(held_memory("self")));
            }
        };
        forget_peak();
        let all_s = timed(&sessions, &folder.path().join("all"), cores, &looked)?;
        let most = peak_memory("self");
        let known_s = timed(&sessions, &folder.path().join("all"), cores, &|_| {})?;
        let one_s = timed(&sessions, &folder.path().join("one"), 1, &|_| {})?;
        Ok(Self {
            sessions: sessions.len(),
            rows: kind.length.rows(),
            cores,
            bytes: size_of(&logs),
            tables: size_of(&folder.path().join("all")),
            one_s,
            all_s,
            known_s,
            held: held.into_inner().unwrap_or_default(),
            most,
        })
    }

    /// Of one core's speed times the cores, how much all reach [1]
    pub fn of_ideal(&self) -> f64 {
        self.one_s / (self.all_s * self.cores as f64)
    }

    /// Core-hours of all sessions.
    fn core_hours(&self) -> f64 {
        self.all_s * self.cores as f64 / 3600.0
    }
}

/// Each session as files, one after the other: what is measured is not what staging holds.
fn staged(kind: &Kind, logs: &Path) -> Result<Vec<FoundSession>, Error> {
    for robot in 0..kind.robots {
        let session = kind.session(robot)?;
        let own = logs.join(format!("r{:03}/2026-11-{:02}", robot / 20, 1 + robot % 20));
        write_session(&own, &session.robot_text, &session.runs)?;
    }
    find(&[logs.to_owned()])
}

/// The wall clock of all sessions, into a store.
fn timed(sessions: &[FoundSession], store: &Path, jobs: usize, progress: &(dyn Fn(&str) + Sync)) -> Result<f64, Error> {
    let knobs = Knobs { equations: true, ..Knobs::default() };
    let options = FleetOptions { knobs, jobs, reports: None, progress, told_to_end: &|| false };
    let begun = Instant::now();
    diagnose_fleet(sessions, &mut Store::open(store)?, &options)?;
    Ok(begun.elapsed().as_secs_f64())
}

/// Bytes of all files below a folder.
fn size_of(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.map(|path| if path.is_dir() { size_of(&path) } else { path.metadata().map_or(0, |m| m.len()) }).sum()
}

/// What a row of the page says of a fleet.
type Row = (&'static str, fn(&Scale) -> String);

const ROWS: &[Row] = &[
    ("wall clock on one core; on all", |s| format!("{} s; {} s", num(s.one_s), num(s.all_s))),
    ("all, of one core's speed times the cores", |s| percent(s.of_ideal())),
    ("core-seconds a session", |s| num(3600.0 * s.core_hours() / s.sessions as f64)),
    ("sessions a core-hour", |s| num(s.sessions as f64 / s.core_hours())),
    ("bytes read a session; bytes of tables a session", |s| {
        format!("{}; {}", num(s.bytes as f64 / s.sessions as f64), num(s.tables as f64 / s.sessions as f64))
    }),
    ("wall clock where all is known already", |s| format!("{} s", num(s.known_s))),
    ("memory when a tenth, a half, all are done; the most", |s| {
        let mib = |bytes: &u64| format!("{} MiB", num(*bytes as f64 / f64::from(1 << 20)));
        let held: Vec<String> = s.held.iter().map(mib).collect();
        format!("{}; {}", held.join(", "), s.most.as_ref().map_or_else(String::new, mib))
    }),
    ("10,000 robots a day, a session each", |s| {
        let times = 1e4 / s.sessions as f64;
        format!(
            "{} core-hours, {} GB read, {} GB of tables",
            num(times * s.core_hours()),
            num(times * s.bytes as f64 / 1e9),
            num(times * s.tables as f64 / 1e9)
        )
    }),
];

/// The page, with a column for each fleet.
pub fn page_of(fleets: &[Scale]) -> String {
    let cells = |cell: &dyn Fn(&Scale) -> String| {
        let cells: Vec<String> = fleets.iter().map(cell).collect();
        cells.join(" | ")
    };
    let rows: String = ROWS.iter().map(|(what, told)| format!("| {what} | {} |\n", cells(told))).collect();
    format!(
        "# How fast a fleet is worked through\n\nSessions as files, into a store without reports, with {} cores.\n\n\
         | what | {} |\n|---|{}\n{rows}",
        fleets.first().map_or(0, |fleet| fleet.cores),
        cells(&|s| format!("{} sessions of {} rows", s.sessions, s.rows)),
        "---|".repeat(fleets.len())
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fleet::kind::Length;

    #[test]
    fn ten_sessions_are_timed_and_looked_at_three_times() {
        let length = Length { runs: 2, duration: 1.0, rate: 50.0 };
        let file = include_str!("../../../examples/feup-4w/robot.toml");
        let kind = Kind { file, robots: 10, hidden: Vec::new(), in_common: 0.5, length, seed: 1 };
        let scale = Scale::of(&kind).unwrap();
        assert_eq!((scale.sessions, scale.rows), (10, 100));
        assert!(scale.tables > 0 && scale.bytes > 0, "{scale:?}");
        assert_eq!(scale.held.len(), if cfg!(target_os = "linux") { 3 } else { 0 }, "{scale:?}");
        let page = page_of(&[scale.clone(), scale]);
        assert!(
            page.contains("| what | 10 sessions of 100 rows | 10 sessions of 100 rows |\n|---|---|---|\n"),
            "{page}"
        );
    }
}
