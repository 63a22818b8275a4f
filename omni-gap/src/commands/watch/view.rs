//! What the screen shows, without the screen.

use std::collections::VecDeque;

use omni_gap::api::News;
use omni_gap::log::records::tail::Heard;
use omni_gap::watch::{Reading, Rule};

/// So many windows are remembered: more than a screen is wide.
const REMEMBERED: usize = 500;

/// What the screen shows.
#[derive(Clone, Debug)]
pub struct View {
    /// The robot's name.
    pub robot: String,
    /// Where its frames come from.
    pub from: String,
    /// When a gap is one.
    pub rule: Rule,
    /// The last windows, the newest last.
    pub readings: VecDeque<Reading>,
    /// What came so far.
    pub heard: Heard,
    /// Until when records came [s]
    pub reaches_s: f64,
    /// How many alarms began.
    pub alarms: u64,
    /// The picture stands still; what comes is read all the same.
    pub paused: bool,
}

impl View {
    /// A view of a robot of which nothing has come.
    pub fn new(robot: &str, from: &str, rule: Rule) -> Self {
        let (robot, from) = (robot.to_owned(), from.to_owned());
        let (readings, heard) = (VecDeque::new(), Heard::default());
        Self { robot, from, rule, readings, heard, reaches_s: 0.0, alarms: 0, paused: false }
    }

    /// Takes news; true if an alarm began with them.
    pub fn take(&mut self, news: News) -> bool {
        (self.heard, self.reaches_s) = (news.heard, news.reaches_s);
        let Some(reading) = news.reading else { return false };
        let began = reading.alarm_began;
        self.alarms += u64::from(began);
        if self.readings.len() == REMEMBERED {
            self.readings.pop_front();
        }
        self.readings.push_back(reading);
        began
    }

    /// The last window.
    pub fn last(&self) -> Option<&Reading> {
        self.readings.back()
    }
}
