//! The list of pins: complete, the board's own, and the soldering iron's.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use firmware::codes::MOTORS;
use firmware::registers::pins::{Job, PINS};
use firmware::registers::timing;

#[test]
fn every_pin_is_used_once_and_every_job_is_done() {
    let places: BTreeSet<_> = PINS.iter().map(|pin| (pin.port, pin.number)).collect();
    let leads: BTreeSet<_> = PINS.iter().map(|pin| pin.lead).collect();
    assert_eq!((places.len(), leads.len()), (PINS.len(), PINS.len()));
    let count = |of: fn(&Job) -> bool| PINS.iter().filter(|pin| of(&pin.job)).count();
    assert_eq!(count(|job| matches!(job, Job::Phase { .. })), 3 * MOTORS);
    assert_eq!(count(|job| matches!(job, Job::Current { .. })), 3 * MOTORS);
    assert_eq!(count(|job| matches!(job, Job::Hall { .. })), 3 * MOTORS);
    assert_eq!(count(|job| matches!(job, Job::Enable { .. })), MOTORS);
    assert_eq!(count(|job| matches!(job, Job::EncoderSelect { .. })), MOTORS);
    let jobs: BTreeSet<_> = PINS.iter().map(|pin| format!("{:?}", pin.job)).collect();
    assert_eq!(jobs.len(), PINS.len(), "no job is done twice");
}

#[test]
fn the_board_takes_every_pin_of_the_list_for_its_job_and_no_other() {
    let source =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/board/f405/parts.rs")).unwrap();
    // all pins in the order in which the source takes them: `gpioa.pa8`
    let mut taken = Vec::new();
    for (at, _) in source.match_indices("gpio") {
        let name = &source.as_bytes()[at + 4..];
        let [port, b'.', b'p', again, digit, ..] = name else { continue };
        if port == again && digit.is_ascii_digit() {
            let digits = name[4..].iter().take_while(|digit| digit.is_ascii_digit());
            taken.push((port.to_ascii_uppercase() as char, digits.fold(0, |sum, digit| sum * 10 + digit - b'0')));
        }
    }
    // the source takes enables, PWM, currents converter by converter, supply, halls, fault line, link, each motor by motor
    let place = |job: Job| match job {
        Job::Enable { motor } => Some((0, 0, motor)),
        Job::Phase { motor, phase } => Some((1, motor, phase)),
        Job::Current { motor, phase } => Some((2, phase, motor)),
        Job::Bus => Some((3, 0, 0)),
        Job::Hall { motor, line } => Some((4, motor, line)),
        Job::Fault => Some((5, 0, 0)),
        Job::LinkOut => Some((6, 0, 0)),
        Job::LinkIn => Some((6, 1, 0)),
        Job::GyroSelect => Some((7, 0, 0)),
        Job::EncoderSelect { motor } => Some((7, 1, motor)),
        Job::SensorClock => Some((7, 2, 0)),
        Job::SensorIn => Some((7, 3, 0)),
        Job::SensorOut => Some((7, 4, 0)),
        // the probe's pins stay as the reset leaves them
        Job::ProbeData | Job::ProbeClock => None,
    };
    let mut listed: Vec<_> = PINS.iter().filter_map(|pin| Some((place(pin.job)?, pin))).collect();
    listed.sort_by_key(|(place, _)| *place);
    assert_eq!(taken, listed.iter().map(|(_, pin)| (pin.port, pin.number)).collect::<Vec<_>>());

    // and each goes through the check of the peripheral that the list names
    for pin in PINS {
        let port = pin.port.to_ascii_lowercase();
        let name = format!("gpio{port}.p{port}{}", pin.number);
        let check = match pin.job {
            Job::Phase { phase, .. } => {
                let (timer, rest) = pin.inside.split_once("_CH").unwrap();
                assert!(rest.starts_with(&(phase + 1).to_string()), "{}", pin.inside);
                format!("pwm::<pac::{timer}, {phase}>({name})")
            }
            Job::Current { .. } | Job::Bus => format!("reaches::<pac::{}, _>({name}.", &pin.inside[..4]),
            Job::LinkOut => format!("sends::<pac::USART3>({name})"),
            Job::LinkIn => format!("receives::<pac::USART3>({name})"),
            Job::SensorClock => format!("beats::<pac::SPI1>({name}."),
            Job::SensorIn => format!("hears::<pac::SPI1>({name}."),
            Job::SensorOut => format!("speaks::<pac::SPI1>({name})"),
            Job::GyroSelect | Job::EncoderSelect { .. } => format!("select({name})"),
            _ => continue,
        };
        assert!(source.contains(&check), "{check}");
    }
}

#[test]
fn the_page_for_the_soldering_iron_has_the_same_pins() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("HARDWARE.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let (begin, end) = ("<!-- pins -->\n", "<!-- end of pins -->");
    let (before, rest) = page.split_once(begin).expect("the table's begin");
    let (table, after) = rest.split_once(end).expect("the table's end");
    let mut sorted = PINS;
    sorted.sort_by_key(|pin| pin.lead);
    let mut should = String::from("| lead | pin | inside | does |\n|---|---|---|---|\n");
    for pin in sorted {
        writeln!(should, "| {} | P{}{} | {} | {} |", pin.lead, pin.port, pin.number, pin.inside, does(pin.job))
            .unwrap();
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, format!("{before}{begin}{should}{end}{after}")).unwrap();
    } else {
        assert_eq!(table, should, "the pins have changed: judge them, then BLESS=1");
    }
    let duty = format!("{:.3}", timing::MAX_DUTY);
    assert!(page.contains(&duty), "HARDWARE.md should state the largest duty, {duty}");
}

fn does(job: Job) -> String {
    let letter = |index: usize| ["a", "b", "c"][index];
    match job {
        Job::Phase { motor, phase } => format!("motor {motor}: PWM of phase {}", letter(phase)),
        Job::Current { motor, phase } => format!("motor {motor}: current of phase {}", letter(phase)),
        Job::Hall { motor, line } => format!("motor {motor}: hall line {}", letter(line)),
        Job::Enable { motor } => format!("motor {motor}: enable of the gate driver"),
        Job::Fault => "fault line of all gate drivers, low is a fault".into(),
        Job::Bus => "supply, divided".into(),
        Job::LinkOut => "link, robot to host".into(),
        Job::LinkIn => "link, host to robot".into(),
        Job::SensorClock => "gyro and encoders: clock".into(),
        Job::SensorIn => "gyro and encoders: from them".into(),
        Job::SensorOut => "gyro and encoders: to them".into(),
        Job::GyroSelect => "gyro: chip select".into(),
        Job::EncoderSelect { motor } => format!("motor {motor}: chip select of the encoder"),
        Job::ProbeData => "probe, data".into(),
        Job::ProbeClock => "probe, clock".into(),
    }
}
