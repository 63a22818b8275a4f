//! The page: the ratios, then what makes the comparison a fair one, and what each side has and lacks.

use std::fmt::Write;
use std::thread::available_parallelism;

use omni_gap::report::num;
use serde_json::Value;

use super::fits::{self, Fits};
use super::motion::Apart;
use super::steps::{self, Steps};

/// How many plain steps a step with eight derivatives may take as long as.
const DERIVATIVES_ASKED: f64 = 5.0;

/// How many times as long as ours SciPy's fit should take.
const FIT_ASKED: f64 = 50.0;

const FRAME: &str = "\
## What is compared

Both sides are the four-wheel robot of `examples/feup-4w/robot.toml`, driven from rest by the same voltages, which reverse
every 0.3 s, in steps of 1 ms, on one thread. MuJoCo's model (`host-tests/mujoco/robot.xml`) is the smallest that it
allows: one body on two slides and a hinge, with nothing that could touch anything. It is timed twice: with the options that
MuJoCo has by default (Newton's solver, the semi-implicit Euler integrator), and with those that are fastest for this robot
(the solver PGS; contacts, gravity, limits, sensors, islands and the rest off). Its 10,000 steps are taken in one call of
`mujoco.rollout`, so that none of the time is Python's, and the forces of the motors come already turned into the world's
axes, so that none of the time goes into them either. A rollout that does not end where the same steps ended one by one
fails the command, and so does a motion that ends further apart than the table allows.

- MuJoCo has, and the plain plant has not: Coriolis terms; they are an effect here, and on in the motions below.
- The plant has, and MuJoCo's model has not: voltages, currents and wheel speeds, which it works out in every step; friction
  along the body's axes, where MuJoCo's joints have the world's (the two are one while the robot does not turn as it
  drives); rest that is rest, where MuJoCo's dry friction is very stiff, and creeps; and every effect but Coriolis: the rows
  with effects compare them with the same plain `mj_step`.

The turns are taken one after the other, MuJoCo and each case in every turn; a ratio is the median of the turns' ratios,
and so little of it is due to what else the machine was doing.

";

const FITTED: &str = "\
Ten recordings of 6 s at 500 rows a second, along one axis each; from the same recordings, both sides find the same seven
numbers, each a stated sigma off at the start, with the same noise, bounds and statements of the robot file. SciPy's
`least_squares` (`trf`, differences of two points) has all runs simulated by one `mujoco.rollout`, each from the rest at
which it is known to begin. Our fit does not know that, and finds the start of every window of half a second besides.
";

/// The page.
pub fn page(versions: &Value, motions: &[Apart], steps: &Steps, fits: &Fits) -> String {
    let mut page = String::from("# This plant beside MuJoCo's\n\n");
    let named = versions.as_object().into_iter().flatten();
    let versions: Vec<String> = named.map(|(what, is)| format!("{what} {}", is.as_str().unwrap_or("?"))).collect();
    let line = |page: &mut String, cells: &[String]| writeln!(page, "| {} |", cells.join(" | ")).expect("text grows");
    write!(page, "{}. On {}.\n\n", versions.join(", "), machine()).expect("text grows");
    page += "Steps a second, and how many times as many as MuJoCo takes: with its default options, and with its fastest.\n\n";
    page += "| case | this plant | MuJoCo | ratio | MuJoCo, fastest | ratio | asked |\n|---|---|---|---|---|---|---|\n";
    let [default, fastest] = steps.mujoco.map(per_s);
    for rate in &steps.rates {
        let asked = rate.asked.map_or_else(none, |asked| format!("at least {asked}"));
        let [ratio, to_fastest] = rate.ratios.map(num);
        let (name, per_s) = (rate.name.to_owned(), per_s(rate.per_s));
        line(&mut page, &[name, per_s, default.clone(), ratio, fastest.clone(), to_fastest, asked]);
    }
    let [ours, theirs] = [&fits.ours, &fits.theirs].map(|side| format!("{} s", num(side.seconds)));
    let least = format!("at least {FIT_ASKED}");
    line(&mut page, &["fit of seven numbers".to_owned(), ours, none(), none(), theirs, num(fits.ratio), least]);
    let most = format!("at most {DERIVATIVES_ASKED}");
    let dear = num(steps.derivatives);
    line(&mut page, &["eight derivatives, in plain steps".to_owned(), dear, none(), none(), none(), none(), most]);
    let (of_steps, of_fits) = (steps::TURNS, fits::TURNS);
    let looped = per_s(steps.looped);
    writeln!(
        page,
        "\nTurns: {of_steps} of the steps, {of_fits} of the fits. A Python loop that turns the forces and calls"
    )
    .expect("text grows");
    write!(page, "`mj_step`, with the fastest options: {looped}.\n\n").expect("text grows");
    page += FRAME;
    page += "## Is it the same robot?\n\nHow far apart the two end after a second.\n\n";
    page += "| motion | went | place | heading | velocity | yaw rate | allowed |\n|---|---|---|---|---|---|---|\n";
    for a in motions {
        let went = format!("{:.3} m, {:.3} rad", a.went[0], a.went[1]);
        let apart = [(a.place, "m"), (a.heading, "rad"), (a.speed, "m/s"), (a.yaw_rate, "rad/s")];
        let mut cells = vec![a.name.to_owned(), went];
        cells.extend(apart.map(|(x, unit)| format!("{x:.5} {unit}")));
        cells.push(num(a.allowed));
        line(&mut page, &cells);
    }
    page += "\n## The fit\n\n";
    page += FITTED;
    page += "\n| | takes | worst number's error | left, per number compared |\n|---|---|---|---|\n";
    for (who, side) in [("this fit", &fits.ours), ("MuJoCo and SciPy", &fits.theirs)] {
        let error = format!("{} %", num(100.0 * side.worst));
        let cells = [who.to_owned(), format!("{:.3} s", side.seconds), error, format!("{:.4} σ²", side.error)];
        line(&mut page, &cells);
    }
    let (threads, rollouts, tolerance) = (fits.threads, fits.rollouts, fits::TOLERANCE);
    write!(
        page,
        "\n{threads} threads each; {rollouts} times all runs for SciPy; both stop below {tolerance:e} of the cost.\n"
    )
    .expect("text grows");
    page
}

/// What stands where there is nothing to say.
fn none() -> String {
    "–".to_owned()
}

fn per_s(rate: f64) -> String {
    match rate {
        1e6.. => format!("{} million/s", num(rate / 1e6)),
        _ => format!("{} thousand/s", num(rate / 1e3)),
    }
}

/// The processor, as far as it tells its name, and how much of it there is.
fn machine() -> String {
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = told.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": ")).map(|(_, name)| name);
    let cores = available_parallelism().map_or(1, usize::from);
    let name = name.unwrap_or(std::env::consts::ARCH);
    format!("{cores} cores of {name}, {}", std::env::consts::OS)
}
