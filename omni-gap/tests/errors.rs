//! An error can be matched: every kind of mistake, made in a sound session.

use std::fs;
use std::path::Path;

use omni_gap::api::{Error, Session, known_effects};
use omni_gap::error::InputKind;

const ROBOT: &str = include_str!("../robots/feup-3w/robot.toml");
const RUN: &str = "t_s,w0_rad_s,w1_rad_s,w2_rad_s\n0.0,1.0,1.0,1.0\n0.1,1.0,1.0,1.0\n";

/// What loading says of a session with one file of it replaced (`None`: taken away).
fn after(file: &str, text: Option<&[u8]>) -> Result<Session, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("runs")).expect("a folder");
    fs::write(at("robot.toml"), ROBOT).expect("it can be written");
    fs::write(at("runs/run.csv"), RUN).expect("it can be written");
    match text {
        Some(text) => fs::write(at(file), text).expect("it can be written"),
        None => fs::remove_file(at(file)).expect("it is there"),
    }
    Session::load(folder.path(), None, &known_effects())
}

#[test]
fn the_session_is_sound_before_it_is_spoiled() {
    assert_eq!(after("robot.toml", Some(ROBOT.as_bytes())).map(|session| session.runs.len()), Ok(1));
}

#[test]
fn every_mistake_has_its_kind_and_its_file() {
    let robot = |from: &str, to: &str| {
        assert!(ROBOT.contains(from), "{from}");
        ROBOT.replacen(from, to, 1).into_bytes()
    };
    let cases: [(InputKind, &str, Option<Vec<u8>>); 13] = [
        (InputKind::NotFound, "robot.toml", None),
        (InputKind::Malformed, "robot.toml", Some(b"name = ".to_vec())),
        (InputKind::Malformed, "robot.toml", Some(b"name = \"\xff\"".to_vec())),
        (InputKind::Newer, "robot.toml", Some(robot("schema = 1", "schema = 9"))),
        (InputKind::Missing, "robot.toml", Some(robot("mass_kg", "# mass_kg"))),
        (InputKind::Unknown, "robot.toml", Some(robot("mass_kg", "mass_g"))),
        (InputKind::Unknown, "robot.toml", Some(robot("[body]", "[effects.corioli]\n[body]"))),
        (InputKind::Invalid, "robot.toml", Some(robot("mass_kg = ", "mass_kg = -"))),
        (InputKind::Conflict, "robot.toml", Some(robot("drive_angle_deg = 270.0", "drive_angle_deg = 150.0"))),
        (InputKind::Malformed, "runs/run.csv", Some([RUN.as_bytes(), b"0.2,1.0\n"].concat())),
        (InputKind::Missing, "runs/run.csv", Some(b"t_s,w0_rad_s,w1_rad_s\n0,1,1\n1,1,1\n".to_vec())),
        (InputKind::Conflict, "runs/run.csv", Some(b"t_s,x,x\n0,1,1\n".to_vec())),
        (InputKind::TooLittle, "runs/run.csv", Some(RUN.as_bytes()[..RUN.len() / 2].to_vec())),
    ];
    for (kind, file, text) in cases {
        let shown = text.as_deref().map(String::from_utf8_lossy).map(|text| text.into_owned());
        match after(file, text.as_deref()) {
            Err(Error::Input { kind: found, file: named, .. }) => {
                assert_eq!(found, kind, "{shown:?}");
                assert!(named.ends_with(Path::new(file)), "{} for {file}", named.display());
            }
            other => panic!("{kind:?}: {other:?}"),
        }
    }
}

#[test]
fn a_folder_for_a_file_is_unreadable() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir_all(folder.path().join("robot.toml")).expect("a folder");
    let told = Session::load(folder.path(), None, &known_effects()).map(|_| ()).map_err(|why| why.input_kind());
    assert_eq!(told, Err(Some(InputKind::Unreadable)));
}
