//! Runs that are folders of files: what is asked of them, and what is said of mistakes.

use crate::bench::{Bench, ROBOT};

const DRIVE: &str = "t_s,u0_V,u1_V,u2_V,u3_V,w0_rad_s,w1_rad_s,w2_rad_s,w3_rad_s\n";
const CAMERA: &str = "t_s,x_m,y_m,theta_rad\n";
const COLUMNS: &str = "[[file]]\nname = \"drive.csv\"\n\n[[file]]\nname = \"camera.csv\"\n";

/// Rows of `width` columns after the time, which goes in steps of 10 ms.
fn rows(width: usize, count: usize) -> String {
    let row = |k: usize| format!("{}{}\n", k as f64 * 0.01, format!(",{}", (k as f64 * 0.3).sin()).repeat(width));
    (0..count).map(row).collect()
}

/// A session whose one run is a folder of a drive's file and a camera's.
fn bench() -> Bench {
    let bench = Bench::empty();
    bench.write("s/robot.toml", ROBOT);
    bench.write("s/columns.toml", COLUMNS);
    bench.write("s/runs/a/drive.csv", &format!("{DRIVE}{}", rows(8, 40)));
    bench.write("s/runs/a/camera.csv", &format!("{CAMERA}{}", rows(3, 40)));
    bench
}

#[test]
fn every_mistake_has_one_message_that_says_where_and_how_to_mend_it() {
    let columns = |text: &str| ("s/columns.toml", text.to_owned());
    let offset = |value: &str| columns(&format!("{COLUMNS}offset_s = {value}\n"));
    let camera = |text: String| ("s/runs/a/camera.csv", text);
    let mistakes = [
        (
            columns("[[file]]\nname = \"imu.csv\"\n"),
            "s/runs/a: the run has no file `imu.csv`; it has camera.csv, drive.csv",
        ),
        (columns("[[file]]\nname = \"*.csv\"\n"), "s/runs/a: `camera.csv` and `drive.csv` both fit `*.csv`"),
        (
            columns("[[file]]\nname = \"drive.csv\"\n\n[[file]]\nname = \"d*\"\n"),
            "s/runs/a/drive.csv: the file fits `drive.csv` and `d*`",
        ),
        (columns("[[file]]\n"), "[[file]] 1 lacks `name`"),
        (
            columns("[file]\nname = \"drive.csv\"\n"),
            "s/columns.toml:1: column `file`: expected one table for each file",
        ),
        (
            columns("[[file]]\nname = \"a\"\n[[file]]\nname = \"a\"\n"),
            "s/columns.toml:4: column `name`: `a` stands in two [[file]] tables",
        ),
        (
            columns("[[file]]\nname = \"a\"\nofset_s = 1\n"),
            "s/columns.toml:3: column `ofset_s`: unknown key in [[file]] 1",
        ),
        (columns("[[file]]\nname = \"a\"\noffset_s = 1\n"), "column `offset_s`: the first file's clock is the one"),
        (offset("\"guess\""), "s/columns.toml:6: column `offset_s`: found \"guess\", expected seconds or \"estimate\""),
        (offset("true"), "column `offset_s`: found boolean, expected seconds or \"estimate\""),
        (offset("inf"), "column `offset_s`: found inf, expected a finite number"),
        (
            offset("100.0"),
            "s/runs/a/camera.csv: column `t_s`: its times, 100 s to 100.39 s, have nothing in common with 0 s",
        ),
        (
            camera(format!("{DRIVE}{}", rows(8, 40))),
            "s/runs/a/camera.csv: column `u0_V`: s/runs/a/drive.csv of the same run has the signal too",
        ),
        (
            camera(format!("{CAMERA}0,0,0,0\n0.02,0,0,0\n0.01,0,0,0\n")),
            "s/runs/a/camera.csv:4: column `t_s`: found 0.01 s after 0.02 s, a time that runs back",
        ),
        (camera("t_s,note\n0,1\n1,1\n".into()), "s/runs/a/camera.csv: found no signal"),
        (camera("t_s,x_m\n0,1\n1,1\n".into()), "s/runs/a/camera.csv: column `y_m`: the column is missing"),
    ];
    for ((file, text), says) in mistakes {
        let bench = bench();
        bench.write(file, &text);
        let before = bench.all();
        for command in [&["check", "s"][..], &["diagnose", "s", "--out", "report"]] {
            let said = bench.run(command);
            assert_eq!((said.code, said.out.as_str()), (2, ""), "{says}\n{}", said.err);
            assert_eq!(said.err.trim_end().lines().count(), 1, "{}", said.err);
            assert!(said.err.contains(says), "expected: {says}\n    told: {}", said.err);
            assert_eq!(bench.all(), before, "{says}: something was left behind");
        }
    }
}

#[test]
fn a_fault_is_told_in_the_file_that_has_it() {
    let bench = bench();
    // the camera's clock is in milliseconds, as nobody said
    let text: String = (0..40).map(|k| format!("{},{k},0,0\n", 10 * k)).collect();
    bench.write("s/runs/a/camera.csv", &format!("{CAMERA}{text}"));
    let said = bench.run(&["check", "s", "--exit-code"]);
    assert_eq!(said.code, 40, "{}", said.out);
    assert!(said.out.contains("fault: s/runs/a/camera.csv, lines 2 to 41, t_s [wrong_time_unit]"), "{}", said.out);
}

#[test]
fn a_folder_is_predicted_through_its_mapping_and_refused_without() {
    let bench = bench();
    let predict = ["predict", "s/robot.toml", "s/runs/a", "--out", "p.csv"];
    let said = bench.run(&predict);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("s/runs/a: this is a folder, expected a run log, or a mapping"), "{}", said.err);
    let among = ["predict", "s/robot.toml", "s/runs/a", "--columns", "s/columns.toml", "--out", "s/runs/a/camera.csv"];
    let said = bench.run(&among);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("it lies among the files of the run s/runs/a"), "{}", said.err);
    bench.done(&[&predict[..], &["--columns", "s/columns.toml"]].concat());
    let text = bench.read("p.csv");
    assert_eq!(text.lines().count(), 41);
    assert!(text.starts_with("t_s,w0_rad_s,w1_rad_s,w2_rad_s,w3_rad_s,x_m,y_m,theta_rad\n"), "{text}");
}

#[test]
fn a_folder_may_be_named_as_a_run_or_as_what_holds_runs() {
    let bench = bench();
    for path in ["s/runs/a", "s/runs"] {
        let said = bench.run(&["check", "--robot", "s/robot.toml", "--columns", "s/columns.toml", path]);
        assert!(said.code == 0 && said.out.contains("1 run(s) checked"), "{path}: {}{}", said.out, said.err);
    }
}

#[test]
fn a_folder_without_a_mapping_is_left_out_and_said() {
    let bench = Bench::with_session();
    bench.write("session/runs/a/drive.csv", DRIVE);
    let said = bench.done(&["check", "session"]);
    assert!(said.out.contains("a folder is a run only where columns.toml has [[file]]"), "{}", said.out);
}
