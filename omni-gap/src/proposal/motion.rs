//! # What all runs together say of wheels and pose

use super::doubt::Certainty;
use super::groups::Groups;
use super::kinematics::{self, Poses, Reading};
use super::logs::LoggedRun;
use super::series::{Way, largest};
use super::wheels::{self, Wheels};
use crate::log::RobotFile;

/// What wheels and pose say of each other.
pub(super) struct Motion {
    pub reading: Reading,
    pub wheels: Wheels,
    /// How many changes more the next reading takes that fits as well.
    lead: usize,
    /// Whether the pose's clock is not that of the wheels.
    pub is_apart: bool,
}

impl Motion {
    /// How sure order, signs and frame are, beside others that fit as well.
    pub fn certainty(&self) -> Certainty {
        match self.lead {
            0 => Certainty::Guess,
            1 => Certainty::Likely,
            _ => Certainty::Sure,
        }
    }
}

/// How far apart clocks are tried (s), and how finely.
const REACH_S: f64 = 5.0;
const STEP_S: f64 = 0.05;

/// Compares wheels and pose; none where there is no pose, or the robot moves too little.
pub(super) fn compare(runs: &[LoggedRun], groups: &Groups, counts: Option<bool>, robot: &RobotFile) -> Option<Motion> {
    let (speeds, pose) = (groups.speed.as_ref().or(groups.set_speed.as_ref())?, groups.pose?);
    let ways = |run: &LoggedRun| -> Vec<Way> {
        let gyro = groups.gyro.map(|gyro| run.way(gyro, None));
        speeds.iter().map(|place| run.way(*place, counts)).chain(gyro).collect()
    };
    let poses = |run: &LoggedRun| Poses::new(run.times(pose[0]), pose.map(|place| &run.column(place).values));
    let evidence: Vec<(Vec<Way>, Poses)> = runs.iter().map(|run| (ways(run), poses(run))).collect();
    // a heading beyond a turn is one that was never wrapped, or degrees
    let stated = runs[0].column(pose[2]).name.unit;
    let largest_heading = evidence.iter().map(|(_, poses)| poses.largest_heading()).fold(0.0, f64::max);
    let degrees = match stated {
        Some("deg") => Some(true),
        Some("rad") => Some(false),
        _ if largest_heading < 2.0 * std::f64::consts::PI + 0.1 => Some(false),
        _ => None,
    };
    let offsets: Vec<f64> =
        runs.iter().zip(&evidence).map(|(run, evidence)| offset(run, evidence, groups, degrees)).collect();
    let evidence: Vec<(Vec<Way>, Poses)> =
        evidence.into_iter().zip(&offsets).map(|((ways, poses), offset_s)| (ways, poses.later(*offset_s))).collect();
    let readings = kinematics::read(&evidence, degrees);
    let of_wheels =
        |reading: &Reading| Reading { columns: reading.columns[..speeds.len()].to_vec(), ..reading.clone() };
    let all = readings.iter().flat_map(|reading| {
        wheels::find(&of_wheels(reading), robot).into_iter().map(|wheels| (reading.clone(), wheels))
    });
    let (mut turning, strange): (Vec<_>, Vec<_>) = all.partition(|(_, wheels)| wheels.off_rad < wheels::OFF_RAD);
    let changes = |(reading, wheels): &(Reading, Wheels)| reading.frame.changes() + wheels.changes();
    turning.sort_by_key(|both| (changes(both), both.1.are_moved()));
    // what is always as good: the same motion seen from below, and a robot that looks the same after a turn
    let lead = turning.get(1).map_or(usize::MAX, |second| changes(second) - changes(&turning[0]));
    let turning = turning.into_iter().next().or_else(|| strange.into_iter().next());
    // what changes least of those that fit the drive angles, or what fits them best
    let straight = || {
        let named = |reading: &Reading| (reading.clone(), wheels::as_named(&of_wheels(reading), robot));
        let all: Vec<(Reading, Wheels)> = readings.iter().map(named).collect();
        let fits = all.iter().find(|(_, wheels)| wheels.off_rad < wheels::OFF_RAD);
        fits.or(all.iter().min_by(|a, b| a.1.off_rad.total_cmp(&b.1.off_rad))).cloned()
    };
    let (reading, wheels) = turning.or_else(straight)?;
    Some(Motion { reading, wheels, lead, is_apart: offsets.iter().any(|offset_s| *offset_s != 0.0) })
}

/// How the clock of the pose's file lies to that of the wheels' file (s).
fn offset(run: &LoggedRun, (ways, poses): &(Vec<Way>, Poses), groups: &Groups, degrees: Option<bool>) -> f64 {
    let wheels = groups.speed.as_ref().or(groups.set_speed.as_ref()).map(|places| places[0].0);
    let pose = groups.pose.map(|pose| pose[0].0);
    let shared = |(a, b): (usize, usize)| a == b || run.tables[a].path == run.tables[b].path;
    let (Some(a), Some(b)) = (ways.first().and_then(Way::span), poses.span()) else { return 0.0 };
    if wheels.zip(pose).is_none_or(shared) {
        return 0.0;
    }
    // where they have nothing in common, both begin together
    let begin = if b.0 > a.1 || b.1 < a.0 { a.0 - b.0 } else { 0.0 };
    let steps = (REACH_S / STEP_S) as i32;
    let tried = (-steps..=steps).map(|k| begin + f64::from(k) * STEP_S).filter_map(|offset_s| {
        let readings = kinematics::read(&[(ways.clone(), poses.clone().later(offset_s))], degrees);
        Some((readings.first()?.rest, offset_s))
    });
    let (_, offset_s) = tried.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((1.0, 0.0));
    if offset_s.abs() < 0.2 { 0.0 } else { offset_s }
}

/// Whether a group of columns counts, and if so whether the count runs on.
pub(super) fn counts(run: &LoggedRun, groups: &Groups) -> Option<bool> {
    let first = *groups.speed.as_ref()?.first()?;
    let column = run.column(first);
    if column.name.unit != Some("counts") {
        return None;
    }
    let values: Vec<f64> = column.values.present().map(|(_, value)| value).collect();
    let step = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    Some(largest(&column.values) > 10.0 * step.max(1.0))
}
