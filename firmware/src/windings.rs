//! # Windings: the turn of all motors, once a period
//!
//! ```text
//! codes ─ guards ─ halls ─ angle ─┬─ current loop ─ duties
//!                                 └─ what the motion turn is told
//! ```
//!
//! First the offsets of the converters are learned with the bridges open, and followed as long as they stay so. Then every
//! period looks for what must not be, follows the halls, and has the current loop decide: six-step while a motor's speed is
//! not known yet, field-oriented once its halls tell where the rotor is between two edges. A fault opens the bridges in the
//! turn that sees it; it is latched until it is cleared. Without parameters nothing is driven.
//!
//! Codes are put right by the motors' wiring before anything looks at them, and duties behind all that decides: nothing
//! in between knows of wires.
//!
//! A voltage decided with one sample is on the motor from the next sample on, for a period
//! ([`crate::registers::timing`]); the mean that a record tells covers exactly the time from its predecessor's codes to
//! its own.

use model_core::control::calibration::AdcCode;
use model_core::control::current_loop::CurrentSetpoint;
use model_core::control::halls::HallCode;
use model_core::link::faults::Fault;

use crate::codes::{Codes, MOTORS, PERIODS_PER_TICK};
use crate::motion::MotionOutput;
use crate::motor_controller::{MotorController, MotorMeasurement, NO_VOLTAGE};
use crate::offsets::Offsets;
use crate::probe::{ProbeVector, probe_limits};
use crate::protection::Protection;
use crate::sensing;
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
    probe: Option<ProbeVector>,
    period: u32,
    /// Periods since a motion turn was due: 0 in which it is
    since_due: u32,
    /// Periods for which all bridges have been open
    open: u8,
}

/// Periods after which nothing of a current is left in an open bridge: 1 ms.
const CURRENT_FREE: u8 = 20;

impl Windings {
    /// Takes what a motion turn decided, from the next period on.
    pub fn apply(&mut self, output: &MotionOutput) {
        self.setpoints = output.setpoints;
        self.probe = output.probe;
        if let Some(config) = &output.config {
            self.install(config);
        }
        if output.clear {
            self.clear();
        }
        self.protection.latch_all(output.faults);
        for (fault, motors) in [(Fault::Stall, output.stalled), (Fault::OpenPhase, output.open_phase)] {
            self.protection.disable_motors(fault, motors, self.config.wheels);
        }
    }

    /// Takes other parameters; motors that come or go begin anew.
    #[inline(never)]
    fn install(&mut self, config: &WindingConfig) {
        if config.wheels != self.config.wheels {
            self.motors = [MotorController::default(); MOTORS];
            self.protection.set_wheels(config.wheels);
        }
        if config.wiring != self.config.wiring {
            // other converters, or codes that count the other way
            self.offsets = Offsets::default();
            self.motors = [MotorController::default(); MOTORS];
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

    /// True once all bridges have been open for so long that no current is left.
    pub fn are_at_rest(&self) -> bool {
        self.open >= CURRENT_FREE
    }

    /// True if a motion turn begins with the period that has just been looked at.
    #[inline]
    pub fn motion_is_due(&self) -> bool {
        self.since_due == 0
    }

    /// True if gyro and encoders are to be read in the period that has just been looked at.
    #[inline]
    pub fn sensors_are_due(&self) -> bool {
        self.since_due == sensing::DUE
    }

    /// One period: what to do in the next.
    #[inline]
    pub fn tick(&mut self, read: &Codes) -> BridgeCommand {
        self.period = self.period.wrapping_add(1);
        self.since_due = if self.since_due + 1 == PERIODS_PER_TICK { 0 } else { self.since_due + 1 };
        let wired;
        let codes = match &self.config.wiring {
            Some(wiring) => {
                wired = wiring.codes(read);
                &wired
            }
            None => read,
        };
        let bus = self.config.calibration.bus_voltage(codes.bus);
        let ready = self.check_supply_and_offsets(codes, bus);
        let may = if ready { self.setpoints.enabled & self.config.motors() & !self.protection.disabled() } else { 0 };
        let mut command = self.drive_motors(codes, bus, ready, may);
        if self.protection.faults().is_empty() {
            command.enabled = may & !self.protection.disabled();
        }
        if command.enabled != may {
            self.forget_what_is_not_applied(&mut command);
        }
        if let Some(wiring) = &self.config.wiring {
            for (j, duties) in command.duties.iter_mut().enumerate() {
                *duties = wiring.duties(j, *duties);
            }
        }
        if self.motion_is_due() {
            self.feedback = self.measure(codes, bus);
        }
        if let Some(vector) = self.probe {
            self.probe(&vector, codes, read, &mut command);
        }
        self.open = if command.enabled == 0 { self.open.saturating_add(1) } else { 0 };
        command
    }

    /// The supply, the drivers' fault line, and the zeros of the converters; true once these are known.
    #[inline]
    fn check_supply_and_offsets(&mut self, codes: &Codes, bus: f32) -> bool {
        if self.config.wheels > 0 {
            self.protection.supply(&self.config.limits, bus);
        }
        if !self.offsets.are_known() {
            self.offsets.learn(&codes.phases);
        } else if self.are_at_rest() && self.protection.faults().is_empty() {
            self.offsets.follow(&codes.phases);
        }
        let ready = self.offsets.are_known();
        if codes.driver_fault && ready && self.config.limits.allow_supply(bus) {
            self.protection.latch(Fault::DriverLine);
        }
        let broken = self.offsets.bad() & self.config.motors();
        if broken != 0 {
            self.protection.disable_motors(Fault::OffsetCalibration, broken, self.config.wheels);
        }
        ready
    }

    /// Duties of all motors, of which those with a bit in `may` may be driven; `ready` once the zeros are known.
    #[inline]
    fn drive_motors(&mut self, codes: &Codes, bus: f32, ready: bool, may: u8) -> BridgeCommand {
        let setpoints = self.setpoints;
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
        command
    }

    /// No voltage where a bridge opens in spite of what was decided.
    fn forget_what_is_not_applied(&mut self, command: &mut BridgeCommand) {
        for (j, (motor, duties)) in self.motors.iter_mut().zip(&mut command.duties).enumerate() {
            if command.enabled >> j & 1 == 0 {
                *duties = NO_VOLTAGE;
                motor.bridge_opened();
            }
        }
    }

    /// A probe's voltage on its motor, and what is measured under it; nothing where there is a fault.
    #[cold]
    #[inline(never)]
    fn probe(&mut self, vector: &ProbeVector, codes: &Codes, read: &Codes, command: &mut BridgeCommand) {
        let j = usize::from(vector.motor()).min(MOTORS - 1);
        let limits = probe_limits(&self.config);
        self.protection.over_current(&limits, &above_zero(&codes.phases[j], &self.offsets.of(j)));
        let bit = (1_u8 << j) & self.config.motors() & !self.protection.disabled();
        if self.offsets.are_known() && self.protection.faults().is_empty() {
            command.enabled = bit;
            command.duties[j] = vector.duties(self.period).unwrap_or(NO_VOLTAGE);
        }
        if self.motion_is_due() {
            self.feedback.probe = Some(vector.report(self.period, read));
        }
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

/// Codes above their zeros [counts].
#[inline]
fn above_zero(codes: &[AdcCode; 3], zeros: &[f32; 3]) -> [f32; 3] {
    core::array::from_fn(|phase| f32::from(codes[phase].0) - zeros[phase])
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
    if let Some(edges) = config.wiring.as_ref().and_then(|wiring| wiring.edges(place.motor)) {
        motor.track(edges);
    }
    if !place.ready {
        return NO_VOLTAGE;
    }
    // a lost motor's bridge is open, and its amplifiers may be what it was lost for
    let in_use = protection.disabled() >> place.motor & 1 == 0;
    if in_use {
        let above = above_zero(&measured.codes, &measured.offsets);
        protection.over_current(&config.limits, &above);
        if place.closed {
            protection.current_sum(place.motor, config.wheels, above);
        }
    }
    motor.tick(config, measured, setpoint, place.closed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_turn_is_due_every_twenty_periods_also_where_their_count_begins_anew() {
        let mut windings = Windings { period: u32::MAX - 50, ..Windings::default() };
        for period in 1..=5 * PERIODS_PER_TICK {
            windings.tick(&Codes::default());
            let of_turn = period % PERIODS_PER_TICK;
            assert_eq!(windings.motion_is_due(), of_turn == 0, "{period}");
            assert_eq!(windings.sensors_are_due(), of_turn == sensing::DUE, "{period}");
        }
        assert_eq!(windings.period, 49);
    }
}
