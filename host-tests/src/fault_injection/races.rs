//! Two programs at one output, and recordings that change while they are read.

use std::fs::{self, File};
use std::io::{self, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;
use std::thread;
use std::time::Duration;

use rustix::fs::{CWD, FileType, Mode, OFlags, mknodat};

use super::fault::Fault;
use super::kills::contents;
use super::outcome::{Outcome, half_written_in, refusal, unkept};
use super::process::{Asked, Ended, Running};
use super::scene::{RUN, Scene};

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "two processes on the same output: diagnoses of two sessions", inject: two_diagnoses },
    Fault { what: "two processes on the same output: fleets", inject: two_fleets },
    Fault { what: "a recording that is cut off while it is read", inject: cut_off },
    Fault { what: "a recording that grows while it is read", inject: growing },
    Fault { what: "a recording that is replaced by another while it is read", inject: replaced },
];

/// How often it is looked whether the program reads.
const LOOK: Duration = Duration::from_millis(1);

/// What two runs came to, told as the one that ended last.
fn of_two(scene: &Scene, asked: &Asked, ended: [&Ended; 2]) -> Outcome {
    let broken = ended.into_iter().flat_map(unkept).collect();
    let worse = if ended[0].code == Some(0) { ended[1] } else { ended[0] };
    Outcome::of(scene, asked, worse, broken)
}

fn two_diagnoses(scene: &Scene) -> io::Result<Outcome> {
    scene.add_session("other", 2)?;
    let to = |session: &'static str, out: &'static str| scene.asked(&["diagnose", session, "--out", out]);
    to("session", "first").run()?;
    to("other", "second").run()?;
    let alone = ["first", "second"].map(|out| contents(&scene.at(out)));
    let mut outcomes = Vec::new();
    for _ in 0..5 {
        let running = [to("session", "both").start()?, to("other", "both").start()?];
        let [first, second] = running.map(Running::end);
        let (first, second) = (first?, second?);
        let left = half_written_in(&scene.at("both"));
        let outcome = of_two(scene, &to("session", "both"), [&first, &second]);
        let outcome = outcome.promising(left.is_empty(), &format!("nothing half-written: {left:?}"));
        let both = [first.code, second.code] == [Some(0); 2];
        let outcome = outcome.promising(both, "both are done");
        let one = alone.contains(&contents(&scene.at("both")));
        outcomes.push(outcome.promising(one, "the files are those of one of the two"));
    }
    Ok(all_of(outcomes).noting("five times: all files are those of one of the two"))
}

/// One for all, with what was broken in any.
fn all_of(mut outcomes: Vec<Outcome>) -> Outcome {
    let broken = outcomes.iter().flat_map(|outcome| outcome.broken.clone()).collect();
    let last = outcomes.pop().unwrap_or_else(|| Outcome::not_staged("nothing ran"));
    Outcome { broken, ..last }
}

fn two_fleets(scene: &Scene) -> io::Result<Outcome> {
    for k in 1..=4 {
        scene.add_session(format!("logs/r0{k}/2026-11-01"), k)?;
    }
    let to = |out: &'static str| scene.asked(&["fleet", "logs", "--out", out]);
    to("alone").run()?;
    let running = [to("both").start()?, to("both").start()?];
    let [first, second] = running.map(Running::end);
    let (first, second) = (first?, second?);
    let outcome = of_two(scene, &to("both"), [&first, &second]);
    let refused = |ended: &&Ended| ended.code == Some(2) && ended.err.contains("another omni-gap fleet");
    let well = |ended: &&Ended| ended.code == Some(0) || refused(ended);
    let ended = [&first, &second];
    let outcome = outcome
        .promising(ended.iter().all(well) && !ended.iter().all(refused), "one is done, the other is done or refused");
    let same = contents(&scene.at("both")) == contents(&scene.at("alone"));
    Ok(outcome.promising(same, "the store is that of one alone").noting("of two, one; the store is that of one alone"))
}

/// Checks a run of two files. The second is a pipe: once the program opens it the first was read, and is changed before the second comes.
fn changed(scene: &Scene, change: fn(&Path) -> io::Result<()>) -> io::Result<Outcome> {
    let text = scene.read(RUN)?;
    fs::remove_dir_all(scene.at("session/runs"))?;
    let first = scene.write("session/runs/drive/a.csv", columns(&text, "w").as_bytes())?;
    let second = scene.at("session/runs/drive/b.csv");
    mknodat(CWD, &second, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0)?;
    scene.write("session/columns.toml", b"[[file]]\nname = \"a.csv\"\n\n[[file]]\nname = \"b.csv\"\n")?;
    let asked = scene.check();
    let mut running = asked.start()?;
    if let Some(mut pipe) = opened(&second, &mut running)? {
        change(&first)?;
        pipe.write_all(columns(&text, "u").as_bytes())?;
    }
    Ok(refusal(scene, &asked, &running.end()?, &["session/runs/drive/a.csv: it changed while it was read"]))
}

/// A pipe that the program reads from; none where it ends without.
fn opened(pipe: &Path, running: &mut Running) -> io::Result<Option<File>> {
    while running.runs()? {
        // without waiting, it can be opened only once somebody reads
        match File::options().write(true).custom_flags(OFlags::NONBLOCK.bits() as i32).open(pipe) {
            Ok(file) => return Ok(Some(file)),
            Err(_) => thread::sleep(LOOK),
        }
    }
    Ok(None)
}

/// The times of a run and the columns whose names begin so.
fn columns(text: &str, begins: &str) -> String {
    let header: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    let kept = |line: &str| {
        let fields = line.split(',').zip(&header).filter(|(_, name)| **name == "t_s" || name.starts_with(begins));
        fields.map(|(field, _)| field).collect::<Vec<_>>().join(",") + "\n"
    };
    text.lines().map(kept).collect()
}

fn cut_off(scene: &Scene) -> io::Result<Outcome> {
    changed(scene, |path| File::options().write(true).open(path)?.set_len(1000))
}

fn growing(scene: &Scene) -> io::Result<Outcome> {
    changed(scene, |path| File::options().append(true).open(path)?.write_all(b"2.005,1.25,0.5"))
}

fn replaced(scene: &Scene) -> io::Result<Outcome> {
    changed(scene, |path| {
        let other = path.with_extension("new");
        fs::write(&other, b"t_s,w0_rad_s,w1_rad_s,w2_rad_s,w3_rad_s\n0,1,1,1,1\n1,1,1,1,1\n")?;
        fs::rename(&other, path)
    })
}
