//! Probes over a line to a robot.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use model_core::link::command::Command;
use model_core::link::hello::Hello;
use model_core::link::message::Message;
use model_core::link::record::{OperatingState, TelemetryRecord};

use super::bench::ProbePort;
use crate::error::{Error, Result};
use crate::wire::line::Line;
use crate::wire::robot::hindrance;

/// What is waited for anything that a robot says: it speaks a thousand times a second.
const SILENT: Duration = Duration::from_millis(1000);

/// What is waited for it to be ready: the zeros of its sensors take 51 ms, and it says who it is once a second.
const READY: Duration = Duration::from_millis(4000);

/// A robot at the other end of a line, ready for probes.
#[derive(Debug)]
pub struct Connected<'a> {
    line: &'a mut Line,
    heard: VecDeque<Message>,
    /// Who it is
    pub hello: Hello,
}

/// Waits until a robot is ready to be commissioned.
///
/// # Errors
/// Where it has no parameters, is driven or has a fault; where nothing is heard of it.
pub fn connect(line: &mut Line) -> Result<Connected<'_>> {
    let (mut hello, mut last): (Option<Hello>, Option<TelemetryRecord>) = (None, None);
    let ready = line.listen(Instant::now() + READY, |message| {
        match message {
            Message::Hello(who) => hello = Some(who),
            Message::Record(record) => last = Some(record),
            Message::Reply(_) | Message::ProbeReport(_) => {}
        }
        hello.filter(|_| last.is_some_and(|record| record.state == OperatingState::Open))
    })?;
    if let Some(hello) = ready {
        return Ok(Connected { line, heard: VecDeque::new(), hello });
    }
    let Some(record) = last else {
        return Err(line.error("nothing is heard of a robot", "Check its power, the line, and --baud"));
    };
    let faults: Vec<&str> = record.faults.iter().map(|fault| fault.text()).collect();
    let (problem, fix) = match (hindrance(record.state, &faults), record.state) {
        (Some(hindrance), _) => hindrance,
        (None, OperatingState::Driving) => ("it is driven by another program".into(), "`omni-gap robot stop` first"),
        (None, _) => ("it does not come to rest with open bridges".into(), "Switch it off and on"),
    };
    Err(line.error(format!("the robot is not commissioned: {problem}"), fix))
}

impl ProbePort for Connected<'_> {
    fn send(&mut self, command: &Command) -> Result<()> {
        self.line.send(command)
    }

    fn next(&mut self) -> Result<Message> {
        let until = Instant::now() + SILENT;
        loop {
            if let Some(message) = self.heard.pop_front() {
                return Ok(message);
            }
            if Instant::now() >= until {
                let fix = "Check its power and the line; it opens its bridges by itself after 200 ms";
                return Err(self.line.error("the robot fell silent while it was commissioned", fix));
            }
            let heard = &mut self.heard;
            self.line.listen(Instant::now() + Duration::from_millis(1), |message| -> Option<()> {
                heard.push_back(message);
                None
            })?;
        }
    }

    fn error(&self, problem: String, fix: &str) -> Error {
        self.line.error(problem, fix)
    }
}
