//! Wheels against the pose: over windows of a third of a second, the wheels' speeds and the pose's steps must agree.
//!
//! A common factor is free (slip, a wrong radius), so is a latency well below the window. What remains to see: a wrong
//! unit, a mirrored or turned frame, and wheels in another order.

use super::Fault;
use super::body::{BodyFromWheels, row_of};
use super::order::{self, Order};
use super::units;
use crate::log::{RobotFile, Run};
use std::f64::consts::TAU;

const WINDOW_S: f64 = 0.33;
/// Below this rim speed [m/s, RMS] a run cannot tell.
const SLOWEST_M_S: f64 = 0.04;

/// One window: rim speeds (m/s), and the pose's step as world speed (m/s), yaw rate (rad/s) and middle heading (rad).
#[derive(Clone)]
struct Window {
    rims: Vec<f64>,
    world: [f64; 2],
    yaw: f64,
    heading: f64,
}

fn windows(run: &Run, robot: &RobotFile) -> Vec<Window> {
    let (Some(speed), Some(pose)) = (run.w.as_ref().filter(|w| !w.unsigned), &run.pose) else {
        return Vec::new();
    };
    let mut turned = vec![0.0; speed.channels.len()];
    let mut last: Option<(f64, Vec<f64>)> = None;
    let mut from: Option<(f64, Vec<f64>, Vec<f64>)> = None;
    let mut windows = Vec::new();
    for (row, &t) in run.t_s.iter().enumerate() {
        if let Some(now) = row_of(speed, row) {
            if let Some((before_t, before)) = &last {
                for j in 0..turned.len() {
                    turned[j] += 0.5 * (now[j] + before[j]) * (t - before_t);
                }
            }
            last = Some((t, now));
        }
        let (Some(pose), true) = (row_of(pose, row), last.as_ref().is_some_and(|(at, _)| *at == t)) else {
            continue;
        };
        let Some((start, before, angles)) = &from else {
            from = Some((t, pose, turned.clone()));
            continue;
        };
        let length = t - start;
        if length < WINDOW_S {
            continue;
        }
        if length < 2.0 * WINDOW_S {
            windows.push(Window {
                rims: (0..turned.len()).map(|j| robot.wheel[j].radius_m * (turned[j] - angles[j]) / length).collect(),
                world: [(pose[0] - before[0]) / length, (pose[1] - before[1]) / length],
                yaw: (pose[2] - before[2]) / length,
                heading: 0.5 * (pose[2] + before[2]),
            });
        }
        from = Some((t, pose, turned.clone()));
    }
    windows
}

pub(super) fn check(run: &Run, robot: &RobotFile) -> Option<Fault> {
    let windows = windows(run, robot);
    let Some(body) = BodyFromWheels::new(robot).filter(|_| windows.len() >= 5) else {
        return heading_alone(run);
    };
    let still = windows.iter().flat_map(|w| &w.rims).map(|v| v * v).sum::<f64>()
        < SLOWEST_M_S * SLOWEST_M_S * (windows.len() * robot.wheel.len()) as f64;
    if still {
        return heading_alone(run);
    }
    // twists by the wheels, with radii already in the rims
    let unit: Vec<f64> = robot.wheel.iter().map(|wheel| 1.0 / wheel.radius_m).collect();
    let twist = |w: &Window| body.twist(&w.rims.iter().zip(&unit).map(|(v, per)| v * per).collect::<Vec<_>>());
    let twists: Vec<[f64; 3]> = windows.iter().map(twist).collect();
    wrong_unit(run, &windows, &twists).or_else(|| wrong_frame(run, robot, &windows, &twists))
}

/// Without wheel speeds: a robot does not spin eight turns a second for long.
fn heading_alone(run: &Run) -> Option<Fault> {
    let heading = run.pose.as_ref()?.channels.get(2)?;
    let seen: Vec<(usize, f64)> = heading.present().collect();
    let mut rates: Vec<f64> =
        seen.windows(2).map(|p| ((p[1].1 - p[0].1) / (run.t_s[p[1].0] - run.t_s[p[0].0])).abs()).collect();
    rates.sort_by(f64::total_cmp);
    let high = rates.get(rates.len() * 4 / 5).copied()?;
    let (low, top) = seen.iter().fold((f64::MAX, f64::MIN), |(l, h), (_, v)| (l.min(*v), h.max(*v)));
    if high < 50.0 || top - low < 30.0 || run.w.is_some() {
        return None;
    }
    Some(degrees(run, format!("The heading turns at {high:.0} rad/s for a fifth of the run.")))
}

fn degrees(run: &Run, sentence: String) -> Fault {
    let mend = "Convert the heading to radians, or state unit = \"deg\" in columns.toml.";
    Fault::of(run, "wrong_unit", "theta_rad", true).says(format!("{sentence} It looks like degrees."), mend)
}

fn wrong_unit(run: &Run, windows: &[Window], twists: &[[f64; 3]]) -> Option<Fault> {
    let pairs =
        |f: &dyn Fn(&Window, &[f64; 3]) -> Pair| windows.iter().zip(twists).map(|(w, t)| f(w, t)).collect::<Vec<_>>();
    let turning = pairs(&|w, t| (w.yaw, t[2]));
    let going = pairs(&|w, t| (w.world[0].hypot(w.world[1]), t[0].hypot(t[1])));
    let turn = ratio(&turning).filter(|(_, fit)| fit.abs() > 0.85).map(|(ratio, _)| ratio.abs());
    let go = ratio(&going).filter(|(_, fit)| *fit > 0.8).map(|(ratio, _)| ratio);
    let told = |signal: &str, name: &str, times: f64| {
        let sentence =
            format!("The `{signal}` columns look like {name}: pose and wheel speeds differ by a factor of {times:.1}.");
        let mend = "Convert the columns to SI units, or state `unit` in columns.toml.";
        Some(Fault::of(run, "wrong_unit", signal, true).says(sentence, mend))
    };
    let of_wheels = |ratio: f64| units::explains(&units::SPEEDS, 1.0 / ratio);
    match (go, turn) {
        (Some(go), Some(turn)) if (go / turn).ln().abs() < 0.7 => {
            of_wheels(go).and_then(|unit| told("w", unit.name, unit.per_unit))
        }
        (Some(go), None) if of_wheels(go).is_some() => {
            of_wheels(go).and_then(|unit| told("w", unit.name, unit.per_unit))
        }
        (go, turn) => {
            if let Some(turn) = turn.filter(|turn| units::explains(&units::ANGLES, *turn).is_some()) {
                return Some(degrees(run, format!("The heading turns {turn:.0} times as fast as the wheels say.")));
            }
            let unit = go.and_then(|go| units::explains(&units::LENGTHS, go))?;
            told("x_m, y_m", unit.name, unit.per_unit)
        }
    }
}

/// Two numbers that should be equal: by the pose, and by the wheels.
type Pair = (f64, f64);

/// y over x by least squares, and how well it fits (−1 to 1).
fn ratio(pairs: &[Pair]) -> Option<(f64, f64)> {
    let sums = pairs.iter().fold((0.0, 0.0, 0.0), |s, (y, x)| (s.0 + y * x, s.1 + x * x, s.2 + y * y));
    (sums.1 > 0.0 && sums.2 > 0.0).then(|| (sums.0 / sums.1, sums.0 / (sums.1 * sums.2).sqrt()))
}

/// What a guess says: the pose's frame is otherwise, or the wheels are.
#[derive(Clone)]
enum Guess {
    Given,
    Degrees,
    Frame { mirrored: bool, heading_negated: bool, offset: f64 },
    Wheels(Order),
}

fn wrong_frame(run: &Run, robot: &RobotFile, windows: &[Window], twists: &[[f64; 3]]) -> Option<Fault> {
    let given = twists_by_pose(windows, false, false, 0.0);
    let asked: f64 = windows.iter().flat_map(|w| &w.rims).map(|v| v * v).sum();
    let as_given = Moments::new(robot, windows, &given);
    let mut guesses = vec![(Guess::Given, 0, true, as_given.rest(&order::all(robot.wheel.len())[0]))];
    for (mirrored, heading_negated) in [(false, false), (true, false), (false, true)] {
        let straight = twists_by_pose(windows, mirrored, heading_negated, 0.0);
        for offset in [0.0, offset(&straight, twists)] {
            let turned = usize::from(offset != 0.0);
            let twists = twists_by_pose(windows, mirrored, heading_negated, offset);
            let rest = Moments::new(robot, windows, &twists).rest(&order::all(robot.wheel.len())[0]);
            let changes = usize::from(mirrored) + usize::from(heading_negated) + turned;
            guesses.push((Guess::Frame { mirrored, heading_negated, offset }, changes, false, rest));
        }
    }
    guesses.extend(in_degrees(robot, windows, twists));
    for order in order::all(robot.wheel.len()) {
        let rest = as_given.rest(&order);
        guesses.push((Guess::Wheels(order.clone()), order.changes(), order.moved(), rest));
    }
    let before = guesses[0].3;
    let (guess, after) = order::best(&guesses, 0.01 * asked)?;
    let small_turn =
        matches!(guess, Guess::Frame { mirrored: false, heading_negated: false, offset } if offset.abs() < 0.35);
    if small_turn || after > 0.25 * asked || before < 6.0 * after || before < 0.1 * asked {
        return None;
    }
    let better = (before / after.max(1e-6 * asked)).sqrt();
    let (code, signal, what, mend) = match guess {
        Guess::Given => return None,
        Guess::Degrees => {
            let sentence =
                format!("Pose and wheel speeds agree {better:.0} times better if the heading is in degrees.");
            return Some(degrees(run, sentence));
        }
        Guess::Wheels(order) if order.is_as_given() => return None,
        Guess::Wheels(order) => {
            let code = if order.moved() { "swapped_wheels" } else { "wrong_sign" };
            (code, "w", order.words("w"), "Put the wheels into order in the log, in columns.toml, or in robot.toml.")
        }
        Guess::Frame { mirrored: true, .. } => (
            "wrong_sign",
            "x_m, y_m",
            "the pose's frame is mirrored".to_string(),
            "Turn the sign of y_m (or x_m), or swap them, in columns.toml.",
        ),
        Guess::Frame { heading_negated: true, .. } => (
            "wrong_sign",
            "theta_rad",
            "the heading counts the wrong way round".to_string(),
            "Turn the sign of theta_rad; anticlockwise is positive.",
        ),
        Guess::Frame { offset, .. } => {
            let what = format!(
                "the heading is off by {:.0} degrees, or the wheels are numbered from another one",
                -offset.to_degrees()
            );
            (
                "wrong_frame",
                "theta_rad",
                what,
                "Add the offset to theta_rad in columns.toml, or correct the drive angles.",
            )
        }
    };
    let sentence = format!("Pose and wheel speeds agree {better:.0} times better if {what}.");
    Some(Fault::of(run, code, signal, true).says(sentence, mend))
}

/// The guess that the heading is in degrees, where it has values that a wrapped heading in radians cannot have.
fn in_degrees(robot: &RobotFile, windows: &[Window], twists: &[[f64; 3]]) -> Option<(Guess, usize, bool, f64)> {
    if !windows.iter().any(|w| w.heading.abs() > TAU + 1.0) {
        return None;
    }
    let radians = |w: &Window| Window { heading: w.heading.to_radians(), yaw: w.yaw.to_radians(), ..w.clone() };
    let windows: Vec<Window> = windows.iter().map(radians).collect();
    let offset = offset(&twists_by_pose(&windows, false, false, 0.0), twists);
    let by_pose = twists_by_pose(&windows, false, false, offset);
    let rest = Moments::new(robot, &windows, &by_pose).rest(&order::all(robot.wheel.len())[0]);
    Some((Guess::Degrees, 1, true, rest))
}

/// How much further the heading must be taken (rad) for the pose's twists to lie along the wheels'.
fn offset(by_pose: &[[f64; 3]], by_wheels: &[[f64; 3]]) -> f64 {
    let along = |(p, w): (&[f64; 3], &[f64; 3])| (p[0] * w[0] + p[1] * w[1], p[0] * w[1] - p[1] * w[0]);
    let turn = by_pose.iter().zip(by_wheels).map(along).fold((0.0, 0.0), |s, a| (s.0 + a.0, s.1 + a.1));
    -turn.1.atan2(turn.0)
}

/// Body twists by the pose, the heading taken `offset` further (rad).
fn twists_by_pose(windows: &[Window], mirrored: bool, heading_negated: bool, offset: f64) -> Vec<[f64; 3]> {
    let twist = |w: &Window| {
        let way = if heading_negated { -1.0 } else { 1.0 };
        let (sin, cos) = (way * w.heading + offset).sin_cos();
        let [x, y] = [w.world[0], if mirrored { -w.world[1] } else { w.world[1] }];
        [cos * x + sin * y, cos * y - sin * x, way * w.yaw]
    };
    windows.iter().map(twist).collect()
}

/// Sums of products of what the pose says each rim does, and what it does.
struct Moments {
    expected: Vec<f64>,
    seen: Vec<f64>,
    both: Vec<Vec<f64>>,
}

impl Moments {
    fn new(robot: &RobotFile, windows: &[Window], twists: &[[f64; 3]]) -> Moments {
        let n = robot.wheel.len();
        let rows: Vec<[f64; 3]> = robot.wheel.iter().map(|wheel| wheel.row()).collect();
        let mut m = Moments { expected: vec![0.0; n], seen: vec![0.0; n], both: vec![vec![0.0; n]; n] };
        for (window, twist) in windows.iter().zip(twists) {
            for (j, row) in rows.iter().enumerate() {
                let rim: f64 = row.iter().zip(twist).map(|(a, b)| a * b).sum();
                m.expected[j] += rim * rim;
                m.seen[j] += window.rims[j] * window.rims[j];
                for k in 0..n {
                    m.both[j][k] += rim * window.rims[k];
                }
            }
        }
        m
    }

    /// What remains with one common factor from 0.4 to 2.5.
    fn rest(&self, order: &Order) -> f64 {
        let n = self.expected.len();
        let both: f64 = (0..n).map(|j| order.sign[j] * self.both[j][order.place[j]]).sum();
        let (expected, seen): (f64, f64) = (self.expected.iter().sum(), self.seen.iter().sum());
        let factor = if expected > 0.0 { (both / expected).clamp(0.4, 2.5) } else { 1.0 };
        (seen - 2.0 * factor * both + factor * factor * expected).max(0.0)
    }
}
