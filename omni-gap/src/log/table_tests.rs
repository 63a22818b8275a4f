use super::{Channel, Missing, RobotFile, Run, Session, Table};
use crate::error::InputKind;
use crate::known_effects;
use std::path::Path;

const ROBOT: &str = include_str!("../../robots/feup-3w/robot.toml");

/// Three rows of a robot with three wheels; a sample is missing, and the heading runs over half a turn.
const COLUMNS: [(&str, [f64; 3]); 10] = [
    ("t_s", [0.0, 0.01, 0.02]),
    ("u0_V", [0.1, 1.0 / 3.0, -2.5]),
    ("u1_V", [0.0, 1e-3, 6.0]),
    ("u2_V", [0.0, -1.0, 0.7]),
    ("w0_rad_s", [0.0, f64::NAN, 0.123456789012345]),
    ("w1_rad_s", [0.0, 0.1, 0.2]),
    ("w2_rad_s", [0.0, -0.1, -0.2]),
    ("x_m", [0.0, f64::NAN, 0.5]),
    ("y_m", [0.0, f64::NAN, 0.5]),
    ("theta_rad", [3.1, f64::NAN, -3.1]),
];

fn table(columns: &[(&str, [f64; 3])]) -> Table {
    let mut table = Table::new("run00");
    for (name, values) in columns {
        table.add(name, values.iter().map(|x| (!x.is_nan()).then_some(*x))).unwrap();
    }
    table
}

/// The same numbers as a file.
fn written(folder: &Path) -> std::path::PathBuf {
    let cell = |x: f64| if x.is_nan() { String::new() } else { x.to_string() };
    let header = COLUMNS.map(|(name, _)| name).join(",");
    let rows = (0..3).map(|row| COLUMNS.map(|(_, values)| cell(values[row])).join(","));
    let text: Vec<String> = std::iter::once(header).chain(rows).collect();
    let path = folder.join("run00.csv");
    std::fs::write(&path, text.join("\n")).unwrap();
    path
}

#[test]
fn a_table_becomes_the_run_that_a_file_of_the_same_numbers_becomes() {
    let folder = tempfile::tempdir().unwrap();
    let (of_file, told_of_file) = Run::load(&written(folder.path()), 3, None).unwrap();
    let (run, told) = Run::of_table(table(&COLUMNS), 3, None).unwrap();
    assert!(run.path.as_os_str().is_empty(), "it came from no file");
    assert_eq!((told, run.line_of(2)), (told_of_file, of_file.line_of(2)));
    assert_eq!(run, Run { path: run.path.clone(), first_line: None, ..of_file });
    let heading = &run.pose.unwrap().channels[2];
    assert_eq!(heading.get(1), Err(Missing::Blank));
    assert!(heading.get(2).unwrap() > 3.1, "unwrapped as a file's is");
}

#[test]
fn a_session_takes_tables_and_files_alike() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Session::of_robot(ROBOT, Path::new("robot.toml"), &known_effects()).unwrap();
    session.add_tables([table(&COLUMNS)], None).unwrap();
    session.add_files(&[written(folder.path())], None).unwrap();
    let channels = |run: &Run| run.signals().into_iter().map(|(_, channel)| channel.clone()).collect::<Vec<Channel>>();
    assert_eq!(session.runs.len(), 2);
    assert_eq!(channels(&session.runs[0]), channels(&session.runs[1]));
    let robot = RobotFile::parse(ROBOT, Path::new("robot.toml"), &known_effects()).unwrap();
    assert_eq!((session.robot, session.robot_text.as_str()), (robot, ROBOT));
}

#[test]
fn what_is_no_column_of_its_table_is_told_with_its_place() {
    let mut begun = table(&COLUMNS[..2]);
    let told = begun.add("u1_V", [Some(1.0); 4]).unwrap_err();
    assert_eq!(told.input_kind(), Some(InputKind::Malformed));
    let expected = "run00: column `u1_V`: found 4 rows, expected 3, as many as `t_s` has. ";
    assert!(told.to_string().starts_with(expected), "{told}");
    let told = begun.add("u1_V", [Some(1.0), Some(f64::INFINITY), None]).unwrap_err();
    assert!(
        told.to_string().starts_with("run00: column `u1_V`: row 2: found `inf`, expected a finite number"),
        "{told}"
    );
    assert_eq!(begun.add("t_s", [None; 3]).unwrap_err().input_kind(), Some(InputKind::Conflict));
    assert!(!begun.has("u1_V"), "what was refused is not there");
}

#[test]
fn a_table_is_refused_for_what_a_file_is_refused_for() {
    let mut without_a_wheel = COLUMNS.to_vec();
    without_a_wheel.remove(3);
    let told = Run::of_table(table(&without_a_wheel), 3, None).unwrap_err();
    assert!(told.to_string().starts_with("run00: column `u2_V`: the column is missing: 2 of 3 wheels"), "{told}");
    let mut back = COLUMNS;
    back[0].1 = [0.0, 0.02, 0.01];
    let told = Run::of_table(table(&back), 3, None).unwrap_err().to_string();
    assert!(told.starts_with("run00: column `t_s`: row 3: found 0.01 s after 0.02 s"), "{told}");
    assert!(Run::of_table(Table::new("empty"), 3, None).unwrap_err().to_string().contains("at least two"));
}

#[test]
fn text_is_left_out_with_a_notice_and_refused_where_numbers_are_asked_for() {
    let mut noted = table(&[]);
    noted.add_other("remark", "text").unwrap();
    for (name, values) in COLUMNS {
        noted.add(name, values.iter().map(|x| (!x.is_nan()).then_some(*x))).unwrap();
    }
    let (_, notices) = Run::of_table(noted, 3, None).unwrap();
    assert_eq!(notices, ["run00: columns left out: `remark`"]);
    let mut spoken = table(&COLUMNS[..3]);
    spoken.add_other("u2_V", "text").unwrap();
    let told = Run::of_table(spoken, 3, None).unwrap_err().to_string();
    assert_eq!(
        told,
        "run00: column `u2_V`: it holds text, expected numbers. Make numbers of it, or name another column"
    );
}
