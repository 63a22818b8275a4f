//! A commissioning with a person at the robot: what is asked, and what is told.

use model_core::link::hello::Hello;

use super::bench::ProbePort;
use super::connected::{Connected, connect};
use super::motor::{Found, MOST_TURNED, SEEN, find, show, wheel_degrees};
use super::winding::Estimate;
use crate::error::{Error, Result};
use crate::log::{CommissionedFile, RobotFile};
use crate::wire::line::Line;

/// Who sees the wheels.
pub trait Person {
    /// One of these answers to a question; none where nobody answers any more.
    fn answer<'a>(&mut self, question: &str, answers: &[&'a str]) -> Option<&'a str>;
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Guided {
    /// Of every motor, as a robot file has it.
    pub motors: Vec<CommissionedFile>,
    /// The same in words, and where it is not what the file says.
    pub told: Vec<String>,
}

/// More than this many standard deviations off what the file says, R or L is told.
const TELLS: f64 = 2.0;

/// What an inductance of a robot file may be off, which states none [1], one standard deviation.
const INDUCTANCE: f64 = 0.1;

/// Commissions motors one after the other; without a person every wheel is taken to have turned forward.
///
/// # Errors
/// What is wrong with a motor or the line to the robot; where the person says no, or nothing more. The bridges are open
/// then.
pub fn guided(
    line: &mut Line,
    file: &RobotFile,
    motors: &[usize],
    mut person: Option<&mut dyn Person>,
) -> Result<Guided> {
    let mut robot = connect(line)?;
    let hello = robot.hello;
    if let Some(person) = &mut person {
        warn(&robot, &hello, *person)?;
    }
    let mut guided = Guided { motors: Vec::new(), told: Vec::new() };
    for motor in motors {
        let found = find(&mut robot, hello, *motor as u8)?;
        let forward = match &mut person {
            Some(person) => seen_forward(&mut robot, *motor, &found, *person)?,
            None => true,
        };
        let entry = CommissionedFile::of(*motor, &found.wiring(forward));
        guided.told.extend(told(&entry, &found, file));
        guided.motors.push(entry);
    }
    Ok(guided)
}

/// What is to happen, and whether it may.
fn warn(robot: &Connected, hello: &Hello, person: &mut dyn Person) -> Result<()> {
    let most = wheel_degrees(hello, MOST_TURNED + 360.0).max(SEEN);
    let question = format!(
        "Each motor gets up to 1 A, and its wheel turns by up to {most:.0}°, one after the other. Are all wheels off the ground, \
         and is a hand at the switch of the motor supply"
    );
    match person.answer(&question, &["yes", "no"]) {
        Some("yes") => Ok(()),
        Some(_) => Err(robot.error("nothing was done".into(), "Put the robot on a stand first")),
        None => Err(unanswered(robot)),
    }
}

/// Shows a wheel until a person knows whether it turned forward.
fn seen_forward(robot: &mut Connected, motor: usize, found: &Found, person: &mut dyn Person) -> Result<bool> {
    let question = format!(
        "Seen from outside the robot, which way did wheel {motor} turn (`again` shows it again, `other`: another wheel, or none)"
    );
    loop {
        show(robot, robot.hello, motor as u8, found)?;
        match person.answer(&question, &["clockwise", "back", "again", "other"]) {
            // the top of a wheel that drives the robot to the left round itself goes to the right of who looks at it
            Some("clockwise") => return Ok(true),
            Some("back") => return Ok(false),
            Some("again") => {}
            Some(_) => {
                let problem = format!("motor {motor}: another wheel turned, or none");
                return Err(
                    robot.error(problem, "Plug the motors' leads into their own gate drivers, and free the wheel")
                );
            }
            None => return Err(unanswered(robot)),
        }
    }
}

fn unanswered(robot: &Connected) -> Error {
    robot.error(
        "the answers ended early, and nothing is written".into(),
        "Somebody must see which way the wheels turn; --yes takes all of them to turn forward",
    )
}

/// What was found of a motor, and where that is not what the file says.
fn told(entry: &CommissionedFile, found: &Found, file: &RobotFile) -> Vec<String> {
    let CommissionedFile { wheel, outputs, converters, inverted, hall_codes, hall_edges_deg } = *entry;
    let letters = |leads: [u8; 3]| -> String { leads.iter().map(|lead| char::from(b'a' + lead)).collect() };
    let signs: String = inverted.iter().map(|inverted| if *inverted { '-' } else { '+' }).collect();
    let edges: Vec<String> = hall_edges_deg.iter().map(|edge| format!("{edge:.1}")).collect();
    let (r, l) = (found.winding.resistance, found.winding.inductance);
    let mut told = vec![format!(
        "motor {wheel}: phases on outputs {}, currents at converters {} with signs {signs}, hall codes {} with edges at {}°; \
         between two terminals R {:.3} ± {:.3} Ω and L {:.3} ± {:.3} mH, half of it in a phase; friction holds the rotor {:.0}° behind",
        letters(outputs),
        letters(converters),
        hall_codes.map(|code| code.to_string()).join(" "),
        edges.join(" "),
        r.value,
        r.sigma,
        1e3 * l.value,
        1e3 * l.sigma,
        found.halls.lag.to_degrees(),
    )];
    let mut compare = |name: &str, key: &str, (of_file, relative): (f64, f64), found: Estimate| {
        if (found.value - of_file).abs() > TELLS * found.sigma.hypot(relative * of_file) {
            told.push(format!(
                "motor {wheel}: its {name} is {:.4e}, and the file says {key} = {of_file}; correct the file if all motors say so",
                found.value
            ));
        }
    };
    let uncertain = file.relative_uncertainty("resistance_ohm").unwrap_or_default();
    compare("R", "resistance_ohm", (file.motor.resistance_ohm, uncertain), r);
    compare("L", "inductance_H", (file.controller.unwrap_or_default().inductance_h, INDUCTANCE), l);
    told
}
