//! What is out of order on one wheel.
//!
//! ```text
//! V(φ) = E·e^(−(1 − cos(φ − φ₀))/w²)      a damaged tooth: the gear climbs over it once a turn
//! |τ| ≤ τ_h                               a hub that is not tight on its shaft, which turns in it beyond that
//! U − Kv·ω → (U − Kv·ω)·sin²(p·φ_r)       a motor with a lost phase: p pairs of poles, φ_r the angle of its rotor
//! ```

use crate::oddities::spells::Spells;
use crate::shaft::Twisted;

/// A tooth that jams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// On which wheel's gear.
    pub wheel: usize,
    /// E [J]
    pub energy: f64,
    /// φ₀ of the wheel [rad]
    pub at: f64,
    /// w [rad]
    pub width: f64,
}

impl Tooth {
    /// V at an angle of the wheel [rad] [J].
    pub fn energy_at(&self, angle: f64) -> f64 {
        self.energy * libm::exp((libm::cos(angle - self.at) - 1.0) / (self.width * self.width))
    }

    /// −dV/dφ at an angle of the wheel [rad] [N·m].
    pub fn torque(&self, angle: f64) -> f64 {
        libm::sin(angle - self.at) / (self.width * self.width) * self.energy_at(angle)
    }
}

/// A hub that slips on an elastic shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub {
    /// Of which wheel.
    pub wheel: usize,
    /// τ_h [N·m]
    pub holds: f64,
}

impl Hub {
    /// What is left of a shaft's torque at a speed between wheel and rotor [rad/s].
    pub fn limited(&self, twisted: Twisted, speed: f64) -> Twisted {
        let torque = twisted.still + twisted.per_speed * speed;
        if torque.abs() <= self.holds {
            twisted
        } else {
            Twisted { still: self.holds.copysign(torque), per_speed: 0.0 }
        }
    }

    /// How far the hub has slipped [rad] once wheel and rotor are an angle apart [rad], behind a shaft of a stiffness
    /// [N·m/rad].
    pub fn slipped(&self, slipped: f64, apart: f64, stiffness: f64) -> f64 {
        let most = self.holds / stiffness;
        slipped + (apart - slipped) - (apart - slipped).clamp(-most, most)
    }
}

/// A phase of one motor that is lost now and then.
#[derive(Clone, Debug, PartialEq)]
pub struct LostPhase {
    /// Of which wheel.
    pub wheel: usize,
    /// Pairs of the motor's poles [1]
    pub pole_pairs: f64,
    /// When.
    pub spells: Spells,
}

impl LostPhase {
    /// What is left of the voltages that drive the current, at a time [s] and an angle of the rotor [rad] [1].
    ///
    /// The voltage that turns with the rotor drives the pair that is left by its part along that pair's axis, and of the
    /// pair's current the same part pushes.
    pub fn leaves(&self, time: f64, angle: f64) -> f64 {
        if self.spells.covers(time) { libm::sin(self.pole_pairs * angle).powi(2) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tooth_pushes_back_what_climbs_it_and_gives_as_much_after() {
        let tooth = Tooth { wheel: 0, energy: 0.03, at: 1.0, width: 0.1 };
        for angle in [0.9, 1.05, 1.3 + core::f64::consts::TAU] {
            let by_difference = -(tooth.energy_at(angle + 1e-6) - tooth.energy_at(angle - 1e-6)) / 2e-6;
            assert!((tooth.torque(angle) - by_difference).abs() < 1e-6, "{angle}");
        }
        assert!(tooth.torque(0.9) < -0.1 && tooth.torque(1.1) > 0.1);
        // nothing is left of it after half of a radian
        assert!(tooth.torque(1.5).abs() < 1e-4 && tooth.torque(-1.0).abs() < 1e-12);
    }

    #[test]
    fn a_hub_passes_on_what_it_holds_and_turns_as_far_as_the_shaft_would_twist_more() {
        let hub = Hub { wheel: 0, holds: 0.2 };
        let below = Twisted { still: 0.1, per_speed: 0.05 };
        assert_eq!(hub.limited(below, 1.0), below);
        assert_eq!(hub.limited(below, -9.0), Twisted { still: -0.2, per_speed: 0.0 });
        let slipped = hub.slipped(0.0, 0.05, 10.0);
        assert!((slipped - 0.03).abs() < 1e-12);
        assert_eq!(hub.slipped(slipped, 0.04, 10.0), slipped);
        assert!((hub.slipped(slipped, 0.0, 10.0) - 0.02).abs() < 1e-12);
    }

    #[test]
    fn with_a_lost_phase_a_half_is_left_in_a_turn_and_nothing_across_the_pair() {
        let always = Spells::drawn((1e3, 1e3), (0.0, 1e-9), 1);
        let motor = LostPhase { wheel: 0, pole_pairs: 7.0, spells: always };
        let angle = |k: u32| core::f64::consts::TAU * f64::from(k) / 1_000.0;
        let mean = (0..1_000).map(|k| motor.leaves(1.0, angle(k))).sum::<f64>() / 1_000.0;
        assert!((mean - 0.5).abs() < 1e-12, "{mean}");
        assert!(motor.leaves(1.0, core::f64::consts::PI / 7.0) < 1e-30);
        let sound = LostPhase { spells: Spells::default(), ..motor };
        assert!((0..1_000).all(|k| sound.leaves(1.0, angle(k)) == 1.0));
    }
}
