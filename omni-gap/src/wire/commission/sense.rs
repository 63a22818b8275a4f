//! # Sense: which converter sits at which output, and whether its code rises with the current
//!
//! ```text
//! a voltage along output k:  i_k = I,  i_x = −I/2 for the others       a star without a wire to its middle
//! response of converter c:   s_c·(1 at its own output, −½ at the others)
//! ```
//!
//! Pulses of 200 µs of a millisecond at a quarter of an ampere: enough to be seen, mostly too little for the rotor to move.

use crate::error::Result;

use super::bench::{Bench, ProbePort, Vector};

/// Where the three converters of a motor sit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sense {
    /// The output whose current each converter reads
    pub output: [u8; 3],
    /// True where its code falls with the current into the motor
    pub inverted: [bool; 3],
}

/// Why the responses fit no motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoSense {
    /// A converter reads less than a fifth of what the others do.
    Silent(usize),
    /// What a converter reads is not that of one output: at its own, and at the worst of the others as a share of it.
    Mixed(usize, f64),
    /// Two converters read the same output.
    Twice(usize, usize),
}

impl Sense {
    /// By what each converter reads under a voltage along each output, in counts: `response[output][converter]`.
    ///
    /// # Errors
    /// [`NoSense`] where that is no motor's answer.
    pub fn of(response: &[[f64; 3]; 3]) -> std::result::Result<Self, NoSense> {
        let at = |c: usize| [0, 1, 2].map(|k| response[k][c]);
        let size = |c: usize| at(c).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let largest = (0..3).map(size).fold(0.0, f64::max);
        let mut sense = Sense::default();
        for c in 0..3 {
            if size(c) < 0.2 * largest {
                return Err(NoSense::Silent(c));
            }
            let own = (0..3).find(|k| at(c)[*k].abs() >= size(c)).unwrap_or_default();
            // −½ at the others
            let apart = |k: usize| at(c)[k] / at(c)[own];
            if let Some(k) = (0..3).find(|k| *k != own && (apart(*k) + 0.5).abs() > 0.2) {
                return Err(NoSense::Mixed(c, apart(k)));
            }
            (sense.output[c], sense.inverted[c]) = (own as u8, at(c)[own] < 0.0);
        }
        for (one, other) in [(0, 1), (0, 2), (1, 2)] {
            if sense.output[one] == sense.output[other] {
                return Err(NoSense::Twice(one, other));
            }
        }
        Ok(sense)
    }

    /// Currents of outputs a, b, c of what the converters read.
    pub fn outputs(&self, read: [f64; 3]) -> [f64; 3] {
        let mut outputs = [0.0; 3];
        for c in 0..3 {
            outputs[usize::from(self.output[c])] = if self.inverted[c] { -read[c] } else { read[c] };
        }
        outputs
    }
}

/// The angle of each output [2⁻¹⁶ turn].
const OUTPUTS: [u16; 3] = [0, 21_845, 43_691];

/// Current of the pulses [A].
const PULSE: f64 = 0.25;

/// Periods for which a pulse lasts.
const PERIODS: u8 = 4;

/// Finds the zeros of the converters and where they sit.
pub(super) fn sense<P: ProbePort>(bench: &mut Bench<P>) -> Result<Sense> {
    bench.zeros = [0.0; 3];
    bench.zeros = bench.measure(Vector { periods: 20, share: 0.0, angle: 0 }, 20, 100)?.counts;
    let mut response = [[0.0; 3]; 3];
    // the outer ones around the first, so that a rotor that follows goes there and back
    for k in [1, 0, 2] {
        let share = ramp(bench, Vector { periods: PERIODS, share: 0.0, angle: OUTPUTS[k] }, PULSE)?;
        let vector = Vector { periods: PERIODS, share, angle: OUTPUTS[k] };
        let mean = bench.measure(vector, 10, 40)?;
        response[k] = mean.counts.map(|counts| counts / share);
        bench.hold(Vector { share: 0.0, ..vector }, 0, 10)?;
    }
    Sense::of(&response).map_err(|why| {
        let letter = |c: usize| ["a", "b", "c"][c];
        let problem = match why {
            NoSense::Silent(c) => format!("the current converter of phase {} reads nothing", letter(c)),
            NoSense::Mixed(c, share) => format!(
                "the current converter of phase {} reads {share:.2} of its own current under the others', expected -0.5",
                letter(c)
            ),
            NoSense::Twice(one, other) => {
                format!("the current converters of phases {} and {} read the same output", letter(one), letter(other))
            }
        };
        bench.trouble(problem, "Check the amplifiers of this motor and the lines to them")
    })
}

/// Raises the share of a vector until its largest phase current is so much [A]; the share.
pub(super) fn ramp<P: ProbePort>(bench: &mut Bench<P>, vector: Vector, current: f64) -> Result<f64> {
    const FIRST: f64 = 0.001;
    const STEP: f64 = 1.25;
    const MOST: f64 = 0.85;
    let amps = f64::from(bench.hello.calibration.amps_per_count).abs();
    let mut share = FIRST;
    loop {
        let mean = bench.measure(Vector { share, ..vector }, 6, 6)?;
        let flows = amps * mean.counts.into_iter().fold(0.0, |most: f64, counts| most.max(counts.abs()));
        if flows * STEP >= current {
            return Ok(share * (current / flows).min(STEP));
        }
        if share >= MOST {
            let bus = mean.bus;
            let problem = format!("{flows:.2} A flow at {:.0} % of {bus:.1} V, expected {current:.2} A", 100.0 * share);
            return Err(
                bench.trouble(problem, "Plug in all three leads of the motor; check its gate driver and supply")
            );
        }
        share = (share * STEP).min(MOST);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What converters read of a motor of so many counts.
    fn response(sense: &Sense, counts: f64) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|k| {
            [0, 1, 2].map(|c| {
                let share = if usize::from(sense.output[c]) == k { 1.0 } else { -0.5 };
                counts * share * if sense.inverted[c] { -1.0 } else { 1.0 }
            })
        })
    }

    #[test]
    fn every_order_with_every_sign_is_told() {
        for output in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            for signs in 0..8 {
                let sense = Sense { output, inverted: [0, 1, 2].map(|bit| signs >> bit & 1 == 1) };
                assert_eq!(Sense::of(&response(&sense, 50.0)), Ok(sense));
            }
        }
    }

    #[test]
    fn what_is_no_motor_is_told() {
        let plain = response(&Sense { output: [0, 1, 2], ..Sense::default() }, 50.0);
        let mut silent = plain;
        silent.iter_mut().for_each(|output| output[1] *= 0.1);
        assert_eq!(Sense::of(&silent), Err(NoSense::Silent(1)));
        let mut twice = plain;
        twice.iter_mut().for_each(|output| output[2] = output[0]);
        assert_eq!(Sense::of(&twice), Err(NoSense::Twice(0, 2)));
        let mut mixed = plain;
        mixed[1][0] = 20.0;
        assert_eq!(Sense::of(&mixed), Err(NoSense::Mixed(0, 0.4)));
    }
}
