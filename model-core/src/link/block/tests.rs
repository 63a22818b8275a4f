use super::*;
use crate::plant::paper;

/// A sound block of the paper's robot.
fn four() -> Block<4> {
    with(paper::four_wheels())
}

fn with<const N: usize>(robot: Robot<N, f32>) -> Block<N> {
    let mut effects = BlockEffects::default();
    effects.push(BlockEffect::new("stribeck", None, &[0.4, 0.05, 1.0]).unwrap()).unwrap();
    effects.push(BlockEffect::new("motor_mismatch", Some(2), &[0.88, 1.1]).unwrap()).unwrap();
    effects.push(BlockEffect::new("coriolis", None, &[1.0]).unwrap()).unwrap();
    Block {
        feedforward: true,
        robot,
        inductance: 0.5e-3,
        mode: ControlMode::Current,
        commutation: Commutation::SixStep,
        pole_pairs: 8,
        limits: Limits {
            current: 3.0,
            speed: 1.5,
            acceleration: [3.0, 2.5, 30.0],
            under_voltage: 9.0,
            over_voltage: 15.0,
        },
        feedback: 0.2,
        feedback_integral: 1.0,
        bandwidth: 4000.0,
        amps_per_count: 0.0049,
        bus_volts_per_count: 0.00886,
        linear_range: 9.4,
        continuous_current: 1.5,
        heating_time: 10.0,
        effects,
        wiring: [None; N],
        sensors: SensorScales::default(),
    }
}

fn encoded<const N: usize>(block: &Block<N>) -> ([u8; MAX_BYTES], usize) {
    let mut bytes = [0xff; MAX_BYTES];
    let length = block.encode(&mut bytes).expect("a sound block");
    (bytes, length)
}

/// The same bytes with a checksum that fits them.
fn resealed(mut bytes: [u8; MAX_BYTES], length: usize) -> [u8; MAX_BYTES] {
    let check = CHECK.checksum(&bytes[..length - 4]).to_le_bytes();
    bytes[length - 4..length].copy_from_slice(&check);
    bytes
}

fn refusal(bytes: &[u8]) -> BlockError {
    Parameters::decode(bytes).map(|_| ()).expect_err("to be refused")
}

#[test]
fn a_block_comes_back_as_it_was_written() {
    let (bytes, length) = encoded(&four());
    // header, four wheels, scalars, three effects with six parameters, checksum
    assert_eq!(length, HEADER + 48 + 116 + 1 + 3 * 2 + 6 * 4 + 4);
    let Ok(Parameters::Four(block)) = Parameters::decode(&bytes[..length]) else { panic!("four wheels") };
    assert_eq!(encoded(&block), (bytes, length));
    assert_eq!(block.robot.wheels, paper::four_wheels().wheels);
    assert_eq!((block.limits, block.mode, block.pole_pairs), (four().limits, ControlMode::Current, 8));
    assert_eq!((block.robot.motor, block.robot.friction), (four().robot.motor, four().robot.friction));
    let effects: [_; 3] =
        core::array::from_fn(|k| block.effects.iter().nth(k).map(|e| (e.id(), e.wheel(), e.params())));
    let expected: [(&str, Option<u8>, &[f32]); 3] =
        [("stribeck", None, &[0.4, 0.05, 1.0]), ("motor_mismatch", Some(2), &[0.88, 1.1]), ("coriolis", None, &[1.0])];
    assert_eq!(effects, expected.map(Some));

    let three =
        Block { mode: ControlMode::Voltage, commutation: Commutation::FieldOriented, ..with(paper::three_wheels()) };
    let (bytes, length) = encoded(&three);
    let Ok(Parameters::Three(block)) = Parameters::decode(&bytes[..length]) else { panic!("three wheels") };
    assert_eq!(encoded(&block), (bytes, length));
    assert_eq!((block.mode, block.commutation), (ControlMode::Voltage, Commutation::FieldOriented));
}

#[test]
fn what_stands_behind_a_block_does_not_matter_and_its_checksum_is_found() {
    let (bytes, length) = encoded(&four());
    assert!(Parameters::decode(&bytes).is_ok());
    assert_eq!(checksum(&bytes), Some(u32::from_le_bytes(bytes[length - 4..length].try_into().unwrap())));
    assert_eq!((checksum(&[0xff; 64]), checksum(&bytes[..length - 1]), checksum(b"OMNI")), (None, None, None));
}

#[test]
fn every_single_bit_that_flips_is_refused() {
    let (bytes, length) = encoded(&four());
    for bit in 0..8 * length {
        let mut hurt = bytes;
        hurt[bit / 8] ^= 1 << (bit % 8);
        assert!(Parameters::decode(&hurt).is_err(), "bit {bit}");
        assert!(Parameters::decode(&hurt[..length]).is_err(), "bit {bit}");
    }
}

#[test]
fn every_shorter_block_is_refused() {
    let (bytes, length) = encoded(&four());
    for shorter in 0..length {
        assert!(Parameters::decode(&bytes[..shorter]).is_err(), "{shorter} bytes");
    }
    // and so is one that says it is shorter, or longer, even with a checksum that fits
    for said in (0..=MAX_BYTES).filter(|said| *said != length) {
        let mut changed = bytes;
        changed[6..8].copy_from_slice(&(said as u16).to_le_bytes());
        let changed = if said >= HEADER { resealed(changed, said) } else { changed };
        assert_eq!(refusal(&changed).reason, BlockErrorKind::Length, "{said} bytes");
    }
}

#[test]
fn flash_that_was_erased_is_no_block() {
    assert_eq!(refusal(&[0xff; MAX_BYTES]).reason, BlockErrorKind::Magic);
    assert_eq!(refusal(&[0; MAX_BYTES]).reason, BlockErrorKind::Magic);
    assert_eq!(refusal(&[]).reason, BlockErrorKind::Magic);
}

#[test]
fn another_version_is_refused_as_newer_or_older() {
    let (bytes, length) = encoded(&four());
    for (version, reason) in
        [(0_u16, BlockErrorKind::Older), (VERSION + 1, BlockErrorKind::Newer), (u16::MAX, BlockErrorKind::Newer)]
    {
        let mut changed = bytes;
        changed[4..6].copy_from_slice(&version.to_le_bytes());
        let error = refusal(&resealed(changed, length));
        assert_eq!((error.reason, error.value), (reason, f32::from(version)));
    }
}

#[test]
fn ways_of_driving_and_numbers_of_wheels_that_do_not_exist_are_refused() {
    let (bytes, length) = encoded(&four());
    for (at, value, reason) in [
        (8, 2, BlockErrorKind::Wheels),
        (8, 5, BlockErrorKind::Wheels),
        (9, 2, BlockErrorKind::Mode),
        (10, 2, BlockErrorKind::Mode),
        (11, 2, BlockErrorKind::Mode),
    ] {
        let mut changed = bytes;
        changed[at] = value;
        assert_eq!(refusal(&resealed(changed, length)).reason, reason, "byte {at} = {value}");
    }
    let mut changed = bytes;
    changed[8] = 3;
    assert!(Parameters::decode(&resealed(changed, length)).is_err(), "a wheel too many");
}

#[test]
fn every_number_is_held_to_its_bounds_on_both_sides() {
    let (bytes, length) = encoded(&four());
    let wheels = (0..4).flat_map(|_| bounds::WHEEL);
    for (k, field) in wheels.chain(bounds::SCALARS).enumerate() {
        let at = HEADER + 4 * k;
        let (low, high) = field.within;
        let out = [low - 0.01 * low.abs() - 1e-6, high + 0.01 * high.abs(), -f32::MAX, f32::MAX];
        for (x, reason) in out
            .map(|x| (x, BlockErrorKind::OutOfBounds))
            .into_iter()
            .chain([f32::NAN, f32::INFINITY, f32::NEG_INFINITY].map(|x| (x, BlockErrorKind::NotFinite)))
        {
            let mut changed = bytes;
            changed[at..at + 4].copy_from_slice(&x.to_le_bytes());
            let error = refusal(&resealed(changed, length));
            assert_eq!((error.reason, error.field), (reason, field.key), "{x}");
            assert!(error.value == x || x.is_nan());
        }
    }
    for pole_pairs in [0, 51, 255] {
        let mut changed = bytes;
        changed[12] = pole_pairs;
        let error = refusal(&resealed(changed, length));
        assert_eq!((error.reason, error.field), (BlockErrorKind::OutOfBounds, "pole_pairs"));
    }
}

#[test]
fn the_host_cannot_write_what_the_robot_would_refuse() {
    let mut bytes = [0; MAX_BYTES];
    for k in 0..bounds::SCALARS.len() {
        for x in [f32::NAN, f32::INFINITY, 1e9, -1e9] {
            let mut block = four();
            *block.scalars()[k] = x;
            assert_eq!(block.encode(&mut bytes).unwrap_err().field, bounds::SCALARS[k].key);
        }
    }
    assert_eq!(bytes, [0; MAX_BYTES], "nothing is written");
    assert!(Block::<4>::default().check().is_err());
}

#[test]
fn numbers_that_contradict_each_other_are_refused() {
    let change = |change: fn(&mut Block<4>)| {
        let mut block = four();
        change(&mut block);
        block.check().expect_err("to be refused")
    };
    assert_eq!(change(|b| b.limits.under_voltage = 12.5).field, "under_voltage_V");
    assert_eq!(change(|b| b.limits.over_voltage = 11.5).field, "over_voltage_V");
    // 4095 · 8.86 mV = 36.3 V is the most that the converter can tell
    assert_eq!(change(|b| b.limits.over_voltage = 37.0).field, "over_voltage_V");
    // 1500 · 4.9 mA = 7.35 A likewise
    assert_eq!(change(|b| b.limits.current = 7.4).field, "current_A");
    // 1.6 · 2.6 A opens the bridges, where an amplifier that is straight up to 4 A reads less than flows
    let beyond = change(|b| (b.limits.current, b.linear_range) = (2.6, 4.0));
    assert_eq!((beyond.field, beyond.within), ("current_A", (0.0, 2.5)));
    assert_eq!(change(|b| b.continuous_current = 3.1).field, "continuous_current_A");
    let along_one_line = |b: &mut Block<4>| {
        b.robot.wheels = Wheels::new(b.robot.wheels.wheels().map(|wheel| Wheel { drive_angle: 0.0, ..wheel }));
    };
    assert_eq!(change(along_one_line).reason, BlockErrorKind::Wheels);
}

#[test]
fn an_amplifier_may_be_connected_either_way() {
    let turned = Block { amps_per_count: -0.0049, ..four() };
    let (bytes, length) = encoded(&turned);
    let Ok(Parameters::Four(block)) = Parameters::decode(&bytes[..length]) else { panic!("four wheels") };
    assert_eq!(block.amps_per_count, -0.0049);
    for amps in [0.0, -0.9e-5, -1.01] {
        assert_eq!(Block { amps_per_count: amps, ..four() }.check().unwrap_err().field, "amps_per_count");
    }
    // the same trip, and the same largest limit
    assert_eq!(trip_current(3.0, -0.0049), trip_current(3.0, 0.0049));
    let mut block = turned;
    block.limits.current = 7.4;
    assert_eq!(block.check().unwrap_err().field, "current_A");
}

#[test]
fn effects_are_held_to_the_catalogue() {
    let (bytes, length) = encoded(&four());
    let at = HEADER + 48 + 116;
    let changed = |changes: &[(usize, u8)]| {
        let mut changed = bytes;
        changes.iter().for_each(|(k, value)| changed[at + k] = *value);
        refusal(&resealed(changed, length)).reason
    };
    assert_eq!(changed(&[(1, 0)]), BlockErrorKind::UnknownEffect);
    assert_eq!(changed(&[(1, 0xfe)]), BlockErrorKind::UnknownEffect);
    // stribeck on a wheel that is not there; motor_mismatch on none; coriolis on one
    assert_eq!(changed(&[(2, 4)]), BlockErrorKind::EffectWheel);
    assert_eq!(changed(&[(16, EVERY)]), BlockErrorKind::EffectWheel);
    assert_eq!(changed(&[(26, 1)]), BlockErrorKind::EffectWheel);
    assert_eq!(changed(&[(0, 2)]), BlockErrorKind::Length);
    assert_eq!(changed(&[(0, 4)]), BlockErrorKind::Length);

    for known in &EFFECT_CODES {
        let wheel = (known.scope == crate::effects::card::Scope::OneWheel).then_some(0);
        for (k, field) in known.fields().iter().enumerate() {
            let (low, high) = field.within;
            for (x, good) in [(low, true), (high, true), (low - 1.0, false), (high + 1.0, false), (f32::NAN, false)] {
                let mut params = [0.0; MAX_PARAMS];
                params.iter_mut().zip(known.fields()).for_each(|(p, f)| *p = f.within.0);
                params[k] = x;
                let mut block = Block { effects: BlockEffects::default(), ..four() };
                let effect = BlockEffect::new(known.id, wheel, &params[..known.fields().len()]).unwrap();
                block.effects.push(effect).unwrap();
                assert_eq!(block.check().is_ok(), good, "{} {} = {x}", known.id, field.key);
            }
        }
    }
}

const EVERY: u8 = effects::EVERY_WHEEL;

#[test]
fn there_is_room_for_as_many_effects_as_a_robot_undoes_each_once_and_the_longest_block_fits() {
    let mut effects = BlockEffects::default();
    let on_wheels = EFFECT_CODES.iter().filter(|known| known.scope == crate::effects::card::Scope::Wheels);
    let mut seats = on_wheels.flat_map(|known| [None, Some(0), Some(1), Some(2)].map(|wheel| (known, wheel)));
    let effect = |known: &EffectCode, wheel| BlockEffect::new(known.id, wheel, known.typical()).unwrap();
    for (known, wheel) in seats.by_ref().take(MOST_UNDONE) {
        effects.push(effect(known, wheel)).unwrap();
    }
    let again = *effects.iter().last().expect("a seat that is taken");
    assert_eq!(effects.push(again).unwrap_err().reason, BlockErrorKind::EffectTwice);
    let (known, wheel) = seats.next().expect("more seats than room");
    assert_eq!(effects.push(effect(known, wheel)).unwrap_err().reason, BlockErrorKind::TooManyEffects);
    assert_eq!(effects.len(), MOST_UNDONE);
    let (bytes, length) = encoded(&Block { effects, ..four() });
    assert!(length <= LONGEST && Parameters::decode(&bytes[..length]).is_ok(), "{length}");
    assert_eq!(BlockEffect::new("creep", None, &[]).unwrap_err().reason, BlockErrorKind::Length);
    assert_eq!(BlockEffect::new("gremlins", None, &[]).unwrap_err().reason, BlockErrorKind::UnknownEffect);
}

#[test]
fn reasons_have_codes_and_words_of_their_own() {
    for (k, reason) in BlockErrorKind::ALL.into_iter().enumerate() {
        assert_eq!(usize::from(reason.code()), k + 1);
        assert_eq!(BlockErrorKind::from_code(reason.code()), Some(reason));
        assert!(BlockErrorKind::ALL.into_iter().skip(k + 1).all(|other| other.text() != reason.text()));
    }
}

#[test]
fn what_a_commissioning_found_comes_back_and_a_robot_without_it_has_the_bytes_that_it_had() {
    let plain = encoded(&four());
    let crossed = MotorWiring { outputs: [0, 2, 1], inverted: [false, true, false], ..MotorWiring::default() };
    let wiring = [Some(crossed), None, None, Some(MotorWiring::default())];
    let (bytes, length) = encoded(&Block { wiring, ..four() });
    assert_eq!(length, plain.1 + 1 + 2 * wirings::BYTES);
    let Ok(Parameters::Four(block)) = Parameters::decode(&bytes[..length]) else { panic!("four wheels") };
    assert_eq!(block.wiring, wiring);
    // the places before are those of a block without it
    assert_eq!(bytes[8..plain.1 - 4], plain.0[8..plain.1 - 4]);
}

#[test]
fn a_wiring_that_no_motor_has_is_refused() {
    let twice = MotorWiring { outputs: [0, 0, 1], ..MotorWiring::default() };
    let told = Block { wiring: [None, Some(twice), None, None], ..four() }.check();
    assert_eq!(told.unwrap_err().reason, BlockErrorKind::Wiring);
    // of a motor that is not there
    let wiring = [Some(MotorWiring::default()), None, None, None];
    let (mut bytes, length) = encoded(&Block { wiring, ..four() });
    bytes[length - 4 - wirings::BYTES - 1] = 0b1_0000;
    assert_eq!(refusal(&resealed(bytes, length)).reason, BlockErrorKind::Length);
}

#[test]
fn what_gyro_and_encoders_are_worth_comes_back_behind_what_a_commissioning_found_or_alone() {
    let scales = SensorScales { gyro: -0.001_065, encoder: 7.7e-5 };
    for wiring in [[None; 4], [Some(MotorWiring::default()), None, None, None]] {
        let without = encoded(&Block { wiring, ..four() });
        let (bytes, length) = encoded(&Block { wiring, sensors: scales, ..four() });
        let behind = usize::from(wiring[0].is_none()) + 8;
        assert_eq!(length, without.1 + behind);
        let Ok(Parameters::Four(block)) = Parameters::decode(&bytes[..length]) else { panic!("four wheels") };
        assert_eq!((block.sensors, block.wiring), (scales, wiring));
    }
}

#[test]
fn sensors_that_are_none_or_none_that_there_can_be_are_refused() {
    let field = |sensors| Block { sensors, ..four() }.check().map_err(|why| why.field);
    assert_eq!(field(SensorScales { gyro: 0.5, encoder: 0.0 }), Err("gyro_rad_s_per_count"));
    assert_eq!(field(SensorScales { gyro: f32::NAN, encoder: 0.0 }), Err("gyro_rad_s_per_count"));
    assert_eq!(field(SensorScales { gyro: 0.0, encoder: -2.0 }), Err("encoder_rad_per_count"));
    assert_eq!(field(SensorScales { gyro: 0.0, encoder: -1.0 }), Ok(()));
    let (bytes, length) = encoded(&Block { sensors: SensorScales { gyro: 0.001, encoder: 0.0 }, ..four() });
    let mut none = bytes;
    none[length - 12..length - 4].fill(0);
    assert_eq!(refusal(&resealed(none, length)).field, "gyro_rad_s_per_count");
    // a byte that says nothing of what follows it, and one that says that there is more
    for which in [0, 0x81] {
        let mut other = bytes;
        other[length - 13] = which;
        assert_eq!(refusal(&resealed(other, length)).reason, BlockErrorKind::Length);
    }
}
