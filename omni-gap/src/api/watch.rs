//! Watch: what a robot sends, judged as it comes.

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
pub fn watch(watching: &Watching, each: impl FnMut(News) -> bool) -> Result<Watched> {
    let mut at = OnTheWay {
        watching,
        tail: Tail::default(),
        watch: Watch::new(watching.robot, watching.rule),
        each,
        windows: 0,
        alarms: 0,
        refused: None,
    };
    let end = watching.source.follow(watching.baud, watching.patience, |bytes| at.take(bytes))?;
    if let Some(why) = at.refused {
        return Err(why);
    }
    if end != End::Enough {
        // the last whole window, without what would have come after it
        while at.tail.reaches_s().is_some_and(|reaches| reaches >= at.watch.to_s()) && at.read()? {}
        if at.windows == 0 {
            return Err(at.too_little());
        }
    }
    let OnTheWay { tail, windows, alarms, .. } = at;
    Ok(Watched { end, heard: tail.heard(), reaches_s: tail.reaches_s().unwrap_or_default(), windows, alarms })
}

/// A watch on its way.
struct OnTheWay<'a, F> {
    watching: &'a Watching<'a>,
    tail: Tail,
    watch: Watch,
    each: F,
    windows: u64,
    alarms: u64,
    refused: Option<Error>,
}

impl<F: FnMut(News) -> bool> OnTheWay<'_, F> {
    fn take(&mut self, bytes: &[u8]) -> Progress {
        let frames = self.tail.take(bytes);
        let mut goes_on = true;
        while goes_on && self.tail.reaches_s().is_some_and(|reaches| reaches >= self.watch.needs_to_s()) {
            goes_on = self.read().unwrap_or_else(|why| {
                self.refused = Some(why);
                false
            });
        }
        match (goes_on && self.tell(None), frames) {
            (false, _) => Progress::Enough,
            (true, true) => Progress::Frames,
            (true, false) => Progress::Nothing,
        }
    }

    /// Reads the next window; false if nobody wants more.
    fn read(&mut self) -> Result<bool> {
        let run = self.tail.run(&self.watching.source.place(), self.watching.robot.wheel.len())?;
        let reading = self.watch.read(&run);
        self.tail.forget_before(self.watch.needs_from_s());
        if let Some(reading) = &reading {
            self.windows += 1;
            self.alarms += u64::from(reading.alarm_began);
        }
        Ok(reading.is_none() || self.tell(reading))
    }

    fn tell(&mut self, reading: Option<Reading>) -> bool {
        let reaches_s = self.tail.reaches_s().unwrap_or_default();
        (self.each)(News { reading, heard: self.tail.heard(), reaches_s })
    }

    /// Why nothing could be told.
    fn too_little(&self) -> Error {
        let (place, rule) = (self.watching.source.place(), &self.watching.rule);
        let came = match self.tail.run(&place, self.watching.robot.wheel.len()) {
            Ok(run) => run.duration_s(),
            Err(why) => return why,
        };
        let problem = format!("{came:.3} s of records came, expected more than a window of {} s", rule.window_s);
        Error::input(&place, problem, "Watch for longer, or shorter windows with --window")
            .of_kind(InputKind::TooLittle)
    }
}
