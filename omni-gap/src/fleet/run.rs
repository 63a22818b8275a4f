//! A session on each core, until all are done.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use schemars::JsonSchema;
use serde::Serialize;

use super::answer::answer_session;
use super::find::FoundSession;
use super::store::Store;
use crate::engine::Knobs;
use crate::error::Result;
use crate::vocabulary::Progress;

/// How to diagnose a fleet.
pub struct FleetOptions<'a> {
    /// Every threshold.
    pub knobs: Knobs,
    /// Sessions worked at at a time.
    pub jobs: usize,
    /// The store's folder, where the report of each session is to be kept in it.
    pub reports: Option<&'a Path>,
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
    let work = Work {
        sessions,
        next: AtomicUsize::new(0),
        ended: AtomicBool::new(false),
        state: Mutex::new(State { store, tally: FleetTally { sessions: sessions.len(), ..FleetTally::default() } }),
    };
    let results: Vec<Result<()>> = thread::scope(|scope| {
        let workers: Vec<_> = (0..options.jobs.max(1)).map(|_| scope.spawn(|| work.worker(options))).collect();
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
    fn worker(&self, options: &FleetOptions<'_>) -> Result<()> {
        while !self.ended.load(Ordering::Relaxed) && !(options.told_to_end)() {
            let Some(session) = self.sessions.get(self.next.fetch_add(1, Ordering::Relaxed)) else { break };
            if let Err(why) = self.session(session, options) {
                self.ended.store(true, Ordering::Relaxed);
                return Err(why);
            }
        }
        Ok(())
    }

    fn session(&self, session: &FoundSession, options: &FleetOptions<'_>) -> Result<()> {
        let held = self.with_state(|state| state.store.session(&session.name).map(|row| row.key.clone()));
        let answer = answer_session(session, held.as_deref(), &options.knobs, options.reports)?;
        self.with_state(|state| {
            let Some(answer) = answer else {
                state.tally.kept += 1;
                return Ok(());
            };
            state.tally.done += 1;
            state.tally.failed += usize::from(answer.session().verdict.is_none());
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
