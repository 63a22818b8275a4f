//! A disk that is full, and folders that take no files.

use std::fs;
use std::io;
use std::os::unix::fs::{FileTypeExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use rustix::fs::{CWD, FileType, Mode, makedev, mknodat};
use rustix::process::geteuid;

use super::fault::Fault;
use super::kills::contents;
use super::outcome::{Outcome, answered, half_written_in, refused, refused_on_the_way};
use super::process::Asked;
use super::scene::{RUN, Scene};

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "disk full: no file of a report can be written", inject: no_room_for_a_report },
    Fault { what: "disk full: a report stands there already", inject: no_room_beside_a_report },
    Fault { what: "disk full: a file system of 64 kB for the report", inject: a_small_file_system },
    Fault { what: "disk full: the run's file", inject: no_room_for_a_run },
    Fault { what: "disk full: the output is a device that is full", inject: a_full_device },
    Fault { what: "disk full: the answer on standard output", inject: no_room_for_the_answer },
    Fault { what: "disk full: a fleet's tables and reports", inject: no_room_for_a_fleet },
    Fault { what: "disk full: the same fleet, once there is room", inject: room_for_a_fleet_again },
    Fault { what: "read-only folder", inject: a_folder_that_takes_nothing },
    Fault { what: "read-only folder for a fleet", inject: a_folder_that_takes_no_fleet },
    Fault { what: "a file in place of the output folder", inject: a_file_for_a_folder },
    Fault { what: "the output is a pipe", inject: a_pipe },
];

/// Blocks of a file system's file at the most: half of the smallest file of a report.
const BLOCKS: u32 = 4;

fn diagnosed(scene: &Scene) -> Asked {
    scene.asked(&["diagnose", "session", "--out", "report"])
}

fn no_room_for_a_report(scene: &Scene) -> io::Result<Outcome> {
    refused(scene, &diagnosed(scene).with_files_of(BLOCKS), &["report/report.json", "cannot be written", "--out"])
}

fn no_room_beside_a_report(scene: &Scene) -> io::Result<Outcome> {
    diagnosed(scene).run()?;
    let before = contents(&scene.at("report"));
    scene.add_session("session", 2)?;
    let outcome = refused(scene, &diagnosed(scene).with_files_of(BLOCKS), &["report/report.json"])?;
    let after = contents(&scene.at("report"));
    Ok(outcome
        .promising(!before.is_empty() && before == after, "the older report is as it was")
        .noting("the older report stays"))
}

fn a_small_file_system(scene: &Scene) -> io::Result<Outcome> {
    fs::create_dir(scene.at("small"))?;
    let mounted = "mount -t tmpfs -o size=64k none small";
    let within = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["-Urm", "sh", "-c", script]).current_dir(scene.at("."));
        command
    };
    if !within(mounted).output().is_ok_and(|done| done.status.success()) {
        return Ok(Outcome::not_staged("this user may not mount a file system"));
    }
    let asked = scene.asked(&["diagnose", "session", "--out", "small/report"]);
    // what is left behind is told before the file system goes away with its last process
    let look = format!("{mounted} && {{ \"$0\" \"$@\"; code=$?; ls -A small; exit $code; }}");
    let asked = asked.through(&["unshare", "-Urm", "sh", "-c", &look]);
    let outcome = refused(scene, &asked, &["small/report/", "No space left", "--out"])?;
    // seen was the shell that ran it
    Ok(Outcome { megabytes: None, ..outcome })
}

fn no_room_for_a_run(scene: &Scene) -> io::Result<Outcome> {
    refused(scene, &simulated(scene, "s.csv").with_files_of(BLOCKS), &["s.csv", "cannot be written", "space"])
}

/// The device that is always full, as a device of the scene: what a program does to it, it does not do to the system's own.
fn a_full_device(scene: &Scene) -> io::Result<Outcome> {
    let (place, mode) = (scene.at("full"), Mode::RUSR | Mode::WUSR);
    let made = mknodat(CWD, &place, FileType::CharacterDevice, mode, makedev(1, 7));
    if made.is_err() || fs::write(&place, b"").is_err() {
        return Ok(Outcome::not_staged("this user may not make a device; standard output below is one that is full"));
    }
    refused(scene, &simulated(scene, "full"), &["full: cannot be written", "No space left"])
}

fn simulated(scene: &Scene, out: &str) -> Asked {
    scene.asked(&["simulate", "session/robot.toml", "--input", RUN, "--noise", "false", "--out", out])
}

fn no_room_for_the_answer(scene: &Scene) -> io::Result<Outcome> {
    refused(scene, &scene.check().answering_to(Path::new("/dev/full")), &["standard output", "No space left"])
}

fn no_room_for_a_fleet(scene: &Scene) -> io::Result<Outcome> {
    let outcome =
        refused_on_the_way(scene, &scene.fleet("session").with_files_of(BLOCKS), &["season/", "cannot be written"])?;
    let left = half_written_in(&scene.at("season"));
    Ok(outcome.promising(left.is_empty(), &format!("nothing half-written: {left:?}")))
}

fn room_for_a_fleet_again(scene: &Scene) -> io::Result<Outcome> {
    scene.fleet("session").with_files_of(BLOCKS).run()?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    let done = outcome.happens.contains("1 diagnosed now, 0 known already");
    Ok(outcome.promising(done, "what there was no room for is done now"))
}

/// A folder that nobody can write to, not even who may do all else.
fn closed(scene: &Scene) -> io::Result<PathBuf> {
    if geteuid().is_root() {
        return Ok(PathBuf::from("/sys"));
    }
    let folder = scene.at("closed");
    fs::create_dir(&folder)?;
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555))?;
    Ok(folder)
}

fn a_folder_that_takes_nothing(scene: &Scene) -> io::Result<Outcome> {
    let out = closed(scene)?.join("report");
    let asked = scene.asked(&["diagnose".as_ref(), "session".as_ref(), "--out".as_ref(), out.as_os_str()]);
    refused(scene, &asked, &["report", "cannot be written", "--out"])
}

fn a_folder_that_takes_no_fleet(scene: &Scene) -> io::Result<Outcome> {
    let out = closed(scene)?.join("season");
    let asked = scene.asked(&["fleet".as_ref(), "session".as_ref(), "--out".as_ref(), out.as_os_str()]);
    refused(scene, &asked, &["season", "cannot be written", "--out"])
}

fn a_file_for_a_folder(scene: &Scene) -> io::Result<Outcome> {
    scene.write("report", b"mine")?;
    refused(scene, &diagnosed(scene), &["report", "it is a file, not a folder", "--out"])
}

fn a_pipe(scene: &Scene) -> io::Result<Outcome> {
    let place = scene.at("pipe.csv");
    mknodat(CWD, &place, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0)?;
    let reader = thread::spawn({
        let place = place.clone();
        move || fs::read_to_string(place)
    });
    let outcome = answered(scene, &simulated(scene, "pipe.csv"))?;
    let is_pipe = fs::metadata(&place)?.file_type().is_fifo();
    let outcome = outcome.promising(is_pipe, "it is a pipe still").noting("written into, not replaced");
    if !is_pipe {
        return Ok(outcome);
    }
    let read = reader.join().unwrap_or_else(|_| Ok(String::new()))?;
    simulated(scene, "s.csv").run()?;
    Ok(outcome.promising(read == scene.read("s.csv")?, "what is read is what a file would hold"))
}
