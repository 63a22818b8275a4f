//! The board's tests that need a wire or a hand: `cargo fw-hand`, after `firmware/HARDWARE.md` has been read.
#![no_std]
#![no_main]

mod on_board;

use panic_probe as _;

#[cfg(test)]
#[embedded_test::tests]
mod tests {
    use crate::on_board::{self, group, wait};
    use defmt::{assert, assert_eq, info, panic};
    use firmware::board::Parts;
    use firmware::codes::{MOTORS, PERIODS_PER_SECOND};
    use firmware::registers::timing;
    use model_core::control::halls::HallDecoder;

    #[init]
    fn init() -> Parts {
        on_board::parts()
    }

    #[test]
    #[timeout(90)]
    fn turning_a_wheel_by_hand_forward_gives_the_sequence(mut parts: Parts) {
        parts.bridges.start();
        info!("turn one wheel forward, at least two turns of the motor, within a minute");
        let (first, _) = group(&mut parts);
        let mut halls = first.halls.map(|code| HallDecoder::new(code).ok());
        let mut last = first.halls;
        for _ in 0..60 * PERIODS_PER_SECOND {
            let (codes, _) = group(&mut parts);
            for motor in 0..MOTORS {
                let Some(followed) = &mut halls[motor] else { continue };
                assert!(followed.update(codes.halls[motor]).is_ok(), "motor {}: a code out of sequence", motor);
                if codes.halls[motor] != last[motor] {
                    last[motor] = codes.halls[motor];
                    info!("motor {}: code {}, {} edges", motor, last[motor].0, followed.edges());
                }
                assert!(followed.edges() > -12, "motor {} counts backwards: two of its lines are swapped", motor);
                if followed.edges() >= 12 {
                    return;
                }
            }
        }
        panic!("no wheel was turned");
    }

    #[test]
    fn with_a_wire_from_pc10_to_pc11_the_link_hears_itself(mut parts: Parts) {
        let mut bytes = [0; 256];
        bytes.iter_mut().zip(0..).for_each(|(byte, at)| *byte = at);
        for _ in 0..20 {
            assert_eq!(parts.serial.send(&bytes), bytes.len());
            // 256 bytes of 10 bits at 2 Mbaud
            wait(1_500);
            let mut heard = [0; 300];
            assert_eq!(parts.serial.receive(&mut heard), bytes.len());
            assert_eq!(heard[..256], bytes);
        }
    }

    /// The gate drivers must be unplugged. The wire puts the PWM of motor 0, phase a, on the pin of its current: at the
    /// moment of the sample the output must be low, for every duty that leaves any low time at all around the top.
    #[test]
    fn with_a_wire_from_pa8_to_pa4_the_sample_is_at_the_centre_of_the_pwm(mut parts: Parts) {
        parts.bridges.start();
        let mut widest = 0;
        for low in (0..200_u16).rev() {
            let duty = f32::from(timing::TOPS[0] - low) / f32::from(timing::TOPS[0]);
            parts.bridges.drive(&[[duty, 0.0, 0.0]; MOTORS], 0);
            // the first group still has the old duty
            for _ in 0..3 {
                group(&mut parts);
            }
            let (codes, _) = group(&mut parts);
            if codes.phases[0][0].0 > 1_000 {
                widest = low;
                break;
            }
        }
        info!("the sample is within {} counts of the centre", widest);
        // the sample is held at the top, but a converter's cycle is 8 counts and its latency known to one or two; the
        // capacitor of the converter takes some 10 counts to follow
        assert!(widest <= 32, "the sample is {} counts off the centre", widest);
    }
}
