//! Files of a session: what the diagnosis reads.

use std::path::Path;

use model_core::link::framing::FrameKind;
use model_core::link::record::TelemetryRecord;
use omni_gap::check::check;
use omni_gap::error::Error;
use omni_gap::fleet::{Folder, fleet_report};
use omni_gap::log::{Columns, RobotFile};
use omni_gap::pooling::PoolingKnobs;
use omni_gap::{Session, known_effects};

use crate::answer::Answer;
use crate::seeds::{FLEET_DAY, ROBOT, TABLE, TOPICS, VISION, framed, hello};

/// Refused with the message that a person reads, the place of the file left out.
fn refused(why: &Error, folder: &Path) -> Answer {
    Answer::Refused(why.to_string().replace(&folder.display().to_string(), "session"))
}

/// `robot.toml`, whose text it is.
pub fn robot(bytes: &[u8]) -> Answer {
    text(bytes, |text| RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).map(drop))
}

/// `columns.toml`, whose text it is.
pub fn columns(bytes: &[u8]) -> Answer {
    text(bytes, |text| Columns::parse(text, Path::new("columns.toml")).map(drop))
}

fn text(bytes: &[u8], parse: impl Fn(&str) -> Result<(), Error>) -> Answer {
    match parse(&String::from_utf8_lossy(bytes)) {
        Ok(()) => Answer::Taken,
        Err(why) => refused(&why, Path::new("/nowhere")),
    }
}

/// A run as a table of text.
pub fn csv(bytes: &[u8]) -> Answer {
    run("run.csv", bytes, None)
}

/// A run as a table in Parquet.
pub fn parquet(bytes: &[u8]) -> Answer {
    run("run.parquet", bytes, Some(TABLE))
}

/// A run as topics in MCAP.
pub fn mcap(bytes: &[u8]) -> Answer {
    run("run.mcap", bytes, Some(&TOPICS.concat()))
}

/// A run as topics in a bag of ROS 1.
pub fn bag(bytes: &[u8]) -> Answer {
    run("run.bag", bytes, Some(&TOPICS.concat()))
}

/// A run as topics in a database of ROS 2.
pub fn sqlite(bytes: &[u8]) -> Answer {
    run("run.db3", bytes, Some(&TOPICS.concat()))
}

/// A game log of SSL-Vision.
pub fn vision(bytes: &[u8]) -> Answer {
    run("game.log", bytes, Some(VISION))
}

/// A robot's records.
pub fn records(bytes: &[u8]) -> Answer {
    run("run.rec", bytes, None)
}

/// A robot's records whose frames are whole: the bytes are what they carry, after a hello that is as sound as a robot's.
pub fn payloads(bytes: &[u8]) -> Answer {
    let records = bytes.chunks(TelemetryRecord::BYTES).flat_map(|payload| framed(FrameKind::Record.code(), payload));
    run("run.rec", &hello().into_iter().chain(records).collect::<Vec<u8>>(), None)
}

/// The table of a fleet's sessions.
pub fn fleet(bytes: &[u8]) -> Answer {
    let store = tempfile::tempdir().expect("a folder");
    let day = store.path().join(FLEET_DAY);
    std::fs::create_dir_all(&day).expect("room for a folder");
    std::fs::write(day.join("part.parquet"), bytes).expect("room for a file");
    match fleet_report(&Folder::to_read(store.path()), &PoolingKnobs::default()) {
        Ok(_) => Answer::Taken,
        Err(why) => refused(&why, store.path()),
    }
}

/// A session of three wheels with this one run, read and looked at as the diagnosis does before it fits anything.
fn run(name: &str, bytes: &[u8], columns: Option<&str>) -> Answer {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("room for a file");
        path
    };
    let robot = write("robot.toml", ROBOT.as_bytes());
    let mapping = columns.map(|text| write("columns.toml", text.as_bytes()));
    let path = write(name, bytes);
    match Session::load_from(&robot, mapping.as_deref(), &[path], &known_effects()) {
        Ok(session) => {
            check(&session);
            Answer::Taken
        }
        Err(why) => refused(&why, folder.path()),
    }
}
