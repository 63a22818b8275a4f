//! One motor from the first pulse to what a person is shown.

use model_core::control::halls::HallCode;
use model_core::control::wiring::MotorWiring;
use model_core::link::hello::Hello;
use model_core::link::probe::ProbeReport;

use crate::error::{Error, Result};

use super::bench::{Bench, ProbePort, QUICKLY, Vector};
use super::halls::{HallsFound, NoHalls};
use super::sense::{Sense, sense};
use super::winding::{Winding, winding};

/// What was found of a motor, in the frame of its outputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Where its converters sit.
    pub sense: Sense,
    /// R, L.
    pub winding: Winding,
    /// Its halls.
    pub halls: HallsFound,
}

/// Where the slow turn begins and how far it goes [2⁻¹⁶ turn]: 60° before output a, over 480°.
const BEGIN: u16 = 0u16.wrapping_sub(10_923);
const WAY: i32 = 87_381;

/// How fast: 0.46 turns a second [2⁻¹⁶ turn/ms]. A rotor that breaks loose from its friction swings about the vector, by an
/// angle that grows with this.
const SLOWLY: u16 = 30;

/// How far a rotor goes from where it was found, at the most, until a person is shown anything [°, electrical]: half a turn to
/// the first pulse, 150° from there to the vector, and with that forward from 90° before output a to 420° behind it.
pub const MOST_TURNED: f64 = 180.0 + 150.0 + 510.0;

/// What the wheel is to turn for a person to see it, in all [°].
pub(super) const SEEN: f64 = 30.0;

/// Finds out how a motor is wired; its bridge is open then, whatever came of it.
///
/// # Errors
/// What is wrong with the motor, or with the line to the robot.
pub fn find<P: ProbePort>(port: &mut P, hello: Hello, motor: u8) -> Result<Found> {
    let mut bench = Bench::new(port, hello, motor);
    let found = found(&mut bench);
    let opened = bench.open();
    found.and_then(|found| opened.map(|()| found))
}

fn found<P: ProbePort>(bench: &mut Bench<P>) -> Result<Found> {
    let sense = sense(bench)?;
    let winding = winding(bench, &sense)?;
    let begin = Vector { periods: 20, share: winding.share, angle: BEGIN };
    bench.turn(Vector { angle: 0, ..begin }, -10_923, SLOWLY)?;
    bench.hold(begin, 100, 0)?;
    let forward = bench.turn(begin, WAY, SLOWLY)?;
    let end = Vector { angle: BEGIN.wrapping_add(WAY as u16), ..begin };
    bench.hold(end, 100, 0)?;
    let back = bench.turn(end, -WAY, SLOWLY)?;
    let motor = usize::from(bench.motor);
    let way = |seen: &[(i32, ProbeReport)], from: u16| -> Vec<(f64, HallCode)> {
        let code = |report: &ProbeReport| report.halls.get(motor).copied().unwrap_or_default();
        seen.iter().map(|(gone, report)| (f64::from(from) + f64::from(*gone), code(report))).collect()
    };
    let halls = HallsFound::of(&way(&forward, begin.angle), &way(&back, end.angle))
        .map_err(|why| no_halls(bench, why, &forward))?;
    Ok(Found { sense, winding, halls })
}

/// Turns a wheel forward so that a person can say which way that was, by 30° with all before or by one electrical turn.
///
/// # Errors
/// Where the robot has a fault, or the line is broken.
pub fn show<P: ProbePort>(port: &mut P, hello: Hello, motor: u8, found: &Found) -> Result<()> {
    let mut bench = Bench::new(port, hello, motor);
    let turns = (SEEN / wheel_degrees(&hello, 1.0) - MOST_TURNED).max(360.0) / 360.0;
    let begin = Vector { periods: 20, share: found.winding.share, angle: BEGIN };
    let shown = bench.hold(begin, 200, 0).and_then(|_| bench.turn(begin, (turns * 65_536.0) as i32, QUICKLY));
    let opened = bench.open();
    shown.and(opened)
}

/// What a wheel turns [°] while its motor turns by so many electrical degrees.
pub fn wheel_degrees(hello: &Hello, electrical: f64) -> f64 {
    electrical / (f64::from(hello.calibration.pole_pairs) * f64::from(hello.gear_ratio))
}

impl Found {
    /// The wiring, of a motor that turned its wheel forward while the vector went from output a to output b, or backward.
    pub fn wiring(&self, forward: bool) -> MotorWiring {
        let outputs = if forward { [0, 1, 2] } else { [0, 2, 1] };
        let halls = if forward { self.halls } else { self.halls.mirrored() };
        let (codes, edges) = halls.sectors();
        let at = |output: u8| self.sense.output.iter().position(|other| *other == output).unwrap_or_default();
        let converters = outputs.map(at);
        MotorWiring {
            outputs,
            converters: converters.map(|c| c as u8),
            inverted: converters.map(|c| self.sense.inverted[c]),
            codes,
            edges,
        }
    }
}

/// What is told of codes that fit no motor.
fn no_halls<P: ProbePort>(bench: &Bench<P>, why: NoHalls, forward: &[(i32, ProbeReport)]) -> Error {
    let moved = |j: usize| {
        let code = |report: &ProbeReport| report.halls[j];
        forward.windows(2).filter(|pair| code(&pair[0].1) != code(&pair[1].1)).count() >= 6
    };
    let other = (0..4).find(|j| *j != usize::from(bench.motor) && moved(*j));
    match (why, other) {
        (NoHalls::Still, Some(other)) => bench.trouble(
            format!("it turns, and the halls of motor {other} say so"),
            "Swap the hall cables, or the motors' leads, of the two",
        ),
        (NoHalls::Still, None) => bench.trouble(
            "its halls do not change while the vector turns",
            "Free the wheel: it may be blocked, or its friction more than 0.85 A can overcome; check the halls' supply",
        ),
        (NoHalls::Order { stuck: 0 }, _) => bench.trouble(
            "its hall codes follow in no ring of six",
            "The rotor slips against the vector: free the wheel; or one hall line alone is turned round: mend that",
        ),
        (NoHalls::Order { stuck }, _) => {
            let lines: Vec<&str> = ["a", "b", "c"]
                .into_iter()
                .enumerate()
                .filter(|(k, _)| stuck >> k & 1 == 1)
                .map(|(_, name)| name)
                .collect();
            bench.trouble(
                format!("hall line {} never changes", lines.join(" and ")),
                "Check that line, its pull-up and the halls' supply",
            )
        }
        (NoHalls::Back, _) => bench.trouble(
            "its halls do not come back the way that they went",
            "Free the wheel: the rotor does not follow the vector both ways",
        ),
    }
}
