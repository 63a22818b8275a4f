//! Under which circumstances a window was driven: what a residual is laid over.
//!
//! They are told by a free run that restarted well before the window, not by what was measured in it: a measurement shares its
//! noise with the residual, and what is laid over its own noise has a shape.

use std::f64::consts::TAU;
use std::ops::Range;

use model_core::plant::Plant;

use super::model::Feature;
use crate::simulate::{AlignedRun, Prediction};

/// What a wheel does.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AtWheel {
    /// [rad/s]
    pub speed: f64,
    /// [A]
    pub current: f64,
    /// [rad/s²]
    pub acceleration: f64,
    /// Since the run began [rad], where speeds are logged
    pub angle: Option<f64>,
}

/// The circumstances of a window, as means over it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Circumstances {
    /// Of each wheel.
    pub wheels: [AtWheel; 4],
    /// v, vn [m/s] and ω [rad/s]
    pub twist: [f64; 3],
    /// x, y [m] and heading [rad] in the world
    pub pose: [f64; 3],
    /// Since the run began [s]
    pub time: f64,
    /// What the load takes off the bus voltage [V], where that was measured
    pub drop: Option<f64>,
}

impl Circumstances {
    /// Of some rows of a run, as a prediction tells them.
    pub fn of<const N: usize>(
        plant: &Plant<N, f64>,
        run: &AlignedRun<N>,
        told: &Prediction,
        rows: Range<usize>,
    ) -> Self {
        let channels = AlignedRun::<N>::channels();
        let (first, last, middle) = (rows.start, rows.end - 1, rows.start + rows.len() / 2);
        let mean =
            |channel: usize| told.rows[rows.clone()].iter().map(|row| row[channel]).sum::<f64>() / rows.len() as f64;
        let span = (run.t[last] - run.t[first]).max(f64::MIN_POSITIVE);
        let mut wheels = [AtWheel::default(); 4];
        for (j, wheel) in wheels.iter_mut().enumerate().take(N) {
            let speed = channels.wheel_speed(j);
            *wheel = AtWheel {
                speed: mean(speed),
                current: mean(channels.current(j)),
                acceleration: (told.rows[last][speed] - told.rows[first][speed]) / span,
                angle: run.turned(middle).map(|turned| turned[j]),
            };
        }
        let battery = channels.battery();
        let drops: Vec<f64> =
            rows.clone().filter(|row| run.saw(*row, battery)).map(|row| run.measured[row][battery]).collect();
        Self {
            twist: plant.robot().wheels.twist_of_wheel_speeds(std::array::from_fn(|j| wheels[j].speed)).to_array(),
            wheels,
            pose: channels.pose().map(|channel| told.rows[middle][channel]),
            time: run.t[middle],
            drop: (!drops.is_empty()).then(|| drops.iter().sum::<f64>() / drops.len() as f64),
        }
    }

    /// A feature, if it is known; of the wheel's.
    pub fn feature(&self, feature: Feature, wheel: usize) -> Option<f64> {
        let at = &self.wheels[wheel];
        let [v, vn, w] = self.twist;
        Some(match feature {
            Feature::WheelSpeed => at.speed,
            Feature::Current => at.current,
            Feature::CurrentSize => at.current.abs(),
            Feature::WheelAcceleration => at.acceleration,
            Feature::WheelAngle => at.angle?.rem_euclid(TAU),
            Feature::SpeedAhead => v,
            Feature::SpeedLeft => vn,
            Feature::YawRate => w,
            Feature::Heading => self.pose[2].rem_euclid(TAU),
            Feature::Turning => v * w,
            Feature::Time => self.time,
            Feature::TotalCurrent => self.wheels.iter().map(|wheel| wheel.current.abs()).sum(),
            Feature::BatteryDrop => self.drop?,
            Feature::Place | Feature::Order => return None,
        })
    }
}
