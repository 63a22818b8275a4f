//! A pass: windows of a run in dual numbers, row by row, as errors and derivatives in units of sigma.

use std::ops::Range;

use model_core::effects::{EffectState, Numbers};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;

use super::shoot::{Starts, Windows, run_some_windows};
use super::whiten::Whitener;
use crate::simulate::{AlignedRun, FreeRun, MAX_CHANNELS, Model, Slot};

/// Parameters of a window's start that need the plant to differentiate, v, vn and ω; moving or turning the whole path
/// is geometry.
pub(super) const TWIST: usize = 3;

/// What a pass goes along.
#[derive(Clone, Copy)]
pub(super) struct Course<'a, const N: usize> {
    pub model: &'a Model<N>,
    pub run: &'a AlignedRun<N>,
    pub windows: &'a Windows,
    pub starts: &'a Starts,
    pub free: &'a [Slot],
}

/// One number that was measured.
#[derive(Clone, Copy)]
pub(super) struct Seen<const LANES: usize> {
    /// Its channel.
    pub channel: usize,
    /// Measured minus predicted [σ]
    pub error: f64,
    /// d predicted / d (x, y, θ of the start) [σ]
    pub moved: [f64; 3],
    /// d predicted / d (the lanes' parameters) [σ]
    pub lanes: [f64; LANES],
}

impl<const LANES: usize> Seen<LANES> {
    const NOTHING: Self = Self { channel: 0, error: 0.0, moved: [0.0; 3], lanes: [0.0; LANES] };
}

/// Takes windows through the plant in dual numbers whose lanes are the derivatives `first..first + LANES` of
/// (v, vn, ω, free…), and hands what was measured on a row to `each(window, row, numbers)`.
///
/// Windows that do not begin the run may only be asked for where the model has no effects: those carry on from one
/// window to the next.
pub(super) fn pass<const N: usize, const LANES: usize>(
    course: Course<'_, N>,
    which: Range<usize>,
    first: usize,
    mut each: impl FnMut(usize, usize, &[Seen<LANES>]),
) {
    let Course { model, run, windows, starts, free } = course;
    let lane = |index: usize, x: f64| match index.checked_sub(first) {
        Some(lane) if lane < LANES => Dual::<LANES>::variable(x, lane),
        _ => Dual::<LANES>::constant(x),
    };
    let plant = model.plant_with::<Dual<LANES>>(|slot, x| match free.iter().position(|f| *f == slot) {
        Some(at) => lane(TWIST + at, x),
        None => Dual::<LANES>::constant(x),
    });
    let own = TWIST.saturating_sub(first).min(LANES);
    let start = |k: usize| {
        let [x, y, theta, v, vn, w] = starts[k];
        let pose = Pose {
            x: Dual::<LANES>::constant(x),
            y: Dual::<LANES>::constant(y),
            theta: Dual::<LANES>::constant(theta),
        };
        (pose, BodyTwist { v: lane(0, v), vn: lane(1, vn), w: lane(2, w) })
    };
    // what the memory holds does not depend on the start of this window
    let enter = |memory: &mut [EffectState<Dual<LANES>>]| {
        memory.iter_mut().for_each(|state| state.for_each_mut(|number| number.eps[..own].fill(0.0)));
    };
    let channels = AlignedRun::<N>::channels();
    let [cx, cy, ctheta] = channels.pose();
    let per_sigma = run.sigma.map(|sigma| 1.0 / sigma);
    let mut white = (Whitener::<LANES>::of(run), Whitener::<4>::of(run));
    let mut seen = [Seen::<LANES>::NOTHING; MAX_CHANNELS];
    let mut last = usize::MAX;
    run_some_windows(FreeRun::new(&plant, run), windows, which, start, enter, |k, row, predicted| {
        if k != last {
            white.0.enter();
            white.1.enter();
            last = k;
        }
        let mut at = 0;
        for c in (0..channels.count()).filter(|c| run.saw(row, *c)) {
            let now = &mut seen[at];
            let error = run.error(row, c, predicted[c].re);
            // moving and turning the start moves and turns the path
            let moved = if c == cx {
                [per_sigma[c], 0.0, -(predicted[cy].re - starts[k][1]) * per_sigma[c]]
            } else if c == cy {
                [0.0, per_sigma[c], (predicted[cx].re - starts[k][0]) * per_sigma[c]]
            } else if c == ctheta {
                [0.0, 0.0, per_sigma[c]]
            } else {
                [0.0; 3]
            };
            now.channel = c;
            for (slope, eps) in now.lanes.iter_mut().zip(&predicted[c].eps) {
                *slope = eps * per_sigma[c];
            }
            let mut few = [error, moved[0], moved[1], moved[2]];
            white.0.whiten(c, run.t[row], &mut now.lanes);
            white.1.whiten(c, run.t[row], &mut few);
            (now.error, now.moved) = (few[0], [few[1], few[2], few[3]]);
            at += 1;
        }
        each(k, row, &seen[..at]);
    });
}
