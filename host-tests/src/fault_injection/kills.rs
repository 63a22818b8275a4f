//! A command that is killed (SIGKILL), and asked again.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::process::{Asked, Running};
use super::scene::{Scene, below};
use super::whole::{amiss, is_unfinished};

/// What came of many kills.
#[derive(Clone, Debug)]
pub struct Kills {
    /// What was asked, as a person types it.
    pub command: String,
    /// How long it takes when nobody kills it \[s\]: the shortest time seen, for the first run also waits for the disk.
    pub seconds: f64,
    /// How often it was to be killed.
    pub tried: usize,
    /// How often it ran still, and so was.
    pub killed: usize,
    /// Kills after which a file was left that was not finished.
    pub unfinished: usize,
    /// Promises that were not kept.
    pub broken: Vec<String>,
}

/// When it is killed.
#[derive(Clone, Copy, Debug)]
enum Moment {
    /// So long after its start.
    After(Duration),
    /// As soon as it writes a file.
    AtAFile,
}

/// What ends before its moment comes is tried again, up to so many times as often.
const MOST_TRIED: usize = 4;

/// How often it is looked whether a file is being written.
const LOOK: Duration = Duration::from_micros(50);

/// Kills a diagnosis so often: its first report and its later ones in turns.
///
/// # Errors
/// Where it cannot be run.
pub fn of_a_diagnosis(program: &Path, random: usize, at_files: usize) -> io::Result<Kills> {
    let scene = Scene::new(program)?;
    let asked = scene.asked(&["diagnose", "session", "--out", "out"]);
    many(&scene, &asked, [random, at_files], 2)
}

/// Kills a fleet of two sessions so often, which goes on where it was.
///
/// # Errors
/// Where it cannot be run.
pub fn of_a_fleet(program: &Path, random: usize, at_files: usize) -> io::Result<Kills> {
    let scene = Scene::new(program)?;
    scene.add_session("logs/r01/2026-11-01", 1)?;
    scene.add_session("logs/r02/2026-11-02", 2)?;
    let asked = scene.asked(&["fleet", "logs", "--out", "out"]);
    many(&scene, &asked, [random, at_files], 1)
}

/// Of so many runs one begins with no output.
fn many(scene: &Scene, asked: &Asked, [random, at_files]: [usize; 2], anew: usize) -> io::Result<Kills> {
    let out = scene.at("out");
    let ended = asked.run()?;
    let whole = contents(&out);
    let command = scene.shortened(&asked.typed());
    let mut kills = Kills { command, seconds: ended.seconds, tried: 0, killed: 0, unfinished: 0, broken: Vec::new() };
    if ended.code != Some(0) || whole.is_empty() {
        kills.broken.push(format!("it does nothing that could be killed: {}", ended.err));
        return Ok(kills);
    }
    let mut moments = ChaCha8Rng::seed_from_u64(17);
    while kills.killed < random + at_files && kills.tried < MOST_TRIED * (random + at_files) {
        let k = kills.tried;
        kills.tried += 1;
        let moment = match kills.killed < random {
            true => Moment::After(Duration::from_secs_f64(kills.seconds * moments.random_range(0.0..1.0))),
            false => Moment::AtAFile,
        };
        if k.is_multiple_of(anew) {
            fs::remove_dir_all(&out)?;
        }
        let mut running = asked.start()?;
        wait(&mut running, moment, &out)?;
        let is_killed = running.runs()?;
        running.kill()?;
        let ended = running.end()?;
        match is_killed {
            true => kills.killed += 1,
            false => kills.seconds = kills.seconds.min(ended.seconds),
        }
        let mut left = BTreeSet::new();
        below(&out, &mut left);
        kills.unfinished += usize::from(left.iter().any(|path| is_unfinished(path)));
        let half = left.iter().filter(|path| !is_unfinished(path)).filter_map(|path| amiss(path));
        kills.broken.extend(half.map(|why| format!("after kill {k}: {why}")));
        let again = asked.run()?;
        if again.code != Some(0) || !again.err.is_empty() {
            kills.broken.push(format!("after kill {k} it does not go on: {}", again.err));
        }
        if contents(&out) != whole {
            kills.broken.push(format!("after kill {k} the bytes are others"));
        }
    }
    kills.broken.iter_mut().for_each(|broken| *broken = scene.shortened(broken));
    Ok(kills)
}

/// Waits until it is to be killed, or has ended.
fn wait(running: &mut Running, moment: Moment, out: &Path) -> io::Result<()> {
    let begun = Instant::now();
    while running.runs()? {
        let mut files = BTreeSet::new();
        let is_time = match moment {
            Moment::After(pause) => begun.elapsed() >= pause,
            Moment::AtAFile => {
                below(out, &mut files);
                files.iter().any(|path| is_unfinished(path))
            }
        };
        if is_time {
            break;
        }
        thread::sleep(LOOK);
    }
    Ok(())
}

/// The bytes of all files below a folder.
pub fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeSet::new();
    below(folder, &mut all);
    let files = all.into_iter().filter(|path| path.is_file());
    files.filter_map(|path| Some((path.strip_prefix(folder).ok()?.to_owned(), fs::read(&path).ok()?))).collect()
}
