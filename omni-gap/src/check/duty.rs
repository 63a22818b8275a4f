//! A duty cycle in the place of volts: volts that are too few, or too many, by one factor for speeds and currents alike.
//!
//! u = k (Kv·l·w + R·i) with k far from one. A wrong Kv or R alone moves one of the two; k near a thousand is left to
//! those who look for millivolts.

use super::gram::Gram;
/// What is known of the drive beside the sums.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// Kv·l (V/(rad/s)) and R (Ω) of the robot file.
    pub nominal: (f64, f64),
    /// Largest |u| logged.
    pub largest: f64,
    /// The robot file's supply (V).
    pub supply: Option<f64>,
    pub currents: bool,
}

/// A duty of one, give or take a bit.
const FULL: f64 = 1.05;
/// Factors that no wrong parameter makes: below, above, and the same without currents.
const LOW: f64 = 0.25;
const HIGH: f64 = 3.0;
const HIGH_WITHOUT: f64 = 8.0;
/// Volts beyond the supply.
const BEYOND: f64 = 1.3;
/// Factors this near to a thousand are millivolts, with currents and without.
const MILLIVOLTS: f64 = 1.6;
const MILLIVOLTS_WITHOUT: f64 = 5.0;
/// What may be left, with currents and without.
const LEFT: f64 = 0.15;
const LEFT_WITHOUT: f64 = 0.3;
/// A term that explains less than this is not asked.
const SILENT: f64 = 0.02;

/// By what factor the volts are a duty cycle: volts logged over volts needed; none where they look like volts.
pub(super) fn factor(gram: &Gram, known: Known) -> Option<f64> {
    let fit = gram.shared(known.currents)?;
    let (of_speed, of_current) = (fit.a / known.nominal.0, fit.b / known.nominal.1);
    if fit.by_speed < SILENT || of_speed <= 0.0 || fit.rest > if known.currents { LEFT } else { LEFT_WITHOUT } {
        return None;
    }
    let asked = known.currents && fit.by_current > SILENT;
    if asked && (of_current <= 0.0 || (of_speed / of_current).ln().abs() > 3_f64.ln()) {
        return None;
    }
    let factor = if asked { (of_speed * of_current).sqrt() } else { of_speed };
    let low = factor < LOW && known.largest <= FULL;
    let above = if known.currents { HIGH } else { HIGH_WITHOUT };
    let beyond = known.supply.map_or(known.largest > 60.0, |supply| known.largest > BEYOND * supply);
    let milli = if known.currents { MILLIVOLTS } else { MILLIVOLTS_WITHOUT };
    let high = factor > above && beyond && (factor / 1000.0).ln().abs() > milli.ln();
    (low || high).then_some(factor)
}
