//! A converter between battery and bridges, whose loop is slow: its voltage dips when a load comes, swings, and is back.
//!
//! ```text
//! C·dp/dt = i − I − G·p        L·di/dt = −p        p: what the voltage is more than the battery's
//! ```
//!
//! I is what the bridges draw, i what the battery gives: at rest the same, so that nothing of p is left.

/// A loop that behaves as an inductance, with the capacitor behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Converter {
    /// L [H]
    pub inductance: f64,
    /// C [F]
    pub capacitance: f64,
    /// G [1/Ω]
    pub conductance: f64,
}

/// What a converter does at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Converting {
    /// p [V]
    pub voltage: f64,
    /// i [A]
    pub current: f64,
}

impl Converter {
    /// One that swings with a frequency [rad/s] and a damping [1], and by a voltage for each ampere that comes at once [Ω].
    pub fn swinging(frequency: f64, damping: f64, impedance: f64) -> Self {
        Self {
            inductance: impedance / frequency,
            capacitance: 1.0 / (impedance * frequency),
            conductance: 2.0 * damping / impedance,
        }
    }

    /// After a step [s] in which bridges draw a current [A], by the midpoint rule.
    pub fn after(&self, from: &Converting, drawn: f64, step: f64) -> Converting {
        let half = 0.5 * step;
        // p½ = p + h/2·(i½ − I − G·p½)/C, i½ = i − h/2·p½/L
        let voltage = (self.capacitance * from.voltage + half * (from.current - drawn))
            / (self.capacitance + half * (self.conductance + half / self.inductance));
        let current = from.current - half * voltage / self.inductance;
        Converting { voltage: 2.0 * voltage - from.voltage, current: 2.0 * current - from.current }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_that_comes_at_once_makes_it_swing_and_leaves_nothing() {
        let (frequency, damping, impedance) = (120.0, 0.2, 1.5);
        let converter = Converter::swinging(frequency, damping, impedance);
        let (mut now, step) = (Converting::default(), 1e-5);
        let mut at = |steps: u32| {
            for _ in 0..steps {
                now = converter.after(&now, 2.0, step);
            }
            now
        };
        // p = −I·Z·e^(−ζωt)·sin(ω_d·t)/√(1 − ζ²)
        let root = (1.0 - damping * damping).sqrt();
        let expected =
            -2.0 * impedance * libm::exp(-damping * frequency * 0.01) / root * libm::sin(frequency * root * 0.01);
        let swings = at(1_000);
        assert!((swings.voltage - expected).abs() < 1e-5, "{swings:?} against {expected}");
        let rests = at(100_000);
        assert!(rests.voltage.abs() < 1e-9 && (rests.current - 2.0).abs() < 1e-9, "{rests:?}");
    }

    #[test]
    fn without_its_damper_it_keeps_what_it_holds() {
        let converter = Converter { conductance: 0.0, ..Converter::swinging(120.0, 0.2, 1.5) };
        let held =
            |now: &Converting| converter.capacitance * now.voltage.powi(2) + converter.inductance * now.current.powi(2);
        let from = Converting { voltage: 1.0, current: -0.5 };
        let to = (0..10_000).fold(from, |now, _| converter.after(&now, 0.0, 1e-4));
        assert!((held(&to) - held(&from)).abs() < 1e-9 * held(&from));
    }
}
