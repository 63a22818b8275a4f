//! Gyro and encoders, against the transfers of their data sheets.
//!
//! BMI088: Bosch BST-BMI088-DS001, revision 1.4, section 6 (a read has bit 7 of the address set, a write has not; data follow
//! at once) and sections 5.5.1 to 5.5.5 (registers). AS5047P: ams datasheet v1-01 of 28 April 2016, SPI command frame, read
//! data frame, volatile registers. Bytes stand here as they are on the wire, none is computed by the drivers' own functions.

use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use embedded_hal_mock::eh1::spi::{Mock, Transaction};
use firmware::drivers::as5047p::As5047p;
use firmware::drivers::bmi088::{Bmi088Gyro, RAD_S_PER_COUNT};
use firmware::drivers::sensor_error::SensorError;
use firmware::drivers::sensors::{FittedSensors, Sensors};
use firmware::silent_sensors::SensorSilence;
use model_core::link::record::MOTORS;
use model_core::link::sensor_codes::SensorCodes;

type Do = Transaction<u8>;

/// A transfer of its own: out, and what comes in.
fn both(out: &[u8], back: &[u8]) -> [Do; 3] {
    let transfer = Do::transfer_in_place(out.to_vec(), back.to_vec());
    [Do::transaction_start(), transfer, Do::transaction_end()]
}

fn only(out: &[u8]) -> [Do; 3] {
    [Do::transaction_start(), Do::write_vec(out.to_vec()), Do::transaction_end()]
}

/// A bus that does not carry a transfer to its end.
struct Broken;

impl ErrorType for Broken {
    type Error = ErrorKind;
}

impl SpiDevice for Broken {
    fn transaction(&mut self, _: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        Err(ErrorKind::Other)
    }
}

fn field(field: &'static str, is: u16) -> SensorError {
    SensorError::Field { field, is }
}

// --- the gyro

/// Section 5.5.1: GYRO_CHIP_ID 0x00 reads 0x0F; 5.5.4: GYRO_RANGE 0x0F, 0x00 is ±2000 °/s; 5.5.5: GYRO_BANDWIDTH 0x10, 0x02 is
/// 1000 Hz and 116 Hz, bit 7 reads as one.
fn begun() -> Vec<Do> {
    [
        both(&[0x80, 0x00], &[0xFF, 0x0F]),
        only(&[0x0F, 0x00]),
        only(&[0x10, 0x02]),
        both(&[0x8F, 0x00], &[0xFF, 0x00]),
        both(&[0x90, 0x00], &[0xFF, 0x82]),
    ]
    .concat()
}

/// Registers 0x00 to 0x07 in one burst.
fn burst(identity: u8, z: [u8; 2]) -> [Do; 3] {
    both(&[0x80, 0, 0, 0, 0, 0, 0, 0, 0], &[0xFF, identity, 0x55, 0x11, 0x22, 0x33, 0x44, z[0], z[1]])
}

fn gyro<T>(expected: &[Do], run: impl FnOnce(&mut Bmi088Gyro<Mock<u8>>) -> T) -> T {
    let mut spi = Mock::new(expected);
    let result = run(&mut Bmi088Gyro::new(spi.clone()));
    spi.done();
    result
}

#[test]
fn a_gyro_is_set_to_2000_degrees_a_second_and_116_hz() {
    assert_eq!(gyro(&begun(), Bmi088Gyro::begin), Ok(()));
}

#[test]
fn another_chip_a_stuck_bus_and_settings_that_do_not_take_are_named() {
    // 0x1E is the accelerometer of the same package: its chip select instead of the gyro's
    for id in [0x1E, 0x00, 0xFF] {
        let told = gyro(&both(&[0x80, 0x00], &[0xFF, id]), Bmi088Gyro::begin);
        assert_eq!(told, Err(field("GYRO_CHIP_ID", id.into())));
    }
    let mut range = begun();
    range.truncate(9);
    range.extend(both(&[0x8F, 0x00], &[0xFF, 0x01]));
    assert_eq!(gyro(&range, Bmi088Gyro::begin), Err(field("GYRO_RANGE", 1)));
    let mut bandwidth = begun();
    bandwidth.truncate(12);
    bandwidth.extend(both(&[0x90, 0x00], &[0xFF, 0x80]));
    assert_eq!(gyro(&bandwidth, Bmi088Gyro::begin), Err(field("GYRO_BANDWIDTH", 0)));
}

#[test]
fn a_rate_is_the_last_two_bytes_of_the_burst_low_byte_first() {
    // section 5.5.2: RATE_Z_MSB * 256 + RATE_Z_LSB, two's complement; +32767 is +2000 °/s
    for (bytes, rate) in [([0xFF, 0x7F], 32_767), ([0x00, 0x00], 0), ([0xFF, 0xFF], -1), ([0x00, 0x40], 0x4000)] {
        assert_eq!(gyro(&burst(0x0F, bytes), Bmi088Gyro::rate_z), Ok(rate));
    }
    // 16.384 counts to 1 °/s
    assert!((16.384 * RAD_S_PER_COUNT - 1.0_f32.to_radians()).abs() < 1e-8);
}

#[test]
fn a_rate_that_does_not_come_with_the_gyros_identifier_is_none() {
    let stuck = |level: u8| both(&[0x80, 0, 0, 0, 0, 0, 0, 0, 0], &[level; 9]);
    assert_eq!(gyro(&stuck(0x00), Bmi088Gyro::rate_z), Err(field("GYRO_CHIP_ID", 0x00)));
    assert_eq!(gyro(&stuck(0xFF), Bmi088Gyro::rate_z), Err(field("GYRO_CHIP_ID", 0xFF)));
    assert_eq!(Bmi088Gyro::new(Broken).begin(), Err(SensorError::Bus));
    assert_eq!(Bmi088Gyro::new(Broken).rate_z(), Err(SensorError::Bus));
}

// --- the encoder

/// Reads of ANGLECOM (0x3FFF), DIAAGC (0x3FFC) and ERRFL (0x0001): bit 14 reads, bit 15 makes the ones even.
const ANGLECOM: [u8; 2] = [0xFF, 0xFF];
const DIAAGC: [u8; 2] = [0xFF, 0xFC];
const ERRFL: [u8; 2] = [0x40, 0x01];

/// DIAAGC of an encoder that works: LF and a gain of 0x80; two ones.
const WORKS: [u8; 2] = [0x01, 0x80];

fn encoder<T>(expected: &[Do], run: impl FnOnce(&mut As5047p<Mock<u8>>) -> T) -> T {
    let mut spi = Mock::new(expected);
    let result = run(&mut As5047p::new(spi.clone()));
    spi.done();
    result
}

fn reading(state: [u8; 2], angle: [u8; 2]) -> Vec<Do> {
    [both(&ANGLECOM, &state), both(&DIAAGC, &angle)].concat()
}

#[test]
fn an_encoder_is_asked_for_its_errors_and_then_for_its_state() {
    let expected = [both(&ERRFL, &[0x12, 0x34]), both(&DIAAGC, &[0x00, 0x04])].concat();
    assert_eq!(encoder(&expected, As5047p::begin), Ok(()));
}

#[test]
fn an_angle_is_the_answer_to_the_frame_before() {
    for (bytes, angle) in [([0x00, 0x00], 0), ([0xBF, 0xFE], 16_382), ([0x3F, 0xFF], 16_383), ([0x90, 0x00], 4096)] {
        assert_eq!(encoder(&reading(WORKS, bytes), As5047p::angle), Ok(angle));
    }
}

#[test]
fn parity_error_flag_and_a_stuck_bus_are_named() {
    let parity = |state, angle| encoder(&reading(state, angle), As5047p::angle);
    assert_eq!(parity(WORKS, [0x00, 0x01]), Err(field("PARD", 0x0001)), "odd");
    assert_eq!(parity(WORKS, [0xC0, 0x00]), Err(field("EF", 0xC000)), "even, with the flag");
    let state = |state: [u8; 2]| encoder(&both(&ANGLECOM, &state), As5047p::angle);
    assert_eq!(state([0x81, 0x80]), Err(field("PARD", 0x8180)));
    assert_eq!(state([0xFF, 0xFF]), Err(field("EF", 0xFFFF)), "all ones");
    assert_eq!(state([0x00, 0x00]), Err(field("DIAAGC", 0)), "all zeros");
    assert_eq!(As5047p::new(Broken).begin(), Err(SensorError::Bus));
    assert_eq!(As5047p::new(Broken).angle(), Err(SensorError::Bus));
}

#[test]
fn an_encoder_without_its_magnet_or_its_zeros_tells_no_angle() {
    let state = |state: [u8; 2]| encoder(&both(&ANGLECOM, &state), As5047p::angle);
    // LF with MAGL and a gain at its end; with MAGH; with COF; no LF
    assert_eq!(state([0x09, 0xFF]), Err(field("DIAAGC", 0x09FF)));
    assert_eq!(state([0x05, 0x00]), Err(field("DIAAGC", 0x0500)));
    assert_eq!(state([0x03, 0x00]), Err(field("DIAAGC", 0x0300)));
    assert_eq!(state([0x80, 0x01]), Err(field("DIAAGC", 0x0001)));
}

// --- all of them

const ALL: FittedSensors = FittedSensors { gyro: true, encoders: 4 };

/// The sensors on five mocks, and these.
fn sensors(gyro: &[Do], encoders: [Vec<Do>; MOTORS]) -> (Sensors<Mock<u8>>, Vec<Mock<u8>>) {
    let mocks: Vec<_> = [gyro.to_vec()].iter().chain(&encoders).map(Mock::new).collect();
    let at = |j: usize| mocks[j].clone();
    (Sensors::new(at(0), [at(1), at(2), at(3), at(4)]), mocks)
}

fn encoder_begins() -> Vec<Do> {
    [both(&ERRFL, &[0, 0]), both(&DIAAGC, &[0, 0])].concat()
}

#[test]
fn nothing_is_asked_of_sensors_that_are_not_fitted() {
    let (mut all, mocks) = sensors(&[], [(); MOTORS].map(|()| Vec::new()));
    assert_eq!(all.read(FittedSensors::default()), SensorCodes::default());
    mocks.into_iter().for_each(|mut mock| mock.done());
}

#[test]
fn every_sensor_is_begun_with_once_and_read_each_turn() {
    let gyro = [begun(), burst(0x0F, [1, 0]).to_vec(), burst(0x0F, [2, 0]).to_vec()].concat();
    let one = || [encoder_begins(), reading(WORKS, [0x00, 0x03]), reading(WORKS, [0x00, 0x05])].concat();
    let (mut all, mocks) = sensors(&gyro, [one(), one(), one(), one()]);
    assert_eq!(all.read(ALL), SensorCodes::of(Some(1), [Some(3); MOTORS]));
    assert_eq!(all.read(ALL), SensorCodes::of(Some(2), [Some(5); MOTORS]));
    mocks.into_iter().for_each(|mut mock| mock.done());
}

#[test]
fn a_sensor_that_fails_is_begun_with_anew_and_costs_the_others_nothing() {
    let silent = both(&[0x80, 0x00], &[0xFF, 0xFF]).to_vec();
    // it is not there in the first turn, and is asked again a hundred turns later
    let gyro = [silent, begun(), burst(0x0F, [7, 0]).to_vec(), burst(0x0F, [8, 0]).to_vec()].concat();
    // its plug is pulled in the second turn
    let pulled = both(&ANGLECOM, &[0, 0]).to_vec();
    let first = [encoder_begins(), reading(WORKS, [0, 3]), pulled, encoder_begins(), reading(WORKS, [0, 6])].concat();
    let others = || [encoder_begins(), (0..102).flat_map(|_| reading(WORKS, [0, 9])).collect()].concat();
    let (mut all, mocks) = sensors(&gyro, [first, others(), others(), others()]);
    let told: Vec<_> = (0..102).map(|_| all.read(ALL)).collect();
    assert_eq!(told[0], SensorCodes::of(None, [Some(3), Some(9), Some(9), Some(9)]));
    let without = SensorCodes::of(None, [None, Some(9), Some(9), Some(9)]);
    assert!(told[1..100].iter().all(|codes| *codes == without));
    assert_eq!(told[100], SensorCodes::of(Some(7), [None, Some(9), Some(9), Some(9)]));
    assert_eq!(told[101], SensorCodes::of(Some(8), [Some(6), Some(9), Some(9), Some(9)]));
    mocks.into_iter().for_each(|mut mock| mock.done());
}

/// A bus whose answer is always this byte.
struct Stuck(u8);

impl ErrorType for Stuck {
    type Error = ErrorKind;
}

impl SpiDevice for Stuck {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        for operation in operations {
            if let Operation::TransferInPlace(bytes) = operation {
                bytes.fill(self.0);
            }
        }
        Ok(())
    }
}

/// Which sensors are silent after so many turns at a bus.
fn silent_after<S: SpiDevice>(turns: u8, bus: impl Fn() -> S) -> u8 {
    let mut all = Sensors::new(bus(), [(); MOTORS].map(|()| bus()));
    let mut silence = SensorSilence::default();
    (0..turns).map(|_| silence.turn(ALL, &all.read(ALL)).bits()).last().unwrap_or_default()
}

#[test]
fn a_bus_that_is_stuck_or_broken_is_a_silence_of_all_after_two_tenths_of_a_second() {
    for level in [0x00, 0xFF] {
        assert_eq!([199, 200].map(|turns| silent_after(turns, || Stuck(level))), [0, 0b1_1111]);
    }
    assert_eq!([199, 200].map(|turns| silent_after(turns, || Broken)), [0, 0b1_1111]);
}
