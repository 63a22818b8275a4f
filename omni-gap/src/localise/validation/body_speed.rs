//! The body's speeds v, vn and ω as the sensors tell them.
//!
//! Measured and simulated speeds go through the same function, so that what it smooths is smoothed alike in both.

use model_core::geometry::frames::{Pose, WorldTwist};
use model_core::geometry::kinematics::Wheels;

use super::model::SpeedsFrom;
use crate::simulate::{AlignedRun, SignalGroup, start_at};

/// The speeds of one row.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodySpeed {
    /// v, vn, ω [m/s, m/s, rad/s]
    pub speed: [f64; 3],
    /// One sigma of each, from the sensors' [m/s, m/s, rad/s]
    pub sigma: [f64; 3],
}

/// What the speeds of a run are to be taken from: the wheel speeds where they are compared, else the pose.
pub(super) fn source<const N: usize>(run: &AlignedRun<N>) -> Option<SpeedsFrom> {
    let all_on_a_row = |group| (0..run.rows()).any(|row| saw_all(run, row, group));
    if all_on_a_row(SignalGroup::WheelSpeed) {
        Some(SpeedsFrom::WheelSpeeds)
    } else {
        all_on_a_row(SignalGroup::Pose).then_some(SpeedsFrom::Pose)
    }
}

/// True if every channel of a group was measured on a row.
fn saw_all<const N: usize>(run: &AlignedRun<N>, row: usize, group: SignalGroup) -> bool {
    AlignedRun::<N>::channels().of(group).all(|channel| run.saw(row, channel))
}

/// The speeds of every row on which their sensors spoke.
pub(super) fn body_speeds<const N: usize>(
    run: &AlignedRun<N>,
    wheels: &Wheels<N, f64>,
    from: SpeedsFrom,
) -> Vec<Option<BodySpeed>> {
    match from {
        SpeedsFrom::WheelSpeeds => {
            let (sigma, channels) = (sigma_of_wheels(run, wheels), AlignedRun::<N>::channels());
            (0..run.rows())
                .map(|row| {
                    let speeds = std::array::from_fn(|j| run.measured[row][channels.wheel_speed(j)]);
                    saw_all(run, row, SignalGroup::WheelSpeed)
                        .then(|| BodySpeed { speed: wheels.twist_of_wheel_speeds(speeds).to_array(), sigma })
                })
                .collect()
        }
        SpeedsFrom::Pose => (0..run.rows()).map(|row| from_pose(run, row)).collect(),
    }
}

/// What the noise of the wheel speeds makes of each axis.
fn sigma_of_wheels<const N: usize>(run: &AlignedRun<N>, wheels: &Wheels<N, f64>) -> [f64; 3] {
    // the twist is linear in the wheel speeds: σ² = Σ_j (∂twist/∂w_j)²·σ_j²
    let mut variance = [0.0; 3];
    for j in 0..N {
        let one =
            std::array::from_fn(|k| if k == j { run.sigma[AlignedRun::<N>::channels().wheel_speed(j)] } else { 0.0 });
        let share = wheels.twist_of_wheel_speeds(one).to_array();
        variance.iter_mut().zip(share).for_each(|(v, s)| *v += s * s);
    }
    variance.map(f64::sqrt)
}

fn from_pose<const N: usize>(run: &AlignedRun<N>, row: usize) -> Option<BodySpeed> {
    if !saw_all(run, row, SignalGroup::Pose) {
        return None;
    }
    let start = start_at(run, row);
    let (at, rate) = start.pose?;
    let spread = start.pose_spread.filter(|s| *s > 0.0)?.sqrt();
    let pose = Pose { x: at[0], y: at[1], theta: at[2] };
    let speed = pose.to_body(WorldTwist { x: rate[0], y: rate[1], w: rate[2] }).to_array();
    let [x, _, theta] = AlignedRun::<N>::channels().pose().map(|channel| run.sigma[channel] / spread);
    Some(BodySpeed { speed, sigma: [x, x, theta] })
}
