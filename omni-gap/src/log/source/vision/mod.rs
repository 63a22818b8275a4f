//! # Game logs of RoboCup's small size league: what SSL-Vision saw, a topic for each robot
//!
//! `yellow/3` is the yellow robot with the pattern 3. Its columns are named as the messages of SSL-Vision name them: `x`
//! and `y` in mm, `orientation` in rad. All cameras are merged, see [`track::Track`].

mod detection;
mod game_log;
mod track;

use super::opened::Source;
use super::suffix::ends_in;
use super::topic::{Seen, absent, the_only_one};
use crate::error::{Error, InputKind, Result};
use detection::{DetectionFrame, RobotName, WrapperPacket};
pub use game_log::Packet;
pub(crate) use game_log::write_game_log;
use game_log::{GameLog, MAGIC};
use prost::Message;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use track::{Track, row};

/// The type of messages that a robot's topic has.
pub(crate) const ROBOT_TYPE: &str = "SSL_DetectionRobot";

/// Suffixes of game logs: packed, and as they were written. Texts have the latter too.
const PACKED: &str = ".log.gz";
const PLAIN: &str = ".log";

/// How much of a file tells whether it is text (bytes).
const HEAD: u64 = 64;

/// Whether a file has a game log's name.
pub(super) fn is_named_as_one(path: &Path) -> bool {
    ends_in(path, &[PACKED, PLAIN])
}

/// Whether a file is to be read as a game log: by its name, and where texts have the same, by not being one.
pub(super) fn is_game_log(path: &Path) -> bool {
    ends_in(path, &[PACKED]) || ends_in(path, &[PLAIN]) && !is_text(path)
}

fn is_text(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.is_err() || !head.starts_with(MAGIC) && !head.contains(&0)
}

/// Whether a topic names a robot.
pub(crate) fn is_robot(topic: &str) -> bool {
    RobotName::of(topic).is_some()
}

/// The robots that a packet shows, as topics name them; none where it is no packet of SSL-Vision.
pub(crate) fn robots_in(packet: &[u8]) -> Vec<String> {
    let detection = WrapperPacket::decode(packet).ok().and_then(|packet| packet.detection);
    detection.iter().flat_map(DetectionFrame::robots).map(|(robot, _)| robot.to_string()).collect()
}

/// The robots that a game log has seen, and how often.
pub(super) fn topics(path: &Path) -> Result<Vec<Seen>> {
    let mut times: BTreeMap<RobotName, usize> = BTreeMap::new();
    frames(path, |_, frame| frame.robots().for_each(|(robot, _)| *times.entry(robot).or_default() += 1))?;
    let seen = |(robot, messages): (RobotName, usize)| Seen {
        topic: robot.to_string(),
        of_type: ROBOT_TYPE.to_owned(),
        messages,
    };
    Ok(times.into_iter().map(seen).collect())
}

/// Reads the track of one robot; of the only one where none is named.
pub(super) fn open(path: &Path, topic: Option<&str>) -> Result<Box<dyn Source>> {
    let topic = match topic {
        Some(topic) => topic.to_owned(),
        None => the_only_one(path, &topics(path)?)?,
    };
    let Some(wanted) = RobotName::of(&topic) else { return Err(absent(path, &topic, &topics(path)?)) };
    let mut rows = Vec::new();
    let notices = frames(path, |received_ns, frame| {
        let of_it = frame.robots().filter(|(robot, _)| *robot == wanted);
        rows.extend(of_it.map(|(_, robot)| row(received_ns, frame, robot)));
    })?;
    if rows.is_empty() {
        return Err(absent(path, &topic, &topics(path)?));
    }
    Ok(Box::new(Track::new(path, &topic, rows, notices)))
}

/// Hands over all frames of detections, each with the time at which it was received (ns); says what was amiss.
fn frames(path: &Path, mut take: impl FnMut(i64, &DetectionFrame)) -> Result<Vec<String>> {
    let (mut packets, mut unreadable) = (0, 0);
    let cut_off = GameLog::open(path)?.vision_packets(|record| {
        packets += 1;
        match WrapperPacket::decode(record.message.as_slice()).map(|packet| packet.detection) {
            // the geometry of the field
            Ok(None) => {}
            Ok(Some(frame)) if frame.t_capture.is_some_and(f64::is_finite) => take(record.received_ns, &frame),
            // whatever else is sent to the address that a recorder listens at
            Ok(Some(_)) | Err(_) => unreadable += 1,
        }
    })?;
    if packets > 0 && unreadable == packets {
        let problem = format!("none of its {packets} vision packets can be read as SSL_WrapperPacket");
        return Err(Error::input(path, problem, "Check that it is a log of SSL-Vision, or record it again")
            .of_kind(InputKind::Malformed));
    }
    let mut notices = Vec::new();
    if unreadable > 0 {
        notices.push(format!("{unreadable} of {packets} vision packets cannot be read, left out"));
    }
    notices.extend(cut_off.map(str::to_owned));
    Ok(notices.into_iter().map(|notice| format!("{}: {notice}", path.display())).collect())
}
