//! Where a free run starts: measurements smoothed by straight lines, without a model.
//!
//! A line is fitted by least squares to the samples around the restart, ±50 ms of wheel speeds and yaw rate, ±100 ms of
//! the pose, and read at the restart itself. A window with fewer than two samples is widened, up to four times. A run goes on
//! with the speeds it has where hall edges lie on one side of the restart alone.

use model_core::geometry::frames::{BodyTwist, Pose, WorldTwist};
use model_core::plant::{Plant, Reading, State};

use super::aligned_run::AlignedRun;

const SPEED_HALF_S: f64 = 0.050;
const POSE_HALF_S: f64 = 0.100;

/// What lies before and behind an instant over which the rate of a pose is taken [s]
const RATE_OVER_S: f64 = 1e-3;

/// A smoothed measurement at the instant of a restart.
#[derive(Clone, Copy, Debug)]
pub struct Start<const N: usize> {
    /// Time since the start of the run [s]
    pub time: f64,
    /// Wheel speeds [rad/s], where measured (or imposed)
    pub wheel_speed: Option<[f64; N]>,
    /// (x, y, θ) and its rate [m, m, rad] [m/s, m/s, rad/s], where measured
    pub pose: Option<([f64; 3], [f64; 3])>,
    /// Σ(t − t̄)² of the samples behind the pose's rate [s²]; the rate's variance is that of a sample over this
    pub pose_spread: Option<f64>,
    /// Yaw rate [rad/s], where measured
    pub gyro: Option<f64>,
    /// True where a speed was measured only after the restart, or only before it, and not until later than the next sample
    /// was due, so that a line was prolonged: speeds from hall edges, which a wheel at rest does not give
    pub prolonged: bool,
}

/// The least-squares line through some points.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// At the time asked for.
    value: f64,
    /// A second.
    slope: f64,
    /// Σ(t − t̄)² [s²]
    spread: f64,
    /// Read farther from the samples, all on one side, than they are apart.
    prolonged: bool,
}

/// The least-squares line through the points, read at time `at`.
fn line(points: impl Iterator<Item = (f64, f64)> + Clone, at: f64) -> Option<Line> {
    let (mut n, mut st, mut sx) = (0.0, 0.0, 0.0);
    for (t, x) in points.clone() {
        n += 1.0;
        st += t - at;
        sx += x;
    }
    if n < 2.0 {
        return None;
    }
    let (mean_t, mean_x) = (st / n, sx / n);
    let (mut tt, mut tx) = (0.0, 0.0);
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    for (t, x) in points {
        let d = t - at - mean_t;
        tt += d * d;
        tx += d * (x - mean_x);
        (first, last) = (first.min(t), last.max(t));
    }
    let slope = if tt > 0.0 { tx / tt } else { 0.0 };
    let beyond = (first - at).max(at - last);
    let interval = (last - first) / (n - 1.0);
    Some(Line { value: mean_x - slope * mean_t, slope, spread: tt, prolonged: beyond > interval + 1e-9 })
}

/// The line through one channel around a row.
fn smooth(t: &[f64], row: usize, half: f64, sample: impl Fn(usize) -> Option<f64> + Copy) -> Option<Line> {
    let at = t[row];
    (0..3).find_map(|widen| {
        let half = half * f64::from(1 << widen) + 1e-9;
        let first = t.partition_point(|x| *x < at - half);
        let last = t.partition_point(|x| *x <= at + half);
        line((first..last).filter_map(move |k| sample(k).map(|x| (t[k], x))), at)
    })
}

/// Whether a run that begins at a row, without what is before, begins with the speeds that the robot has: those of all wheels
/// are measured from there on, or none is for a while, as of a robot at rest, or a pose tells them.
pub(super) fn begins_known<const N: usize>(run: &AlignedRun<N>, row: usize) -> bool {
    let channels = AlignedRun::<N>::channels();
    let after = |c: usize, half: f64| {
        smooth(&run.t, row, half, move |k| (k >= row && run.saw(k, c)).then(|| run.measured[k][c]))
    };
    let speeds: [Option<Line>; N] = std::array::from_fn(|j| after(channels.wheel_speed(j), SPEED_HALF_S));
    speeds.iter().all(|line| line.is_some_and(|line| !line.prolonged))
        || speeds.iter().all(Option::is_none)
        || channels.pose().into_iter().all(|axis| after(axis, POSE_HALF_S).is_some())
}

/// The smoothed measurement at a row.
pub fn start_at<const N: usize>(run: &AlignedRun<N>, row: usize) -> Start<N> {
    let (t, channels) = (&run.t, AlignedRun::<N>::channels());
    // what moved the robot in between is not known: it may have been jerked
    let stretch = &run.stretch(row);
    let saw = move |k: usize, c: usize| stretch.contains(&k) && run.saw(k, c);
    let channel = |c: usize, half: f64| smooth(t, row, half, move |k| saw(k, c).then(|| run.measured[k][c]));
    let mut wheel_speed = Some([0.0; N]);
    let mut prolonged = false;
    for j in 0..N {
        wheel_speed = wheel_speed.zip(channel(channels.wheel_speed(j), SPEED_HALF_S)).map(|(mut w, line)| {
            w[j] = line.value;
            prolonged |= line.prolonged;
            w
        });
    }
    if wheel_speed.is_none() && matches!(run.chain, super::Chain::WheelSpeed | super::Chain::SetSpeed) {
        wheel_speed = Some(run.input[row]);
    }
    let axis = |a: usize| channel(channels.pose()[a], POSE_HALF_S);
    let lines = axis(0).zip(axis(1)).zip(axis(2)).map(|((x, y), theta)| [x, y, theta]);
    let pose = lines.map(|lines| (lines.map(|l| l.value), lines.map(|l| l.slope)));
    let pose_spread = lines.map(|lines| lines[0].spread);
    let gyro = channel(channels.gyro(), SPEED_HALF_S).map(|g| g.value);
    Start { time: t[row], prolonged: prolonged && wheel_speed.is_some(), wheel_speed, pose, pose_spread, gyro }
}

impl<const N: usize> Start<N> {
    /// The same without speeds that are told by a prolonged line alone: two edges of a hall sensor a millisecond apart, read
    /// 50 ms away, are wrong by fifty times their noise.
    pub fn seen_on_both_sides(self) -> Self {
        Self { wheel_speed: self.wheel_speed.filter(|_| !self.prolonged), ..self }
    }

    /// The plant's own true state behind this measurement: through the inverse of its sensing effects.
    ///
    /// The twist comes from the wheel speeds, less what the wheels slip by in `before`; where there are none from the pose's
    /// rate, and where there is neither the run goes on with `before`.
    pub fn state(&self, plant: &Plant<N, f64>, before: &State<N, f64>) -> State<N, f64> {
        let measured = self.pose.map_or(before.pose, |(p, _)| Pose { x: p[0], y: p[1], theta: p[2] });
        let reading = Reading {
            current: [0.0; N],
            wheel_speed: self.wheel_speed.unwrap_or([0.0; N]),
            pose: measured,
            gyro: self.gyro.unwrap_or(0.0),
        };
        let truth = plant.invert_sensing(self.time, BodyTwist::default(), reading);
        let mut twist = if self.wheel_speed.is_some() {
            plant.twist_of_wheel_speeds(std::array::from_fn(|j| truth.wheel_speed[j] - before.slip[j]))
        } else if let Some((_, [x, y, theta])) = self.pose {
            // the rate of the pose behind the one that is read
            let behind = |after_s: f64| {
                let pose = Pose {
                    x: measured.x + after_s * x,
                    y: measured.y + after_s * y,
                    theta: measured.theta + after_s * theta,
                };
                plant.invert_sensing(self.time, BodyTwist::default(), Reading { pose, ..reading }).pose
            };
            let (from, to, span) = (behind(-RATE_OVER_S), behind(RATE_OVER_S), 2.0 * RATE_OVER_S);
            let rate = |from: f64, to: f64| (to - from) / span;
            let rate = WorldTwist { x: rate(from.x, to.x), y: rate(from.y, to.y), w: rate(from.theta, to.theta) };
            truth.pose.to_body(rate)
        } else {
            before.twist
        };
        if self.gyro.is_some() {
            twist.w = truth.gyro;
        }
        let truth = plant.invert_sensing(self.time, twist, reading);
        let pose = if self.pose.is_some() { truth.pose } else { before.pose };
        plant.start_from(before, self.time, pose, twist)
    }
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;
    use model_core::effects::active::Effects;
    use model_core::plant::{Input, paper};

    use super::*;

    #[test]
    fn a_line_is_read_at_the_restart_itself() {
        let points = [(0.0, 1.0), (0.1, 1.2), (0.2, 1.4)];
        let Line { value, slope, spread, prolonged } = line(points.into_iter(), 0.25).unwrap();
        assert!((value - 1.5).abs() < 1e-12 && (slope - 2.0).abs() < 1e-12 && (spread - 0.02).abs() < 1e-12);
        assert!(!prolonged, "the next sample is not due yet");
        assert!(
            line(points.into_iter(), 0.35).unwrap().prolonged && line(points.into_iter(), -0.15).unwrap().prolonged
        );
        assert!([0.0, 0.15, 0.2].iter().all(|at| !line(points.into_iter(), *at).unwrap().prolonged));
    }

    #[test]
    fn a_window_without_samples_is_widened_and_one_sample_is_none() {
        let t: Vec<f64> = (0..101).map(|k| f64::from(k) * 0.01).collect();
        let sparse = |k: usize| k.is_multiple_of(15).then(|| 3.0 * t[k]);
        assert!((smooth(&t, 50, 0.05, sparse).unwrap().value - 1.5).abs() < 1e-12);
        assert!(smooth(&t, 50, 0.05, |k| (k == 50).then_some(1.0)).is_none());
    }

    #[test]
    fn speeds_seen_on_one_side_alone_are_no_speeds_to_restart_with() {
        let start = |prolonged| Start::<4> {
            time: 1.0,
            wheel_speed: Some([9.0; 4]),
            pose: None,
            pose_spread: None,
            gyro: None,
            prolonged,
        };
        let plant = Plant::new(paper::four_wheels::<f64>(), Effects::default());
        let before = plant.start(1.0, Pose::default(), BodyTwist { v: 0.1, vn: 0.2, w: 0.3 });
        let begun = |prolonged| start(prolonged).seen_on_both_sides().state(&plant, &before).twist;
        assert_eq!(begun(true), before.twist);
        assert!((begun(false).w - before.twist.w).abs() > 1.0, "{:?}", begun(false));
    }

    #[test]
    fn wheels_that_spin_go_on_spinning_and_the_robot_is_as_slow_as_it_was() {
        let mut effects = Effects::default();
        effects.add(EffectKind::WheelSlip, None, &[0.2, 30.0, 1.0, 7e-5, 0.0]).expect("parameters of its card");
        let plant = Plant::new(paper::four_wheels::<f64>(), effects);
        let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
        for _ in 0..60 {
            plant.step(&mut state, &mut [], &Input::Voltage([9.0, -9.0, -9.0, 9.0]), 1e-3);
        }
        assert!(state.slip.iter().all(|slip| slip.abs() > 10.0), "every wheel spins: {state:?}");
        let start = Start {
            time: state.time,
            wheel_speed: Some(state.wheel_speed),
            pose: None,
            pose_spread: None,
            gyro: None,
            prolonged: false,
        };
        let begun = start.state(&plant, &state);
        let of = |twist: BodyTwist<f64>| twist.to_array();
        assert!(of(begun.twist).iter().zip(of(state.twist)).all(|(a, b)| (a - b).abs() < 1e-12), "{begun:?}");
        assert!(begun.wheel_speed.iter().zip(state.wheel_speed).all(|(a, b)| (a - b).abs() < 1e-10), "{begun:?}");
    }

    #[test]
    fn where_only_a_pose_is_read_the_velocity_is_that_of_the_pose_behind_it() {
        let twist = BodyTwist { v: 0.5, vn: -0.2, w: 1.0 };
        for (effect, params) in [
            (EffectKind::CameraRotation, &[0.1][..]),
            (EffectKind::CameraScale, &[0.05]),
            (EffectKind::MarkerOffset, &[0.04, -0.03]),
        ] {
            let mut effects = Effects::default();
            effects.add(effect, None, params).expect("parameters of its card");
            let plant = Plant::new(paper::four_wheels::<f64>(), effects);
            let mut state = plant.start(0.0, Pose { x: 1.0, y: -0.5, theta: 0.3 }, twist);
            let (speeds, mut read) = (Input::Speed(state.wheel_speed), Vec::new());
            let mut at_row = state;
            for row in 0..3 {
                at_row = if row == 1 { state } else { at_row };
                read.push(plant.step(&mut state, &mut [], &speeds, 1e-3).pose);
            }
            let of = |pose: Pose<f64>| [pose.x, pose.y, pose.theta];
            let rate = std::array::from_fn(|k| (of(read[2])[k] - of(read[0])[k]) / 2e-3);
            let start = Start {
                time: at_row.time,
                wheel_speed: None,
                pose: Some((of(read[1]), rate)),
                pose_spread: None,
                gyro: None,
                prolonged: false,
            };
            let found = start.state(&plant, &state);
            // a chord of 2 ms of a curve: v·ω²·(1 ms)²/6 and less
            let off =
                found.twist.to_array().iter().zip(twist.to_array()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6 && (found.pose.x - at_row.pose.x).abs() < 1e-12, "{effect:?}: {:?}", found.twist);
        }
    }
}
