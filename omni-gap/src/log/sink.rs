//! Runs out of the house: as CSV, Parquet or MCAP, by what a file's name ends in.

mod mcap;
mod parquet;

use std::path::Path;

use super::run::Run;
use super::source::{MCAP, PARQUET, ends_in};
use super::write::{write_whole, write_whole_with};
use crate::error::{Error, Result};

/// Writes a run: as MCAP where the name ends in `.mcap`, as Parquet where it ends in `.parquet`, else as CSV.
///
/// # Errors
/// Where the file cannot be written; nothing is left of it then.
pub fn write_run(path: &Path, run: &Run) -> Result<()> {
    if holds_several(path) {
        write_runs(path, &[("", run)])
    } else if ends_in(path, &[PARQUET]) {
        write_bytes(path, parquet::bytes(run))
    } else {
        write_whole_with(path, |out| run.write_csv(out))
    }
}

/// Whether a file of this name holds runs beside each other.
pub fn holds_several(path: &Path) -> bool {
    ends_in(path, &[MCAP])
}

/// Writes runs beside each other as MCAP, the topics of each below its name.
///
/// # Errors
/// Where the file cannot be written; nothing is left of it then.
pub fn write_runs(path: &Path, runs: &[(&str, &Run)]) -> Result<()> {
    write_bytes(path, mcap::bytes(runs))
}

/// Writes a session: the robot file, and its runs as CSV beside each other in `runs/`; the folder is made if need be.
///
/// # Errors
/// Where a folder or file cannot be made.
pub fn write_session(folder: &Path, robot_text: &str, runs: &[Run]) -> Result<()> {
    let within = folder.join("runs");
    std::fs::create_dir_all(&within)
        .map_err(|why| Error::output(&within, why.to_string(), "Name another folder with --out"))?;
    write_whole(&folder.join("robot.toml"), robot_text.as_bytes())?;
    runs.iter().try_for_each(|run| write_run(&within.join(format!("{}.csv", run.name)), run))
}

fn write_bytes(path: &Path, bytes: std::result::Result<Vec<u8>, String>) -> Result<()> {
    let bytes = bytes.map_err(|reason| Error::output(path, reason, "Write it as .csv"))?;
    write_whole(path, &bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Channel, Group, Missing};

    /// Two rows of a run with a hole.
    fn run() -> Run {
        let mut x = Channel::from_values([0.25]);
        x.push_missing(Missing::Blank);
        let pose = Group::new(vec![x, Channel::from_values([1.0, 2.0]), Channel::from_values([0.0, -0.5])]);
        Run {
            t_s: vec![0.0, 0.01],
            i: Some(Group::from_columns(vec![vec![0.5, 0.75]; 3])),
            pose: Some(pose),
            ..Run::default()
        }
    }

    #[test]
    fn a_run_comes_back_from_parquet_with_its_hole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.parquet");
        write_run(&path, &run()).unwrap();
        let (read, _) = Run::load(&path, 3, None).unwrap();
        assert_eq!(read.t_s, run().t_s);
        assert_eq!(read.i, run().i);
        let pose = read.pose.unwrap();
        assert_eq!((pose.channels[0].get(0), pose.channels[0].get(1).is_err()), (Ok(0.25), true));
    }

    #[test]
    fn topics_of_an_mcap_hold_what_was_measured_and_leave_out_what_was_not() {
        let run = run();
        let bytes = mcap::bytes(&[("measured", &run), ("predicted", &run)]).unwrap();
        let mut said: Vec<(String, u64, serde_json::Value)> = Vec::new();
        for message in ::mcap::MessageStream::new(&bytes).unwrap() {
            let message = message.unwrap();
            said.push((
                message.channel.topic.clone(),
                message.log_time,
                serde_json::from_slice(&message.data).unwrap(),
            ));
        }
        assert_eq!(said.len(), 8);
        let pose = said.iter().find(|(topic, time, _)| topic == "/predicted/pose" && *time == 10_000_000).unwrap();
        assert_eq!(pose.2, serde_json::json!({"y_m": 2.0, "theta_rad": -0.5}));
    }

    #[test]
    fn a_place_that_cannot_be_written_to_is_named() {
        for name in ["no/run.mcap", "no/run.parquet", "no/run.csv"] {
            let said = write_run(Path::new(name), &run()).unwrap_err().to_string();
            assert!(said.contains("there is no folder no"), "{said}");
        }
    }
}
