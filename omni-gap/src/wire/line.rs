//! A line to a robot: commands one way, what it says the other.

use std::fmt;
use std::path::PathBuf;
use std::time::Instant;

use model_core::link::command::Command;
use model_core::link::framing::{FrameDecoder, MAX_FRAME};
use model_core::link::message::Message;

use super::source::{CABLE, Look, Source, Stream};
use crate::error::{Error, InputKind, Result};

/// An open line to a robot.
pub struct Line {
    stream: Box<dyn Stream>,
    decoder: FrameDecoder,
    source: Source,
    kept: Option<Vec<u8>>,
}

impl fmt::Debug for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Line").field("source", &self.source).finish_non_exhaustive()
    }
}

impl Line {
    /// Opens the line to a robot.
    ///
    /// # Errors
    /// Where there is no such device or address, or it is a file.
    pub fn open(source: &Source, baud: u32) -> Result<Self> {
        let stream = source.connect(baud)?;
        Ok(Self { stream, decoder: FrameDecoder::default(), source: source.clone(), kept: None })
    }

    /// Keeps every byte that comes from now on.
    pub fn keep(&mut self) {
        self.kept.get_or_insert_default();
    }

    /// The bytes that were kept.
    pub fn kept(&self) -> &[u8] {
        self.kept.as_deref().unwrap_or_default()
    }

    /// Its name for messages.
    pub fn place(&self) -> PathBuf {
        self.source.place()
    }

    /// A mistake about the robot at its other end.
    pub fn error(&self, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        self.source.error(problem, fix)
    }

    /// Sends a command.
    ///
    /// # Errors
    /// Where the line is broken.
    pub fn send(&mut self, command: &Command) -> Result<()> {
        let mut room = [0; MAX_FRAME];
        let frame = command.frame(&mut room).unwrap_or_default();
        let sent = self.stream.write_all(frame).and_then(|()| self.stream.flush());
        sent.map_err(|why| match self.source.was_closed(&why) {
            true => self.closed(),
            false => self.error(format!("cannot be written to: {why}"), CABLE),
        })
    }

    /// Listens until a time; `take` is told what comes, and ends it before with an answer.
    ///
    /// # Errors
    /// Where the line is broken or closed.
    pub fn listen<T>(&mut self, until: Instant, mut take: impl FnMut(Message) -> Option<T>) -> Result<Option<T>> {
        let mut bytes = [0; 1 << 12];
        while Instant::now() < until {
            let count = match self.source.look(&mut *self.stream, &mut bytes)? {
                Look::Bytes(count) => count,
                Look::Nothing => 0,
                Look::End => return Err(self.closed()),
            };
            let bytes = bytes.get(..count).unwrap_or_default();
            self.kept.iter_mut().for_each(|kept| kept.extend(bytes));
            for byte in bytes {
                let frame = self.decoder.push(*byte);
                let message = frame.and_then(|frame| Message::decode(frame.kind, frame.payload));
                if let Some(answer) = message.and_then(&mut take) {
                    return Ok(Some(answer));
                }
            }
        }
        Ok(None)
    }

    fn closed(&self) -> Error {
        self.error("the other side closed the line", "Start what listens there again").of_kind(InputKind::Unreadable)
    }
}
