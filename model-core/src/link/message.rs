//! # Message: what a robot says
//!
//! The other direction of [`command`](super::command): what a turn left behind, who the robot is, and answers.

use crate::link::command::Reply;
use crate::link::framing::FrameKind;
use crate::link::hello::Hello;
use crate::link::probe::ProbeReport;
use crate::link::record::TelemetryRecord;

/// What a robot says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Message {
    /// What a turn of its loop left behind.
    Record(TelemetryRecord),
    /// Who it is, and how to read its records.
    Hello(Hello),
    /// An answer to a command.
    Reply(Reply),
    /// What was measured under a probe.
    ProbeReport(ProbeReport),
}

impl Message {
    /// Reads the payload of a frame; `None` where it is nothing that a robot says.
    pub fn decode(kind: u8, payload: &[u8]) -> Option<Message> {
        match FrameKind::from_code(kind)? {
            FrameKind::Record => TelemetryRecord::from_bytes(payload).map(Message::Record),
            FrameKind::Hello => Hello::from_bytes(payload).map(Message::Hello),
            FrameKind::Reply => Reply::from_bytes(payload).map(Message::Reply),
            FrameKind::ProbeReport => ProbeReport::from_bytes(payload).map(Message::ProbeReport),
            FrameKind::Drive
            | FrameKind::Open
            | FrameKind::Clear
            | FrameKind::Chunk
            | FrameKind::Commit
            | FrameKind::Probe
            | FrameKind::DriveRamp => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_robot_says_is_read_and_what_it_is_told_is_not() {
        let reply = Reply { to: FrameKind::Clear.code(), taken: true, reason: 0 };
        let record = TelemetryRecord { sequence: 7, time: 140, ..TelemetryRecord::default() };
        assert_eq!(Message::decode(FrameKind::Reply.code(), &reply.to_bytes()), Some(Message::Reply(reply)));
        assert_eq!(Message::decode(FrameKind::Record.code(), &record.to_bytes()), Some(Message::Record(record)));
        // of another length, of a command, of no kind
        assert_eq!(Message::decode(FrameKind::Hello.code(), &record.to_bytes()), None);
        assert_eq!(Message::decode(FrameKind::Drive.code(), &reply.to_bytes()), None);
        assert_eq!(Message::decode(0x7f, &reply.to_bytes()), None);
    }
}
