//! # Windings: the turn of all motors, once a period
//!
//! ```text
//! codes ─ guards ─ halls ─ angle ─┬─ current loop ─ duties
//!                                 └─ what the motion turn is told
//! ```
//!
//! First the offsets of the converters are learned with the bridges open, and followed as long as they stay so. Then every period looks for what must not be,
//! follows the halls, and has the current loop decide: six-step while a motor's speed is not known yet, field-oriented
//! once its halls tell where the rotor is between two edges. A fault opens the bridges in the turn that sees it; it is
//! latched until it is cleared. Without parameters nothing is driven.
//!
//! A voltage decided with one sample is on the motor from the next sample on, for a period
//! ([`crate::registers::timing`]); the mean that a record tells covers exactly the time from its predecessor's codes to
//! its own.

use model_core::control::current_loop::CurrentSetpoint;
use model_core::control::halls::HallCode;
use model_core::link::faults::Fault;

use crate::codes::{Codes, MOTORS, PERIODS_PER_TICK};
use crate::motion::MotionOutput;
use crate::motor_controller::{MotorController, MotorMeasurement, NO_VOLTAGE};
use crate::offsets::Offsets;
use crate::protection::Protection;
use crate::winding_config::WindingConfig;
use crate::winding_signals::{MotorSetpoints, WindingFeedback};

/// What the board is to do in the next period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BridgeCommand {
    /// Duties of the three phases [1]
    pub duties: [[f32; 3]; MOTORS],
    /// One bit a motor: its gate driver is enabled
    pub enabled: u8,
}

/// All windings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Windings {
    config: WindingConfig,
    offsets: Offsets,
    protection: Protection,
    motors: [MotorController; MOTORS],
    setpoints: MotorSetpoints,
    feedback: WindingFeedback,
    period: u32,
    /// Periods for which all bridges have been open
    open: u8,
}

/// Periods after which nothing of a current is left in an open bridge: 1 ms.
const CURRENT_FREE: u8 = 20;

impl Windings {
    /// Takes what a motion turn decided, from the next period on.
    pub fn apply(&mut self, output: &MotionOutput) {
        self.setpoints = output.setpoints;
        if let Some(config) = &output.config {
            self.install(config);
        }
        if output.clear {
            self.clear();
        }
        self.protection.latch_all(output.faults);
        for j in (0..MOTORS).filter(|j| output.stalled >> j & 1 != 0) {
            self.protection.disable_motor(Fault::Stall, j, self.config.wheels);
        }
    }

    /// Takes other parameters; motors that come or go begin anew.
    #[inline(never)]
    fn install(&mut self, config: &WindingConfig) {
        if config.wheels != self.config.wheels {
            self.motors = [MotorController::default(); MOTORS];
            self.protection.set_wheels(config.wheels);
        }
        self.config = *config;
    }

    /// Forgets latched faults; what is still there is found again in the next turns.
    fn clear(&mut self) {
        self.protection = Protection::default();
        if self.offsets.bad() & self.config.motors() != 0 {
            self.offsets = Offsets::default();
        }
    }

    /// What has been found and is latched.
    pub fn protection(&self) -> &Protection {
        &self.protection
    }

    /// Latches a fault that was seen elsewhere.
    pub fn latch(&mut self, fault: Fault) {
        self.protection.latch(fault);
    }

    /// What the last motion turn's codes were, and what goes with them.
    pub fn feedback(&self) -> WindingFeedback {
        self.feedback
    }

    /// True if a motion turn begins with the period that has just been looked at.
    #[inline]
    pub fn motion_is_due(&self) -> bool {
        self.period.is_multiple_of(PERIODS_PER_TICK)
    }

    /// One period: what to do in the next.
    #[inline]
    pub fn tick(&mut self, codes: &Codes) -> BridgeCommand {
        self.period = self.period.wrapping_add(1);
        let setpoints = self.setpoints;
        let bus = self.config.calibration.bus_voltage(codes.bus);
        if self.config.wheels > 0 {
            self.protection.supply(&self.config.limits, bus);
        }
        if !self.offsets.are_known() {
            self.offsets.learn(&codes.phases);
        } else if self.open >= CURRENT_FREE && self.protection.faults().is_empty() {
            self.offsets.follow(&codes.phases);
        }
        let ready = self.offsets.are_known();
        if codes.driver_fault && ready && self.config.limits.allow_supply(bus) {
            self.protection.latch(Fault::DriverLine);
        }
        let broken = self.offsets.bad() & self.config.motors();
        if broken != 0 {
            for j in (0..MOTORS).filter(|j| broken >> j & 1 != 0) {
                self.protection.disable_motor(Fault::OffsetCalibration, j, self.config.wheels);
            }
        }
        let may = if ready { setpoints.enabled & self.config.motors() & !self.protection.disabled() } else { 0 };

        let mut command = BridgeCommand::default();
        let per_bus = 1.0 / bus;
        for j in 0..MOTORS {
            let motor = &mut self.motors[j];
            motor.accumulate_voltage();
            if j >= usize::from(self.config.wheels) {
                continue;
            }
            let measured = MotorMeasurement { codes: codes.phases[j], offsets: self.offsets.of(j), bus, per_bus };
            let setpoint = CurrentSetpoint {
                current: setpoints.current[j],
                voltage: setpoints.voltage[j],
                closed: setpoints.closed,
            };
            let place = Place { motor: j, ready, closed: may >> j & 1 != 0, hall: codes.halls[j] };
            command.duties[j] = tick_motor(motor, &mut self.protection, &self.config, &place, &measured, &setpoint);
        }
        if self.protection.faults().is_empty() {
            command.enabled = may & !self.protection.disabled();
        }
        if command.enabled != may {
            // what was decided above and is not applied
            for (j, (motor, duties)) in self.motors.iter_mut().zip(&mut command.duties).enumerate() {
                if command.enabled >> j & 1 == 0 {
                    *duties = NO_VOLTAGE;
                    motor.bridge_opened();
                }
            }
        }
        self.open = if command.enabled == 0 { self.open.saturating_add(1) } else { 0 };
        if self.motion_is_due() {
            self.feedback = self.measure(codes, bus);
        }
        command
    }

    /// What the motion turn is to know of this period; begins its next mean.
    #[inline]
    fn measure(&mut self, codes: &Codes, bus: f32) -> WindingFeedback {
        let mut feedback = WindingFeedback {
            period: self.period,
            codes: *codes,
            bus,
            faults: self.protection.faults(),
            motor_faults: self.protection.motor_faults(),
            disabled: self.protection.disabled(),
            ready: self.offsets.are_known(),
            offsets: *self.offsets.all(),
            ..WindingFeedback::default()
        };
        for (j, motor) in self.motors.iter_mut().enumerate().take(usize::from(self.config.wheels)) {
            feedback.angle[j] = motor.angle();
            feedback.current[j] = motor.current();
            feedback.voltage[j] = motor.mean_voltage();
            if let Some(halls) = motor.halls() {
                feedback.edges[j] = halls.edges();
                feedback.since_edge[j] = halls.since_edge();
                feedback.interval[j] = halls.interval();
                feedback.wheel_speed[j] = halls.electrical_speed::<f32>() * self.config.wheel_speed_per_electrical;
            }
        }
        feedback
    }
}

/// Which motor's turn it is, and what may be done.
struct Place {
    motor: usize,
    /// The offsets are known
    ready: bool,
    /// The bridge may be closed
    closed: bool,
    hall: HallCode,
}

/// One motor's turn: what to put on its phases. By itself, so that four motors are not four times the code.
#[inline(never)]
fn tick_motor(
    motor: &mut MotorController,
    protection: &mut Protection,
    config: &WindingConfig,
    place: &Place,
    measured: &MotorMeasurement,
    setpoint: &CurrentSetpoint,
) -> [f32; 3] {
    match motor.update_halls(place.hall) {
        Ok(()) => protection.good_hall(place.motor),
        Err(_) => protection.bad_hall(place.motor, config.wheels),
    }
    if !place.ready {
        return NO_VOLTAGE;
    }
    // a lost motor's bridge is open, and its amplifiers may be what it was lost for
    let in_use = protection.disabled() >> place.motor & 1 == 0;
    if in_use {
        let above = core::array::from_fn(|k| f32::from(measured.codes[k].0) - measured.offsets[k]);
        protection.over_current(&config.limits, &above);
        if place.closed {
            protection.current_sum(place.motor, config.wheels, above);
        }
    }
    motor.tick(config, measured, setpoint, place.closed)
}
