//! Next: what to record or measure, and what further recordings settled.

use crate::bench::{Bench, ROBOT, refused};

/// Two sessions of a robot whose windings have half as much resistance again as its file says: of the first no currents are
/// logged, so that weaker magnets would do the same; of `further` they are.
fn resistive() -> Bench {
    let bench = Bench::empty();
    bench.write("truth.toml", ROBOT);
    bench.change("truth.toml", "resistance_ohm = 4.3111", "resistance_ohm = 6.5");
    let scripts = ["--rich", "--scripts", "3", "--duration", "8", "--rate", "200"];
    bench.done(&[&["experiment", "truth.toml", "--out", "played"], &scripts[..]].concat());
    for (folder, first_seed) in [("session", 10), ("further", 20)] {
        bench.write(&format!("{folder}/robot.toml"), ROBOT);
        std::fs::create_dir(bench.at(&format!("{folder}/runs"))).expect("room");
        for run in 1..=3 {
            let (input, seed) = (format!("played/scripts/rich-{run}.csv"), (first_seed + run).to_string());
            let out = format!("{folder}/runs/{run}.csv");
            bench.done(&["simulate", "truth.toml", "--input", &input, "--seed", &seed, "--out", &out]);
            if folder == "session" {
                bench.write(&out, &without_currents(&bench.read(&out)));
            }
        }
    }
    bench
}

fn without_currents(table: &str) -> String {
    let names: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let kept = |line: &str| {
        let fields = line.split(',').zip(&names).filter(|(_, name)| !name.starts_with('i'));
        fields.map(|(field, _)| field).collect::<Vec<_>>().join(",") + "\n"
    };
    table.lines().map(kept).collect()
}

fn json(bench: &Bench, path: &str) -> serde_json::Value {
    serde_json::from_str(&bench.read(path)).expect("a design is JSON")
}

#[test]
fn a_sound_robot_is_told_what_would_show_what_its_runs_could_not() {
    let bench = Bench::with_session();
    let said = bench.done(&["next", "session", "--out", "out/deep"]).out;
    assert!(said.starts_with("Nothing is open; "), "{said}");
    for part in ["play ", "floor:", "By how much it would show", "random motion", "out/deep/next.html", "--also NEW"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let next = json(&bench, "out/deep/next.json");
    assert_eq!(
        (&next["schema"], &next["verdict"], &next["file"]),
        (&1.into(), &"no_gap".into(), &"next_experiment.csv".into())
    );
    assert_eq!(next["design"]["aim"], "show");
    let script = bench.read("out/deep/next_experiment.csv");
    assert!(script.starts_with("t_s,u0_V,u1_V,u2_V,u3_V"), "{script}");
    assert_eq!(script.lines().count(), 1001, "10 s at 100 rows a second");
    let page = bench.read("out/deep/next.html");
    for part in ["What to play", "What it would settle", "<svg", "Wheel 3"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn where_no_script_helps_it_says_what_to_measure_and_a_further_session_settles_it() {
    let bench = resistive();
    let said = bench.done(&["next", "session", "--out", "out"]).out;
    assert!(said.starts_with("These recordings cannot tell apart: "), "{said}");
    for part in ["Winding resistance", "none of 24 scripts tells them apart", "i: Log the motor currents"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let next = json(&bench, "out/next.json");
    assert_eq!(next["design"]["aim"], "tell_apart");
    // the script is of use with a further sensor
    assert_eq!(next["file"], "next_experiment.csv");
    assert!(bench.read("out/next_experiment.csv").starts_with("t_s,u0_V"));
    let alone = bench.done(&["diagnose", "session", "--out", "alone"]).out;
    assert!(alone.contains("not told apart from"), "{alone}");
    let both = bench.done(&["diagnose", "session", "--also", "further", "--out", "both"]).out;
    assert!(both.contains("notice      with further beside it Winding resistance is left; ruled out: "), "{both}");
    assert!(!both.contains("not told apart"), "{both}");
}

#[test]
fn what_cannot_be_used_is_told_and_nothing_is_written() {
    let bench = Bench::with_session();
    refused(&bench, &["next", "nowhere"], &["nowhere", "no such folder"]);
    refused(&bench, &["next", "session", "--duration", "3"], &["from 5 to 120 s", "--duration"]);
    refused(&bench, &["next", "session", "--without", "slipp"], &["slipp"]);
    refused(&bench, &["diagnose", "session", "--also", "elsewhere"], &["elsewhere", "no such file or folder"]);
    bench.write("broken/runs/a.csv", "t_s,u0_V\n0,zero\n");
    refused(
        &bench,
        &["diagnose", "session", "--also", "broken"],
        &["broken/runs/a.csv", "column `u1_V`", "is missing"],
    );
}

#[test]
fn a_session_beside_itself_changes_no_answer() {
    let bench = Bench::with_session();
    let said = bench.done(&["diagnose", "session", "--also", "session", "--out", "out"]).out;
    assert!(said.contains("two runs are the same") || said.contains("the answer is the same"), "{said}");
}
