//! # Heading: what a lap leaves of the direction that a robot faces
//!
//! The wheels' distance from the centre is believed 2 % too large, or too small. A robot without a gyro then turns 2 % more or less
//! than it is told, 7.2° in a lap with one turn. The same ride is driven with a gyro ([`model_core::control::heading`]) whose bias,
//! noise and scale are as far off as its data sheet lets them be, after it has stood for 2.4 s.
//!
//! Laps: a circle with the robot's face along it (one whole turn), a square with a quarter turn on each corner (one whole turn),
//! and a figure-eight of two circles (one turn to each side). Each leg's speeds rise and fall over 0.3 s. Nobody corrects the
//! heading; what is told is by how much the true one was off the commanded one at the end of the lap, at rest.

use std::f64::consts::{FRAC_PI_2, TAU};

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::geometry::kinematics::{Wheel, Wheels};
use model_core::link::block::Block;
use model_core::link::sensor_codes::SensorScales;
use model_core::plant::paper::four_wheels;

use super::robots::{self, HALL_SPREAD, SAG, ToParameters};
use super::{ClosedLoopRun, HostProgram};
use crate::emulator::{BoardProgram, RunError};
use crate::virtual_board::motion_sensors::{GyroErrors, scales};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// Time in which a leg's speeds rise, and fall [s]
const RAMP: f64 = 0.3;

/// Time at rest before a lap [s]: the converters' zeros, and eight windows of the gyro.
const REST: f64 = 2.4;

/// Time at rest after it [s]
const AFTER: f64 = 0.3;

/// By how much the wheels' distance is believed too large [1].
pub const DISTANCES: [f64; 2] = [0.02, -0.02];

/// The most that a heading may be off after a lap, with a gyro that was calibrated [°]
pub const MOST: f64 = 1.0;

/// A way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lap {
    /// Once round, facing along
    Circle,
    /// Four sides, and a quarter turn on each corner
    Square,
    /// A circle to the left, and one to the right
    FigureEight,
}

/// A part of a lap: speeds that rise, stay and fall.
#[derive(Clone, Copy, Debug)]
struct Leg {
    v: f64,
    w: f64,
    /// From the beginning of the rise to the end of the fall [s]
    time: f64,
}

impl Leg {
    /// One that turns by an angle [rad].
    fn turning(v: f64, w: f64, angle: f64) -> Self {
        // ∫ω dt = ω·(T − ramp)
        Self { v, w, time: angle / w + RAMP }
    }

    fn share(&self, time: f64) -> f64 {
        (time / RAMP).min((self.time - time) / RAMP).clamp(0.0, 1.0)
    }
}

impl Lap {
    /// All of them.
    pub const ALL: [Lap; 3] = [Lap::Circle, Lap::Square, Lap::FigureEight];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Lap::Circle => "circle",
            Lap::Square => "square",
            Lap::FigureEight => "figure-eight",
        }
    }

    fn legs(self) -> Vec<Leg> {
        match self {
            Lap::Circle => vec![Leg::turning(1.0, 2.0, TAU)],
            Lap::Square => [Leg { v: 1.0, w: 0.0, time: 1.0 }, Leg::turning(0.0, 3.0, FRAC_PI_2)].repeat(4),
            Lap::FigureEight => vec![Leg::turning(1.0, 2.0, TAU), Leg::turning(1.0, -2.0, -TAU)],
        }
    }

    /// How long it takes [s].
    fn duration(self) -> f64 {
        self.legs().iter().map(|leg| leg.time).sum()
    }

    /// How far it turns [rad].
    fn turns(self) -> f64 {
        self.legs().iter().map(|leg| leg.w * (leg.time - RAMP)).sum()
    }

    /// The motion at a time since its beginning [s].
    fn twist(self, time: f64) -> BodyTwist<f64> {
        let mut since = time;
        for leg in self.legs() {
            if since < leg.time {
                let share = leg.share(since);
                return BodyTwist { v: share * leg.v, vn: 0.0, w: share * leg.w };
            }
            since -= leg.time;
        }
        BodyTwist::default()
    }
}

/// The block of the paper's robot with this gyro scale, its wheels' distance off by a share [1].
fn block(distance: f64, sensors: SensorScales) -> Block<4> {
    let mut robot = four_wheels::<f32>();
    let wheels =
        robot.wheels.wheels().map(|wheel| Wheel { distance: wheel.distance * (1.0 + distance) as f32, ..wheel });
    robot.wheels = Wheels::new(wheels);
    Block { sensors, ..robots::block(robot) }
}

/// The board with this gyro, or without one.
fn setup(gyro: Option<GyroErrors>, seed: u64) -> BoardSetup<4> {
    let mut besides = Effects::default();
    besides.add(EffectKind::SupplySag, None, &[SAG, 0.0]).expect("room for one");
    BoardSetup { hall_spread: HALL_SPREAD, gyro, ..BoardSetup::new(four_wheels(), besides, seed) }
}

/// Drives a lap on a program: by how much the heading is off at its end [°].
///
/// # Errors
/// [`RunError`] says what became of the program.
pub fn drift_of<B: BoardProgram>(
    program: B,
    lap: Lap,
    distance: f64,
    gyro: Option<GyroErrors>,
    seed: u64,
) -> Result<f64, RunError> {
    let mut run = ClosedLoopRun::new(program, VirtualBoard::new(setup(gyro, seed)));
    let sensors = match gyro {
        Some(_) => SensorScales { encoder: 0.0, ..scales(four_wheels::<f32>().motor.gear_ratio) },
        None => SensorScales::default(),
    };
    run.send_block(&block(distance, sensors).parameters());
    run.wait(REST)?;
    let before = run.lockstep.board.state().pose.theta;
    run.follow_ramps(lap.duration(), |time| lap.twist(time))?;
    run.follow(AFTER, |_| BodyTwist::default())?;
    Ok((run.lockstep.board.state().pose.theta - before - lap.turns()).to_degrees())
}

/// The same on the library.
///
/// # Errors
/// As [`drift_of`].
pub fn drift(lap: Lap, distance: f64, gyro: Option<GyroErrors>, seed: u64) -> Result<f64, RunError> {
    drift_of(HostProgram::default(), lap, distance, gyro, seed)
}

/// Gyros that are compared, in the order of the page's columns.
fn gyros() -> [Option<GyroErrors>; 3] {
    [None, Some(GyroErrors::uncalibrated()), Some(GyroErrors::calibrated())]
}

/// The largest drift over both distances and some seeds, of each gyro [°].
///
/// # Errors
/// As [`drift_of`].
pub fn largest(lap: Lap) -> Result<[f64; 3], RunError> {
    let mut most = [0.0_f64; 3];
    for (most, gyro) in most.iter_mut().zip(gyros()) {
        for distance in DISTANCES {
            for (seed, sign) in [(1, 1.0), (2, -1.0)] {
                let gyro = gyro.map(|gyro| GyroErrors { bias: sign * gyro.bias, scale: sign * gyro.scale, ..gyro });
                let off = drift(lap, distance, gyro, seed)?.abs();
                // one that is no number is the largest too
                *most = if off <= *most { *most } else { off };
            }
        }
    }
    Ok(most)
}

/// The page.
pub fn page(rows: &[(Lap, [f64; 3])]) -> String {
    let mut text = String::from(
        "# Heading after a lap\n\nMade by `BLESS=1 cargo test -p host-tests --test heading_page`. Four wheels whose distance from the centre \
         is believed 2 % too large or too small; the largest of both, of two seeds each, and of a gyro whose bias and scale are off to \
         either side. Bias 1 °/s, noise 0.014 °/s/√Hz; scale off by 1 % out of its box, by 0.2 % where it was calibrated (BMI088 data \
         sheet). The software loop, without the emulator.\n\n\
         | lap | without a gyro | gyro out of its box | gyro calibrated |\n|---|---|---|---|\n",
    );
    for (lap, [without, uncalibrated, calibrated]) in rows {
        text += &format!("| {} | {without:.1}° | {uncalibrated:.1}° | {calibrated:.1}° |\n", lap.name());
    }
    text += &format!("\nPromised: at most {MOST:.0}° with a gyro that was calibrated.\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::link::block::Parameters;

    #[test]
    fn a_lap_comes_round_as_often_as_it_says() {
        for (lap, turns) in Lap::ALL.into_iter().zip([1.0, 1.0, 0.0]) {
            let steps = (lap.duration() * 1e4).round() as usize;
            let turned: f64 = (0..steps).map(|k| 1e-4 * lap.twist(1e-4 * (k as f64 + 0.5)).w).sum();
            assert!(
                (turned - turns * TAU).abs() < 1e-3 && (lap.turns() - turns * TAU).abs() < 1e-9,
                "{lap:?} {turned}"
            );
        }
    }

    #[test]
    fn a_gyro_that_nobody_asks_changes_nothing() {
        let records = |gyro| {
            let mut run = ClosedLoopRun::new(HostProgram::default(), VirtualBoard::new(setup(gyro, 5)));
            run.send_block(&Parameters::Four(block(0.0, SensorScales::default())));
            run.wait(0.2).expect("software does not fail");
            run.follow(0.3, |_| BodyTwist { v: 0.3, vn: 0.1, w: 1.0 }).expect("software does not fail");
            run.log.records
        };
        let without = records(None);
        assert!(without.len() > 400 && without.iter().all(|record| record.sensors.is_none()));
        assert_eq!(without, records(Some(GyroErrors::calibrated())));
    }

    #[test]
    fn records_tell_what_the_gyro_said() {
        let quiet = GyroErrors { bias: 0.0, noise: 0.0, scale: 0.0 };
        let mut run = ClosedLoopRun::new(HostProgram::default(), VirtualBoard::new(setup(Some(quiet), 5)));
        let scales = scales(four_wheels::<f32>().motor.gear_ratio);
        run.send_block(&Parameters::Four(block(0.0, scales)));
        run.wait(0.2).expect("software does not fail");
        run.follow(0.5, |_| BodyTwist { v: 0.0, vn: 0.0, w: 2.0 }).expect("software does not fail");
        let last = run.log.records.last().and_then(|record| record.sensors).expect("a robot with a gyro");
        let told = f64::from(scales.yaw_rate(&last).expect("a reading"));
        let truth = run.log.truth[run.log.truth.len() - 2].twist.w;
        assert!((told - truth).abs() < 0.02 && truth > 1.8, "{told} {truth}");
        assert_eq!(last.angle(0), None, "a board without encoders");
    }
}
