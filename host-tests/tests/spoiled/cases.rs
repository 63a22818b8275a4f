//! One sound session, and every way in which it is spoiled.

use std::path::Path;

use omni_gap::known_effects;
use omni_gap::log::{Channel, Group, Missing, Run};
use omni_gap::synthesize::{Scenario, synthesize};

/// A session as files: the text of the robot file, and the runs with their file names.
#[derive(Clone)]
pub struct Files {
    pub robot: String,
    pub runs: Vec<(String, Run)>,
}

/// What was done to the session, by whom it is to be told, and how it is done.
pub struct Spoiled {
    pub what: &'static str,
    pub expected: Expected,
    pub spoil: fn(&mut Files),
}

/// Who must tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// Nothing is wrong, or what is wrong is left to the diagnosis.
    Nothing,
    /// A fatal fault of this code.
    Fatal(&'static str),
    /// A slight fault of this code: the diagnosis goes on.
    Slight(&'static str),
    /// One message that holds this: the files cannot be read.
    Refused(&'static str),
}

use Expected::{Fatal, Nothing, Refused, Slight};

/// The sound one: three runs of three seconds of the four-wheel robot at 200 rows a second.
pub fn sound() -> Files {
    let text = include_str!("../../../examples/feup-4w/robot.toml");
    let plan = Scenario { runs: 3, duration: 3.0, rate: 200.0, ..Scenario::default() };
    let session = synthesize(text, &plan, &known_effects()).expect("the example is sound");
    let runs = session.runs.into_iter().map(|run| (format!("{}.csv", run.name), run)).collect();
    Files { robot: session.robot_text, runs }
}

/// Puts the files into a folder.
pub fn write(files: &Files, folder: &Path) {
    std::fs::create_dir_all(folder.join("runs")).expect("a folder for the session");
    std::fs::write(folder.join("robot.toml"), &files.robot).expect("the robot file");
    for (name, run) in &files.runs {
        let out = std::fs::File::create(folder.join("runs").join(name)).expect("a run");
        run.write_csv(out).expect("a run");
    }
}

fn each(files: &mut Files, change: impl Fn(&mut Run)) {
    files.runs.iter_mut().for_each(|(_, run)| change(run));
}

fn channels<'a>(run: &'a mut Run, stem: &str) -> &'a mut Vec<Channel> {
    let group: &mut Option<Group> = match stem {
        "u" => &mut run.u,
        "i" => &mut run.i,
        "w" => &mut run.w,
        _ => &mut run.pose,
    };
    &mut group.as_mut().expect("a staged run has all groups").channels
}

/// Every sample of one channel, or of all of a group, through a function of row and value.
fn change(files: &mut Files, stem: &str, only: Option<usize>, by: impl Fn(usize, f64) -> f64) {
    each(files, |run| {
        for (k, channel) in channels(run, stem).iter_mut().enumerate() {
            if only.is_none_or(|only| only == k) {
                *channel = channel.map(&by);
            }
        }
    });
}

fn clock(files: &mut Files, times: f64) {
    each(files, |run| run.t_s.iter_mut().for_each(|t| *t *= times));
}

/// One number of the robot file, wherever its key stands.
fn robot(files: &mut Files, key: &str, by: impl Fn(f64) -> f64) {
    let line = |line: &str| match line.split_once(" = ") {
        Some((found, number)) if found == key => {
            format!("{key} = {:?}\n", by(number.split('#').next().unwrap_or("").trim().parse().expect("a number")))
        }
        _ => format!("{line}\n"),
    };
    files.robot = files.robot.lines().map(line).collect();
}

fn append(files: &mut Files, text: &str) {
    files.robot += text;
}

/// The first rows of every run.
fn shorten(files: &mut Files, rows: usize) {
    each(files, |run| cut(run, rows));
}

fn cut(run: &mut Run, rows: usize) {
    run.t_s.truncate(rows);
    for group in [&mut run.u, &mut run.i, &mut run.w, &mut run.pose] {
        for channel in group.iter_mut().flat_map(|group| &mut group.channels) {
            *channel = channel.iter().take(rows).collect();
        }
    }
}

/// The camera's last value on every row without a frame.
fn hold(run: &mut Run) {
    for channel in channels(run, "pose") {
        let mut last = Err(Missing::Blank);
        *channel = channel
            .iter()
            .map(|sample| {
                last = sample.or(last);
                last
            })
            .collect();
    }
}

/// Noise alone, as a robot that stands still shows it.
fn rest(run: &mut Run) {
    let noise = |row: usize| (((row * 7919) % 101) as f64 - 50.0) / 100.0;
    for (stem, size) in [("i", 0.04), ("w", 0.3), ("pose", 0.006)] {
        for channel in channels(run, stem) {
            *channel = channel.map(|row, _| size * noise(row));
        }
    }
}

/// A group as it was some rows before; of a negative number, as it will be.
fn late(run: &mut Run, group: &str, rows: isize) {
    for channel in channels(run, group) {
        let now = channel.clone();
        let from = |row: usize| row.saturating_add_signed(-rows).min(now.len() - 1);
        *channel = (0..now.len()).map(|row| now.get(from(row))).collect();
    }
}

const fn spoiled(what: &'static str, expected: Expected, spoil: fn(&mut Files)) -> Spoiled {
    Spoiled { what, expected, spoil }
}

pub const ALL: [Spoiled; 49] = [
    spoiled("nothing", Nothing, |_| {}),
    spoiled("`[effects.coriolis]` with a wheel", Refused("acts on the whole robot"), |f| {
        append(f, "[effects.coriolis]\nwheel = 1\n")
    }),
    spoiled("`[effects.motor_mismatch]` without a wheel", Refused("sits on one wheel"), |f| {
        append(f, "[effects.motor_mismatch]\ntorque_constant_ratio = 0.9\n");
    }),
    spoiled("an effect on wheel 7", Refused("wheels 0 to 3"), |f| {
        append(f, "[[effects.wheel_slip]]\nwheel = 7\nfriction_coefficient = 0.4\n");
    }),
    spoiled("an effect beyond its bounds", Refused("expected a value from"), |f| {
        append(f, "[effects.wheel_slip]\nfriction_coefficient = 40\n")
    }),
    spoiled("an effect with an unknown key", Refused("unknown key in [effects.wheel_slip]"), |f| {
        append(f, "[effects.wheel_slip]\nmu = 0.4\n")
    }),
    spoiled("an effect on all wheels and on one", Refused("acts there twice"), |f| {
        append(
            f,
            "[[effects.wheel_slip]]\nfriction_coefficient = 0.4\n[[effects.wheel_slip]]\nwheel = 1\nfriction_coefficient = 0.4\n",
        );
    }),
    spoiled("twenty-five effects", Refused("room for 24 effects"), |f| {
        for (id, size) in [
            ("wheel_slip", "friction_coefficient = 0.4"),
            ("motor_mismatch", "torque_constant_ratio = 0.9"),
            ("creep", "creep_m_s_per_N = 0.01"),
            ("gear_efficiency", "efficiency = 0.9"),
            ("dead_time", "voltage_loss_V = 0.2"),
            ("rotor_inertia", "inertia_at_wheel_kg_m2 = 1e-5"),
        ] {
            for wheel in 0..4 {
                append(f, &format!("[[effects.{id}]]\nwheel = {wheel}\n{size}\n"));
            }
        }
        append(f, "[effects.coriolis]\n");
    }),
    spoiled("mass in grams", Refused("if the number is in g"), |f| robot(f, "mass_kg", |x| 1000.0 * x)),
    spoiled("inertia in kg·cm²", Refused("do not belong to one robot"), |f| {
        robot(f, "inertia_kg_m2", |x| 1e4 * x);
    }),
    spoiled("a mass of 1e200 kg", Refused("found 1e200"), |f| robot(f, "mass_kg", |_| 1e200)),
    spoiled("a radius of 30 m", Refused("expected a number from 0.002 to 0.6 m"), |f| robot(f, "radius_m", |_| 30.0)),
    spoiled("distances in millimetres", Refused("if the number is in mm"), |f| robot(f, "distance_m", |x| 1000.0 * x)),
    spoiled("Kt in mN·m/A", Refused("if the number is in mN·m/A"), |f| {
        robot(f, "torque_constant_Nm_per_A", |x| 1000.0 * x)
    }),
    spoiled("Kv in rpm/V", Refused("if the number is in rpm/V"), |f| robot(f, "emf_constant_V_s", |x| 9.549_3 / x)),
    spoiled("gear ratio inverted", Refused("wheel turns in a turn of the motor"), |f| {
        robot(f, "gear_ratio", |x| 1.0 / x)
    }),
    spoiled("no `[friction]`", Slight("no_friction"), |f| {
        let (before, after) = f.robot.split_once("[friction]").expect("the example has friction");
        let (_, after) = after.split_once("\n\n").expect("and a section below it");
        f.robot = format!("{before}{after}");
    }),
    spoiled("time in milliseconds", Fatal("wrong_time_unit"), |f| clock(f, 1e3)),
    spoiled("time in microseconds", Fatal("wrong_time_unit"), |f| clock(f, 1e6)),
    spoiled("time in nanoseconds", Fatal("wrong_time_unit"), |f| clock(f, 1e9)),
    spoiled("time in milliseconds, scaled by 1e-3 twice", Fatal("wrong_time_unit"), |f| clock(f, 1e-3)),
    spoiled("a pause of an hour in a run", Fatal("time_gap"), |f| {
        each(f, |run| run.t_s[300..].iter_mut().for_each(|t| *t += 3600.0))
    }),
    spoiled("one wheel speed × 1e200", Fatal("absurd_value"), |f| change(f, "w", Some(1), |_, w| 1e200 * w)),
    spoiled("heading in degrees", Fatal("wrong_unit"), |f| change(f, "pose", Some(2), |_, theta| theta.to_degrees())),
    spoiled("heading in degrees, wrapped", Fatal("wrong_unit"), |f| {
        change(f, "pose", Some(2), |_, theta| (theta.to_degrees() + 180.0).rem_euclid(360.0) - 180.0);
    }),
    spoiled("the z of a quaternion for the heading", Fatal("quaternion_for_heading"), |f| {
        change(f, "pose", Some(2), |_, theta| (0.5 * theta).sin())
    }),
    spoiled("duty from -1 to 1 for volts", Fatal("duty_for_volts"), |f| change(f, "u", None, |_, u| u / 12.0)),
    spoiled("duty in per cent", Fatal("duty_for_volts"), |f| change(f, "u", None, |_, u| u / 12.0 * 100.0)),
    spoiled("duty of 255", Fatal("duty_for_volts"), |f| change(f, "u", None, |_, u| (u / 12.0 * 255.0).round())),
    spoiled("duty of 1000, no currents", Fatal("duty_for_volts"), |f| {
        change(f, "u", None, |_, u| u / 12.0 * 1000.0);
        each(f, |run| run.i = None);
    }),
    spoiled("duty from -1 to 1, no currents", Fatal("duty_for_volts"), |f| {
        change(f, "u", None, |_, u| u / 12.0);
        each(f, |run| run.i = None);
    }),
    spoiled("currents without sign", Fatal("unsigned_currents"), |f| change(f, "i", None, |_, i| i.abs())),
    spoiled("the pose held between frames", Fatal("held_pose"), |f| each(f, hold)),
    spoiled("one run under two names", Fatal("same_run_twice"), |f| {
        let again = f.runs[0].1.clone();
        f.runs.push(("another.csv".into(), again));
    }),
    spoiled("a run and its first half", Fatal("same_run_twice"), |f| {
        let mut half = f.runs[1].1.clone();
        cut(&mut half, 300);
        f.runs.push(("half.csv".into(), half));
    }),
    spoiled("the same run six times", Fatal("same_run_twice"), |f| {
        let run = f.runs[0].1.clone();
        f.runs = (0..6).map(|k| (format!("run{k}.csv"), run.clone())).collect();
    }),
    spoiled("a robot that never moves", Fatal("never_moves"), |f| each(f, rest)),
    spoiled("two rows", Fatal("too_little_data"), |f| {
        f.runs.truncate(1);
        shorten(f, 2);
    }),
    spoiled("a third of a second a run", Fatal("too_little_data"), |f| shorten(f, 66)),
    spoiled("spikes of 65535 in the currents", Slight("glitches"), |f| {
        change(f, "i", Some(2), |row, i| if row % 97 == 13 { 65535.0 } else { i })
    }),
    spoiled("one row of a wheel speed at 400 rad/s", Slight("glitches"), |f| {
        change(f, "w", Some(0), |row, w| if row == 211 { 400.0 } else { w })
    }),
    spoiled("the pose jumps 5 m away for one frame", Slight("glitches"), |f| {
        each(f, |run| {
            let at = channels(run, "pose")[0].present().nth(20).expect("twenty frames").0;
            let x = &mut channels(run, "pose")[0];
            *x = x.map(|row, x| if row == at { x + 5.0 } else { x });
        });
    }),
    spoiled("a pose-only log", Fatal("nothing_drives_the_model"), |f| {
        each(f, |run| (run.u, run.i, run.w) = (None, None, None));
    }),
    spoiled("voltages alone", Fatal("nothing_to_compare"), |f| {
        each(f, |run| (run.i, run.w, run.pose) = (None, None, None));
    }),
    spoiled("millivolts", Fatal("wrong_unit"), |f| change(f, "u", None, |_, u| 1000.0 * u)),
    spoiled("wheels 0 and 1 swapped", Fatal("swapped_wheels"), |f| each(f, |run| channels(run, "w").swap(0, 1))),
    spoiled("encoders 50 ms late", Nothing, |f| each(f, |run| late(run, "w", 10))),
    spoiled("encoders and currents stamped 0.3 s early", Fatal("shifted_signals"), |f| {
        each(f, |run| ["w", "i"].into_iter().for_each(|group| late(run, group, -60)));
    }),
    spoiled("camera frames stamped 0.5 s early", Fatal("shifted_signals"), |f| {
        each(f, |run| late(run, "pose", -100));
    }),
];
