//! The same tables, whether answers went straight into a folder or, as bytes, into something else that keeps files by name.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::*;
use crate::engine::Knobs;
use crate::error::Result;
use crate::known::known_effects;
use crate::log::write_session;
use crate::synthesize::{Scenario, synthesize};

const ROBOT: &str = include_str!("../../robots/feup-3w/robot.toml");

/// Files in memory.
#[derive(Clone, Default)]
struct Memory(Arc<Mutex<BTreeMap<String, Vec<u8>>>>);

impl Storage for Memory {
    fn place(&self, name: &str) -> PathBuf {
        Path::new("memory").join(name)
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        let held = self.0.lock().unwrap();
        Ok(held.keys().filter(|name| name.starts_with(&format!("{folder}/"))).cloned().collect())
    }

    fn read(&self, name: &str) -> Result<Option<Vec<u8>>> {
        Ok(self.0.lock().unwrap().get(name).cloned())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<()> {
        self.0.lock().unwrap().insert(name.to_owned(), bytes.to_vec());
        Ok(())
    }

    fn remove(&self, name: &str) -> Result<()> {
        self.0.lock().unwrap().retain(|held, _| held != name && !held.starts_with(&format!("{name}/")));
        Ok(())
    }
}

/// Two robots, one with a session that cannot be read.
fn logs(at: &Path) {
    for (robot, seed) in [("r01", 1), ("r02", 2)] {
        let plan = Scenario { runs: 3, duration: 2.0, rate: 100.0, seed, ..Scenario::default() };
        let staged = synthesize(ROBOT, &plan, &known_effects()).unwrap();
        write_session(&at.join(robot).join("2026-11-03"), &staged.robot_text, &staged.runs).unwrap();
    }
    fs::create_dir_all(at.join("r02/2026-11-04/runs")).unwrap();
    fs::write(at.join("r02/2026-11-04/robot.toml"), "name = 7\n").unwrap();
}

#[test]
fn answers_that_travelled_as_bytes_make_the_same_files_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let (logs_at, store_at) = (folder.path().join("logs"), folder.path().join("season"));
    logs(&logs_at);
    let sessions = find(&[logs_at]).unwrap();
    let knobs = Knobs { equations: true, ..Knobs::default() };
    let options =
        FleetOptions { knobs: knobs.clone(), jobs: 2, reports: None, progress: &|_| {}, told_to_end: &|| false };
    let tally = diagnose_fleet(&sessions, &mut Store::open(&store_at).unwrap(), &options).unwrap();
    assert_eq!((tally.done, tally.failed, tally.left), (3, 1, 0));

    let memory = Memory::default();
    let mut store = Store::of(Box::new(memory.clone())).unwrap();
    for session in sessions.iter().rev() {
        let answer = answer_session(session, None, &knobs, None).unwrap().unwrap();
        let travelled = SessionAnswer::of_parquet(answer.to_parquet().unwrap()).unwrap();
        assert_eq!(travelled, answer);
        store.put(travelled).unwrap();
    }
    store.flush().unwrap();
    let on_disk = Folder::to_read(&store_at);
    let names: Vec<String> =
        ["sessions", "causes", "equations"].iter().flat_map(|table| on_disk.files(table).unwrap()).collect();
    let told: BTreeMap<String, Vec<u8>> =
        names.into_iter().map(|name| (name.clone(), on_disk.read(&name).unwrap().unwrap())).collect();
    assert_eq!(told.len(), 7, "{:?}", told.keys());
    assert!(told == *memory.0.lock().unwrap(), "the bytes are others");

    for session in &sessions {
        let key = store.session(&session.name).unwrap().key.clone();
        assert!(
            answer_session(session, Some(&key), &knobs, None).unwrap().is_none(),
            "{}: it is as it was",
            session.name
        );
    }
    assert!(fleet_report(&memory, &Default::default()).is_ok());
}

#[test]
fn bytes_of_no_session_are_refused() {
    let none = || [Vec::new(), Vec::new(), Vec::new()];
    let told = SessionAnswer::of_parquet(none()).unwrap_err().to_string();
    assert!(told.contains("sessions") && told.contains("Send the three files"), "{told}");
}
