//! A session on each core, until all are done.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use rayon::ThreadPoolBuilder;
use schemars::JsonSchema;
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::answer::answered;
use super::find::FoundSession;
use super::key::Basis;
use super::store::Store;
use crate::engine::Knobs;
use crate::error::{Error, Result};
use crate::vocabulary::Progress;

/// How to diagnose a fleet.
pub struct FleetOptions<'a> {
    /// Every threshold.
    pub knobs: Knobs,
    /// Sessions worked at at a time.
    pub jobs: usize,
    /// Whether the report of each session is kept in the store.
    pub reports: bool,
    /// Told what is being done.
    pub progress: Progress<'a>,
    /// Asked between sessions whether to end: what is done is then on the disk.
    pub told_to_end: &'a (dyn Fn() -> bool + Sync),
}

impl std::fmt::Debug for FleetOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { knobs, jobs, reports, .. } = self;
        f.debug_struct("FleetOptions")
            .field("knobs", knobs)
            .field("jobs", jobs)
            .field("reports", reports)
            .finish_non_exhaustive()
    }
}

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize)]
pub struct FleetTally {
    /// Sessions below the folders.
    pub sessions: usize,
    /// Answered now.
    pub done: usize,
    /// Answered before, and nothing of them changed since.
    pub kept: usize,
    /// Of those done now, sessions without an answer.
    pub failed: usize,
    /// Left for the next time.
    pub left: usize,
}

/// Diagnoses the sessions that the store does not hold as they are now.
///
/// # Errors
/// Where the store cannot be written. What a session has wrong is a row, no error.
pub fn diagnose_fleet(sessions: &[FoundSession], store: &mut Store, options: &FleetOptions<'_>) -> Result<FleetTally> {
    let basis = Basis::of(&options.knobs);
    let work = Work {
        sessions,
        folder: store.folder().to_path_buf(),
        next: AtomicUsize::new(0),
        ended: AtomicBool::new(false),
        state: Mutex::new(State { store, tally: FleetTally { sessions: sessions.len(), ..FleetTally::default() } }),
    };
    let results: Vec<Result<()>> = thread::scope(|scope| {
        let workers: Vec<_> = (0..options.jobs.max(1)).map(|_| scope.spawn(|| work.worker(&basis, options))).collect();
        let joined = workers.into_iter().map(|worker| worker.join());
        joined.map(|result| result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    let State { store, mut tally } = work.state.into_inner().unwrap_or_else(PoisonError::into_inner);
    let flushed = store.flush();
    results.into_iter().collect::<Result<()>>()?;
    flushed?;
    tally.left = tally.sessions - tally.done - tally.kept;
    Ok(tally)
}

struct Work<'a> {
    sessions: &'a [FoundSession],
    folder: std::path::PathBuf,
    next: AtomicUsize,
    ended: AtomicBool,
    state: Mutex<State<'a>>,
}

struct State<'a> {
    store: &'a mut Store,
    tally: FleetTally,
}

impl Work<'_> {
    /// Takes one session after the other. Each is done by one thread: that many sessions at a time use all cores and no more
    /// memory than themselves.
    fn worker(&self, basis: &Basis, options: &FleetOptions<'_>) -> Result<()> {
        let one = ThreadPoolBuilder::new().num_threads(1).build();
        let one = one.map_err(|why| Error::output(&self.folder, why.to_string(), "Ask for fewer with --jobs"))?;
        while !self.ended.load(Ordering::Relaxed) && !(options.told_to_end)() {
            let Some(session) = self.sessions.get(self.next.fetch_add(1, Ordering::Relaxed)) else { break };
            if let Err(why) = one.install(|| self.session(session, basis, options)) {
                self.ended.store(true, Ordering::Relaxed);
                return Err(why);
            }
        }
        Ok(())
    }

    fn session(&self, session: &FoundSession, basis: &Basis, options: &FleetOptions<'_>) -> Result<()> {
        let (key, unreadable) = match basis.with_session(&session.path) {
            Ok(key) => (key, None),
            Err(why) => (String::new(), Some(why.to_string())),
        };
        let held = self.with_state(|state| {
            let held = state.store.session(&session.path.display().to_string()).is_some_and(|row| {
                row.key == key && unreadable.is_none() && session.robot.as_ref().is_none_or(|robot| *robot == row.robot)
            });
            state.tally.kept += usize::from(held);
            held
        });
        if held {
            return Ok(());
        }
        let refused = session.refused.clone().or(unreadable);
        let session = FoundSession { refused, ..session.clone() };
        let name = report_folder(&session.path, &key);
        let folder = self.folder.join(Path::new(&name));
        let answer = answered(&session, key, &options.knobs, options.reports.then_some((&*folder, name)));
        self.with_state(|state| {
            state.tally.done += 1;
            state.tally.failed += usize::from(answer.session.verdict.is_none());
            let FleetTally { sessions, done, kept, .. } = state.tally;
            (options.progress)(&format!("{} of {sessions} sessions", done + kept));
            state.store.put(answer)
        })
    }

    fn with_state<T>(&self, work: impl FnOnce(&mut State<'_>) -> T) -> T {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        work(&mut state)
    }
}

/// Where a session's report is kept: two copies of a session have a report each.
fn report_folder(session: &Path, key: &str) -> String {
    let mut hash = Sha256::new();
    hash.update(session.as_os_str().as_encoded_bytes());
    hash.update(key);
    format!("reports/{}", &format!("{:x}", hash.finalize())[..16])
}
