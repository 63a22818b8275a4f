//! How large a cause has to be for the gap that is asked for.

use crate::causes::Cause;
use crate::driving::{Driver, Style};
use crate::gap::gap;
use crate::robot_file::RobotFile;
use crate::setup::Setup;

/// Of the typical size, the least and the most that a cause is given [1]: what is beyond is no robot that anybody drives.
pub const BOUNDS: (f64, f64) = (0.02, 4.0);

/// Of a robot with nothing hidden, a gap below this is none that thousands of rows together would show [1]
const NONE: f64 = 0.05;

/// Ramps to full speed that are tried, one after the other [s]
const RAMPS: [f64; 5] = [1.5, 2.5, 4.0, 6.0, 9.0];

/// A gap within this share of what was asked is what was asked [1]
const CLOSE: f64 = 0.1;

/// Gaps that are looked at.
const LOOKS: usize = 6;

/// A cause, its size, and the gap that it makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sized {
    /// Of the typical size [1]
    pub times: f64,
    /// The group that is missed most, over its noise [1]
    pub gap: f64,
}

/// What a gap is measured on.
#[derive(Clone, Copy, Debug)]
pub struct Trial<'a> {
    /// The robot, its numbers true.
    pub truth: &'a RobotFile,
    /// The most that a motor is given [V]
    pub voltage: f64,
    /// How it is driven.
    pub style: Style,
    /// Of the drive.
    pub seed: u64,
    /// How long it is [s]
    pub seconds: f64,
    /// Between two rows of it [s]
    pub row: f64,
}

impl Trial<'_> {
    /// The robot with a cause, so many times the typical size.
    pub fn with(&self, cause: &Cause, wheel: Option<usize>, times: f64) -> Setup {
        let mut setup = self.truth.setup();
        (cause.put)(&mut setup, wheel, times);
        setup
    }

    /// The same with ramps as steep as drives can follow that control speed: with nothing hidden, the model misses next to
    /// nothing.
    #[must_use]
    pub fn calmed(mut self) -> Self {
        let plain = self.truth.setup();
        for ramp in RAMPS {
            self.style = Style::SetPoints { ramp };
            if self.gap(&plain) < NONE {
                break;
            }
        }
        self
    }

    /// The gap that a robot with something hidden makes [1].
    pub fn gap(&self, hidden: &Setup) -> f64 {
        let mut driver = Driver::new(self.truth, self.voltage, self.style, self.seed);
        gap(self.truth, hidden, &mut driver, (self.seconds, self.row))
    }

    /// The size at which a cause makes a gap, or what comes closest to it within [`BOUNDS`].
    pub fn sized(&self, cause: &Cause, wheel: Option<usize>, asked: f64) -> Sized {
        // a number that is off by less than three times what is stated of it is not wrong
        let least = if cause.keys.is_empty() { BOUNDS.0 } else { 1.0 };
        self.sized_by(asked, least, &|setup, times| (cause.put)(setup, wheel, times))
    }

    /// The same of anything that can be put into a setup, at `least` [1] so many times its typical size.
    pub fn sized_by(&self, asked: f64, least: f64, put: &dyn Fn(&mut Setup, f64)) -> Sized {
        let at = |times: f64| {
            let mut setup = self.truth.setup();
            put(&mut setup, times);
            Sized { times, gap: self.gap(&setup) }
        };
        let off = |sized: &Sized| libm::log(sized.gap / asked).abs();
        let mut best = at(1.0);
        let (mut below, mut above) = (None, None);
        let mut now = best;
        for _ in 1..LOOKS {
            if off(&now) < off(&best) {
                best = now;
            }
            if off(&best) < libm::log(1.0 + CLOSE) {
                break;
            }
            if now.gap < asked {
                below = Some(now);
            } else {
                above = Some(now);
            }
            let next = match (below, above) {
                (Some(below), Some(above)) => between(&below, &above, asked),
                // a gap grows about as its cause does
                _ => now.times * (asked / now.gap).clamp(0.1, 10.0),
            };
            let next = next.clamp(least, BOUNDS.1);
            if next == now.times {
                break;
            }
            now = at(next);
        }
        if off(&now) < off(&best) { now } else { best }
    }
}

/// Where a power law through two sizes makes a gap.
fn between(below: &Sized, above: &Sized, asked: f64) -> f64 {
    let part = libm::log(asked / below.gap) / libm::log(above.gap / below.gap);
    below.times * libm::pow(above.times / below.times, part.clamp(0.1, 0.9))
}
