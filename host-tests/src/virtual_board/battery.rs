//! # Battery: a voltage behind a resistance, and a bus that it cannot discharge
//!
//! ```text
//! U = U₀ − R_b·I,  not below zero                                       takes current back
//! C·dU/dt = I_s − I,  I_s = (U₀ − U)/R_b where that is above zero, else 0     does not: a diode, and a capacitor on the bus
//! U(t) = U_∞ + (U(0) − U_∞)·e^{−t/(R_b·C)},  U_∞ = U₀ − R_b·I            while the diode conducts
//! U(t) = U(0) − I·t/C                                                    while it does not
//! ```
//!
//! I is the current of the period before: the capacitor on the bus bridges one period, and the loop has no knot.

/// Resistance behind the diode where the battery has none [Ω]
const LEAST: f64 = 1e-3;

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

/// The capacitor of a bus that is supplied through a diode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusCapacitor {
    /// C [F]
    pub capacitance: f64,
    /// U [V]
    pub voltage: f64,
    /// What the supply has given [J]
    pub supplied: f64,
}

impl BusCapacitor {
    /// One that the battery has charged.
    pub fn charged(capacitance: f64, battery: &Battery) -> Self {
        Self { capacitance, voltage: battery.open_circuit, supplied: 0.0 }
    }

    /// What it holds [J].
    pub fn energy(&self) -> f64 {
        // ½·C·U²
        0.5 * self.capacitance * self.voltage * self.voltage
    }

    /// A period of `dt` [s] in which the robot draws this current [A].
    pub fn period(&mut self, battery: &Battery, current: f64, dt: f64) {
        let resistance = battery.resistance.max(LEAST);
        let settles = battery.open_circuit - resistance * current;
        let apart = |time: f64| (self.voltage - settles) * (-time / (resistance * self.capacitance)).exp();
        if self.voltage < battery.open_circuit {
            // U(t) = U_∞ + (U(0) − U_∞)·e^{−t/(R_b·C)}; the supply gives I + C·dU/dt at U₀
            let voltage = settles + apart(dt);
            let given = current * dt + self.capacitance * (voltage - self.voltage);
            self.supplied += battery.open_circuit * given;
            self.voltage = voltage.max(0.0);
        } else {
            // U(t) = U(0) − I·t/C
            self.voltage = (self.voltage - current * dt / self.capacitance).max(0.0);
        }
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

    #[test]
    fn what_is_supplied_is_what_is_drawn_held_and_lost() {
        let battery = Battery { open_circuit: 12.0, resistance: 0.15 };
        let mut bus = BusCapacitor::charged(1.6e-3, &battery);
        let begins = bus.energy();
        let (dt, mut drawn, mut lost) = (1e-6, 0.0, 0.0);
        for k in 0..200_000 {
            // drives for 0.1 s, brakes for as long
            let current = if k < 100_000 { 2.0 } else { -0.1 };
            let before = bus;
            bus.period(&battery, current, dt);
            drawn += current * 0.5 * (before.voltage + bus.voltage) * dt;
            // I_s²·R_b = (U₀ − U)²/R_b
            let flows = (battery.open_circuit - 0.5 * (before.voltage + bus.voltage)).max(0.0);
            lost += flows * flows / battery.resistance * dt;
        }
        let gained = bus.energy() - begins;
        // steps of 1/240 of the time constant, by their middles
        assert!((bus.supplied - drawn - gained - lost).abs() < 1e-3 * bus.supplied, "{bus:?} {drawn} {gained} {lost}");
        assert!(bus.voltage > 17.0, "what the robot gave back is in the capacitor: {bus:?}");
    }

    #[test]
    fn at_rest_a_loaded_bus_is_that_of_the_battery() {
        let battery = Battery { open_circuit: 12.0, resistance: 0.15 };
        let mut bus = BusCapacitor::charged(1.6e-3, &battery);
        (0..1000).for_each(|_| bus.period(&battery, 4.0, 50e-6));
        assert!((bus.voltage - battery.bus(4.0)).abs() < 1e-9, "{bus:?}");
    }
}
