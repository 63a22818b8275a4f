//! `robot drive`: leg by leg, recorded if that is asked for.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::atomic::Ordering;
use std::time::Duration;

use model_core::geometry::frames::BodyTwist;
use model_core::link::command::{FASTEST, FASTEST_TURN, HARDEST, HARDEST_TURN};
use model_core::link::faults::Faults;
use omni_gap::Error;
use omni_gap::api::{RobotFile, known_effects, record_kept};
use omni_gap::wire::line::Line;
use omni_gap::wire::robot::{Driven, Ended, Leg, MEND, drive};
use omni_gap::wire::status::Status;

use super::ask::Ask;
use super::live;
use crate::commands::cli_error::CliError;
use crate::commands::console::Console;
use crate::commands::record::run_place::{RunPlace, name, remarks, text_of};
use crate::commands::told_to_end::{Also, told_to_end};

/// What to drive, and where to record it.
#[derive(Debug, clap::Args)]
pub struct Drive {
    /// Speed forward [m/s], to the left [m/s], turning counterclockwise [rad/s], and for how long [s]; where it is to change on the
    /// way, by how much a second [m/s², m/s², rad/s²]; may be given several times
    #[arg(long = "leg", value_name = "V,VN,W,SECONDS[,AV,AVN,AW]", required = true, allow_hyphen_values = true)]
    legs: Vec<AskedLeg>,

    /// Record the drive into this session: a new one, or one of this robot that gets another run
    #[arg(long, value_name = "SESSION", requires = "robot")]
    out: Option<PathBuf>,

    /// The robot's file, for the session and for --live
    #[arg(long, value_name = "ROBOT.toml")]
    robot: Option<PathBuf>,

    /// Show by how much robot and model are apart while it drives, as `omni-gap watch` does; needs --robot
    #[arg(long, requires = "robot", conflicts_with = "json")]
    live: bool,

    /// The run's name
    #[arg(long, value_name = "NAME", default_value = "run", value_parser = name, requires = "out")]
    name: String,

    #[command(flatten)]
    ask: Ask,
}

/// A leg as it is asked for.
#[derive(Clone, Copy, Debug)]
struct AskedLeg(Leg);

impl Drive {
    /// Does it.
    pub fn run(&self, console: &Console) -> Result<(), CliError> {
        let robot = self.robot.as_deref().map(|path| RobotFile::load(path, &known_effects())).transpose()?;
        let place = self.place()?;
        let told_to_end = told_to_end(Also::CtrlC)
            .map_err(|why| Error::output(Path::new("Ctrl-C"), why.to_string(), "Start it from an ordinary shell"))?;
        let legs: Vec<Leg> = self.legs.iter().map(|asked| asked.0).collect();
        let mut line = self.ask.line()?;
        if robot.is_some() {
            line.keep();
        }
        let Driven { ended, status } = match &robot {
            Some(robot) if self.live => live::driven(&mut line, &legs, robot, &told_to_end, console)?,
            _ => {
                console.phase("driving");
                drive(&mut line, &legs, |look| {
                    console.phase_is_at(driving(look.status));
                    !told_to_end.load(Ordering::Relaxed)
                })?
            }
        };
        // what was recorded before a fault tells of it
        let notices = match (&robot, place) {
            (Some(robot), Some((place, path))) => self.write(&line, robot, &place, path)?,
            _ => Vec::new(),
        };
        if let Ended::Faulted(faults) = ended {
            return Err(faulted(&line, faults).into());
        }
        self.ask.say(console, &status, &notices)
    }

    /// Where the drive is to be recorded, and the robot file that goes with it.
    fn place(&self) -> Result<Option<(RunPlace, &Path)>, CliError> {
        let (Some(session), Some(path)) = (&self.out, &self.robot) else { return Ok(None) };
        Ok(Some((RunPlace::new(session, &self.name, false, vec![("robot.toml", text_of(path)?)])?, path)))
    }

    /// Writes the run; what a person should know of it.
    fn write(&self, line: &Line, robot: &RobotFile, place: &RunPlace, path: &Path) -> Result<Vec<String>, CliError> {
        let recorded = record_kept(line.kept(), &line.place(), &self.name, robot.wheel.len())?;
        let mut notices = vec![place.write(&recorded, |_| Ok(()))?];
        notices.extend(remarks(&recorded, robot, path));
        Ok(notices)
    }
}

/// How a robot that drives is, on one line.
fn driving(status: &Status) -> String {
    let [v, vn, w] = status.wanted;
    let bus = status.bus_v.map_or(String::new(), |volts| format!(", bus {volts:.1} V"));
    let load = 100.0 * status.load;
    format!("{}: wants {v:.2} {vn:.2} m/s {w:.2} rad/s{bus}, load {load:.0} %", status.state.name())
}

fn faulted(line: &Line, faults: Faults) -> Error {
    let told: Vec<&str> = faults.iter().map(|fault| fault.text()).collect();
    line.error(format!("the robot stopped: {}", told.join("; ")), MEND)
}

impl FromStr for AskedLeg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let fields: Vec<&str> = text.split(',').map(str::trim).collect();
        let (asked, slope) = match fields[..] {
            [v, vn, w, seconds] => ([v, vn, w, seconds], ["0"; 3]),
            [v, vn, w, seconds, av, avn, aw] => ([v, vn, w, seconds], [av, avn, aw]),
            _ => {
                let found = fields.len();
                return Err(format!(
                    "found {found} numbers, expected four: v,vn,w,seconds, such as 0.3,0,0,2, or seven, with accelerations"
                ));
            }
        };
        let [v, vn, w, seconds] = asked;
        let speed = |text| within(text, FASTEST, "a speed", "m/s");
        let twist = BodyTwist { v: speed(v)?, vn: speed(vn)?, w: within(w, FASTEST_TURN, "a speed", "rad/s")? };
        let [av, avn, aw] = slope;
        let along = |text| within(text, HARDEST, "an acceleration", "m/s²");
        let about = within(aw, HARDEST_TURN, "an acceleration", "rad/s²")?;
        let acceleration = BodyTwist { v: along(av)?, vn: along(avn)?, w: about };
        let lasts = seconds.parse::<f64>().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let lasts = lasts.filter(|lasts| !lasts.is_zero());
        let lasts = lasts.ok_or_else(|| format!("found {seconds} for the time, expected seconds above zero"))?;
        let leg = Leg { twist, acceleration, lasts };
        let [v, vn, w] = leg.end().to_array();
        let fits = v.abs() <= FASTEST && vn.abs() <= FASTEST && w.abs() <= FASTEST_TURN;
        let slow = "a leg that ends within what a robot may be asked";
        if fits { Ok(Self(leg)) } else { Err(format!("it ends with {v},{vn},{w}, expected {slow}")) }
    }
}

fn within(text: &str, most: f32, what: &str, unit: &str) -> Result<f32, String> {
    let number = text.parse::<f32>().ok().filter(|x| x.abs() <= most);
    number.ok_or_else(|| format!("found {text}, expected {what} from -{most} to {most} {unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_leg_is_four_or_seven_numbers_within_what_a_command_may_ask() {
        let AskedLeg(leg) = "0.3, -0.1,2,1.5".parse().unwrap();
        assert_eq!((leg.twist, leg.lasts), (BodyTwist { v: 0.3, vn: -0.1, w: 2.0 }, Duration::from_millis(1500)));
        let AskedLeg(leg) = "0,0,0,2,0.5,0,-3".parse().unwrap();
        assert_eq!(
            (leg.acceleration, leg.end()),
            (BodyTwist { v: 0.5, vn: 0.0, w: -3.0 }, BodyTwist { v: 1.0, vn: 0.0, w: -6.0 })
        );
        for (text, says) in [
            ("0.3,0,2", "found 3 numbers"),
            ("0.3,0,2,1,0", "found 5 numbers"),
            ("0,0,0,1,101,0,0", "from -100 to 100 m/s²"),
            ("0,0,0,5,5,0,0", "it ends with 25,0,0"),
            ("30,0,0,1", "from -20 to 20 m/s"),
            ("0,0,-200,1", "from -100 to 100 rad/s"),
            ("0,nan,0,1", "found nan"),
            ("0,0,0,0", "seconds above zero"),
            ("0,0,0,-1", "seconds above zero"),
        ] {
            let told = text.parse::<AskedLeg>().unwrap_err();
            assert!(told.contains(says), "{text}: {told}");
        }
    }
}
