//! # Which column is which wheel, by the angles that they roll along

use super::kinematics::Reading;
use crate::log::{RobotFile, permutations};
use std::f64::consts::{PI, TAU};

/// Columns put to wheels.
#[derive(Debug, Clone)]
pub(super) struct Wheels {
    /// The column of each wheel.
    pub column: Vec<usize>,
    /// The sign of each wheel's column.
    pub sign: Vec<f64>,
    /// What the heading lacks (rad).
    pub offset_rad: f64,
    /// How far the angles are from the robot file's (rad, RMS).
    pub off_rad: f64,
    /// Numbers of the columns in a rad/s, and of the pose in a metre; none where the robot hardly turned.
    pub scales: Option<Scales>,
    /// Numbers of the columns in a rad/s, over those of the pose in a metre [m·s/rad].
    pub per_rad_s_per_m: f64,
}

impl Wheels {
    /// Whether their order is another than that of their names.
    pub fn are_moved(&self) -> bool {
        self.column.iter().enumerate().any(|(wheel, column)| wheel != *column)
    }

    /// How many things are otherwise than their names would have it: the order, signs (all at once being one), and a
    /// marker that lies across.
    pub fn changes(&self) -> usize {
        let turned = self.sign.iter().filter(|sign| **sign < 0.0).count();
        let all = turned == self.sign.len();
        usize::from(self.are_moved())
            + if all { 1 } else { turned }
            + usize::from(self.offset_rad.abs() > NO_OFFSET_RAD)
    }
}

/// A heading that is off by less than this may be what a diagnosis is to find, a turned camera (rad).
pub(super) const NO_OFFSET_RAD: f64 = 0.25;

/// What the numbers of columns and pose are in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales {
    pub per_rad_s: f64,
    pub per_m: f64,
}

/// Drive angles further than this from the robot file's are others (rad, RMS).
pub(super) const OFF_RAD: f64 = 0.35;

/// Angles nearer to each other than this cannot be told apart (rad).
const SAME_RAD: f64 = 0.1;

/// Puts columns to wheels: every way that fits the drive angles as well as the best, since a robot that looks the same after a
/// turn has several; none where it turned too little for the signs of its wheels.
pub(super) fn find(reading: &Reading, robot: &RobotFile) -> Vec<Wheels> {
    const SURE: f64 = 0.2;
    // less than that slip makes of a robot that goes straight on
    const TURNS: f64 = 0.02;
    let by_turning = reading.columns.iter().map(|column| column.by_turning).sum::<f64>() / reading.columns.len() as f64;
    if by_turning < TURNS || reading.columns.iter().any(|column| column.unsure_turn > SURE) {
        return Vec::new();
    }
    let sign: Vec<f64> = reading.columns.iter().map(|column| column.of[2].signum()).collect();
    let all = permutations(sign.len()).into_iter().map(|column| ordered(reading, robot, column, &sign));
    let mut all: Vec<Wheels> = all.collect();
    let least = all.iter().map(|wheels| wheels.off_rad).fold(f64::INFINITY, f64::min);
    all.retain(|wheels| wheels.off_rad <= least + SAME_RAD);
    all
}

fn ordered(reading: &Reading, robot: &RobotFile, column: Vec<usize>, sign: &[f64]) -> Wheels {
    let (offset_rad, off_rad) = lies(reading, robot, &column, sign);
    // κ = |γ| r/d
    let of_wheel = |wheel: usize| {
        reading.columns[column[wheel]].of[2].abs() * robot.wheel[wheel].radius_m / robot.wheel[wheel].distance_m
    };
    let per_rad_s = (0..column.len()).map(of_wheel).sum::<f64>() / column.len() as f64;
    let per_rad_s_per_m = along(reading, robot, &column);
    Wheels {
        sign: column.iter().map(|column| sign[*column]).collect(),
        column,
        offset_rad,
        off_rad,
        scales: Some(Scales { per_rad_s, per_m: per_rad_s / per_rad_s_per_m }),
        per_rad_s_per_m,
    }
}

/// Columns in the order of their names, none turned round: what is left to say where the robot hardly turned.
pub(super) fn as_named(reading: &Reading, robot: &RobotFile) -> Wheels {
    let column: Vec<usize> = (0..reading.columns.len()).collect();
    let sign = vec![1.0; column.len()];
    let (offset_rad, off_rad) = lies(reading, robot, &column, &sign);
    let per_rad_s_per_m = along(reading, robot, &column);
    Wheels { column, sign, offset_rad, off_rad, scales: None, per_rad_s_per_m }
}

/// How the heading lies (rad) if the columns are the wheels in this order and with these signs, and how far their angles are
/// then from the robot file's (rad, RMS).
fn lies(reading: &Reading, robot: &RobotFile, order: &[usize], sign: &[f64]) -> (f64, f64) {
    let apart = |(wheel, column): (usize, &usize)| {
        let (of, sign) = (reading.columns[*column].of, sign[*column]);
        (sign * of[1]).atan2(sign * of[0]) - robot.wheel[wheel].drive_angle_deg.to_radians()
    };
    let apart: Vec<f64> = order.iter().enumerate().map(apart).collect();
    let (sin, cos) = apart.iter().fold((0.0, 0.0), |sum, a| (sum.0 + a.sin(), sum.1 + a.cos()));
    let offset = f64::atan2(sin, cos);
    let off = apart.iter().map(|a| wrapped(a - offset).powi(2)).sum::<f64>() / apart.len() as f64;
    (offset, off.sqrt())
}

/// κ·λ = |α + iβ| r, in the mean
fn along(reading: &Reading, robot: &RobotFile, order: &[usize]) -> f64 {
    let of_wheel =
        |(wheel, column): (usize, &usize)| reading.columns[*column].of.xy().norm() * robot.wheel[wheel].radius_m;
    order.iter().enumerate().map(of_wheel).sum::<f64>() / order.len() as f64
}

/// An angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
