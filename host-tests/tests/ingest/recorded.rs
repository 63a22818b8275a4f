//! A robot that is recorded by two files, each with a clock of its own.

use std::path::Path;

use host_tests::catalogue::sessions::truth;
use model_core::plant::Input;
use omni_gap::known_effects;
use omni_gap::log::{Channel, Group, Missing, RobotFile, Run, write_whole, write_whole_with};
use omni_gap::simulate::{EffectInstance, Excitation, Model, SensorSetup, excite, record};

/// How the two files are recorded.
#[derive(Clone, Copy, Debug)]
pub struct Clocks {
    /// Rows a second of the drive [1/s]
    pub drive_hz: f64,
    /// Frames a second of the camera [1/s]
    pub camera_hz: f64,
    /// How long after a row of the drive the first frame is taken [s]
    pub camera_after_s: f64,
    /// What the camera's clock says less when the drive's says zero [s]
    pub camera_clock_s: f64,
}

impl Default for Clocks {
    fn default() -> Self {
        Self { drive_hz: 100.0, camera_hz: 50.0, camera_after_s: 0.0037, camera_clock_s: 0.0 }
    }
}

/// A columns.toml for the two files; `offset` is what stands behind `offset_s =`.
pub fn columns(offset: &str) -> String {
    format!("[[file]]\nname = \"drive.csv\"\n\n[[file]]\nname = \"camera.csv\"\noffset_s = {offset}\n")
}

/// One run as both files have it.
pub struct Recorded {
    pub drive: Run,
    pub camera: Run,
}

/// Runs of a robot with four wheels that is what its file says but for these effects.
pub fn runs(clocks: Clocks, hidden: &[EffectInstance], seconds: f64, count: u64) -> Vec<Recorded> {
    let robot = robot();
    let mut model = Model::<4>::nominal(&robot, 12.0);
    for effect in hidden {
        model.add_effect(effect.clone());
    }
    let plant = model.plant();
    let wish = Excitation { duration: seconds, rate: clocks.drive_hz, voltage: 8.0 };
    (0..count)
        .map(|k| {
            let volts = excite(&model.robot().wheels, &wish, 8100 + k);
            let rows = (0..volts.len()).map(|row| (row as f64 / clocks.drive_hz, true));
            let frames = (0..(seconds * clocks.camera_hz) as usize - 1)
                .map(|frame| (clocks.camera_after_s + frame as f64 / clocks.camera_hz, false));
            let mut instants: Vec<(f64, bool)> = rows.chain(frames).collect();
            instants.sort_by(|a, b| a.0.total_cmp(&b.0));
            let t: Vec<f64> = instants.iter().map(|(t, _)| *t).collect();
            let held = |t: f64| Input::Voltage(volts[((t * clocks.drive_hz + 1e-6) as usize).min(volts.len() - 1)]);
            let input: Vec<_> = t.iter().map(|t| held(*t)).collect();
            let how = SensorSetup {
                camera_rate: 1e9,
                dropouts: 0.0,
                sensors: robot.sensors,
                steps_a_row: 20,
                ..SensorSetup::default()
            };
            let run = record(&plant, "run", &t, &input, &how, 8200 + k);
            let of =
                |is_drive: bool| -> Vec<usize> { (0..t.len()).filter(|row| instants[*row].1 == is_drive).collect() };
            let (drive, camera) = (of(true), of(false));
            let on = |group: &Option<Group>, rows: &[usize]| {
                let pick = |channel: &Channel| rows.iter().map(|row| channel.get(*row)).collect();
                group.as_ref().map(|group| Group::new(group.channels.iter().map(pick).collect()))
            };
            let times = |rows: &[usize], by: f64| rows.iter().map(|row| t[*row] + by).collect();
            Recorded {
                drive: Run {
                    t_s: times(&drive, 0.0),
                    u: on(&run.u, &drive),
                    i: on(&run.i, &drive),
                    w: on(&run.w, &drive),
                    ..Run::default()
                },
                camera: Run {
                    t_s: times(&camera, -clocks.camera_clock_s),
                    pose: on(&run.pose, &camera),
                    ..Run::default()
                },
            }
        })
        .collect()
}

/// The robot of these runs.
pub fn robot() -> RobotFile {
    RobotFile::parse(truth(4), "robot.toml".as_ref(), &known_effects()).expect("an example is a sound robot file")
}

/// Writes a session of such runs, a folder each.
pub fn write_session(folder: &Path, columns: &str, runs: &[Recorded]) {
    write_whole(&folder.join("robot.toml"), truth(4).as_bytes()).unwrap();
    write_whole(&folder.join("columns.toml"), columns.as_bytes()).unwrap();
    for (k, run) in runs.iter().enumerate() {
        let path = folder.join(format!("runs/run{k}"));
        std::fs::create_dir_all(&path).unwrap();
        write_whole_with(&path.join("drive.csv"), |out| run.drive.write_csv(out)).unwrap();
        write_whole_with(&path.join("camera.csv"), |out| run.camera.write_csv(out)).unwrap();
    }
}

/// The run as one table has it: each frame on the row of the drive before it.
pub fn in_one_table(run: &Recorded) -> Run {
    let t = &run.drive.t_s;
    let pose = run.camera.pose.as_ref().expect("a camera's file has a pose");
    let mut one = run.drive.clone();
    let column = |axis: usize| -> Channel {
        let mut column = vec![Err(Missing::Blank); t.len()];
        for (frame, time) in run.camera.t_s.iter().enumerate() {
            column[t.partition_point(|t| t <= time).saturating_sub(1)] = pose.channels[axis].get(frame);
        }
        column.into_iter().collect()
    };
    one.pose = Some(Group::new((0..3).map(column).collect()));
    one
}

/// A table in two files by one clock: what the drive logged, and the rows that have a frame.
pub fn in_two_files(table: &Run) -> Recorded {
    let pose = table.pose.as_ref().expect("the table has a pose");
    let frames: Vec<usize> = pose.channels[0].present().map(|(row, _)| row).collect();
    let pick = |channel: &Channel| frames.iter().map(|row| channel.get(*row)).collect();
    Recorded {
        drive: Run { pose: None, ..table.clone() },
        camera: Run {
            t_s: frames.iter().map(|row| table.t_s[*row]).collect(),
            pose: Some(Group::new(pose.channels.iter().map(pick).collect())),
            ..Run::default()
        },
    }
}
