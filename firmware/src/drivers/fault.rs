//! # Fault line: pulled low by any gate driver that protects itself
//!
//! The drivers' outputs are open drains on one line with one pull-up. A line that cannot be read counts as a fault.

use embedded_hal::digital::InputPin;

/// The fault line that all gate drivers share.
#[derive(Debug)]
pub struct FaultLine<P>(P);

impl<P: InputPin> FaultLine<P> {
    /// The line at a pin with a pull-up.
    pub fn new(pin: P) -> Self {
        Self(pin)
    }

    /// True while a driver pulls it.
    #[inline]
    pub fn is_pulled(&mut self) -> bool {
        self.0.is_low().unwrap_or(true)
    }
}
