//! # Regeneration: a hard stop on a supply that takes nothing back
//!
//! The robot stops from its largest speed as hard as it may. Its supply has a diode and a capacitor of 100 µF for each
//! ampere of motor current, as `firmware/HARDWARE.md` asks for.

use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::Block;
use model_core::link::events::Event;
use model_core::link::faults::Fault;
use model_core::link::record::TelemetryRecord;
use model_core::number::scalar::Real;
use model_core::plant::paper::four_wheels;
use model_core::plant::robot::Robot;

use super::robots::ToParameters;
use super::{ClosedLoopRun, HostProgram, robots};
use crate::virtual_board::{BoardSetup, VirtualBoard};

/// C of four motors of 4 A [F]
const CAPACITOR: f64 = 1.6e-3;

/// What a stop did to the bus.
struct Stop {
    /// Highest bus voltage [V]
    highest: f64,
    /// Energy that the body and the capacitor lost [J]; below zero: got
    lost: [f64; 2],
    /// ∫ U·I dt into the robot from the bus [J]
    drawn: f64,
    /// Speed a second after the command [m/s]
    speed: f64,
    records: Vec<TelemetryRecord>,
}

/// The paper's robot, whose motors have a quarter of the resistance: they can give back what they brake.
fn strong<T: Real>() -> Robot<4, T> {
    let mut robot = four_wheels::<T>();
    robot.motor.resistance *= T::lit(0.25);
    robot
}

fn stop(change: impl Fn(&mut Block<4>)) -> Stop {
    let mut block = robots::block(strong());
    change(&mut block);
    let fastest = BodyTwist { v: f64::from(block.limits.speed), vn: 0.0, w: 0.0 };
    let setup = BoardSetup { bus_capacitor: Some(CAPACITOR), ..BoardSetup::new(strong(), Effects::default(), 4) };
    let mut run = ClosedLoopRun::new(HostProgram::default(), VirtualBoard::new(setup));
    run.send_block(&block.parameters());
    run.wait(0.15).expect("software does not fail");
    run.follow(1.5, |_| fastest).expect("software does not fail");
    let holds = |run: &ClosedLoopRun<HostProgram, 4>| {
        let (v, u) = (run.lockstep.board.state().twist.v, run.lockstep.board.bus());
        [0.5 * strong::<f64>().mass * v * v, 0.5 * CAPACITOR * u * u]
    };
    let (begins, from) = (holds(&run), run.log.records.len());
    let (mut highest, mut drawn) = (0.0_f64, 0.0);
    for k in 0..20_000 {
        if k % 200 == 0 {
            run.drive(BodyTwist::default());
        }
        run.period().expect("software does not fail");
        let board = &run.lockstep.board;
        highest = highest.max(board.bus());
        drawn += board.bus() * board.bus_current() * 50e-6;
    }
    let ends = holds(&run);
    Stop {
        highest,
        lost: [begins[0] - ends[0], begins[1] - ends[1]],
        drawn,
        speed: run.lockstep.board.state().twist.v,
        records: run.log.records.split_off(from),
    }
}

#[test]
fn the_bus_stays_a_volt_below_its_limit_and_the_bridges_stay_closed() {
    let stop = stop(|_| {});
    println!(
        "hard stop from 2 m/s: the bus came to {:.2} V, limit 16 V; 1 s later {:.2} m/s",
        stop.highest, stop.speed
    );
    assert!(stop.highest > 14.0 && stop.highest < 15.0, "{} V", stop.highest);
    assert!(stop.records.iter().all(|record| record.faults.is_empty() && record.enabled == 0b1111));
    // the controller knows, and says so
    assert!(stop.records.iter().any(|record| record.events.has(Event::Saturated) && record.headroom < 128));
}

#[test]
fn without_the_limit_the_same_stop_would_have_tripped() {
    // a limit so high that the band is never met
    let free = stop(|block| block.limits.over_voltage = 36.0);
    println!("with the limit at 36 V the bus came to {:.2} V", free.highest);
    assert!(free.highest > 17.0, "{} V", free.highest);
    // what the robot gave back is in the capacitor, and less than what the body lost
    assert!(
        free.drawn < 0.0 && (free.lost[1] - free.drawn).abs() < 0.1 * free.lost[1].abs(),
        "{:?} {}",
        free.lost,
        free.drawn
    );
    assert!(-free.lost[1] < free.lost[0], "{:?}", free.lost);
    assert!(!free.records.iter().any(|record| record.faults.has(Fault::OverVoltage)));
}
