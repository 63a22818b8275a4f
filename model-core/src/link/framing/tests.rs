use super::*;

/// The frame of a payload, and how long it is.
fn framed(kind: u8, payload: &[u8]) -> ([u8; MAX_FRAME], usize) {
    let mut out = [0xaa; MAX_FRAME];
    let len = encode_frame(kind, payload, &mut out).expect("a payload that fits").len();
    (out, len)
}

/// A generator of no quality that is the same everywhere.
struct Dice(u64);

impl Dice {
    fn byte(&mut self) -> u8 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 56) as u8
    }

    /// Bytes of which many are zero.
    fn fill(&mut self, into: &mut [u8]) {
        for slot in into {
            *slot = if self.byte() < 80 { 0 } else { self.byte() };
        }
    }
}

#[test]
fn the_checksum_and_the_stuffing_are_those_of_the_books() {
    // the check value of CRC-16/IBM-3740, and the examples of the COBS paper's form
    assert_eq!(CHECK.checksum(b"123456789"), 0x29b1);
    let (out, len) = framed(0x11, &[0x00, 0x00, 0x22]);
    assert_eq!(out[..5], [0x02, 0x11, 0x01, 0x04, 0x22]);
    assert_eq!((len, out[len - 1]), (3 + 3 + 2, 0));
}

#[test]
fn every_length_of_payload_goes_through_and_a_longer_one_is_refused() {
    let mut dice = Dice(1);
    let mut decoder = FrameDecoder::new();
    for len in 0..=MAX_PAYLOAD {
        for filling in 0..3_u8 {
            let mut payload = [filling; MAX_PAYLOAD];
            if filling == 2 {
                dice.fill(&mut payload);
            }
            let (out, frame_len) = framed(filling, &payload[..len]);
            assert_eq!(frame_len, len + 5);
            let (last, before) = out[..frame_len].split_last().unwrap();
            assert!(before.iter().all(|byte| *byte != 0 && decoder.push(*byte).is_none()));
            assert_eq!(decoder.push(*last), Some(Frame { kind: filling, payload: &payload[..len] }));
        }
    }
    assert_eq!((decoder.good(), decoder.bad()), (3 * 241, 0));
    assert!(encode_frame(1, &[1; MAX_PAYLOAD + 1], &mut [0; MAX_FRAME]).is_none());
}

#[test]
fn a_decoder_is_in_step_again_after_any_garbage() {
    for seed in 0..500 {
        let mut dice = Dice(seed);
        let mut decoder = FrameDecoder::new();
        let mut garbage = [0; 600];
        let len = usize::from(dice.byte()) + usize::from(dice.byte());
        if seed % 2 == 0 {
            dice.fill(&mut garbage);
        } else {
            garbage = garbage.map(|_| dice.byte().max(1));
        }
        for byte in &garbage[..len] {
            assert!(decoder.push(*byte).is_none_or(|f| f.payload.is_empty()), "seed {seed}");
        }
        // one end mark, and the very next frame arrives
        decoder.push(0);
        let (out, len) = framed(7, &[0, 1, 2, 0]);
        let found = out[..len].iter().filter(|byte| decoder.push(**byte).is_some()).count();
        assert_eq!(found, 1, "seed {seed}");
    }
}

#[test]
fn lost_doubled_and_changed_bytes_cost_at_most_two_frames() {
    for seed in 0..2000 {
        let mut dice = Dice(seed);
        let mut payload = [0; 40];
        dice.fill(&mut payload);
        let (out, len) = framed(9, &payload);
        let hurt_at = usize::from(dice.byte()) % len;
        let how = dice.byte() % 3;
        let mut decoder = FrameDecoder::new();
        let mut arrived = 0;
        for k in 0..5 {
            for (at, byte) in out[..len].iter().enumerate() {
                let (copies, byte) = match how {
                    0 if (k, at) == (2, hurt_at) => (0, *byte),
                    1 if (k, at) == (2, hurt_at) => (2, *byte),
                    2 if (k, at) == (2, hurt_at) => (1, *byte ^ (1 << (dice.byte() % 8))),
                    _ => (1, *byte),
                };
                for _ in 0..copies {
                    if let Some(frame) = decoder.push(byte) {
                        assert_eq!(frame, Frame { kind: 9, payload: &payload }, "seed {seed}");
                        arrived += 1;
                    }
                }
            }
        }
        // a lost end mark joins two frames; a doubled one stands between two frames and hurts none
        assert!((3..=5).contains(&arrived) && (arrived == 5 || decoder.bad() > 0), "seed {seed}: {arrived}");
    }
}

#[test]
fn every_single_bit_that_flips_in_a_frame_is_found() {
    let (out, len) = framed(3, &[0, 5, 0, 0, 255, 1]);
    for bit in 0..8 * (len - 1) {
        let mut hurt = out;
        hurt[bit / 8] ^= 1 << (bit % 8);
        let mut decoder = FrameDecoder::new();
        assert!(hurt[..len].iter().all(|byte| decoder.push(*byte).is_none()), "bit {bit}");
    }
}

#[test]
fn joining_in_the_middle_of_a_frame_is_no_fault() {
    let (out, len) = framed(3, &[1, 2, 3]);
    let mut decoder = FrameDecoder::new();
    assert_eq!(out[2..len].iter().chain(&out[..len]).filter(|byte| decoder.push(**byte).is_some()).count(), 1);
    assert_eq!((decoder.good(), decoder.bad()), (1, 0));
}
