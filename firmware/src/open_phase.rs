//! # Open phase: a wire of a motor that carries nothing
//!
//! ```text
//! quiet:  |i_k| < ⅕·max |i|,  max |i| > I/20         in one sample
//! open:   quiet in all six hall sectors, and in no sample between not
//! ```
//!
//! A phase of a motor that turns has a sine for a current, which is quiet within 10° (electrical) of its two zeros: in two
//! sectors, or in four where the zeros lie at their edges. One that is open is quiet in all six. So the answer does not rest on
//! how fast the motor turns against the samples, and none comes of a motor that stands.
//!
//! Neither the sum of the three currents tells it, of which one is zero, nor the wheel, which the other two phases and the
//! robot turn along.
//!
//! Fails when: the motor carries too little, and the robot does not miss it then.

use crate::codes::MOTORS;
use crate::winding_signals::WindingFeedback;

/// Share of the largest phase current below which a phase is quiet [1].
const QUIET: f32 = 0.2;

/// Share of the current limit that some phase has to carry [1].
const CARRIES: f32 = 0.05;

/// A bit for each of the six sectors.
const ALL_SECTORS: u8 = 0b11_1111;

/// Sectors in which each phase of each motor was quiet, since it carried a current last.
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenPhaseDetector([[u8; 3]; MOTORS]);

impl OpenPhaseDetector {
    /// One turn; one bit a motor of which a phase is open. `amps_per_count` is a converter's [A], `limit` the most current of a
    /// motor [A].
    pub fn tick(&mut self, feedback: &WindingFeedback, amps_per_count: f32, limit: f32) -> u8 {
        let least = CARRIES * limit / amps_per_count.abs();
        let mut open = 0;
        for j in 0..MOTORS {
            let quiet_sectors = &mut self.0[j];
            let Some(sector) = feedback.codes.halls[j].sector().filter(|_| feedback.disabled >> j & 1 == 0) else {
                *quiet_sectors = [0; 3];
                continue;
            };
            let (codes, zeros) = (&feedback.codes.phases[j], &feedback.offsets[j]);
            let counts: [f32; 3] = core::array::from_fn(|k| (f32::from(codes[k].0) - zeros[k]).abs());
            let most = counts[0].max(counts[1]).max(counts[2]);
            if most < least {
                continue;
            }
            for (sectors, count) in quiet_sectors.iter_mut().zip(counts) {
                *sectors = if count < QUIET * most { *sectors | 1 << sector } else { 0 };
                if *sectors == ALL_SECTORS {
                    open |= 1 << j;
                }
            }
        }
        open
    }
}

#[cfg(test)]
mod tests {
    use model_core::control::calibration::AdcCode;
    use model_core::control::halls::HallCode;

    use super::*;

    const AMPS_PER_COUNT: f32 = 0.005;
    const LIMIT: f32 = 4.0;

    /// What is seen of motor 1 with a current of this amplitude [A] at an electrical angle [rad], one of its phases open or none.
    fn seen(amplitude: f32, angle: f32, open: Option<usize>) -> WindingFeedback {
        let third = core::f32::consts::TAU / 3.0;
        let sine = |k: usize| amplitude * (angle - k as f32 * third).sin();
        let currents: [f32; 3] = match open {
            None => core::array::from_fn(sine),
            // the circuit of the other two: what one carries in, the other carries out
            Some(open) => core::array::from_fn(|k| match (k + 3 - open) % 3 {
                0 => 0.0,
                1 => sine(k),
                _ => -sine((k + 2) % 3),
            }),
        };
        let mut feedback = WindingFeedback { offsets: [[2048.0; 3]; MOTORS], ..WindingFeedback::default() };
        feedback.codes.phases = [[AdcCode(2048); 3]; MOTORS];
        feedback.codes.halls = [HallCode::of_angle(angle); MOTORS];
        feedback.codes.phases[1] = currents.map(|i| AdcCode((2048.0 + i / AMPS_PER_COUNT).round() as u16));
        feedback
    }

    /// Turns until an open phase is found, of a motor that turns by `step` [rad] from one to the next.
    fn found(amplitude: f32, step: f32, open: Option<usize>) -> Option<usize> {
        let mut detector = OpenPhaseDetector::default();
        (1..=3000).find(|turn| {
            let angle = step * *turn as f32 + 0.01;
            detector.tick(&seen(amplitude, angle, open), AMPS_PER_COUNT, LIMIT) == 0b0010
        })
    }

    #[test]
    fn an_open_phase_of_a_motor_that_turns_is_found_and_a_sound_one_is_not() {
        // up to a whole electrical turn between two samples, both ways
        for k in -40..=40 {
            let step = 0.157 * k as f32 + 0.003;
            assert_eq!(found(1.0, step, None), None, "{step} rad a turn");
        }
        for (open, step) in [(0, 1.3), (1, -1.3), (2, 0.4), (2, 2.9)] {
            let turns = found(1.0, step, Some(open)).expect("it is open");
            assert!((6..60).contains(&turns), "{turns} turns at {step} rad");
        }
    }

    #[test]
    fn samples_that_keep_step_with_the_rotor_find_nothing_in_a_sound_motor() {
        use core::f32::consts::TAU;
        // two, three and six samples an electrical turn, drifting slowly through all angles
        for part in [1.0, 2.0, 3.0, 6.0] {
            assert_eq!(found(1.0, TAU / part + 1e-3, None), None, "{part} samples a turn");
        }
    }

    #[test]
    fn a_motor_that_stands_or_carries_nothing_tells_nothing() {
        assert_eq!(found(1.0, 0.0, Some(2)), None);
        assert_eq!(found(0.15, 1.3, Some(2)), None);
        let mut detector = OpenPhaseDetector::default();
        let lost = |angle: f32| WindingFeedback { disabled: 0b0010, ..seen(1.0, angle, Some(2)) };
        assert!((0..1000).all(|k| detector.tick(&lost(1.3 * k as f32), AMPS_PER_COUNT, LIMIT) == 0));
    }
}
