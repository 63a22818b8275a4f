//! Signals of one run that are shifted in time against each other, farther than any drive or camera is late.
//!
//! Wheels cannot answer before they are driven, and the pose cannot move before the wheels turn. The shift is looked for at
//! which one explains the other best ([`wheels`], [`body`]); it is told where it lies outside what delays can make and explains
//! far more than any that lies within.

mod body;
mod integral;
mod shifts;
mod wheels;

use shifts::LeftByShift;

use super::Fault;
use crate::log::{RobotFile, Run};

/// What the shift may leave unexplained at the most [1], and as a share of what any usual delay leaves [1].
const LEFT: f64 = 0.5;
const BETTER: f64 = 0.5;

/// Two signals, the one that leads and the one that follows, and what is said where they are shifted.
struct Pair {
    /// How much later the one that follows may be [s], from and to, and be no fault of the log.
    usual_s: (f64, f64),
    leads: &'static str,
    follows: &'static str,
    early: &'static str,
    late: &'static str,
}

/// Samples of one row are not of one instant; a drive that controls speed has a dead time of up to 0.3 s and a lag of up to 0.5 s.
const WHEELS: Pair = Pair {
    usual_s: (-0.1, 0.8),
    leads: "the command",
    follows: "w",
    early: "The wheels answer {} s before they are driven, which no robot can",
    late: "The wheels answer {} s after they are driven, later than any drive",
};

/// Wheel speeds are filtered over up to 0.2 s, a camera is late by up to 0.3 s.
const BODY: Pair = Pair {
    usual_s: (-0.35, 0.45),
    leads: "w",
    follows: "x_m, y_m, theta_rad",
    early: "The pose moves {} s before the wheels turn, which no robot can",
    late: "The pose moves {} s after the wheels turn, later than any camera",
};

/// Signals that are shifted against each other in a run, the one that follows first.
pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let wheels = wheels::left_by_shift(run).and_then(|left| WHEELS.shifted(run, &left));
    wheels.or_else(|| body::left_by_shift(run, robot).and_then(|left| BODY.shifted(run, &left)))
}

impl Pair {
    /// The shift that explains most, if none that is usual does nearly as well.
    fn shifted(&self, run: &Run, left: &LeftByShift) -> Option<Fault> {
        let least = |among: &dyn Fn(f64) -> bool| {
            left.iter().copied().filter(|(shift, _)| among(*shift)).min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let (shift_s, best) = least(&|_| true)?;
        let (_, usual) = least(&|shift| (self.usual_s.0..=self.usual_s.1).contains(&shift))?;
        (best < LEFT && best < BETTER * usual).then(|| self.told(run, shift_s))
    }

    fn told(&self, run: &Run, shift_s: f64) -> Fault {
        let Self { leads, follows, early, late, .. } = self;
        let how = if shift_s < 0.0 { early } else { late };
        let sentence = how.replacen("{}", &format!("{:.2}", shift_s.abs()), 1)
            + &format!(": {leads} and {follows} are shifted against each other.");
        let fix = "Take the times of both from one clock, where they are sampled; or log each to a file of its own in a folder \
                   for the run: the offset between two clocks is estimated then.";
        // what comes before its cause is no robot's doing; what comes late may be a slow link
        Fault::of(run, "shifted_signals", *follows, shift_s < 0.0).says(sentence, fix)
    }
}
