//! `validate`: a model laid over what was measured.

use crate::bench::{Bench, refused, table};

const RUN: &str = "session/runs/run01.csv";

/// A run with some of its columns only.
fn with_columns(bench: &Bench, keep: &dyn Fn(&str) -> bool) -> String {
    let text = bench.read(RUN);
    let (names, rows) = table(&text);
    let kept: Vec<usize> = (0..names.len()).filter(|k| keep(names[*k])).collect();
    let cut = |row: &[&str]| kept.iter().map(|k| row[*k]).collect::<Vec<_>>().join(",");
    let lines: Vec<String> = std::iter::once(cut(&names)).chain(rows.iter().map(|row| cut(row))).collect();
    lines.join("\n") + "\n"
}

#[test]
fn a_session_is_said_in_a_table_and_written_as_numbers_and_as_a_page() {
    let bench = Bench::with_session();
    std::fs::create_dir(bench.at("session/heldout")).unwrap();
    std::fs::rename(bench.at("session/runs/run02.csv"), bench.at("session/heldout/run02.csv")).unwrap();
    let said = bench.done(&["validate", "session", "--out", "out/deep"]).out;
    for part in ["The model follows", "worst: ", "run00 ", "run02 (held out)", "all runs", "restarted   every 0.1 s:"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(said.contains("out/deep/validation.html"), "{said}");
    let json: serde_json::Value = serde_json::from_str(&bench.read("out/deep/validation.json")).unwrap();
    assert_eq!((&json["schema"], &json["session"]), (&1.into(), &"session".into()));
    let runs = json["runs"].as_array().unwrap();
    assert_eq!(runs.iter().map(|run| run["held_out"].as_bool().unwrap()).collect::<Vec<_>>(), [false, false, true]);
    // the file is wrong by its stated uncertainty only: the model follows, though not perfectly
    for signal in runs[0]["signals"].as_array().unwrap() {
        let name = signal["signal"].as_str().unwrap();
        if ["v_m_s", "vn_m_s", "omega_rad_s"].contains(&name) {
            let fit = signal["fit_percent"].as_f64().unwrap();
            assert!((50.0..100.0).contains(&fit), "{name}: {fit}");
        }
    }
    let page = bench.read("out/deep/validation.html");
    for part in ["run02 (held out)", "<svg", "Wheel speeds, currents and pose", "How errors grow"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn without_a_folder_only_the_table_is_said() {
    let bench = Bench::with_session();
    let before = bench.all();
    let said = bench.done(&["validate", "session"]);
    assert!(said.out.contains("all runs") && !said.out.contains("validation.json"), "{}", said.out);
    assert_eq!(bench.all(), before);
}

#[test]
fn a_robot_file_and_runs_that_lie_anywhere_and_horizons_of_ones_own() {
    let bench = Bench::with_session();
    let args = ["validate", "--robot", "session/robot.toml", RUN, "--horizon", "0.4,0.2", "--horizon", "60"];
    let said = bench.done(&args).out;
    assert!(said.contains("over the one run") && !said.contains("all runs"), "{said}");
    assert!(said.contains("every 0.2 s:") && said.contains("0.4 s:") && !said.contains("60 s"), "{said}");
}

#[test]
fn a_recording_of_the_model_itself_fits_better_than_that_of_another_robot() {
    let bench = Bench::with_session();
    let robot = "session/robot.toml";
    bench.done(&["simulate", robot, "--input", RUN, "--seed", "1", "--noise", "false", "--out", "own.csv"]);
    let fit = |run: &str| -> f64 {
        bench.done(&["validate", "--robot", robot, run, "--out", "out"]);
        let json: serde_json::Value = serde_json::from_str(&bench.read("out/validation.json")).unwrap();
        json["all_runs"][0]["fit_percent"].as_f64().unwrap()
    };
    let (own, other) = (fit("own.csv"), fit(RUN));
    // rows of 10 ms: what is left is the step of integration and the smoothed start
    assert!(own > 99.0 && own > other, "{own} against {other}");
}

#[test]
fn recordings_with_a_fault_are_compared_and_the_fault_is_told() {
    let bench = Bench::with_session();
    let text = bench.read(RUN);
    let (names, rows) = table(&text);
    let frozen = names.iter().position(|n| *n == "w1_rad_s").unwrap();
    let row = |row: &Vec<&str>| {
        let field = |(k, x): (usize, &&str)| if k == frozen { "1.25" } else { *x }.to_owned();
        row.iter().enumerate().map(field).collect::<Vec<_>>().join(",")
    };
    let lines: Vec<String> = std::iter::once(names.join(",")).chain(rows.iter().map(row)).collect();
    bench.write(RUN, &(lines.join("\n") + "\n"));
    assert_eq!(bench.run(&["check", "session", "--exit-code"]).code, 40);
    let said = bench.done(&["validate", "session"]).out;
    assert!(said.contains("notice") && said.contains("fault") && said.contains("`omni-gap check`"), "{said}");
}

#[test]
fn what_cannot_be_compared_is_refused_in_one_message() {
    let bench = Bench::with_session();
    bench.write("three.toml", include_str!("../../robots/feup-3w/robot.toml"));
    let says = ["run01.csv: column `u3_V`", "does not have", "3 wheels"];
    refused(&bench, &["validate", "--robot", "three.toml", RUN, "--out", "out"], &says);
    refused(&bench, &["validate", "--robot", "session/robot.toml", "gone.csv"], &["gone.csv", "no such file"]);
    refused(&bench, &["validate", "nowhere", "--out", "out"], &["nowhere: no such folder"]);

    let volts = with_columns(&bench, &|name| name == "t_s" || name.starts_with('u'));
    let pose = with_columns(&bench, &|name| ["t_s", "x_m", "y_m", "theta_rad"].contains(&name));
    bench.write("volts.csv", &volts);
    bench.write("pose.csv", &pose);
    let validate = |run: &'static str| ["validate", "--robot", "session/robot.toml", run, "--out", "out"];
    refused(&bench, &validate("volts.csv"), &["volts.csv: nothing was measured in it", "i, w or the pose"]);
    refused(&bench, &validate("pose.csv"), &["pose.csv: nothing in it can drive a model", "Log at least one of"]);
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_anything_is_read() {
    let bench = Bench::with_session();
    bench.write("plain", "mine");
    refused(&bench, &["validate", "session", "--out", "plain"], &["plain: cannot be written: it is a file", "--out"]);
    refused(&bench, &["validate", "nowhere", "--out", "plain/out"], &["plain is a file, not a folder", "--out"]);
    std::fs::create_dir_all(bench.at("taken/validation.json")).unwrap();
    refused(&bench, &["validate", "session", "--out", "taken"], &["validation.json: cannot be written"]);
    assert_eq!(bench.read("plain"), "mine");
    for horizon in ["0", "-1", "0.5,soon"] {
        let said = bench.run(&["validate", "session", &format!("--horizon={horizon}")]);
        assert!(said.code == 2 && said.err.contains("above zero"), "{}", said.err);
    }
}
