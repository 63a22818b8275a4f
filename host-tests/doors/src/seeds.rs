//! Sound bytes for every door, from which the spoiled ones are made.

use std::path::{Path, PathBuf};

use model_core::control::calibration::{AdcCode, Calibration};
use model_core::geometry::frames::BodyTwist;
use model_core::link::command::{Command, MAX_CHUNK};
use model_core::link::framing::{FrameKind, MAX_FRAME, encode_frame};
use model_core::link::hello::{Commutation, Hello, OFFSET_PARTS};
use model_core::link::record::TelemetryRecord;
use model_core::link::sensor_codes::SensorScales;
use omni_gap::engine::Knobs;
use omni_gap::fleet::{FleetOptions, Store, diagnose_fleet, find};
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::wire::block::export;

/// A robot of three wheels.
pub const ROBOT: &str = include_str!("../../../examples/feup-3w/robot.toml");

/// What the topics of a robot with ROS mean.
pub const TOPICS: [&str; 2] = [
    include_str!("../../../omni-gap/tests/recordings/columns/topics.toml"),
    include_str!("../../../omni-gap/tests/recordings/columns/pose.toml"),
];

/// What the columns of a table mean.
pub const TABLE: &str = include_str!("../../../omni-gap/tests/recordings/columns/table.toml");

/// One robot of a game log.
pub const VISION: &str = include_str!("../../../omni-gap/tests/recordings/columns/vision.toml");

/// Sound bytes for the door with this name.
///
/// # Panics
/// Where a recording of the tests is missing.
pub fn seeds(door: &str) -> Vec<Vec<u8>> {
    let texts = |texts: &[&str]| texts.iter().map(|text| text.as_bytes().to_vec()).collect();
    match door {
        "robot" => texts(&[ROBOT, include_str!("../../../examples/ssl-24v/robot.toml")]),
        "columns" => texts(&[TOPICS.concat().as_str(), TABLE, VISION]),
        "csv" => vec![run()],
        "parquet" => recordings(&["table-none.parquet", "table-zstd.parquet", "table-brotli.parquet"]),
        "mcap" => recordings(&["ros2-zstd.mcap", "ros2-lz4.mcap"]),
        "bag" => recordings(&["ros1-lz4.bag", "ros1-bz2.bag"]),
        "sqlite" => recordings(&["ros2-sqlite-foxy/ros2-sqlite-foxy.db3"]),
        "vision" => recordings(&["vision/game.log", "vision/game.log.gz"]),
        "records" => vec![records()],
        "payloads" => vec![(0..10).flat_map(|k| record(k).to_bytes().to_vec()).collect()],
        "fleet" => vec![sessions_of_a_fleet()],
        "frames" => vec![records(), commands()],
        "block" => vec![block()],
        _ => Vec::new(),
    }
}

/// A robot's day in the table of a fleet's sessions.
pub const FLEET_DAY: &str = "sessions/robot=r01/date=2026-11-03";

/// That table, of two sessions that cannot be read: they need no diagnosis.
fn sessions_of_a_fleet() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["a", "b"] {
        let session = folder.path().join("logs/r01/2026-11-03").join(name);
        std::fs::create_dir_all(session.join("runs")).expect("room for a folder");
        std::fs::write(session.join("robot.toml"), "name = 7\n").expect("room for a file");
    }
    let options =
        FleetOptions { knobs: Knobs::default(), jobs: 1, reports: None, progress: &|_| {}, told_to_end: &|| false };
    let sessions = find(&[folder.path().join("logs")]).expect("two sessions");
    let store = folder.path().join("store");
    let mut opened = Store::open(&store).expect("a new store");
    diagnose_fleet(&sessions, &mut opened, &options).expect("a store that takes rows");
    std::fs::read(store.join(FLEET_DAY).join("part.parquet")).expect("a table")
}

/// Files that the formats' own libraries wrote.
fn recordings(names: &[&str]) -> Vec<Vec<u8>> {
    let folder: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../omni-gap/tests/recordings");
    names.iter().map(|name| std::fs::read(folder.join(name)).expect("a recording of the tests")).collect()
}

/// Half a second of a robot that drives.
fn run() -> Vec<u8> {
    let plan = Scenario { runs: 1, duration: 0.5, rate: 100.0, ..Scenario::default() };
    let staged = synthesize(ROBOT, &plan, &known_effects()).expect("the example is sound");
    let mut text = Vec::new();
    staged.runs[0].write_csv(&mut text).expect("memory takes all");
    text
}

/// How to read a robot's records, in its frame.
pub fn hello() -> Vec<u8> {
    let hello = Hello {
        firmware: 1,
        block_version: 1,
        block_check: 7,
        wheels: 3,
        commutation: Commutation::FieldOriented,
        calibration: Calibration::of_board(8),
        gear_ratio: 5.0,
        offsets: [[2048 * OFFSET_PARTS; 3]; 4],
        sensors: SensorScales::default(),
    };
    framed(FrameKind::Hello.code(), &hello.to_bytes())
}

/// The record of one turn, ten of which are a second.
fn record(sequence: u32) -> TelemetryRecord {
    TelemetryRecord {
        sequence,
        time: 2000 * sequence,
        phases: [[AdcCode(2048); 3]; 4],
        edges: [10 * sequence as i16; 4],
        interval: [200; 4],
        voltage: [1.5; 4],
        ..TelemetryRecord::default()
    }
}

/// What a robot sends: how to read its records, and a second of them, ten a second.
fn records() -> Vec<u8> {
    let records = (0..10).map(record).map(|record| framed(FrameKind::Record.code(), &record.to_bytes()));
    [hello()].into_iter().chain(records).flatten().collect()
}

/// A frame with this payload, and the right checksum.
pub fn framed(kind: u8, payload: &[u8]) -> Vec<u8> {
    encode_frame(kind, payload, &mut [0; MAX_FRAME]).map_or_else(Vec::new, <[u8]>::to_vec)
}

/// What a robot is told: to take a block, to drive, to stop.
fn commands() -> Vec<u8> {
    let block = block();
    let chunk = Command::Chunk { offset: 0, bytes: &block[..MAX_CHUNK] };
    let drive = Command::Drive { sequence: 1, twist: BodyTwist { v: 0.5, vn: 0.0, w: 1.0 } };
    let commit = Command::Commit { length: block.len() as u16 };
    let frame = |command: Command<'_>| command.frame(&mut [0; MAX_FRAME]).map_or_else(Vec::new, <[u8]>::to_vec);
    [chunk, commit, drive, Command::Clear, Command::Open].into_iter().flat_map(frame).collect()
}

/// The block of the example's robot.
fn block() -> Vec<u8> {
    let path = Path::new("robot.toml");
    let file = RobotFile::parse(ROBOT, path, &known_effects()).expect("the example is sound");
    export(&file, path).expect("the example can be exported").bytes
}
