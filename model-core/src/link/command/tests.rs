use super::*;
use crate::link::framing::FrameDecoder;

const TWIST: BodyTwist<f32> = BodyTwist { v: 1.25, vn: -0.5, w: 3.0 };

#[test]
fn every_command_arrives_as_it_was_sent() {
    let bytes = [0, 1, 2, 0xff, 0];
    let all = [
        Command::Drive { sequence: 0xfffe, twist: TWIST },
        Command::Drive { sequence: 0, twist: BodyTwist { v: -20.0, vn: 20.0, w: -100.0 } },
        Command::DriveRamp {
            sequence: 3,
            ramp: TwistRamp { twist: TWIST, acceleration: BodyTwist { v: 100.0, vn: -2.5, w: 1000.0 }, horizon_ms: 90 },
        },
        Command::Open,
        Command::Clear,
        Command::Chunk { offset: 384, bytes: &bytes },
        Command::Chunk { offset: 0, bytes: &[7; MAX_CHUNK] },
        Command::Commit { length: 412 },
        Command::Probe(Probe { sequence: 9, motor: 3, periods: 20, share: 0xffff, angle: 1, rate: 0x1234 }),
    ];
    let mut decoder = FrameDecoder::new();
    for command in all {
        let mut out = [0; MAX_FRAME];
        let (end, before) = command.frame(&mut out).unwrap().split_last().unwrap();
        assert!(before.iter().all(|byte| decoder.push(*byte).is_none()));
        let frame = decoder.push(*end).unwrap();
        assert_eq!(Command::decode(frame.kind, frame.payload), Ok(command));
    }
}

/// The payload of a drive command.
fn driven(v: f32, vn: f32, w: f32) -> [u8; 14] {
    let mut payload = [0; 14];
    let mut writer = Writer::new(&mut payload);
    writer.u16(5);
    [v, vn, w].into_iter().for_each(|x| writer.f32(x));
    payload
}

#[test]
fn speeds_that_nothing_can_mean_are_refused_with_their_reason() {
    let decode = |payload: [u8; 14]| Command::decode(FrameKind::Drive.code(), &payload).map(|_| ());
    for not_finite in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(decode(driven(not_finite, 0.0, 0.0)), Err(CommandError::NotFinite));
        assert_eq!(decode(driven(0.0, not_finite, 0.0)), Err(CommandError::NotFinite));
        assert_eq!(decode(driven(0.0, 0.0, not_finite)), Err(CommandError::NotFinite));
    }
    for sign in [1.0, -1.0] {
        assert_eq!(decode(driven(sign * 20.001, 0.0, 0.0)), Err(CommandError::TooFast));
        assert_eq!(decode(driven(0.0, sign * 20.001, 0.0)), Err(CommandError::TooFast));
        assert_eq!(decode(driven(0.0, 0.0, sign * 100.01)), Err(CommandError::TooFast));
        assert_eq!(decode(driven(sign * 20.0, -sign * 20.0, sign * 100.0)), Ok(()));
    }
}

/// What becomes of a ramp on the wire.
fn decoded(ramp: TwistRamp) -> Result<(), CommandError> {
    let mut payload = [0; 28];
    let mut writer = Writer::new(&mut payload);
    writer.u16(5);
    let numbers = [ramp.twist.to_array(), ramp.acceleration.to_array()];
    numbers.as_flattened().iter().for_each(|x| writer.f32(*x));
    writer.u16(ramp.horizon_ms);
    Command::decode(FrameKind::DriveRamp.code(), &payload).map(|_| ())
}

#[test]
fn a_ramp_that_nothing_can_mean_is_refused_with_its_reason() {
    let along = |v: f32| BodyTwist { v, vn: 0.0, w: 0.0 };
    let about = |w: f32| BodyTwist { v: 0.0, vn: 0.0, w };
    let steady = TwistRamp::default();
    for not_finite in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let of_acceleration = TwistRamp { acceleration: along(not_finite), ..steady };
        for ramp in [of_acceleration, TwistRamp::steady(about(not_finite))] {
            assert_eq!(decoded(ramp), Err(CommandError::NotFinite));
        }
    }
    for sign in [1.0, -1.0] {
        for hard in [along(sign * 100.01), about(sign * 1000.1)] {
            assert_eq!(decoded(TwistRamp { acceleration: hard, ..steady }), Err(CommandError::TooHard));
        }
        // 18 m/s and 40 m/s² for 50 ms are 20 m/s, for 51 ms they are more
        let fast = TwistRamp { twist: along(sign * 18.0), acceleration: along(sign * 40.0), horizon_ms: 50 };
        assert_eq!(decoded(fast), Ok(()));
        assert_eq!(decoded(TwistRamp { horizon_ms: 51, ..fast }), Err(CommandError::TooFast));
    }
    assert_eq!(decoded(TwistRamp { horizon_ms: LONGEST_HORIZON_MS, ..steady }), Ok(()));
    assert_eq!(decoded(TwistRamp { horizon_ms: LONGEST_HORIZON_MS + 1, ..steady }), Err(CommandError::TooLong));
}

#[test]
fn every_other_length_and_every_other_kind_is_refused() {
    for kind in 0..=u8::MAX {
        // a probe of motor 1 for one period is possible, a horizon of 257 ms is not
        let long = [u8::from(kind != FrameKind::DriveRamp.code()); MAX_PAYLOAD];
        for len in 0..=MAX_PAYLOAD {
            let fits = match FrameKind::from_code(kind) {
                Some(FrameKind::Drive) => len == 14,
                Some(FrameKind::DriveRamp) => len == 28,
                Some(FrameKind::Open | FrameKind::Clear) => len == 0,
                Some(FrameKind::Chunk) => (3..=2 + MAX_CHUNK).contains(&len),
                Some(FrameKind::Commit) => len == 2,
                Some(FrameKind::Probe) => len == 10,
                _ => {
                    assert_eq!(Command::decode(kind, &long[..len]), Err(CommandError::Kind));
                    continue;
                }
            };
            assert_eq!(Command::decode(kind, &long[..len]).is_ok(), fits, "kind {kind}, {len} bytes");
        }
    }
}

#[test]
fn a_probe_of_a_motor_that_is_not_there_is_refused() {
    let mut payload = [0, 0, 3, 20, 0, 1, 0, 1, 0, 1];
    assert!(Command::decode(FrameKind::Probe.code(), &payload).is_ok());
    for (at, value) in [(2, 4), (3, 0), (3, 21)] {
        let before = core::mem::replace(&mut payload[at], value);
        assert_eq!(Command::decode(FrameKind::Probe.code(), &payload), Err(CommandError::NoSuchProbe));
        payload[at] = before;
    }
}

#[test]
fn a_reply_is_read_as_it_was_written() {
    for taken in [false, true] {
        let reply = Reply { to: FrameKind::Commit.code(), taken, reason: 9 };
        assert_eq!(Reply::from_bytes(&reply.to_bytes()), Some(reply));
    }
    assert_eq!(Reply::from_bytes(&[5, 2, 0]), None);
    assert_eq!(Reply::from_bytes(&[5, 1]), None);
}

#[test]
fn reasons_have_codes_and_words_of_their_own() {
    for (k, reason) in CommandError::ALL.into_iter().enumerate() {
        assert_eq!(usize::from(reason.code()), k + 1);
        assert!(CommandError::ALL.into_iter().skip(k + 1).all(|other| other.text() != reason.text()));
    }
}
