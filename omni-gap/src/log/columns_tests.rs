use super::super::channel::Missing;
use super::super::run::Run;
use super::*;

fn read(mapping: &str, log: &str, wheels: usize) -> Result<(Run, Vec<String>)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("exp.any");
    std::fs::write(&path, log).unwrap();
    Run::load(&path, wheels, Some(&Columns::parse(mapping, Path::new("columns.toml"))?))
}

const ROBOTINO: &str = include_str!("../../robots/robotino/columns.toml");
const SSL2018: &str = include_str!("../../robots/ssl2018/columns.toml");

/// The TOML blocks of the page above.
fn blocks() -> Vec<&'static str> {
    include_str!("columns.md").split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

#[test]
fn the_page_shows_what_the_examples_say() {
    let read = |text: &str| Columns::parse(text, Path::new("columns.toml")).unwrap();
    let blocks = blocks();
    assert_eq!(blocks.len(), 7);
    read(blocks[0]);
    read(blocks[1]);
    assert_eq!(read(blocks[2]).parts.len(), 3);
    assert_eq!(read(blocks[3]).parts.len(), 2);
    assert_eq!(read(blocks[4]), read(ROBOTINO));
    assert_eq!(read(blocks[5]), read(SSL2018));
    assert_eq!(read(blocks[6]).parts.len(), 2);
}

#[test]
fn a_semicolon_table_with_three_header_lines_and_a_camera_is_read() {
    let log = "Time;Set 1;\nms;rad/s;\n\
        t;m1setvel;m2setvel;m3setvel;m1pos;m1vel;m2vel;m3vel;m1cur;m2cur;m3cur;xpos;ypos;ang;\n\
        0.5;-32;0;32;0;0;0;0;0;0;0;1000;500;350;\n\
        32.5;-32;0;32;-7;-16;0;16;0.25;0;0.5;1000;400;10;\n";
    let (run, notices) = read(ROBOTINO, log, 3).unwrap();
    assert_eq!(run.t_s, [0.0005, 0.0325]);
    let w = run.w.unwrap();
    assert_eq!((w.channels[0].get(1), w.channels[2].get(1)), (Ok(-1.0), Ok(1.0)));
    assert_eq!(run.wset.unwrap().channels[0].get(0), Ok(-2.0));
    let i = run.i.unwrap();
    assert!(i.unsigned && i.quantum == Some(0.025641));
    let pose = run.pose.unwrap();
    let moved_m = pose.channels[1].get(1).unwrap() - pose.channels[1].get(0).unwrap();
    assert!((moved_m - 0.18372).abs() < 1e-9, "up the picture is +y");
    let turned_rad = pose.channels[2].get(1).unwrap() - pose.channels[2].get(0).unwrap();
    assert!((turned_rad - 20f64.to_radians()).abs() < 1e-9, "350 degrees to 10 degrees is 20 degrees on");
    assert!(notices.contains(&"columns that the mapping leaves out: `m1pos`".to_string()), "{notices:?}");
}

#[test]
fn integers_without_a_header_become_speeds_volts_and_a_clock() {
    let log = "0, 0, 0, 0, 4, 4, 3, 3, 360, -20998\n6144, -3072, 0, 0, 512, -512, 3, 3, 720, 1270\n";
    let (run, _) = read(SSL2018, log, 4).unwrap();
    assert_eq!(run.t_s[0], 0.0);
    assert!((run.t_s[1] - 0.01).abs() < 1e-12);
    let w = run.w.unwrap();
    assert!((w.channels[0].get(1).unwrap() - std::f64::consts::TAU / 0.01).abs() < 1e-9);
    assert!((w.channels[1].get(1).unwrap() + std::f64::consts::PI / 0.01).abs() < 1e-9);
    assert_eq!(w.channels[0].get(0), Ok(0.0), "the first sample has its own length");
    let u = run.u.unwrap();
    assert_eq!((u.channels[0].get(1), u.channels[1].get(1)), (Ok(9.5), Ok(-9.5)));
}

#[test]
fn a_running_count_is_differenced_over_the_last_row_that_has_one() {
    let mapping = "[columns]\nt_s = { from = 1 }\nw0_rad_s = { from = \"p0\", counts_per_turn = 100, counts = \"position\", sign = -1 }\n\
        w1_rad_s = { from = \"p1\", counts_per_turn = 100, counts = \"position\" }\n\
        w2_rad_s = { from = \"p2\", counts_per_turn = 100, counts = \"position\" }\n";
    let (run, _) = read(mapping, "t,p0,p1,p2\n0,0,0,0\n1,100,,0\n2,100,50,0\n", 3).unwrap();
    let w = run.w.unwrap();
    assert_eq!(w.channels[0].get(0), Err(Missing::Blank));
    assert!((w.channels[0].get(1).unwrap() + std::f64::consts::TAU).abs() < 1e-12);
    assert_eq!(w.channels[1].get(1), Err(Missing::Blank));
    assert!((w.channels[1].get(2).unwrap() - std::f64::consts::TAU / 4.0).abs() < 1e-12);
}

#[test]
fn each_mistake_in_a_mapping_has_its_line_and_its_mend() {
    let t = "[columns]\nt_s = { from = 1 }\n";
    let mistakes = [
        ("separator = \"ab\"\n".to_string() + t, "columns.toml:1: column `separator`: expected one ASCII character"),
        ("seperator = \";\"\n".to_string() + t, "Did you mean `separator`?"),
        ("header = 1\n".to_string() + t, "expected true or false"),
        ("currents_sampled = \"during\"\n".to_string() + t, "expected \"before\" or \"after\""),
        ("files = \"*.csv\"\n".to_string() + t, "expected a list of file name patterns"),
        ("header = true\n".to_string(), "[columns] is missing"),
        (
            format!("{t}u0_mV = {{ from = 2 }}\n"),
            "columns.toml:3: column `u0_mV`: this is not a column of the run log. Did you mean `u0_V`?",
        ),
        (format!("{t}u0_V = {{ scale = 2 }}\n"), "`from` is missing"),
        (format!("{t}u0_V = {{ from = 0 }}\n"), "Positions are counted from 1"),
        (format!("header = false\n{t}u0_V = {{ from = \"a\" }}\n"), "but the log has no header"),
        (format!("{t}u0_V = {{ from = 2, unit = \"mA\" }}\n"), "`mA` is not a unit for u0_V. Known here: V, mV"),
        (format!("{t}u0_V = {{ from = 2, sign = 2 }}\n"), "found 2, expected 1 or -1"),
        (format!("{t}u0_V = {{ from = 2, scale = 0 }}\n"), "expected a factor other than zero"),
        (format!("{t}u0_V = {{ from = 2, counts_per_turn = 9 }}\n"), "u0_V is not a speed"),
        (format!("{t}w0_rad_s = {{ from = 2, counts = \"position\" }}\n"), "`counts_per_turn` is missing"),
        (format!("{t}w0_rad_s = {{ from = 2, running_sum = true }}\n"), "only time can be a running sum"),
        (format!("{t}[groups]\nw = {{ quantum = -1 }}\n"), "found -1, expected a number above zero"),
        (format!("{t}x_m = {{ from = \"xpos\" }}\n"), "the log has no column `xpos` for x_m; it has t, a"),
        (format!("{t}x_m = {{ from = 3 }}\n"), "the log has no column 3 for x_m"),
    ];
    for (mapping, expected) in mistakes {
        let told = read(&mapping, "t,a\n0,0\n1,0\n", 3).expect_err(expected).to_string();
        assert!(told.contains(expected), "expected: {expected}\n    told: {told}");
    }
}

#[test]
fn an_optional_column_may_be_missing() {
    let mapping = "[columns]\nt_s = { from = 1 }\nw0_rad_s = { from = 2 }\nw1_rad_s = { from = 2 }\nw2_rad_s = { from = 2 }\n\
        gyro_rad_s = { from = \"g\", optional = true }\n";
    let (run, notices) = read(mapping, "t,a\n0,0\n1,0\n", 3).unwrap();
    assert!(run.gyro.is_none() && notices[0].ends_with("no column `g` for gyro_rad_s"), "{notices:?}");
}

#[test]
fn a_column_is_computed_of_others_and_a_mistake_in_that_is_told() {
    let mapping = |expr: &str| {
        format!(
            "[columns]\nt_s = {{ from = \"t\" }}\nw0_rad_s = {{ expr = {expr:?}, unit = \"rpm\" }}\nw1_rad_s = {{ from = \"a\" }}\nw2_rad_s = {{ from = \"a\" }}\n"
        )
    };
    let log = "t,a,b [V]\n0,1,2\n1,3,\n";
    let (run, _) = read(&mapping("a * {b [V]} * 30 / PI"), log, 3).unwrap();
    let made = &run.w.as_ref().unwrap().channels[0];
    assert!((made.get(0).unwrap() - 2.0).abs() < 1e-12 && made.get(1).is_err());
    for (expr, told) in
        [("a * c", "no column `c` for w0_rad_s"), ("a *", "this is no formula"), ("2", "no column is named")]
    {
        let said = read(&mapping(expr), log, 3).unwrap_err().to_string();
        assert!(said.contains(told) && said.contains("expr"), "{said}");
    }
    let both = "[columns]\nt_s = { from = \"t\", expr = \"a\" }\n";
    assert!(read(both, log, 3).unwrap_err().to_string().contains("Keep one of the two"));
}
