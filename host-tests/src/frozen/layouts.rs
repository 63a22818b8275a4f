//! Recordings in the layouts of two real robots' makers: made here, and read through the mappings in `examples/`.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use model_core::plant::Input;
use omni_gap::error::{Error, Result};
use omni_gap::log::{RobotFile, Run, write_whole};
use omni_gap::simulate::{Excitation, Model, SensorSetup, excite, record};
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Session, known_effects};

/// A layout that `examples/` has a mapping for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Three header lines, semicolons, milliseconds, pixels and degrees; commanded wheel speeds.
    Robotino,
    /// No header, integers: counts, duties and sample lengths.
    Ssl2018,
}

impl Layout {
    /// Its folder in `examples/`.
    pub fn example(self) -> &'static str {
        match self {
            Layout::Robotino => "robotino",
            Layout::Ssl2018 => "ssl2018",
        }
    }

    /// A robot that is what the example's file says, recorded, written down in the layout and read again.
    ///
    /// # Errors
    /// Where a file cannot be written, or is not read as it was meant.
    pub fn session(self, seed: u64) -> Result<Session> {
        let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(self.example());
        let robot = example.join("robot.toml");
        let unreadable = |why: std::io::Error| Error::input(&robot, why.to_string(), "Check the tree");
        let text = std::fs::read_to_string(&robot).map_err(unreadable)?;
        let runs = match self {
            Layout::Robotino => by_set_speed(&RobotFile::parse(&text, &robot, &known_effects())?, seed),
            Layout::Ssl2018 => {
                let plan = Scenario { runs: 6, duration: 4.0, rate: 200.0, seed, ..Scenario::default() };
                synthesize(&text, &plan, &known_effects())?.runs
            }
        };
        let folder = tempfile::tempdir().map_err(|why| Error::output(Path::new("."), why.to_string(), "Free space"))?;
        let mut paths: Vec<PathBuf> = Vec::new();
        for (k, run) in runs.iter().enumerate() {
            let (name, text) = match self {
                Layout::Robotino => (format!("exp{k:02}.csv"), robotino(run)),
                Layout::Ssl2018 => (format!("excite_{k}"), ssl2018(run)),
            };
            paths.push(folder.path().join(name));
            write_whole(&paths[k], text.as_bytes())?;
        }
        Session::load_from(&robot, Some(&example.join("columns.toml")), &paths, &known_effects())
    }
}

/// Runs of a robot whose drive follows its set speeds exactly, about as many rows a second as the makers' logs have.
fn by_set_speed(robot: &RobotFile, seed: u64) -> Vec<Run> {
    const RATE: f64 = 32.0;
    let model = Model::<3>::nominal(robot, 24.0);
    let plant = model.plant();
    let how = SensorSetup { sensors: robot.sensors, ..SensorSetup::default() };
    // no more than three fifths of the speed at which the motors' own voltage leaves nothing of 20 V
    let wish = Excitation { duration: 4.0, rate: RATE, voltage: 0.6 * 20.0 / robot.volts_per_wheel_speed() };
    (0..6)
        .map(|k| {
            let speeds = excite(&model.robot().wheels, &wish, seed + 100 * k);
            let t: Vec<f64> = (0..speeds.len()).map(|row| row as f64 / RATE).collect();
            let input: Vec<Input<3, f64>> = speeds.into_iter().map(Input::Speed).collect();
            record(&plant, &format!("run{k:02}"), &t, &input, &how, seed + 100 * k + 1)
        })
        .collect()
}

/// A sample of channel `k` of a group, where there is one.
fn sample(group: &Option<omni_gap::log::Group>, k: usize, row: usize) -> Option<f64> {
    group.as_ref().and_then(|group| group.channels[k].get(row).ok())
}

/// Speeds on the motor side of a gear of 16; a camera that looks down, y turned over.
fn robotino(run: &Run) -> String {
    let mut text =
        "Time;...\nms;...\nt;m1setvel;m2setvel;m3setvel;m1vel;m2vel;m3vel;m1cur;m2cur;m3cur;xpos;ypos;ang\n".to_owned();
    let quantized = |x: f64, quantum: f64| (x / quantum).round() * quantum;
    for (row, t) in run.t_s.iter().enumerate() {
        let speeds = |group| (0..3).map(move |j| 16.0 * sample(group, j, row).unwrap_or(0.0));
        let currents = (0..3).map(|j| sample(&run.i, j, row).unwrap_or(0.0).abs());
        let mut fields = vec![1e3 * t];
        fields.extend(speeds(&run.wset).map(|w| quantized(w, 0.1)));
        fields.extend(speeds(&run.w).map(|w| quantized(w, 2.83)));
        fields.extend(currents.map(|i| quantized(i, 0.025641)));
        text += &fields.iter().map(f64::to_string).collect::<Vec<_>>().join(";");
        match [0, 1, 2].map(|k| sample(&run.pose, k, row)) {
            [Some(x), Some(y), Some(theta)] => {
                let turned = (theta - TAU / 4.0).to_degrees().rem_euclid(360.0);
                let _ = writeln!(text, ";{:.3};{:.3};{turned:.3}", x / 1.8405e-3, -y / 1.8372e-3);
            }
            _ => text += ";;;\n",
        }
    }
    text
}

/// Encoder counts of each sample, duties, the sample's length in the logger's ticks, and a gyro that is not usable.
fn ssl2018(run: &Run) -> String {
    let mut text = String::new();
    let (tick, per_turn) = (256.0 / 18.432e6, 6144.0);
    let mut left = [0.0; 4];
    for row in 0..run.rows() {
        let length = run.t_s.get(row + 1).map_or(0.005, |next| next - run.t_s[row]);
        for (j, left) in left.iter_mut().enumerate() {
            *left += sample(&run.w, j, row).unwrap_or(0.0) * length / TAU * per_turn;
            let counts = left.trunc();
            *left -= counts;
            let _ = write!(text, "{counts}, ");
        }
        for j in 0..4 {
            let duty = sample(&run.u, j, row).unwrap_or(0.0) * 1024.0 / 19.0;
            let _ = write!(text, "{}, ", duty.round());
        }
        let _ = writeln!(text, "{}, {}", (length / tick).round(), (row * 7919) % 4001);
    }
    text
}
