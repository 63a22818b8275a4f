//! Watch: what a robot sends, judged as it comes.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::{Error, InputKind, Result};
use crate::log::RobotFile;
use crate::log::records::capture::Progress;
use crate::log::records::tail::{Heard, Tail};
use crate::watch::{Reading, Rule, Watch};
use crate::wire::source::{End, Source};

/// What to watch.
#[derive(Clone, Debug)]
pub struct Watching<'a> {
    /// Where the frames come from; a file that grows is followed.
    pub source: &'a Source,
    /// Speed of a serial line.
    pub baud: u32,
    /// How long nothing may come before the watch ends.
    pub patience: Duration,
    /// The robot.
    pub robot: &'a RobotFile,
    /// When a gap is one.
    pub rule: Rule,
}

/// What is new.
#[derive(Clone, Debug)]
pub struct News {
    /// What a window says, where one ended.
    pub reading: Option<Reading>,
    /// What came so far.
    pub heard: Heard,
    /// Until when records came, by the robot's clock since the first [s]
    pub reaches_s: f64,
}

/// How a watch ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// Why.
    pub end: End,
    /// What came.
    pub heard: Heard,
    /// Until when records came, by the robot's clock since the first [s]
    pub reaches_s: f64,
    /// How many windows were read.
    pub windows: u64,
    /// How many alarms began.
    pub alarms: u64,
}

/// Watches a robot until its records end, or `each`, which gets all news, ten times a second at least, says false.
///
/// # Errors
/// Where the source cannot be read, it is another robot's, or less than a window came.
pub fn watch(watching: &Watching, mut each: impl FnMut(News) -> bool) -> Result<Watched> {
    let mut feed = WatchFeed::new(watching.robot, &watching.source.place(), watching.rule);
    let mut refused = None;
    let end = watching.source.follow(watching.baud, watching.patience, |bytes| {
        feed.take(bytes, &mut each).unwrap_or_else(|why| {
            refused = Some(why);
            Progress::Enough
        })
    })?;
    match refused {
        Some(why) => Err(why),
        None => feed.finish(end, &mut each),
    }
}

/// A watch of bytes that come some other way.
#[derive(Debug)]
pub struct WatchFeed<'a> {
    robot: &'a RobotFile,
    place: PathBuf,
    rule: Rule,
    tail: Tail,
    watch: Watch,
    windows: u64,
    alarms: u64,
}

impl<'a> WatchFeed<'a> {
    /// Nothing has come; `place` is where it comes from, for messages.
    pub fn new(robot: &'a RobotFile, place: &Path, rule: Rule) -> Self {
        let (tail, watch) = (Tail::default(), Watch::new(robot, rule));
        Self { robot, place: place.to_owned(), rule, tail, watch, windows: 0, alarms: 0 }
    }

    /// Takes bytes, and tells `each` what is new; enough where it says false.
    ///
    /// # Errors
    /// Where the bytes are another robot's.
    pub fn take(&mut self, bytes: &[u8], mut each: impl FnMut(News) -> bool) -> Result<Progress> {
        let frames = self.tail.take(bytes);
        let mut goes_on = true;
        while goes_on && self.tail.reaches_s().is_some_and(|reaches| reaches >= self.watch.needs_to_s()) {
            goes_on = self.read(&mut each)?;
        }
        Ok(match (goes_on && each(self.news(None)), frames) {
            (false, _) => Progress::Enough,
            (true, true) => Progress::Frames,
            (true, false) => Progress::Nothing,
        })
    }

    /// No more comes: reads the last whole window, without what would have come after it.
    ///
    /// # Errors
    /// Where less than a window came.
    pub fn finish(mut self, end: End, mut each: impl FnMut(News) -> bool) -> Result<Watched> {
        if end != End::Enough {
            while self.tail.reaches_s().is_some_and(|reaches| reaches >= self.watch.to_s()) && self.read(&mut each)? {}
            if self.windows == 0 {
                return Err(self.too_little());
            }
        }
        Ok(self.watched(end))
    }

    /// What was watched up to now.
    pub fn watched(&self, end: End) -> Watched {
        let Self { windows, alarms, tail, .. } = self;
        let reaches_s = tail.reaches_s().unwrap_or_default();
        Watched { end, heard: tail.heard(), reaches_s, windows: *windows, alarms: *alarms }
    }

    /// Reads the next window; false if nobody wants more.
    fn read(&mut self, each: &mut impl FnMut(News) -> bool) -> Result<bool> {
        let run = self.tail.run(&self.place, self.robot.wheel.len())?;
        let reading = self.watch.read(&run);
        self.tail.forget_before(self.watch.needs_from_s());
        if let Some(reading) = &reading {
            self.windows += 1;
            self.alarms += u64::from(reading.alarm_began);
        }
        Ok(reading.is_none() || each(self.news(reading)))
    }

    fn news(&self, reading: Option<Reading>) -> News {
        let reaches_s = self.tail.reaches_s().unwrap_or_default();
        News { reading, heard: self.tail.heard(), reaches_s }
    }

    /// Why nothing could be told.
    fn too_little(&self) -> Error {
        let came = match self.tail.run(&self.place, self.robot.wheel.len()) {
            Ok(run) => run.duration_s(),
            Err(why) => return why,
        };
        let problem = format!("{came:.3} s of records came, expected more than a window of {} s", self.rule.window_s);
        Error::input(&self.place, problem, "Watch for longer, or shorter windows with --window")
            .of_kind(InputKind::TooLittle)
    }
}
