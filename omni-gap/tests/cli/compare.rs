//! Compare: two sessions, or a simulator's log, beside each other.

use crate::bench::{Bench, refused};

const RUN: &str = "session/runs/run01.csv";

fn json(bench: &Bench, path: &str) -> serde_json::Value {
    serde_json::from_str(&bench.read(path)).expect("a report is JSON")
}

#[test]
fn a_session_is_like_itself_and_both_files_stand_in_the_folder() {
    let bench = Bench::with_session();
    let said = bench.done(&["compare", "session", "session", "--out", "out/deep", "--exit-code"]).out;
    assert!(said.starts_with("Alike: "), "{said}");
    for part in ["the same inputs, row by row", "would count from", "body.mass_kg", "out/deep/compare.html"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let report = json(&bench, "out/deep/compare.json");
    assert_eq!((&report["verdict"], &report["aligned_by"]), (&"alike".into(), &"input".into()));
    assert_eq!((&report["schema"], &report["a"], &report["b"]), (&1.into(), &"session".into(), &"session".into()));
    assert_eq!(report["causes"].as_array().map(Vec::len), Some(0));
    let page = bench.read("out/deep/compare.html");
    for part in ["Alike: ", "would end there", "by A’s model", "<svg"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn a_simulators_log_with_another_mass_is_told_by_the_line_to_change() {
    let bench = Bench::with_session();
    // the robot has a third more mass than its file and the simulator say
    let text = bench.read("session/robot.toml");
    let line = text.lines().find(|line| line.starts_with("mass_kg")).expect("it stands there");
    let mass: f64 = line.split('=').nth(1).expect("a value").trim().parse().expect("a number");
    bench.write("heavy.toml", &text.replace(line, &format!("mass_kg = {}", 1.33 * mass)));
    for run in ["run00", "run01", "run02"] {
        let input = format!("session/runs/{run}.csv");
        let (sim, real) = (format!("sim/{run}.csv"), format!("real/runs/{run}.csv"));
        for out in [&sim, &real] {
            std::fs::create_dir_all(bench.at(out).parent().expect("a folder")).expect("room");
        }
        let simulate = |robot: &str, noise: &str, out: &str| {
            bench.done(&["simulate", robot, "--input", &input, "--seed", "3", "--noise", noise, "--out", out]);
        };
        simulate("session/robot.toml", "false", &sim);
        simulate("heavy.toml", "true", &real);
    }
    bench.write("real/robot.toml", &text);
    let said = bench.done(&["compare", "real", "--sim", "sim", "--out", "out"]).out;
    assert!(said.starts_with("Its numbers are not the robot’s: Mass."), "{said}");
    assert!(said.contains("change      body.mass_kg: set ") && said.contains("A           sim"), "{said}");
    let report = json(&bench, "out/compare.json");
    assert_eq!((&report["verdict"], &report["against"]), (&"different".into(), &"simulator".into()));
    let change = report["causes"][0]["numbers"][0]["change"]["value"].as_f64().expect("a number");
    assert!((change / (0.33 * mass) - 1.0).abs() < 0.15, "{change} of {}", 0.33 * mass);
    assert_eq!(bench.run(&["compare", "real", "--sim", "sim", "--quiet", "--exit-code"]).code, 20);
}

#[test]
fn a_side_without_a_robot_file_is_of_the_others_robot() {
    let bench = Bench::with_session();
    for run in ["run00", "run01", "run02"] {
        let file = format!("runs/{run}.csv");
        bench.write(&format!("after/{file}"), &bench.read(&format!("session/{file}")));
    }
    let said = bench.done(&["compare", "session", "after", "--out", "out"]).out;
    assert!(said.starts_with("Alike: ") && said.contains("B           after"), "{said}");
    let named = ["compare", "after/runs", "after/runs", "--robot", "session/robot.toml", "--out", "out"];
    let said = bench.done(&named).out;
    assert!(said.starts_with("Alike: ") && said.contains("A           runs"), "{said}");
    refused(&bench, &["compare", RUN, "after"], &["run01.csv: there is no robot.toml, neither here", "--robot"]);
}

#[test]
fn robots_with_another_number_of_wheels_are_refused() {
    let bench = Bench::with_session();
    let three = include_str!("../../robots/feup-3w/robot.toml");
    bench.write("other/robot.toml", three);
    bench.done(&["experiment", "other/robot.toml", "--out", "morning", "--only", "spin", "--rehearse", "paper"]);
    let args = ["compare", "session", "morning/session", "--out", "out"];
    let says = ["morning/session/robot.toml: 3 wheels, where the robot of session has 4", "as many wheels each"];
    refused(&bench, &args, &says);
}

#[test]
fn what_is_not_two_sides_is_refused_in_one_message() {
    let bench = Bench::with_session();
    refused(&bench, &["compare", "session"], &["one session was given", "--sim LOG"]);
    refused(&bench, &["compare", "session", "session", "--sim", RUN], &["two sessions and a simulator's log"]);
    refused(&bench, &["compare", "session", "gone"], &["gone: no such file or folder", "Give a session folder"]);
    refused(&bench, &["compare", "session", "--sim", "gone.csv"], &["gone.csv: no such file or folder"]);
    refused(&bench, &["compare", "session", "session", "--without", "ghosts"], &["`ghosts` is neither"]);
    bench.write("plain", "mine");
    refused(&bench, &["compare", "session", "session", "--out", "plain"], &["plain: cannot be written: it is a file"]);
    bench.set_field(RUN, 17, "w0_rad_s", "fast");
    refused(&bench, &["compare", "session", "session", "--out", "out"], &["run01.csv:17: column `w0_rad_s`", "`fast`"]);
}

#[test]
fn recordings_with_a_fault_are_answered_with_it_and_its_side() {
    let bench = Bench::with_session();
    bench.write("after/robot.toml", &bench.read("session/robot.toml"));
    let text = bench.read(RUN);
    let rows: Vec<String> = text.lines().map(str::to_owned).collect();
    let at = rows[0].split(',').position(|name| name == "w1_rad_s").expect("the column");
    let frozen = |row: &String| {
        let mut fields: Vec<&str> = row.split(',').collect();
        fields[at] = "1.25";
        fields.join(",")
    };
    let text = std::iter::once(rows[0].clone()).chain(rows[1..].iter().map(frozen)).collect::<Vec<_>>().join("\n");
    bench.write("after/runs/b.csv", &(text + "\n"));
    let said = bench.run(&["compare", "session", "after", "--out", "out", "--exit-code"]);
    assert_eq!(said.code, 40, "{}", said.err);
    assert!(said.out.contains("not fit for a comparison") && said.out.contains("after: "), "{}", said.out);
}
