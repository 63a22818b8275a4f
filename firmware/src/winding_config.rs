//! # Winding configuration: what the windings' turn needs of the parameters

use model_core::control::calibration::Calibration;
use model_core::control::current_loop::CurrentLoop;
use model_core::link::block::{Block, MAX_TRIP_COUNTS, Parameters, VERSION, trip_current};
use model_core::link::hello::{Commutation, Hello};
use model_core::link::record::MOTORS;

use crate::codes::PERIODS_PER_SECOND;
use crate::offsets::{MIDDLE, REACH};
use crate::protection::TripLimits;
use crate::registers::timing;

/// Version of this firmware, as a hello tells it. From 2 on a robot that hears nothing brakes, where 1 latched a fault.
pub const FIRMWARE: u16 = 2;

/// Largest share of the bus that the three duties may span: the rest of the period is the converters', which sample while
/// all low sides conduct [1].
pub const MAX_DUTY: f32 = timing::MAX_SHARE;

const _: () = assert!(MAX_TRIP_COUNTS + REACH < MIDDLE - 1.0, "a trip is seen whatever the converter's zero");

/// What the windings' turn needs to know of the robot.
#[derive(Clone, Copy, Debug)]
pub struct WindingConfig {
    /// Motors in use; 0 without parameters
    pub wheels: u8,
    /// What codes mean
    pub calibration: Calibration<f32>,
    /// The current loop of every motor
    pub current_loop: CurrentLoop<f32>,
    /// True: commutate by the halls' sectors at every speed
    pub six_step: bool,
    /// What is too much
    pub limits: TripLimits,
    /// Speed of the wheel's shaft [rad/s] over electrical speed [rad a period]
    pub wheel_speed_per_electrical: f32,
}

impl Default for WindingConfig {
    /// No motors.
    fn default() -> Self {
        let calibration = Calibration::of_board(1);
        Self {
            wheels: 0,
            calibration,
            current_loop: CurrentLoop::new(1.0, 0.0, calibration.amps_per_count, 0.0, calibration.period, 0.0),
            six_step: false,
            limits: TripLimits::default(),
            wheel_speed_per_electrical: 0.0,
        }
    }
}

impl WindingConfig {
    /// One bit a motor in use.
    #[inline]
    pub fn motors(&self) -> u8 {
        (1 << (self.wheels & 7)) - 1
    }

    /// The windings' share of these parameters.
    pub fn of(parameters: &Parameters) -> Self {
        match parameters {
            Parameters::Three(block) => Self::of_block(block),
            Parameters::Four(block) => Self::of_block(block),
        }
    }

    fn of_block<const N: usize>(block: &Block<N>) -> Self {
        let calibration = Calibration {
            amps_per_count: block.amps_per_count,
            bus_volts_per_count: block.bus_volts_per_count,
            pole_pairs: block.pole_pairs,
            period: 1.0 / PERIODS_PER_SECOND as f32,
        };
        let motor = block.robot.motor;
        Self {
            wheels: N as u8,
            calibration,
            current_loop: CurrentLoop::new(
                motor.resistance,
                block.inductance,
                calibration.amps_per_count,
                block.bandwidth,
                calibration.period,
                MAX_DUTY,
            ),
            six_step: block.commutation == Commutation::SixStep,
            limits: TripLimits {
                // the trip current lies on either side of zero, and so may the scale
                trip_counts: trip_current(block.limits.current, calibration.amps_per_count)
                    / calibration.amps_per_count.abs(),
                least_supply: block.limits.under_voltage,
                most_supply: block.limits.over_voltage,
            },
            wheel_speed_per_electrical: calibration.wheel_speed(1.0, motor.gear_ratio),
        }
    }

    /// How to read the records of a robot with these parameters; the converters' zeros are not known yet.
    pub fn hello(&self, parameters: &Parameters, check: u32) -> Hello {
        let (gear_ratio, commutation) = match parameters {
            Parameters::Three(block) => (block.robot.motor.gear_ratio, block.commutation),
            Parameters::Four(block) => (block.robot.motor.gear_ratio, block.commutation),
        };
        Hello {
            firmware: FIRMWARE,
            block_version: VERSION,
            block_check: check,
            wheels: self.wheels,
            commutation,
            calibration: self.calibration,
            gear_ratio,
            offsets: [[0; 3]; MOTORS],
        }
    }
}
