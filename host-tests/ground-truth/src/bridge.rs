//! The bridge of one motor: what it makes of a command, what it loses, and the current that it allows.
//!
//! ```text
//! U = (1 + g)·u·U_bus/U_nominal + o − (U_d + U_b·[i·ω < 0])·i/√(i² + i₀²)        |i| ≤ i_max
//! ```
//!
//! Between two switches that must not be closed at once the motor's own current decides which way the voltage goes: what is
//! lost has the sign of the current, and fades where the current is too small to reverse the bridge in the dead time.

/// What stands between the battery and a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    /// g [1]
    pub gain_error: f64,
    /// o [V]
    pub offset: f64,
    /// U_d, what dead time takes away [V]
    pub dead_time_loss: f64,
    /// i₀, the current below which that fades [A]
    pub fade_current: f64,
    /// U_b, what is lost beyond that while the motor brakes, but no more than it induces [V]
    pub braking_loss: f64,
    /// i_max [A]
    pub current_limit: f64,
}

impl Default for Bridge {
    /// One that passes on what is asked for.
    fn default() -> Self {
        Self {
            gain_error: 0.0,
            offset: 0.0,
            dead_time_loss: 0.0,
            fade_current: 0.05,
            braking_loss: 0.0,
            current_limit: f64::INFINITY,
        }
    }
}

/// A voltage that depends on the current, as a straight line near one current.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss {
    /// What is lost at no current, by the line [V]
    pub at_none: f64,
    /// [V/A]
    pub per_current: f64,
}

impl Bridge {
    /// What the motor would get without a current [V], of a command that the bus voltage has scaled [V].
    pub fn applied(&self, command: f64) -> f64 {
        (1.0 + self.gain_error) * command + self.offset
    }

    /// What is lost near a current [A] of a motor that induces a voltage [V].
    pub fn loss(&self, current: f64, induced: f64) -> Loss {
        let braking = if current * induced < 0.0 { self.braking_loss.min(induced.abs()) } else { 0.0 };
        let most = self.dead_time_loss + braking;
        if most == 0.0 {
            return Loss::default();
        }
        // s = i/√(i² + i₀²), ds/di = i₀²/(i² + i₀²)^(3/2)
        let square = current * current + self.fade_current * self.fade_current;
        let root = square.sqrt();
        let per_current = most * self.fade_current * self.fade_current / (square * root);
        Loss { at_none: most * current / root - per_current * current, per_current }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loss_has_the_sign_of_the_current_and_fades_where_that_is_small() {
        let bridge = Bridge { dead_time_loss: 0.3, ..Bridge::default() };
        let lost = |current: f64| {
            let Loss { at_none, per_current } = bridge.loss(current, 0.0);
            at_none + per_current * current
        };
        assert!((lost(2.0) - 0.3).abs() < 1e-3 && (lost(-2.0) + 0.3).abs() < 1e-3);
        assert_eq!(lost(0.0), 0.0);
        assert!((lost(0.05) - 0.3 / 2.0_f64.sqrt()).abs() < 1e-12);
        let by_difference = (lost(0.05 + 1e-6) - lost(0.05 - 1e-6)) / 2e-6;
        assert!((bridge.loss(0.05, 0.0).per_current - by_difference).abs() < 1e-6);
    }

    #[test]
    fn braking_costs_no_more_than_is_induced() {
        let bridge = Bridge { braking_loss: 0.5, fade_current: 1e-6, ..Bridge::default() };
        let lost = |current, induced| bridge.loss(current, induced).at_none;
        assert!((lost(-1.0, 2.0) + 0.5).abs() < 1e-6 && (lost(-1.0, 0.2) + 0.2).abs() < 1e-6);
        assert_eq!(lost(1.0, 2.0), 0.0);
    }
}
