//! Paths in files that would lead out of the folder they stand in. Nothing is ever unpacked onto the disk; what names files is the list of a
//! recording that was split, and a mapping.

use std::io;

use super::fault::Fault;
use super::outcome::{Outcome, refused};
use super::scene::{RUN, Scene};

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "paths out of an archive: a split recording that lists `../../robot.toml`", inject: a_part_above },
    Fault { what: "paths out of an archive: a split recording that lists `/etc/passwd`", inject: a_part_from_the_root },
    Fault {
        what: "paths out of an archive: a split recording that lists `..`",
        inject: a_part_that_is_the_folder_above,
    },
    Fault {
        what: "paths out of an archive: a mapping that names `../../other.csv`",
        inject: a_file_of_a_mapping_above,
    },
];

fn listing(scene: &Scene, path: &str) -> io::Result<()> {
    let list = format!("rosbag2_bagfile_information:\n  relative_file_paths:\n    - {path}\n");
    scene.write("session/runs/drive/metadata.yaml", list.as_bytes()).map(drop)
}

fn a_part_above(scene: &Scene) -> io::Result<Outcome> {
    listing(scene, "../../robot.toml")?;
    refused(scene, &scene.check(), &["metadata.yaml: lists `robot.toml`, which is not in the folder"])
}

fn a_part_from_the_root(scene: &Scene) -> io::Result<Outcome> {
    listing(scene, "/etc/passwd")?;
    refused(scene, &scene.check(), &["metadata.yaml: lists `passwd`, which is not in the folder"])
}

fn a_part_that_is_the_folder_above(scene: &Scene) -> io::Result<Outcome> {
    listing(scene, "..")?;
    refused(scene, &scene.check(), &["metadata.yaml: expected a list of files"])
}

fn a_file_of_a_mapping_above(scene: &Scene) -> io::Result<Outcome> {
    let run = scene.read(RUN)?;
    scene.write("session/other.csv", run.as_bytes())?;
    scene.write("session/runs/drive/notes.txt", b"where is it?\n")?;
    scene.write("session/columns.toml", b"[[file]]\nname = \"../../other.csv\"\n")?;
    refused(
        scene,
        &scene.asked(&["check", "--columns", "session/columns.toml", "session"]),
        &["session/", "../../other.csv"],
    )
}
