//! # Halls: three lines, one code
//!
//! Lines a, b, c are bits 1, 2, 4 of the code. They are read once a period, not on edges: on this chip several of them
//! share an interrupt line. A line that cannot be read makes the code 0, which no motor gives, so that it is a fault
//! like a cut cable.

use embedded_hal::digital::InputPin;
use model_core::control::halls::HallCode;

/// The hall lines of one motor.
#[derive(Debug)]
pub struct HallLines<A, B, C> {
    a: A,
    b: B,
    c: C,
}

impl<A: InputPin, B: InputPin, C: InputPin> HallLines<A, B, C> {
    /// The lines of one motor.
    pub fn new(a: A, b: B, c: C) -> Self {
        Self { a, b, c }
    }

    /// The code that they show.
    #[inline]
    pub fn code(&mut self) -> HallCode {
        match (self.a.is_high(), self.b.is_high(), self.c.is_high()) {
            (Ok(a), Ok(b), Ok(c)) => HallCode(u8::from(a) | (u8::from(b) << 1) | (u8::from(c) << 2)),
            _ => HallCode(0),
        }
    }
}
