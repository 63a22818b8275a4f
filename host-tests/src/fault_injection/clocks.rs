//! Clocks that were set back or never set, as files' times show them.

use std::fs::File;
use std::io;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::fault::Fault;
use super::outcome::{Outcome, answered};
use super::scene::Scene;

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "clock: recordings from before 1970, in a fleet", inject: before_1970 },
    Fault { what: "clock: recordings from the year 2400, in a fleet", inject: far_in_the_future },
    Fault { what: "clock: set back by a year between two runs of a fleet", inject: set_back },
    Fault { what: "clock: a recording that changed and kept its time and length", inject: changed_at_the_same_time },
];

const YEAR: Duration = Duration::from_secs(365 * 86_400);

fn stamp(scene: &Scene, at: SystemTime) -> io::Result<()> {
    for run in ["run00", "run01", "run02"] {
        File::options().append(true).open(scene.at(format!("session/runs/{run}.csv")))?.set_modified(at)?;
    }
    Ok(())
}

/// The day that the session was put down under, which has to be this one.
fn on(scene: &Scene, outcome: Outcome, day: &str) -> Outcome {
    let folder = scene.at(format!("season/sessions/robot=feup-4w/date={day}"));
    outcome.promising(folder.is_dir(), &format!("its day is {day}")).noting(&format!("its day is {day}"))
}

fn before_1970(scene: &Scene) -> io::Result<Outcome> {
    stamp(scene, UNIX_EPOCH - 10 * YEAR)?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    Ok(on(scene, outcome, "1960-01-04"))
}

fn far_in_the_future(scene: &Scene) -> io::Result<Outcome> {
    stamp(scene, UNIX_EPOCH + 430 * YEAR)?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    Ok(on(scene, outcome, "2399-09-19"))
}

fn set_back(scene: &Scene) -> io::Result<Outcome> {
    scene.fleet("session").run()?;
    stamp(scene, SystemTime::now() - YEAR)?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    let known = outcome.happens.contains("0 diagnosed now, 1 known already");
    Ok(outcome.promising(known, "bytes count, not times").noting("bytes count, not times"))
}

fn changed_at_the_same_time(scene: &Scene) -> io::Result<Outcome> {
    let at = UNIX_EPOCH + 50 * YEAR;
    stamp(scene, at)?;
    scene.fleet("session").run()?;
    let run = "session/runs/run01.csv";
    let text = scene.read(run)?;
    let last = text.trim_end().len() - 1;
    let other = if text.as_bytes()[last] == b'1' { "2" } else { "1" };
    scene.write(run, [&text[..last], other, &text[last + 1..]].concat().as_bytes())?;
    stamp(scene, at)?;
    let outcome = answered(scene, &scene.fleet("session"))?;
    let again = outcome.happens.contains("1 diagnosed now, 0 known already");
    Ok(outcome.promising(again, "the change is seen").noting("the change is seen"))
}
