//! # Windings: the turn of all motors, once a period
//!
//! ```text
//! codes ─ guards ─ halls ─ angle ─┬─ current loop ─ duties
//!                                 └─ what the motion turn is told
//! ```
//!
//! First the offsets of the converters are learned with the bridges open. Then every period looks for what must not be,
//! follows the halls, and has the current loop decide: six-step while a motor's speed is not known yet, field-oriented
//! once its halls tell where the rotor is between two edges. A fault opens the bridges in the turn that sees it; it is
//! latched until it is cleared. Without parameters nothing is driven.
//!
//! A voltage decided in one period holds over the next (compare registers are loaded at the update), so the mean that a
//! record tells covers exactly the periods from its predecessor's codes to its own.

use model_core::control::current_loop::CurrentSetpoint;
use model_core::control::halls::HallCode;
use model_core::link::faults::{Fault, Faults};

use crate::codes::{Codes, MOTORS, PERIODS_PER_TURN};
use crate::guard::Guard;
use crate::motion::Turn;
use crate::motor::{Motor, NO_VOLTAGE, Sensed};
use crate::offsets::Offsets;
use crate::setup::Setup;

/// What the motion turn asks of the windings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ask {
    /// DC-equivalent currents [A]
    pub current: [f32; MOTORS],
    /// DC-equivalent voltages [V] that go ahead of the currents, or stand alone where `closed` is false
    pub voltage: [f32; MOTORS],
    /// True: the currents are controlled; false: the voltages are applied as they are
    pub closed: bool,
    /// One bit a motor: its bridge may be closed
    pub enabled: u8,
}

/// What the motion turn is told of the windings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// The period of the codes, since the start
    pub period: u32,
    /// The codes themselves
    pub codes: Codes,
    /// Electrical angle that the currents were turned by [2⁻¹⁶ turn]
    pub angle: [u16; MOTORS],
    /// Hall edges since the start
    pub edges: [i32; MOTORS],
    /// Periods since the last edge
    pub since_edge: [u16; MOTORS],
    /// Periods that the edges looked at for the speed took
    pub interval: [u16; MOTORS],
    /// Speed at the wheel's shaft [rad/s]
    pub wheel_speed: [f32; MOTORS],
    /// DC-equivalent current measured last [A]
    pub current: [f32; MOTORS],
    /// What the converters say without current [counts]
    pub offsets: [[f32; 3]; MOTORS],
    /// Mean DC-equivalent voltage since the last turn [V]
    pub voltage: [f32; MOTORS],
    /// Supply [V]
    pub bus: f32,
    /// Faults that are latched here and open all bridges
    pub faults: Faults,
    /// Faults that are latched here and cost a wheel
    pub costs: Faults,
    /// One bit a motor: it is out of use
    pub lost: u8,
    /// True once the offsets are known
    pub ready: bool,
}

/// What the board is to do in the next period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drive {
    /// Duties of the three phases [1]
    pub duties: [[f32; 3]; MOTORS],
    /// One bit a motor: its gate driver is enabled
    pub enabled: u8,
}

/// All windings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Windings {
    setup: Setup,
    offsets: Offsets,
    guard: Guard,
    motors: [Motor; MOTORS],
    ask: Ask,
    told: Told,
    period: u32,
}

impl Windings {
    /// Takes what a motion turn decided, from the next period on.
    pub fn take(&mut self, turn: &Turn) {
        self.ask = turn.ask;
        if let Some(setup) = &turn.setup {
            self.install(setup);
        }
        if turn.clear {
            self.clear();
        }
        self.guard.latch_all(turn.faults);
        for j in (0..MOTORS).filter(|j| turn.stalled >> j & 1 != 0) {
            self.guard.lose(Fault::Stall, j, self.setup.wheels);
        }
    }

    /// Takes other parameters; motors that come or go begin anew.
    #[inline(never)]
    fn install(&mut self, setup: &Setup) {
        if setup.wheels != self.setup.wheels {
            self.motors = [Motor::default(); MOTORS];
            self.guard.recount(setup.wheels);
        }
        self.setup = *setup;
    }

    /// Forgets latched faults; what is still there is found again in the next turns.
    fn clear(&mut self) {
        self.guard = Guard::default();
        if self.offsets.bad() & self.setup.motors() != 0 {
            self.offsets = Offsets::default();
        }
    }

    /// What has been found and is latched.
    pub fn guard(&self) -> &Guard {
        &self.guard
    }

    /// Latches a fault that was seen elsewhere.
    pub fn latch(&mut self, fault: Fault) {
        self.guard.latch(fault);
    }

    /// What the last motion turn's codes were, and what goes with them.
    pub fn told(&self) -> Told {
        self.told
    }

    /// True if a motion turn begins with the period that has just been looked at.
    #[inline]
    pub fn begins_motion(&self) -> bool {
        self.period.is_multiple_of(PERIODS_PER_TURN)
    }

    /// One period: what to do in the next.
    #[inline]
    pub fn turn(&mut self, codes: &Codes) -> Drive {
        self.period = self.period.wrapping_add(1);
        let ask = self.ask;
        let bus = self.setup.calibration.bus_voltage(codes.bus);
        if self.setup.wheels > 0 {
            self.guard.supply(&self.setup.limits, bus);
        }
        if codes.driver_fault {
            self.guard.latch(Fault::DriverLine);
        }
        if !self.offsets.are_known() {
            self.offsets.learn(&codes.phases);
        }
        let ready = self.offsets.are_known();
        let broken = self.offsets.bad() & self.setup.motors();
        if broken != 0 {
            for j in (0..MOTORS).filter(|j| broken >> j & 1 != 0) {
                self.guard.lose(Fault::OffsetCalibration, j, self.setup.wheels);
            }
        }
        let may = if ready { ask.enabled & self.setup.motors() & !self.guard.lost() } else { 0 };

        let mut drive = Drive::default();
        let per_bus = 1.0 / bus;
        for j in 0..MOTORS {
            let motor = &mut self.motors[j];
            motor.hold();
            if j >= usize::from(self.setup.wheels) {
                continue;
            }
            let sensed = Sensed { codes: codes.phases[j], offsets: self.offsets.of(j), bus, per_bus };
            let want = CurrentSetpoint { current: ask.current[j], voltage: ask.voltage[j], closed: ask.closed };
            let place = Place { motor: j, ready, closed: may >> j & 1 != 0 };
            drive.duties[j] = turn_of(motor, &mut self.guard, &self.setup, &place, codes.halls[j], &sensed, &want);
        }
        if self.guard.faults().is_empty() {
            drive.enabled = may & !self.guard.lost();
        }
        if drive.enabled != may {
            // what was decided above and is not applied
            for (j, (motor, duties)) in self.motors.iter_mut().zip(&mut drive.duties).enumerate() {
                if drive.enabled >> j & 1 == 0 {
                    *duties = NO_VOLTAGE;
                    motor.opened();
                }
            }
        }
        if self.begins_motion() {
            self.told = self.tell(codes, bus);
        }
        drive
    }

    /// What the motion turn is to know of this period; begins its next mean.
    #[inline]
    fn tell(&mut self, codes: &Codes, bus: f32) -> Told {
        let mut told = Told {
            period: self.period,
            codes: *codes,
            bus,
            faults: self.guard.faults(),
            costs: self.guard.costs(),
            lost: self.guard.lost(),
            ready: self.offsets.are_known(),
            offsets: *self.offsets.all(),
            ..Told::default()
        };
        for (j, motor) in self.motors.iter_mut().enumerate().take(usize::from(self.setup.wheels)) {
            told.angle[j] = motor.angle();
            told.current[j] = motor.current();
            told.voltage[j] = motor.mean_voltage();
            if let Some(halls) = motor.halls() {
                told.edges[j] = halls.edges();
                told.since_edge[j] = halls.since_edge();
                told.interval[j] = halls.interval();
                told.wheel_speed[j] = halls.electrical_speed::<f32>() * self.setup.wheel_speed_per_electrical;
            }
        }
        told
    }
}

/// Which motor's turn it is, and what may be done.
struct Place {
    motor: usize,
    /// The offsets are known
    ready: bool,
    /// The bridge may be closed
    closed: bool,
}

/// One motor's turn: what to put on its phases. By itself, so that four motors are not four times the code.
#[inline(never)]
fn turn_of(
    motor: &mut Motor,
    guard: &mut Guard,
    setup: &Setup,
    place: &Place,
    hall: HallCode,
    sensed: &Sensed,
    want: &CurrentSetpoint,
) -> [f32; 3] {
    match motor.follow(hall) {
        Ok(()) => guard.good_hall(place.motor),
        Err(_) => guard.bad_hall(place.motor, setup.wheels),
    }
    if !place.ready {
        return NO_VOLTAGE;
    }
    // a lost motor's bridge is open, and its amplifiers may be what it was lost for
    let in_use = guard.lost() >> place.motor & 1 == 0;
    if in_use && guard.over_current(&setup.limits, &sensed.codes, &sensed.offsets) {
        guard.latch(Fault::OverCurrent);
    }
    motor.decide(setup, sensed, want, place.closed)
}
