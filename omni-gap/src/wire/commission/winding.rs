//! # Winding: R by a steady current, L by its rise
//!
//! ```text
//! R = Δu/Δi                                             two steady levels: what dead time takes from both drops out
//! i_n/i_20 = (1 − e^{−n·x})/(1 − e^{−20·x}),  x = R·Δt/L    on for n periods of 20, again and again
//! u: DC-equivalent,  i = √3/2·|i_αβ|
//! ```
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | R, L | Ω, H | DC-equivalent, between two terminals; twice those of a phase |
//! | n | periods | for which the voltage is on before the sample |
//! | Δt | s | a period |
//!
//! The rotor stands along the vector, where its magnet induces nothing and its torque is none.
//!
//! Neglects: saturation and saliency: it is the inductance along d, at the current that is used. What the scales of the
//! codes are off by, R and L are off by too; the uncertainty stated is that of noise and rounding alone.

use model_core::control::phases::{AlphaBeta, dc_current};

use crate::error::Result;

use super::bench::{Bench, CURRENT, Mean, ProbePort, QUICKLY, Vector};
use super::sense::{Sense, ramp};

/// A number with its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub sigma: f64,
}

/// What a winding is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Winding {
    /// R, DC-equivalent [Ω]
    pub resistance: Estimate,
    /// L, DC-equivalent [H]
    pub inductance: Estimate,
    /// Share of the bus at which the current of a commissioning flows [1]
    pub share: f64,
}

/// A quarter of a turn before output a [2⁻¹⁶ turn].
const SIDE: u16 = 49_152;

/// Periods of the rises that are looked at.
const RISES: [u8; 6] = [1, 2, 3, 5, 8, 12];

/// Steps in which a duty is made, of a period [1].
const DUTY_STEP: f64 = 1.0 / 4200.0;

/// Draws the rotor along output a, and measures there.
pub(super) fn winding<P: ProbePort>(bench: &mut Bench<P>, sense: &Sense) -> Result<Winding> {
    let along = Vector { periods: 20, share: 0.0, angle: 0 };
    // a rotor that stands against the vector would break loose at its full current, and induce as much again: it is drawn
    // along from the side first, at half of that
    let side = Vector { angle: SIDE, ..along };
    let gently = Vector { share: ramp(bench, side, 0.5 * CURRENT)?, ..side };
    bench.turn(gently, i32::from(SIDE.wrapping_neg()), QUICKLY)?;
    bench.hold(Vector { angle: 0, ..gently }, 100, 0)?;
    let share = ramp(bench, along, CURRENT)?;
    let (full, half) = (Vector { share, ..along }, Vector { share: 0.5 * share, ..along });
    // until the rotor has come to rest
    bench.hold(full, 300, 0)?;
    let high = bench.measure(full, 50, 100)?;
    let low = bench.measure(half, 50, 100)?;
    let amps = f64::from(bench.hello.calibration.amps_per_count).abs();
    let dc = |mean: &Mean| amps * dc_size(sense.outputs(mean.counts));
    let (volts, current) = (high.voltage - low.voltage, dc(&high) - dc(&low));
    if current <= 0.1 * CURRENT {
        let problem = format!("the current does not grow with the voltage: {:.2} A and {:.2} A", dc(&low), dc(&high));
        return Err(bench.trouble(problem, "Check the motor's leads and its gate driver"));
    }
    // R = Δu/Δi
    let resistance = volts / current;
    let noise = amps * (high.sigma.powi(2) + low.sigma.powi(2)).sqrt() / current;
    let rounding = high.bus * DUTY_STEP / 6.0_f64.sqrt() / volts;
    let resistance = Estimate { value: resistance, sigma: resistance * noise.hypot(rounding) };
    let mut rises = [(0.0, 0.0, 0.0); RISES.len()];
    for (slot, periods) in rises.iter_mut().zip(RISES) {
        let rise = bench.measure(Vector { periods, ..full }, 20, 60)?;
        *slot = (f64::from(periods), dc(&rise) / dc(&high), amps * rise.sigma / dc(&high));
    }
    bench.hold(full, 0, 20)?;
    let inductance = inductance(&rises, resistance, f64::from(bench.hello.calibration.period));
    Ok(Winding { resistance, inductance, share })
}

/// DC-equivalent current of a vector of phase currents.
fn dc_size(phases: [f64; 3]) -> f64 {
    // √3/2·|i_αβ|
    let AlphaBeta { alpha, beta } = AlphaBeta::clarke(phases);
    dc_current(alpha.hypot(beta))
}

/// (1 − e^{−n·x})/(1 − e^{−20·x})
fn rise(n: f64, x: f64) -> f64 {
    (-n * x).exp_m1() / (-20.0 * x).exp_m1()
}

/// L of rises (n, i_n/i_20, σ of that), by least squares over x.
fn inductance(rises: &[(f64, f64, f64)], resistance: Estimate, period: f64) -> Estimate {
    let misfit = |log: f64| -> f64 {
        rises.iter().map(|(n, share, sigma)| ((share - rise(*n, log.exp())) / sigma).powi(2)).sum()
    };
    // x from 10⁻⁴ (L/R of half a second) to 20 (2.5 µs), the best of a grid and then between its neighbours
    let (mut low, mut high) = (1.0e-4_f64.ln(), 20.0_f64.ln());
    for _ in 0..12 {
        let step = (high - low) / 20.0;
        let at = |k: u32| low + step * f64::from(k);
        let best = (0..=20).min_by(|a, b| misfit(at(*a)).total_cmp(&misfit(at(*b)))).unwrap_or_default();
        (low, high) = (at(best) - step, at(best) + step);
    }
    let x = (0.5 * (low + high)).exp();
    let slope = |n: f64| (rise(n, x * 1.001) - rise(n, x * 0.999)) / 0.002;
    // σ of ln x, the part of R's in L = R·Δt/x beside it
    let weight: f64 = rises.iter().map(|(n, _, sigma)| (slope(*n) / sigma).powi(2)).sum();
    let value = resistance.value * period / x;
    let relative = (1.0 / weight.max(f64::MIN_POSITIVE)).sqrt().hypot(resistance.sigma / resistance.value);
    Estimate { value, sigma: value * relative }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rise_tells_the_inductance_and_how_well() {
        let resistance = Estimate { value: 4.3, sigma: 0.0 };
        for inductance_h in [0.05e-3, 0.6e-3, 5.0e-3] {
            let x = 4.3 * 50e-6 / inductance_h;
            let rises = RISES.map(|n| (f64::from(n), rise(f64::from(n), x), 1e-3));
            let told = inductance(&rises, resistance, 50e-6);
            assert!((told.value / inductance_h - 1.0).abs() < 1e-6, "{told:?}");
            assert!(told.sigma > 0.0);
        }
        // faster than a period: nothing of it is seen, and that is told
        let blind = inductance(&RISES.map(|n| (f64::from(n), 1.0, 1e-3)), resistance, 50e-6);
        assert!(blind.sigma > blind.value, "{blind:?}");
    }

    #[test]
    fn a_vector_along_a_phase_is_what_a_direct_current_would_be() {
        // u/√3 over R/2 in phase a: u = √3·(R/2)·I, so that u/R is √3/2 of it
        assert!((dc_size([1.0, -0.5, -0.5]) - 0.866_025).abs() < 1e-6);
        assert!((dc_size([0.0, 1.0, -1.0]) - 1.0).abs() < 1e-12, "between two terminals");
    }
}
