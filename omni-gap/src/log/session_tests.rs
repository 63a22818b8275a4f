use super::super::robot_read::tests::GOOD;
use super::*;

const LOG: &str = "t_s,w0_rad_s,w1_rad_s,w2_rad_s\n0,1,2,3\n0.1,1,2,3\n";

fn session(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

fn load(files: &[(&str, &str)]) -> Result<Session> {
    Session::load(session(files).path(), None, &Catalogue::default())
}

#[test]
fn a_folder_is_read_in_the_order_of_names() {
    let files = [
        ("robot.toml", GOOD),
        ("runs/b.csv", LOG),
        ("runs/a.csv", LOG),
        ("runs/notes.txt", "hm"),
        ("heldout/c.csv", LOG),
    ];
    let session = load(&files).unwrap();
    let names: Vec<&str> = session.runs.iter().chain(&session.heldout).map(|run| run.name.as_str()).collect();
    assert_eq!(names, ["a", "b", "c"]);
    assert_eq!(session.robot_text, GOOD);
    assert!(session.notices.len() == 1 && session.notices[0].ends_with("notes.txt: not a run log, left out"));
}

#[test]
fn a_mapping_in_the_folder_is_used() {
    let mapping = "files = [\"*.log\"]\n[columns]\nt_s = { from = \"t\" }\nw0_rad_s = { from = 2 }\nw1_rad_s = { from = 3 }\nw2_rad_s = { from = 4 }\n";
    let files = [
        ("robot.toml", GOOD),
        ("columns.toml", mapping),
        ("runs/a.log", "t,a,b,c\n0,1,2,3\n1,1,2,3\n"),
        ("runs/a.csv", LOG),
    ];
    let session = load(&files).unwrap();
    assert_eq!((session.runs.len(), session.runs[0].t_s[1]), (1, 1.0));
}

#[test]
fn parts_may_lie_anywhere_and_equal_names_are_told_apart() {
    let folder = session(&[("nominal.toml", GOOD), ("x/a.csv", LOG), ("y/a.csv", LOG)]);
    let at = |name: &str| folder.path().join(name);
    let session =
        Session::load_from(&at("nominal.toml"), None, &[at("x"), at("y/a.csv")], &Catalogue::default()).unwrap();
    let names: Vec<&str> = session.runs.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(names, ["x/a.csv", "y/a.csv"]);
}

#[test]
fn what_is_missing_is_named() {
    let told = |files: &[(&str, &str)]| load(files).unwrap_err().to_string();
    assert!(told(&[("runs/a.csv", LOG)]).contains("robot.toml: no such file, expected a robot file"));
    assert!(told(&[("robot.toml", GOOD)]).contains("runs: there is no such folder"));
    assert!(told(&[("robot.toml", GOOD), ("runs/a.txt", LOG)]).contains("runs: there is no run log in the folder"));
    let nowhere = Session::load(Path::new("no/such/folder"), None, &Catalogue::default()).unwrap_err().to_string();
    assert!(nowhere.contains("no such folder"));
    let folder = session(&[("file", "")]);
    let file = Session::load(&folder.path().join("file"), None, &Catalogue::default()).unwrap_err().to_string();
    assert!(file.contains("this is a file, expected a session folder"));
}

#[test]
fn the_example_robots_are_sound() {
    for (text, wheels) in
        [(include_str!("../../robots/robotino/robot.toml"), 3), (include_str!("../../robots/ssl2018/robot.toml"), 4)]
    {
        let robot = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        assert_eq!(robot.wheel.len(), wheels);
    }
}
