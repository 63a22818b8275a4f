//! A probe closes one bridge, from open bridges alone, and everything else opens it; a wiring that is put right changes
//! nothing but the leads.

mod program;

use firmware::codes::Codes;
use firmware::motor_controller::NO_VOLTAGE;
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::control::wiring::MotorWiring;
use model_core::link::block::{Block, Parameters};
use model_core::link::command::{Command, CommandError};
use model_core::link::faults::Fault;
use model_core::link::probe::Probe;
use model_core::link::record::OperatingState;
use model_core::plant::paper::four_wheels;
use program::{Program, block, bytes, still};

const PROBE: Probe = Probe { sequence: 1, motor: 2, periods: 20, share: 0x1000, angle: 0, rate: 0 };

fn probe(program: &mut Program, sequence: u16, probe: Probe) {
    program.command(&Command::Probe(Probe { sequence, ..probe }));
}

fn ready() -> Program {
    let mut program = Program::new();
    program.send_block(&bytes(&Parameters::Four(block(four_wheels()))));
    program.ticks(100, &still());
    program
}

/// One whose motor 2 is probed.
fn probing() -> Program {
    let mut program = ready();
    probe(&mut program, 1, PROBE);
    let command = program.ticks(2, &still());
    assert_eq!((command.enabled, program.output.state), (0b0100, OperatingState::Probing));
    let [a, b, c] = command.duties[2];
    assert!(a > b && b == c && command.duties[1] == NO_VOLTAGE, "{command:?}");
    program
}

#[test]
fn one_motor_has_a_voltage_whatever_its_halls_say() {
    let mut program = probing();
    let mut codes = still();
    for code in [1, 5, 4, 6, 2, 3, 1] {
        codes.halls[2] = HallCode(code);
        let command = program.ticks(1, &codes);
        assert!(command.enabled == 0b0100 && command.duties[2][0] > 0.5, "{command:?}");
    }
    let report = program.windings.feedback().probe.unwrap();
    assert_eq!((report.motor, report.share, report.halls[2], report.phases), (2, 0x1000, HallCode(1), codes.phases[2]));
}

#[test]
fn only_open_bridges_are_probed_and_only_a_motor_that_is_there() {
    let mut asleep = Program::new();
    probe(&mut asleep, 1, PROBE);
    asleep.ticks(2, &still());
    let mut driving = Program::driving(&Parameters::Four(block(four_wheels())));
    probe(&mut driving, 1, PROBE);
    assert_eq!(driving.ticks(2, &still()).enabled, 0b1111);
    for program in [&asleep, &driving] {
        assert_eq!(program.refused, [CommandError::NotOpen.code()]);
    }
    let mut three = Program::new();
    three.send_block(&bytes(&Parameters::Three(block(model_core::plant::paper::three_wheels()))));
    three.ticks(100, &still());
    probe(&mut three, 1, Probe { motor: 3, ..PROBE });
    assert_eq!(three.ticks(2, &still()).enabled, 0);
    assert_eq!(three.refused.last(), Some(&CommandError::NoSuchProbe.code()));
}

#[test]
fn a_phase_with_more_than_an_ampere_and_a_quarter_opens_the_bridge_in_the_period_that_sees_it() {
    for phase in 0..3 {
        for code in [2048 + 256, 2048 - 256] {
            let mut program = probing();
            let mut codes = still();
            codes.phases[2][phase] = AdcCode(if code > 2048 { code - 1 } else { code + 1 });
            assert_eq!(program.period(&codes).enabled, 0b0100, "1.2495 A");
            codes.phases[2][phase] = AdcCode(code);
            assert_eq!(program.period(&codes).enabled, 0, "1.2544 A");
            program.ticks(2, &still());
            assert!(program.windings.protection().faults().has(Fault::OverCurrent));
            assert_eq!(program.output.state, OperatingState::Faulted);
        }
    }
    // the current of another motor is not this one's, and the usual limit stands for it
    let mut program = probing();
    let mut codes = still();
    codes.phases[0][0] = AdcCode(2048 + 400);
    assert_eq!(program.period(&codes).enabled, 0b0100);
}

#[test]
fn silence_an_open_a_command_to_move_and_other_parameters_end_it() {
    let mut silent = probing();
    assert_eq!(silent.ticks(198, &still()).enabled, 0b0100);
    assert_eq!((silent.ticks(3, &still()).enabled, silent.output.state), (0, OperatingState::Open));
    // the same probe once more, from a relay that has lost its host, begins nothing
    probe(&mut silent, 1, PROBE);
    assert_eq!(silent.ticks(3, &still()).enabled, 0);

    let mut opened = probing();
    opened.command(&Command::Open);
    assert_eq!((opened.ticks(2, &still()).enabled, opened.output.state), (0, OperatingState::Open));
    let mut driven = probing();
    driven.drive();
    assert_eq!((driven.ticks(2, &still()).enabled, driven.output.state), (0, OperatingState::Open));
    let mut changed = probing();
    changed.send_block(&bytes(&Parameters::Four(block(four_wheels()))));
    assert_eq!((changed.ticks(2, &still()).enabled, changed.output.state), (0, OperatingState::Open));
    let mut faulty = probing();
    assert_eq!(faulty.period(&Codes { driver_fault: true, ..still() }).enabled, 0);
}

/// What a board reads that is wired like that where it should read `codes`.
fn miswired(wiring: &MotorWiring, codes: &Codes) -> Codes {
    let mut read = *codes;
    for j in 0..4 {
        for (x, converter) in wiring.converters.iter().enumerate() {
            let code = codes.phases[j][x].0;
            read.phases[j][usize::from(*converter)] = AdcCode(if wiring.inverted[x] { 4095 - code } else { code });
        }
        let sector = codes.halls[j].sector().unwrap_or_default();
        read.halls[j] = wiring.codes[usize::from(sector)];
    }
    read
}

#[test]
fn a_robot_with_crossed_leads_that_was_commissioned_decides_what_one_without_does() {
    let straight = MotorWiring::default();
    let crossed = MotorWiring {
        outputs: [0, 2, 1],
        converters: [1, 2, 0],
        inverted: [true, false, true],
        codes: [6, 4, 5, 1, 3, 2].map(HallCode),
        ..straight
    };
    let mut programs = [straight, crossed].map(|wiring| {
        let block = Block { wiring: [Some(wiring); 4], ..block(four_wheels()) };
        Program::driving_where(&Parameters::Four(block), &miswired(&wiring, &still()))
    });
    for period in 0..4_000_u32 {
        let mut codes = still();
        codes.halls = [HallCode::of_sector((period / 9 % 6) as u8); 4];
        codes.phases = [[2040 + (period % 17) as u16, 2050, 2047].map(AdcCode); 4];
        let [wanted, decided] =
            [(0, straight), (1, crossed)].map(|(k, wiring)| programs[k].period(&miswired(&wiring, &codes)));
        assert_eq!(wanted.enabled, decided.enabled);
        for j in 0..4 {
            assert_eq!(crossed.leads().duties(wanted.duties[j]), decided.duties[j], "period {period}");
        }
        if period % 100 == 0 {
            programs.iter_mut().for_each(Program::drive);
        }
    }
    assert_eq!(programs[0].output.state, OperatingState::Driving);
}
