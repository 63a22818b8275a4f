//! # Gate driver: three PWM inputs and one enable
//!
//! A driver of this kind (DRV8313, DRV8316 in its 3-PWM mode) switches a phase to the supply while its input is high
//! and to ground while it is low; it makes the dead time itself. So a duty of zero on all phases shorts the motor and
//! brakes it. Only the enable, low, opens the bridge and lets the motor coast.

use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::SetDutyCycle;

use crate::registers::timing::compare;

/// One gate driver.
#[derive(Debug)]
pub struct GateDriver<A, B, C, E> {
    a: A,
    b: B,
    c: C,
    enable: E,
}

/// Why a gate driver did not do as it was told; the bridge is then open, if that could be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GateFault {
    /// A PWM channel refused its count
    Channel,
    /// The enable refused its level
    Enable,
}

impl<A: SetDutyCycle, B: SetDutyCycle, C: SetDutyCycle, E: OutputPin> GateDriver<A, B, C, E> {
    /// A gate driver, its bridge open.
    pub fn new(a: A, b: B, c: C, mut enable: E) -> Result<Self, E::Error> {
        enable.set_low()?;
        Ok(Self { a, b, c, enable })
    }

    /// Opens the bridge: no phase is connected to anything.
    #[inline]
    pub fn open(&mut self) -> Result<(), GateFault> {
        self.enable.set_low().map_err(|_| GateFault::Enable)
    }

    /// Drives the phases with these duties [1] and closes the bridge. If a channel fails the bridge is opened.
    #[inline]
    pub fn drive(&mut self, duties: [f32; 3]) -> Result<(), GateFault> {
        if self.set(duties).is_err() {
            self.open()?;
            return Err(GateFault::Channel);
        }
        self.enable.set_high().map_err(|_| GateFault::Enable)
    }

    /// Prepares duties [1] without closing the bridge.
    #[inline]
    pub fn set(&mut self, [a, b, c]: [f32; 3]) -> Result<(), GateFault> {
        channel(&mut self.a, a)?;
        channel(&mut self.b, b)?;
        channel(&mut self.c, c)
    }
}

#[inline]
fn channel(pwm: &mut impl SetDutyCycle, duty: f32) -> Result<(), GateFault> {
    let top = pwm.max_duty_cycle();
    pwm.set_duty_cycle(compare(duty, top)).map_err(|_| GateFault::Channel)
}
