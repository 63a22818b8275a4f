//! # Probe: a voltage that stands still, on one motor, to find out how it is wired
//!
//! ```text
//! α = m·cos θ,  β = m·sin θ                 m: share of the bus, DC-equivalent; θ: from output a towards output b
//! on in turn k:  (18 − k) mod 20 < n        what turn k decides holds from sample k + 1 to k + 2, codes are told
//!                                           where k is a multiple of 20, and n periods end there
//! |i_x| > 1.25 A:  over-current             in the period that sees it
//! ```
//!
//! Nothing of the motor's wiring is trusted: neither halls nor the signs of the currents are looked at, and what is too
//! much is the size of any converter's code. A vector that stands still cannot run away: the rotor comes to it, by half
//! an electrical turn at the most, and stays.
//!
//! The host is to ramp the voltage. One that asks for the whole bus at once is stopped by the limit, in the second period
//! after it: until then U/L·100 µs flow at the most, and the over-current of the gate driver is what guards against that.
//!
//! Source: definitions; space vector as in [`model_core::control::phases`].

use model_core::control::phases::{DirectQuadrature, Rotation, centred_duties};
use model_core::link::probe::{MOST_PERIODS, Probe, ProbeReport};

use crate::codes::{Codes, PERIODS_PER_TICK};
use crate::protection::TripLimits;
use crate::winding_config::{MAX_DUTY, WindingConfig};

/// Phase current beyond which a probe ends [A]: what a commissioning may use, and a quarter.
pub const PROBE_CURRENT: f32 = 1.25;

/// Turns without a probe after which the voltage goes: 200 ms.
pub const PROBE_TIMEOUT_TICKS: u16 = 200;

/// What is too much while a motor is probed.
pub fn probe_limits(config: &WindingConfig) -> TripLimits {
    let counts = PROBE_CURRENT / config.calibration.amps_per_count.abs();
    TripLimits { trip_counts: config.limits.trip_counts.min(counts), ..config.limits }
}

const _: () = assert!(MOST_PERIODS as u32 == PERIODS_PER_TICK, "a voltage may be on all the time");

/// What the windings are to put on one motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeVector {
    /// What was asked for
    probe: Probe,
    /// Where the vector stands now [2⁻¹⁶ turn]
    angle: u16,
    /// Duties of the outputs while it is on [1]
    duties: [f32; 3],
}

impl ProbeVector {
    /// A probe with its vector at an angle.
    fn new(probe: Probe, angle: u16) -> Self {
        let share = (f32::from(probe.share) * (1.0 / 65_536.0)).min(MAX_DUTY);
        let vector = Rotation::of_code(angle).inverse_park(DirectQuadrature { d: share, q: 0.0 });
        // the phases' share of a DC-equivalent vector is 1/√3 of it
        let phase = vector.inverse_clarke();
        let duties = centred_duties(phase.map(|x| x * 0.577_350_26));
        Self { probe, angle, duties }
    }

    /// Which motor.
    #[inline]
    pub fn motor(&self) -> u8 {
        self.probe.motor
    }

    /// Duties of the outputs in what a period decides [1]; none while the voltage is off.
    pub fn duties(&self, period: u32) -> Option<[f32; 3]> {
        // (18 − k) mod 20 < n
        let before = (2 * PERIODS_PER_TICK - 2 - period % PERIODS_PER_TICK) % PERIODS_PER_TICK;
        (before < u32::from(self.probe.periods)).then_some(self.duties)
    }

    /// What was measured under it.
    pub fn report(&self, period: u32, read: &Codes) -> ProbeReport {
        let Probe { motor, periods, share, .. } = self.probe;
        ProbeReport {
            time: period,
            motor,
            periods,
            share,
            angle: self.angle,
            bus: read.bus,
            phases: read.phases.get(usize::from(motor)).copied().unwrap_or_default(),
            halls: read.halls,
        }
    }
}

/// The probe that is on, turn by turn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Prober {
    vector: Option<ProbeVector>,
    silent: u16,
}

impl Prober {
    /// Begins a probe, or goes on with another.
    pub fn take(&mut self, probe: Probe) {
        let angle = self.vector.filter(|before| before.probe.motor == probe.motor).map(|before| before.angle);
        let vector = ProbeVector { probe, angle: angle.unwrap_or(probe.angle), duties: [0.5; 3] };
        (self.vector, self.silent) = (Some(vector), 0);
    }

    /// One motion turn; none where there is no probe, or none more for too long.
    pub fn tick(&mut self) -> Option<ProbeVector> {
        let ProbeVector { probe, angle, .. } = self.vector?;
        self.silent += 1;
        if self.silent > PROBE_TIMEOUT_TICKS {
            self.end();
            return None;
        }
        let ahead = probe.angle.wrapping_sub(angle).cast_signed();
        let step = if probe.rate == 0 { ahead.unsigned_abs() } else { ahead.unsigned_abs().min(probe.rate) };
        let angle = if ahead < 0 { angle.wrapping_sub(step) } else { angle.wrapping_add(step) };
        self.vector = Some(ProbeVector::new(probe, angle));
        self.vector
    }

    /// No voltage any more.
    pub fn end(&mut self) {
        self.vector = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROBE: Probe = Probe { sequence: 0, motor: 1, periods: 20, share: 0x4000, angle: 0, rate: 0 };

    #[test]
    fn the_voltage_is_on_in_the_periods_that_end_with_the_sample() {
        for periods in 1..=20_u8 {
            let vector = ProbeVector::new(Probe { periods, ..PROBE }, 0);
            // what is decided in turn k is on from sample k + 1 to sample k + 2: the periods before sample 40
            let on = (0..40).filter(|k| vector.duties(*k).is_some()).map(|k| k + 2);
            assert!(on.eq((2..42).filter(|end| (40 - end % 20) % 20 < u32::from(periods))), "{periods} periods");
        }
    }

    #[test]
    fn the_duties_span_the_share_along_an_output_and_never_more() {
        for angle in (0..=u16::MAX).step_by(97) {
            let [a, b, c] = ProbeVector::new(PROBE, angle).duties;
            let span = a.max(b).max(c) - a.min(b).min(c);
            // 0.25 of the bus; √3/2 of it along an output
            assert!((0.2164..=0.2501).contains(&span), "{angle}: {span}");
        }
        let [a, b, c] = ProbeVector::new(PROBE, 0).duties;
        assert!(a > b && (b - c).abs() < 1e-6, "along output a");
        let [a, b, c] = ProbeVector::new(Probe { share: u16::MAX, ..PROBE }, 0x1555).duties;
        assert!((a.max(b).max(c) - a.min(b).min(c)) <= MAX_DUTY + 1e-6, "room for the converters is left");
    }

    #[test]
    fn the_vector_turns_the_shorter_way_and_stands_when_it_is_there() {
        let mut prober = Prober::default();
        prober.take(Probe { angle: 0x0100, ..PROBE });
        assert_eq!(prober.tick().map(|vector| vector.angle), Some(0x0100), "the first is there at once");
        prober.take(Probe { angle: 0xff00, rate: 0x0180, ..PROBE });
        let way = (0..3).filter_map(|_| prober.tick()).map(|vector| vector.angle);
        assert!(way.eq([0xff80, 0xff00, 0xff00]));
        prober.take(Probe { motor: 2, angle: 0x4000, rate: 1, ..PROBE });
        assert_eq!(prober.tick().map(|vector| vector.angle), Some(0x4000), "another motor begins anew");
    }

    #[test]
    fn a_host_that_falls_silent_ends_it_after_200_ms() {
        let mut prober = Prober::default();
        prober.take(PROBE);
        assert_eq!((0..1000).filter(|_| prober.tick().is_some()).count(), 200);
    }
}
