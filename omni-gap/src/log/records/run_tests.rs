use super::super::capture::Progress;
use super::*;
use model_core::control::phases::q_current;
use model_core::link::framing::{FrameKind, MAX_FRAME, encode_frame};
use model_core::link::sensor_codes::{SensorCodes, SensorScales};

/// What the robot says of itself; its zeros are not in the middle.
fn hello(wheels: u8) -> Hello {
    Hello {
        firmware: 1,
        block_version: 1,
        block_check: 7,
        wheels,
        commutation: Commutation::FieldOriented,
        calibration: Calibration::of_board(8),
        gear_ratio: 5.0,
        offsets: [[2050 * 16 + 5, 2040 * 16 + 11, 2048 * 16]; 4],
        sensors: SensorScales::default(),
    }
}

/// The current that record k shows on every wheel [A].
fn shown(k: u32) -> f64 {
    2.5 * (f64::from(k) * 0.1).sin()
}

/// A robot that drives with a voltage of k/100 V after turn k.
pub(in super::super) fn record(k: u32) -> TelemetryRecord {
    let mut record = TelemetryRecord {
        sequence: k,
        time: 20 * k,
        state: OperatingState::Driving,
        enabled: 0b1111,
        bus: AdcCode(1354),
        interval: [100; 4],
        voltage: [k as f32 / 128.0; 4],
        ..TelemetryRecord::default()
    };
    for wheel in 0..4 {
        record.angle[wheel] = (k * 997 + 20_000 * wheel as u32) as u16;
        let angle = f64::from(record.angle[wheel]) / 65_536.0 * TAU;
        let q = q_current(shown(k));
        let phases = Rotation::of_angle(angle)
            .inverse_park(model_core::control::phases::DirectQuadrature { d: 0.0, q })
            .inverse_clarke();
        let calibration = calibration(&hello(4));
        for (phase, x) in phases.into_iter().enumerate() {
            let zero = f64::from(hello(4).offsets[wheel][phase]) / 16.0;
            record.phases[wheel][phase] = calibration.current_code(x, zero);
        }
    }
    record
}

/// The frames of a hello and of these records.
pub(in super::super) fn sent(wheels: u8, records: &[TelemetryRecord]) -> Vec<u8> {
    let mut out = [0; MAX_FRAME];
    let mut bytes = encode_frame(FrameKind::Hello.code(), &hello(wheels).to_bytes(), &mut out).unwrap().to_vec();
    for record in records {
        bytes.extend(encode_frame(FrameKind::Record.code(), &record.to_bytes(), &mut out).unwrap());
    }
    bytes
}

fn captured(bytes: &[u8]) -> Capture {
    let mut capture = Capture::new(None);
    capture.take(bytes);
    capture
}

/// The frames of a robot with sensors, and of these records.
fn sent_with(sensors: SensorScales, records: &[TelemetryRecord]) -> Vec<u8> {
    let mut out = [0; MAX_FRAME];
    let hello = Hello { sensors, ..hello(4) }.to_bytes();
    let mut bytes = encode_frame(FrameKind::Hello.code(), &hello, &mut out).unwrap().to_vec();
    for record in records {
        bytes.extend(encode_frame(FrameKind::Record.code(), &record.to_bytes(), &mut out).unwrap());
    }
    bytes
}

#[test]
fn a_gyro_is_a_channel_of_its_own_and_encoders_tell_the_speeds() {
    let sensors = |k: u32| SensorCodes::of((k != 5).then_some(-100 + k as i16), [Some((40 * k) as u16); 4]);
    let with: Vec<TelemetryRecord> =
        (0..10).map(|k| TelemetryRecord { sensors: Some(sensors(k)), ..record(k) }).collect();
    let read = |scales| run(&captured(&sent_with(scales, &with)), Path::new("frames.bin"), "run", Some(4)).unwrap();
    let both = read(SensorScales { gyro: -0.001, encoder: 1e-4 });
    let gyro = both.gyro.as_ref().unwrap();
    assert_eq!((gyro.len(), gyro.get(5)), (9, Err(Missing::Blank)));
    // counts of −1 mrad/s each, as single precision has it
    assert!((gyro.get(3).unwrap() - 0.097).abs() < 1e-8);
    // 40 counts of 0.1 mrad in a millisecond
    assert!((0..9).all(|row| (at(&both.w, 2, row).unwrap() - 4.0).abs() < 1e-6));
    // without a scale neither is told: speeds are those of the halls
    let neither = read(SensorScales::default());
    assert_eq!((neither.gyro, at(&neither.w, 2, 3)), (None, Err(Missing::Stale)));
    // and a record from before there were any is read beside those of a robot that has them
    let old: Vec<TelemetryRecord> = (0..10).map(record).collect();
    let old =
        run(&captured(&sent_with(SensorScales { gyro: 0.001, encoder: 0.0 }, &old)), Path::new("f"), "run", Some(4));
    assert_eq!(old.unwrap().gyro.unwrap().get(3), Err(Missing::Blank));
}

fn run_of(records: &[TelemetryRecord]) -> Run {
    run(&captured(&sent(4, records)), Path::new("frames.bin"), "run", Some(4)).unwrap()
}

fn at(group: &Option<Group>, wheel: usize, row: usize) -> std::result::Result<f64, Missing> {
    group.as_ref().unwrap().channels[wheel].get(row)
}

#[test]
fn a_row_has_its_own_codes_and_the_voltage_of_the_record_that_follows() {
    let records: Vec<TelemetryRecord> = (5..105).map(record).collect();
    let run = run_of(&records);
    assert_eq!(run.rows(), 99, "the last record only ends the row before it");
    for row in 0..99 {
        let k = row as u32 + 5;
        assert!((run.t_s[row] - 1e-3 * row as f64).abs() < 1e-12);
        for wheel in 0..4 {
            assert_eq!(at(&run.u, wheel, row), Ok(f64::from(k + 1) / 128.0));
            let i = at(&run.i, wheel, row).unwrap();
            // half a count on each of three phases, 4.9 mA a count, and the zeros' sixteenths
            assert!((i - shown(k)).abs() < 0.0049, "{i} A against {} A", shown(k));
        }
    }
    // 1354 · 8.86 mV
    assert!((run.vbat.unwrap().get(3).unwrap() - 11.99644).abs() < 1e-6);
    assert_eq!((run.currents_sampled, run.enable.unwrap().get(0)), (Sampled::Before, Ok(1.0)));
}

#[test]
fn records_that_did_not_arrive_leave_empty_rows_and_are_counted() {
    let mut records: Vec<TelemetryRecord> =
        (0..50).map(record).filter(|r| ![10, 11, 30].contains(&r.sequence)).collect();
    records.iter_mut().find(|r| r.sequence == 31).unwrap().dropped = 1;
    let capture = captured(&sent(4, &records));
    assert_eq!(capture.lost(), (2, 1));
    let run = run_of(&records);
    assert_eq!(run.rows(), 49);
    for row in [10, 11, 30] {
        assert!((run.t_s[row] - 1e-3 * row as f64).abs() < 1e-12);
        assert_eq!((at(&run.u, 0, row), at(&run.i, 3, row)), (Err(Missing::Lost), Err(Missing::Lost)));
    }
    // nobody told what was applied between the last record before the gap and the first after it
    assert_eq!((at(&run.u, 0, 9), at(&run.u, 0, 29)), (Err(Missing::Lost), Err(Missing::Lost)));
    assert!(at(&run.i, 0, 9).is_ok() && at(&run.u, 0, 12).is_ok());
}

#[test]
fn a_broken_frame_is_counted_and_costs_its_row() {
    let records: Vec<TelemetryRecord> = (0..20).map(record).collect();
    let mut bytes = sent(4, &records);
    let hello_len = sent(4, &[]).len();
    bytes[hello_len + 5 * (TelemetryRecord::BYTES + 5) + 30] ^= 0x10;
    let capture = captured(&bytes);
    assert_eq!((capture.bad_frames(), capture.lost(), capture.records.len()), (1, (1, 0), 19));
    let run = run(&capture, Path::new("frames.bin"), "run", Some(4)).unwrap();
    assert_eq!((at(&run.i, 2, 5), at(&run.i, 2, 6).is_ok()), (Err(Missing::BadCrc), true));
    // nobody knows which of two missing records was the broken frame
    let without = hello_len + 6 * (TelemetryRecord::BYTES + 5);
    let gone: Vec<u8> =
        bytes[..without].iter().chain(&bytes[without + TelemetryRecord::BYTES + 5..]).copied().collect();
    let run = super::run(&captured(&gone), Path::new("frames.bin"), "run", Some(4)).unwrap();
    assert_eq!((at(&run.i, 2, 5), at(&run.i, 2, 6)), (Err(Missing::Lost), Err(Missing::Lost)));
}

#[test]
fn open_bridges_have_no_voltage() {
    let mut records: Vec<TelemetryRecord> = (0..30).map(record).collect();
    records[10..20].iter_mut().for_each(|r| (r.state, r.enabled) = (OperatingState::Faulted, 0));
    records[25..].iter_mut().for_each(|r| r.enabled = 0b1011);
    let run = run_of(&records);
    let enable = run.enable.as_ref().unwrap();
    assert_eq!((enable.get(9), enable.get(10), enable.get(19), enable.get(20)), (Ok(1.0), Ok(0.0), Ok(0.0), Ok(1.0)));
    // opened within row 9, open up to row 19
    assert!((9..20).all(|row| at(&run.u, 0, row) == Err(Missing::Open)) && at(&run.u, 0, 20).is_ok());
    let open = run.open_bridges::<4>();
    assert!(run.opens_single_bridges());
    records.truncate(25);
    assert!(!run_of(&records).opens_single_bridges(), "all of them opened within row 9");
    assert_eq!((open[5], open[10], open[26]), ([false; 4], [true; 4], [false, false, true, false]));
    assert_eq!((at(&run.u, 2, 26), at(&run.u, 1, 26)), (Err(Missing::Open), Ok(27.0 / 128.0)));
}

#[test]
fn a_sensor_at_its_limit_tells_nothing() {
    let mut records: Vec<TelemetryRecord> = (0..10).map(record).collect();
    records[4].phases[1][2] = AdcCode(FULL_SCALE);
    let run = run_of(&records);
    assert_eq!((at(&run.i, 1, 4), at(&run.i, 0, 4).is_ok()), (Err(Missing::Saturated), true));
}

#[test]
fn at_rest_the_current_is_that_of_the_conducting_phases() {
    let mut records: Vec<TelemetryRecord> = (0..10).map(record).collect();
    // sector 0: b up, c down; zeros 2040 11/16 and 2048
    records[3].interval[0] = 0;
    records[3].angle[0] = 0;
    records[3].phases[0] = [AdcCode(2050), AdcCode(2041 + 100), AdcCode(2048 - 100)];
    let i = at(&run_of(&records).i, 0, 3).unwrap();
    assert!((i - 0.0049 * (200.0 + 5.0 / 16.0) / 2.0).abs() < 1e-7, "{i}");
}

#[test]
fn what_comes_after_a_restart_is_left_out() {
    let records: Vec<TelemetryRecord> = (100..150).chain(0..80).map(record).collect();
    let capture = captured(&sent(4, &records));
    assert!(capture.restarted);
    assert_eq!(capture.records.len(), 50);
}

#[test]
fn a_recording_ends_when_there_is_enough() {
    let records: Vec<TelemetryRecord> = (0..500).map(record).collect();
    let mut capture = Capture::new(Some(20 * 100));
    assert_eq!(capture.take(&sent(4, &records)), Progress::Enough);
    assert_eq!(capture.records.len(), 101);
}

#[test]
fn what_is_no_recording_is_told() {
    let records: Vec<TelemetryRecord> = (0..50).map(record).collect();
    let told = |bytes: &[u8]| run(&captured(bytes), Path::new("frames.bin"), "run", Some(4)).unwrap_err().to_string();
    assert!(told(&[]).contains("frames.bin: nothing came"));
    assert!(told(&[1, 2, 3, 0, 9, 9, 0, 9, 0]).contains("no whole frame"));
    assert!(told(&sent(4, &records)[sent(4, &[]).len()..]).contains("no frame says how to read the records"));
    assert!(told(&sent(3, &records)).contains("the robot has 3 wheels, the robot file 4"));
    assert!(told(&sent(4, &records[..2])).contains("2 records came, expected three at least"));
}

#[test]
fn a_file_of_records_is_read_with_the_reason_of_every_hole() {
    let mut records: Vec<TelemetryRecord> = (0..60).map(record).filter(|r| r.sequence != 40).collect();
    records[10].enabled = 0b1101;
    records[20].phases[3][0] = AdcCode(0);
    let mut bytes = sent(4, &records);
    let frame = sent(4, &[]).len() + 30 * (TelemetryRecord::BYTES + 5);
    bytes[frame + 30] ^= 0x10;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("drive.REC");
    std::fs::write(&path, bytes).unwrap();
    let (run, notices) = Run::load(&path, 4, None).unwrap();
    let why = |wheel: usize, row: usize| at(&run.u, wheel, row).or_else(|_| at(&run.i, wheel, row)).err();
    assert_eq!(
        (why(0, 30), why(0, 40), at(&run.u, 1, 10)),
        (Some(Missing::BadCrc), Some(Missing::Lost), Err(Missing::Open))
    );
    assert_eq!(at(&run.i, 3, 20), Err(Missing::Saturated));
    assert_eq!((run.name.as_str(), run.currents_sampled, run.first_line), ("drive", Sampled::Before, None));
    assert!(notices.iter().any(|notice| notice.contains("2 records were lost on the way")), "{notices:?}");
    let told = Run::load(&path, 3, None).unwrap_err().to_string();
    assert!(told.contains("a column for a wheel that the robot file does not have; it has 3 wheels"), "{told}");
}
