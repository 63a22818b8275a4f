//! # Battery: a voltage behind a resistance
//!
//! ```text
//! U = U₀ − R_b·I,  not below zero
//! ```
//!
//! I is the current of the period before: the capacitor on the bus bridges one period, and the loop has no knot.

/// The supply of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    /// U₀, without load [V]
    pub open_circuit: f64,
    /// R_b [Ω]
    pub resistance: f64,
}

impl Battery {
    /// Bus voltage [V] at a current [A].
    pub fn bus(&self, current: f64) -> f64 {
        // U = U₀ − R_b·I
        (self.open_circuit - self.resistance * current).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn load_lowers_the_bus_and_braking_lifts_it() {
        let battery = Battery { open_circuit: 12.0, resistance: 0.15 };
        assert_eq!([0.0, 10.0, -10.0, 1000.0].map(|i| battery.bus(i)), [12.0, 10.5, 13.5, 0.0]);
    }
}
