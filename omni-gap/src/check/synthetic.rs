//! A small simulated robot for the tests of this room.

use crate::log::{Catalogue, Channel, Group, Missing, RobotFile, Run};
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;
use std::path::Path;

/// What differs from the plain robot.
#[derive(Debug, Clone)]
pub struct Made {
    pub wheels: usize,
    pub seconds: f64,
    pub step_s: f64,
    /// Volts lost in the bridge.
    pub dead_volts: f64,
    /// Torque and Kv factor of wheel 1.
    pub weak: f64,
    /// How much faster wheels turn than the body moves.
    pub slip: f64,
    /// Camera latency (s).
    pub latency_s: f64,
    /// Slope's pull along world x (m/s²).
    pub slope: f64,
    /// Offset of current sensors (A).
    pub offset_a: f64,
    /// All nominal motor parameters are off by this factor.
    pub wrong: f64,
    pub noise: f64,
    /// Volts of the drive; zero is a robot at rest.
    pub drive: f64,
    /// Only straight on.
    pub straight: bool,
    /// A hand: start (s), length (s), acceleration (m/s²).
    pub hand: Option<(f64, f64, f64)>,
}

impl Default for Made {
    fn default() -> Made {
        Made {
            wheels: 4,
            seconds: 12.0,
            step_s: 0.01,
            dead_volts: 0.0,
            weak: 1.0,
            slip: 1.0,
            latency_s: 0.0,
            slope: 0.0,
            offset_a: 0.0,
            wrong: 1.0,
            noise: 1.0,
            drive: 6.0,
            straight: false,
            hand: None,
        }
    }
}

pub fn robot(wheels: usize) -> RobotFile {
    let angles: &[f64] = if wheels == 3 { &[150.0, 270.0, 30.0] } else { &[90.0, 180.0, 270.0, 0.0] };
    let mut text = String::from("name = \"r\"\n");
    for angle in angles {
        text += &format!("[[wheel]]\ndrive_angle_deg = {angle}\ndistance_m = 0.089\nradius_m = 0.0325\n");
    }
    text += "[motor]\ngear_ratio = 5.0\nresistance_ohm = 4.3\nemf_constant_V_s = 0.0259\ntorque_constant_Nm_per_A = 0.0259\n\
             [body]\nmass_kg = 2.34\ninertia_kg_m2 = 0.0228\n[friction]\ncoulomb_v_N = 1.9\ncoulomb_vn_N = 2.2\ncoulomb_w_Nm = 0.14\n";
    RobotFile::parse(&text, Path::new("robot.toml"), &Catalogue::default()).unwrap()
}

/// Wanted direction of drive: v, vn, ω in −1..1; off for the last quarter of every 4 s.
fn wanted(made: &Made, t: f64) -> [f64; 3] {
    if t % 4.0 > 3.0 || t < 0.2 {
        return [0.0; 3];
    }
    let step = (t / 1.0) as usize;
    if made.straight {
        return [[0.9, -0.8, 0.6][step % 3], 0.0, 0.0];
    }
    let wave = (TAU * 0.7 * t).sin();
    [
        [0.7, -0.5, 0.2, 0.0][step % 4] + 0.2 * wave,
        [0.1, 0.6, -0.6, 0.0][step % 4],
        [0.3, 0.0, -0.4, 0.1][step % 4] - 0.2 * wave,
    ]
}

pub fn run(made: &Made) -> Run {
    let robot = robot(made.wheels);
    let n = made.wheels;
    let k = robot.volts_per_wheel_speed() * made.wrong;
    let r_ohm = robot.motor.resistance_ohm * made.wrong;
    let rows: Vec<[f64; 3]> = robot.wheel.iter().map(|w| w.wheel().row()).collect();
    let radius = robot.wheel[0].radius_m;
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let mut noise = move |sigma: f64| made.noise * sigma * ((0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0);
    let (mut twist, mut pose) = ([0.0f64; 3], [0.3f64, -0.2, 0.4]);
    let mut poses: Vec<[f64; 3]> = Vec::new();
    let (mut t_s, mut u, mut i, mut w) = (Vec::new(), vec![Vec::new(); n], vec![Vec::new(); n], vec![Vec::new(); n]);
    let mut seen = vec![Vec::new(); 3];
    const FINE: f64 = 0.001;
    for row in 0..(made.seconds / made.step_s) as usize {
        let t = row as f64 * made.step_s;
        let want = wanted(made, t);
        let volts: Vec<f64> =
            rows.iter().map(|a| made.drive * (a[0] * want[0] + a[1] * want[1] + want[2] * 0.8)).collect();
        let rim = |twist: &[f64; 3], j: usize| rows[j].iter().zip(twist).map(|(a, b)| a * b).sum::<f64>();
        let motor = |twist: &[f64; 3], j: usize| {
            let weak = if j == 1 { made.weak } else { 1.0 };
            let speed = rim(twist, j) / radius * made.slip;
            let emf = weak * k * speed;
            let left = volts[j] - emf;
            let amps = left.signum() * (left.abs() - made.dead_volts).max(0.0) / r_ohm;
            (speed, amps, weak * 5.0 * 0.0259 * amps / radius)
        };
        t_s.push(t);
        for j in 0..n {
            let (speed, amps, _) = motor(&twist, j);
            u[j].push(volts[j]);
            i[j].push(amps + made.offset_a + noise(0.02));
            w[j].push(speed + noise(0.15));
        }
        for _ in 0..(made.step_s / FINE).round() as usize {
            let mut force = [0.0; 3];
            for (j, row) in rows.iter().enumerate() {
                let (_, _, pull) = motor(&twist, j);
                for (force, part) in force.iter_mut().zip(row) {
                    *force += part * pull;
                }
            }
            let (sin, cos) = pose[2].sin_cos();
            force[0] += 2.34 * made.slope * cos;
            force[1] -= 2.34 * made.slope * sin;
            if let Some((_, _, push)) = made.hand.filter(|hand| t >= hand.0 && t < hand.0 + hand.1) {
                force[0] += 2.34 * push + 1.9;
            }
            for (axis, (mass, hold)) in [(2.34, 1.9), (2.34, 2.2), (0.0228, 0.14)].into_iter().enumerate() {
                let free = twist[axis] + force[axis] / mass * FINE;
                let stop = hold / mass * FINE;
                twist[axis] = if free.abs() < stop { 0.0 } else { free - free.signum() * stop };
            }
            pose[0] += (cos * twist[0] - sin * twist[1]) * FINE;
            pose[1] += (sin * twist[0] + cos * twist[1]) * FINE;
            pose[2] += twist[2] * FINE;
            poses.push(pose);
        }
        let late = poses.len().saturating_sub(1 + (made.latency_s / FINE) as usize).min(poses.len() - 1);
        for (axis, sigma) in [0.003, 0.003, 0.01].into_iter().enumerate() {
            seen[axis].push((row % 3 == 0).then(|| poses[late][axis] + noise(sigma)));
        }
    }
    let blank = |column: Vec<Option<f64>>| column.into_iter().map(|v| v.ok_or(Missing::Blank)).collect::<Channel>();
    Run {
        name: "made".into(),
        t_s,
        u: Some(Group::from_columns(u)),
        i: Some(Group::from_columns(i)),
        w: Some(Group::from_columns(w)),
        pose: Some(Group::new(seen.into_iter().map(blank).collect())),
        ..Run::default()
    }
}
