//! Names with spaces, ends of lines and bytes that are no Unicode; names that would lead elsewhere.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;

use super::fault::Fault;
use super::outcome::{Outcome, answered, refused};
use super::scene::{Scene, odd_name};

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "spaces, a newline, no Unicode: names of session, runs and output", inject: odd_names },
    Fault { what: "the same: a run that cannot be read", inject: an_odd_run_that_is_refused },
    Fault { what: "the same: files of a run that is a folder", inject: an_odd_folder_of_files },
    Fault { what: "the same: two sessions of a fleet that differ in bytes that are no Unicode", inject: odd_twins },
    Fault { what: "a robot named `../../x`, in a fleet", inject: a_robot_that_leads_out },
    Fault { what: "a robot with a name of 5,000 letters, in a fleet", inject: a_robot_with_a_long_name },
];

fn odd_names(scene: &Scene) -> io::Result<Outcome> {
    let (session, out) = (odd_name("session"), odd_name("out"));
    scene.add_session(&session, 1)?;
    let runs = scene.at(Path::new(&session).join("runs"));
    fs::rename(runs.join("run01.csv"), runs.join(odd_name("run")).with_extension("csv"))?;
    let asked = scene.asked(&["diagnose".as_ref(), session.as_os_str(), "--out".as_ref(), out.as_os_str()]);
    let outcome = answered(scene, &asked)?;
    let there = scene.at(&out).join("report.json").is_file();
    Ok(outcome.promising(there, "the report is in the folder of that name"))
}

fn an_odd_run_that_is_refused(scene: &Scene) -> io::Result<Outcome> {
    scene.write(Path::new("session/runs").join(odd_name("run")).with_extension("csv"), b"t_s\n")?;
    refused(scene, &scene.check(), &["session/runs/run a\\nb", "found no signal"])
}

fn an_odd_folder_of_files(scene: &Scene) -> io::Result<Outcome> {
    let text = scene.read("session/runs/run01.csv")?;
    fs::remove_dir_all(scene.at("session/runs"))?;
    let name = odd_name("log");
    scene.write(Path::new("session/runs/drive").join(&name).with_extension("csv"), text.as_bytes())?;
    scene.write("session/columns.toml", b"[[file]]\nname = \"log*.csv\"\n")?;
    answered(scene, &scene.check())
}

fn odd_twins(scene: &Scene) -> io::Result<Outcome> {
    for (end, seed) in [(b"\xfe", 1), (b"\xff", 2)] {
        let name = OsStr::from_bytes(&[&b"logs/r01/2026-11-01 "[..], end].concat()).to_owned();
        scene.add_session(name, seed)?;
    }
    let asked = scene.fleet("logs");
    asked.run()?;
    let outcome = answered(scene, &asked)?;
    let known = outcome.happens.contains("0 diagnosed now, 2 known already");
    Ok(outcome.promising(known, "both are known when asked again").noting("asked a second time"))
}

fn named(scene: &Scene, name: &str) -> io::Result<()> {
    let text = scene.read("session/robot.toml")?;
    let of_name =
        |line: &str| if line.starts_with("name = ") { format!("name = {name:?}\n") } else { format!("{line}\n") };
    scene.write("session/robot.toml", text.lines().map(of_name).collect::<String>().as_bytes()).map(drop)
}

fn a_robot_that_leads_out(scene: &Scene) -> io::Result<Outcome> {
    named(scene, "../../x")?;
    let before = fs::read_dir(scene.at("."))?.count();
    let outcome = answered(scene, &scene.fleet("session"))?;
    let within =
        fs::read_dir(scene.at("."))?.count() == before + 1 && scene.at("season/sessions/robot=..%2F..%2Fx").is_dir();
    Ok(outcome.promising(within, "all of it is in the store").noting("its tables are in `robot=..%2F..%2Fx`"))
}

fn a_robot_with_a_long_name(scene: &Scene) -> io::Result<Outcome> {
    named(scene, &"x".repeat(5_000))?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    let done = outcome.happens.contains("1 diagnosed now");
    Ok(outcome.promising(done, "it has an answer").noting("its tables' folder has the name's beginning and a hash"))
}
