//! # Winding heating: a warm motor draws less current and gives less torque for it
//!
//! ```text
//! τ·dΔT/dt + ΔT = R_θ·R·i²
//! R → R·(1 + α·ΔT)        K_t → K_t·(1 − β·ΔT)        K_v → K_v·(1 − β·ΔT)
//! ```
//!
//! What the current loses in the winding warms the motor, until as much goes out through its housing. Copper resists more
//! as it warms up, and magnets weaken; both go back when it cools. One temperature stands for winding and magnets.
//!
//! symbol  code                  unit  meaning
//! ------  --------------------  ----  -----------------------------------------------------
//! R_θ     `thermal_resistance`  K/W   rise of temperature over the heat that is kept up
//! τ       `time_constant`       s     how long it takes to warm up; R_θ times the heat capacity
//! α       `resistance_rise`     1/K   copper: 1/(235 + 20)
//! β       `magnet_loss`         1/K   neodymium magnets; 0.002 of ferrite
//! ΔT      `rise`                K     temperature above that at which R, K_t and K_v hold
//!
//! Over a step the heat is taken as even, so that the rise follows exactly, at steps of any length:
//!
//! ```text
//! ΔT⁺ = ΔT·e⁻ˣ + R_θ·(Q/τ)·(1 − e⁻ˣ)/x,   x = Δt/τ,   Q = heat of the step
//! ```
//!
//! Memory: ΔT of each wheel's motor. It is zero at the start of a run: a run is taken to begin cold. Where a simulation
//! restarts from a measured pose in the middle of a run, the motors are as warm as they were. The law holds up to a rise of
//! 600 K, where no winding is left; above, the motor gets no warmer.
//!
//! Fails when: a run begins with warm motors; in the first seconds, when the winding is warm and the magnets are not yet.
//! How to measure it: measure R cold; hold a wheel for some minutes at a known current, and measure u/i again and again.
//! Source: Body with one heat capacity: Hughes, Drury, Electric Motors and Drives, 2013, ch. 1 and 11; copper: IEC 60034-1;
//! magnets: Hendershot, Miller, Design of Brushless Permanent-Magnet Machines, 2010; sizes: estimated after data sheets of
//! small motors, 5 to 30 K/W and 20 s to some minutes.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{EffectContext, StepOutcome, Winding};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs, Numbers, State};
use crate::number::decay;
use crate::number::scalar::Real;

/// The warmest that a motor gets, above cold [K].
const WARMEST: f64 = 600.0;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "winding_heating",
    title: "Heating of the windings",
    summary: "A motor that has worked is warm: its winding resists more and its magnets are weaker.",
    equation: "τ·dΔT/dt + ΔT = R_θ·R·i²,  R → R·(1 + α·ΔT),  K_t, K_v → (1 − β·ΔT)·K_t, K_v",
    source: "body with one heat capacity: Hughes, Drury, Electric Motors and Drives, 2013, ch. 1 and 11; copper: IEC 60034-1; magnets: Hendershot, Miller, Design of Brushless Permanent-Magnet Machines, 2010; sizes: estimated after data sheets of small motors, 5 to 30 K/W and 20 s to some minutes",
    seams: &[Seam::Winding],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "thermal_resistance_K_per_W",
            symbol: "R_θ",
            unit: "K/W",
            absent: 0.0,
            typical: 15.0,
            within: (0.0, 200.0),
            role: Role::Size,
        },
        Param {
            key: "time_constant_s",
            symbol: "τ",
            unit: "s",
            absent: 60.0,
            typical: 60.0,
            within: (5.0, 1000.0),
            role: Role::Shape,
        },
        Param {
            key: "resistance_rise_per_K",
            symbol: "α",
            unit: "1/K",
            absent: 0.0039,
            typical: 0.0039,
            within: (0.0, 0.006),
            role: Role::Fixed,
        },
        Param {
            key: "magnet_loss_per_K",
            symbol: "β",
            unit: "1/K",
            absent: 0.0011,
            typical: 0.0011,
            within: (0.0, 0.0015),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::Current], regime: Regime::Current, parity: Parity::Odd, order: None },
    signature: "current right at the start of a run and short later on; free speed rises a little",
    look_alikes: &[LookAlike {
        with: "resistance",
        settled_by: "let the motors cool, and do the same run again: a resistance that is wrong shows from the start, heating only later on",
    }],
    code: 30,
    undone: Undone::No("the controller does not know how warm its motors are"),
    physics: Physics::PASSIVE,
};

/// The rise of temperature after a step that made this much heat [K].
#[inline]
pub fn warmed<T: Real>(of: &WindingHeating<T>, rise: T, heat: T, elapsed: T) -> T {
    let WindingHeating { thermal_resistance, time_constant, .. } = *of;
    let made = thermal_resistance * (heat / time_constant) * decay::mean_remaining(time_constant, elapsed);
    // ΔT⁺ = ΔT·e⁻ˣ + R_θ·(Q/τ)·(1 − e⁻ˣ)/x
    (rise * decay::remaining(time_constant, elapsed) + made).min(T::lit(WARMEST))
}

/// How warm a motor is.
#[derive(Clone, Copy, Debug)]
pub struct Warmth<T> {
    /// ΔT, above cold [K]
    rise: T,
}

impl<T: Real> Numbers<T> for Warmth<T> {
    fn for_each_mut(&mut self, mut visit: impl FnMut(&mut T)) {
        visit(&mut self.rise);
    }
}

impl<T: Real> State<T> for Warmth<T> {
    fn start() -> Self {
        Self { rise: T::zero() }
    }
}

/// Heating of the windings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindingHeating<T> {
    /// R_θ, rise of temperature over heat [K/W]
    pub thermal_resistance: T,
    /// τ, how long it takes to warm up [s]
    pub time_constant: T,
    /// α, by how much copper resists more [1/K]
    pub resistance_rise: T,
    /// β, by how much magnets weaken [1/K]
    pub magnet_loss: T,
}

impl<T: Copy> Catalogued<T> for WindingHeating<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[thermal_resistance, time_constant, resistance_rise, magnet_loss] = params else { return None };
        Some(Self { thermal_resistance, time_constant, resistance_rise, magnet_loss })
    }
}

impl<T: Real> Hooks<T> for WindingHeating<T> {
    type State = Warmth<T>;
    const NEEDS: Needs = Needs { heat: true, ..Needs::NOTHING };

    fn winding(&self, s: &Warmth<T>, _: &EffectContext<T>, x: &mut Winding<T>) {
        let one = T::one();
        // R → R·(1 + α·ΔT),  K → K·(1 − β·ΔT)
        x.resistance *= one + self.resistance_rise * s.rise;
        let kept = one - self.magnet_loss * s.rise;
        x.torque_constant *= kept;
        x.emf_constant *= kept;
        x.torque_bend *= kept;
    }

    fn advance(&self, s: &mut Warmth<T>, at: &EffectContext<T>, done: &StepOutcome<T>) {
        s.rise = warmed(self, s.rise, done.heat, at.dt);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    fn typical<T: Real>() -> WindingHeating<T> {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| T::lit(CARD.params[k].typical));
        WindingHeating { thermal_resistance: a, time_constant: b, resistance_rise: c, magnet_loss: d }
    }

    const COLD: Winding<f64> = Winding {
        current: 0.7,
        speed: 13.0,
        resistance: 4.3111,
        inductance: 0.0,
        emf_constant: 0.1295,
        torque_constant: 0.1297,
        torque: 0.0,
        torque_bend: 0.0,
    };

    fn wound(of: WindingHeating<f64>, rise: f64) -> Winding<f64> {
        let mut x = COLD;
        of.winding(&Warmth { rise }, &EffectContext::default(), &mut x);
        x
    }

    #[test]
    fn a_motor_without_thermal_resistance_stays_as_it_was_bit_for_bit() {
        let of = WindingHeating { thermal_resistance: 0.0, ..typical() };
        let mut s = Warmth::start();
        for heat in [0.0, 0.03, 7.0] {
            let at = EffectContext { dt: 1e-3, ..EffectContext::default() };
            of.advance(&mut s, &at, &StepOutcome { heat, ..StepOutcome::default() });
            let x = wound(of, s.rise);
            let bits = |x: &Winding<f64>| [x.resistance, x.emf_constant, x.torque_constant].map(f64::to_bits);
            assert_eq!(bits(&x), bits(&COLD));
        }
    }

    #[test]
    fn heat_that_is_kept_up_ends_in_its_rise_at_steps_of_any_length() {
        let of = typical::<f64>();
        for dt in [1e-3, 0.4, 30.0, 1e4] {
            let mut rise = 0.0;
            for _ in 0..if dt < 1e-2 { 1_000_000 } else { 3000 } {
                rise = warmed(&of, rise, 2.0 * dt, dt);
            }
            // 2 W at 15 K/W, after 16 time constants; a million roundings of 30 K
            assert!((rise - 30.0).abs() < 1e-5, "{rise} at {dt} s");
        }
    }

    #[test]
    fn a_step_is_its_parts_and_without_current_a_motor_cools_by_the_exponential() {
        let of = typical::<f64>();
        let whole = warmed(&of, 40.0, 12.0, 6.0);
        let parts = [0.1, 2.4, 3.5].into_iter().fold(40.0, |rise, part| warmed(&of, rise, 2.0 * part, part));
        assert!((whole - parts).abs() < 1e-12, "{whole} against {parts}");
        assert!((warmed(&of, 40.0, 0.0, 60.0) - 40.0 * libm::exp(-1.0)).abs() < 1e-13);
    }

    #[test]
    fn heat_is_stored_or_gone_through_the_housing() {
        let of = typical::<f64>();
        let capacity = of.time_constant / of.thermal_resistance;
        // in steps so short that the loss is that of the rise in their middle
        let (mut rise, mut gone) = (10.0_f64, 0.0);
        for k in 0..10_000 {
            let after = warmed(&of, rise, 3e-3 * f64::from(k % 7), 1e-3);
            gone += 0.5 * (rise + after) / of.thermal_resistance * 1e-3;
            rise = after;
        }
        let given: f64 = (0..10_000).map(|k| 3e-3 * f64::from(k % 7)).sum();
        assert!((given - gone - capacity * (rise - 10.0)).abs() < 1e-7, "{given} J: {gone} J gone, {rise} K");
    }

    #[test]
    fn a_warm_motor_resists_more_turns_faster_and_stalls_at_less() {
        let x = wound(typical(), 100.0);
        assert!((x.resistance / COLD.resistance - 1.39).abs() < 1e-12);
        // two faces of one flux
        let (kt, kv) = (x.torque_constant / COLD.torque_constant, x.emf_constant / COLD.emf_constant);
        assert!((kt - 0.89).abs() < 1e-12 && (kv - 0.89).abs() < 1e-12);
    }

    #[test]
    fn however_much_heat_the_numbers_stay_those_of_a_motor() {
        let rise = warmed(&typical::<f32>(), 0.0, 1e30, 1e-3);
        assert_eq!(rise, 600.0);
        let [alpha, beta] = [2, 3].map(|k| CARD.params[k].within.1);
        let x = wound(WindingHeating { resistance_rise: alpha, magnet_loss: beta, ..typical() }, f64::from(rise));
        assert!(x.torque_constant > 0.0 && x.emf_constant > 0.0 && x.resistance.is_finite());
    }

    #[test]
    fn from_nothing_on_the_rise_grows_in_proportion_to_the_thermal_resistance() {
        let none = Dual::<1>::variable(0.0, 0);
        let of = WindingHeating { thermal_resistance: none, ..typical::<Dual<1>>() };
        let rise = warmed(&of, Dual::zero(), Dual::constant(6.0), Dual::constant(1e-3));
        // ∂ΔT/∂R_θ = Q/τ over a step that is short
        assert!(rise.re == 0.0 && (rise.eps[0] - 0.1).abs() < 1e-5, "{rise:?}");
    }
}
