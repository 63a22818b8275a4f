//! # Winding configuration: what the windings' turn needs of the parameters

use model_core::control::calibration::Calibration;
use model_core::control::current_loop::CurrentLoop;
use model_core::control::hall_tracker::HallEdges;
use model_core::control::halls::HallCode;
use model_core::control::wiring::{MotorLeads, MotorWiring};
use model_core::link::block::{Block, MAX_TRIP_COUNTS, Parameters, VERSION, trip_current};
use model_core::link::hello::{Commutation, Hello};
use model_core::link::record::MOTORS;

use crate::codes::{Codes, PERIODS_PER_SECOND};
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
    /// How the motors are wired, where any was commissioned
    pub wiring: Option<WiringTables>,
}

/// How the motors are wired, as the turn needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WiringTables {
    leads: [MotorLeads; MOTORS],
    edges: [HallEdges; MOTORS],
    /// What stands for each code of the hall lines
    halls: [[HallCode; 8]; MOTORS],
    /// One bit a motor that was commissioned
    commissioned: u8,
}

impl WiringTables {
    /// Those of a block; none where no motor was commissioned.
    fn of<const N: usize>(wirings: &[Option<MotorWiring>; N]) -> Option<Self> {
        let plain = MotorWiring::default();
        let edges = [HallEdges::new(plain.edges); MOTORS];
        let mut tables = Self { leads: [plain.leads(); MOTORS], edges, halls: [PLAIN_HALLS; MOTORS], commissioned: 0 };
        for (j, wiring) in wirings.iter().enumerate().take(MOTORS) {
            if let Some(wiring) = wiring {
                tables.leads[j] = wiring.leads();
                tables.edges[j] = HallEdges::new(wiring.edges);
                tables.halls[j] = wiring.hall_table();
                tables.commissioned |= 1 << j;
            }
        }
        (tables.commissioned != 0).then_some(tables)
    }

    /// What the board would read if it were wired as its table of pins says.
    #[inline]
    pub fn codes(&self, read: &Codes) -> Codes {
        let mut codes = *read;
        for j in 0..MOTORS {
            codes.phases[j] = self.leads[j].phases(read.phases[j]);
            codes.halls[j] = self.halls[j][usize::from(read.halls[j].0 & 7)];
        }
        codes
    }

    /// Duties of a motor's outputs that give its phases theirs [1].
    #[inline]
    pub fn duties(&self, motor: usize, duties: [f32; 3]) -> [f32; 3] {
        self.leads[motor % MOTORS].duties(duties)
    }

    /// Where a motor's hall edges are, if it was commissioned.
    #[inline]
    pub fn edges(&self, motor: usize) -> Option<&HallEdges> {
        self.edges.get(motor).filter(|_| self.commissioned >> (motor & 7) & 1 != 0)
    }
}

/// Every code stands for itself.
const PLAIN_HALLS: [HallCode; 8] =
    [HallCode(0), HallCode(1), HallCode(2), HallCode(3), HallCode(4), HallCode(5), HallCode(6), HallCode(7)];

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
            wiring: None,
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
            wiring: WiringTables::of(&block.wiring),
        }
    }

    /// How to read the records of a robot with these parameters; the converters' zeros are not known yet.
    pub fn hello(&self, parameters: &Parameters, check: u32) -> Hello {
        let (gear_ratio, commutation, sensors) = match parameters {
            Parameters::Three(block) => (block.robot.motor.gear_ratio, block.commutation, block.sensors),
            Parameters::Four(block) => (block.robot.motor.gear_ratio, block.commutation, block.sensors),
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
            sensors,
        }
    }
}
