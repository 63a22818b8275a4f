//! Answers: what the commands find and write.

use crate::bench::{Bench, table};

const RUN: &str = "session/runs/run01.csv";

#[test]
fn the_demo_finds_what_is_hidden_and_its_files_say_the_same_again() {
    let bench = Bench::empty();
    let said = bench.done(&["demo"]);
    assert!(said.out.contains("Missing from the simulator: Dead time"), "{}", said.out);
    assert!(said.out.contains("What was hidden: dead_time") && said.out.contains("What was found: dead_time"));
    let report: serde_json::Value = serde_json::from_str(&bench.read("omni-gap-demo/report/report.json")).unwrap();
    assert_eq!(report["verdict"], "effect");
    assert_eq!(report["causes"], serde_json::json!(["dead_time"]));
    assert!(report["shrink"]["closed"].as_f64().unwrap() > 0.9);

    // the recording it left is a session like any other, and gives the same bytes
    let again = bench.run(&["diagnose", "omni-gap-demo/session", "--out", "again", "--exit-code"]);
    assert_eq!(again.code, 20, "{}", again.err);
    for file in ["report.json", "report.html", "corrected_robot.toml"] {
        assert_eq!(bench.read(&format!("omni-gap-demo/report/{file}")), bench.read(&format!("again/{file}")), "{file}");
    }

    // with the cause in the model nothing is left
    let runs = bench.at("omni-gap-demo/session/runs").display().to_string();
    let args = ["diagnose", "--robot", "again/corrected_robot.toml", &runs, "--out", "after", "--exit-code"];
    let after = bench.run(&args);
    assert_eq!(after.code, 0, "{}{}", after.out, after.err);
    let report: serde_json::Value = serde_json::from_str(&bench.read("after/report.json")).unwrap();
    assert_eq!(report["verdict"], "no_gap");

    // a second demo may take the place of the first
    let corrected = bench.read("omni-gap-demo/report/corrected_robot.toml");
    bench.done(&["demo", "--quiet"]);
    assert_eq!(bench.read("omni-gap-demo/report/corrected_robot.toml"), corrected);
}

#[test]
fn without_the_cause_the_answer_is_another_and_says_what_was_left_out() {
    let bench = Bench::empty();
    bench.done(&["demo", "--quiet"]);
    let args = ["diagnose", "omni-gap-demo/session", "--without", "dead_time,mass", "--out", "without"];
    let said = bench.done(&args);
    assert!(said.out.contains("left out of the catalogue, as asked: `dead_time`, `mass`"), "{}", said.out);
    let report: serde_json::Value = serde_json::from_str(&bench.read("without/report.json")).unwrap();
    let considered = |id: &str| report["which"].as_array().unwrap().iter().any(|which| which["cause"] == id);
    assert!(!considered("dead_time") && !considered("mass"), "{}", report["which"]);
    // half of what dead time does nothing else explains
    assert_ne!(report["causes"], serde_json::json!(["dead_time"]));
    assert_ne!(report["verdict"], "no_gap");
    let refused = bench.run(&["diagnose", "omni-gap-demo/session", "--without", "dead_tim"]);
    assert_eq!(refused.code, 2);
    assert!(refused.err.contains("Did you mean `dead_time`?"), "{}", refused.err);
}

#[test]
fn the_bytes_depend_neither_on_threads_nor_on_what_the_processor_can() {
    let bench = Bench::with_session();
    bench.done(&["diagnose", "session", "--out", "here"]);
    let narrow = "glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX2,-FMA,-FMA4";
    for (name, value) in [("RAYON_NUM_THREADS", "1"), ("RAYON_NUM_THREADS", "5"), ("GLIBC_TUNABLES", narrow)] {
        let mut command = bench.command(&["diagnose", "session", "--out", "there"]);
        let said = command.env(name, value).output().expect("the command starts");
        assert!(said.status.success(), "{name}={value}: {}", String::from_utf8_lossy(&said.stderr));
        for file in ["report.json", "refitted_robot.toml"] {
            assert_eq!(bench.read(&format!("here/{file}")), bench.read(&format!("there/{file}")), "{name}={value}");
        }
    }
}

#[test]
fn a_prediction_has_the_rows_and_the_measured_columns_of_its_run_and_no_gaps() {
    let bench = Bench::with_session();
    bench.done(&["predict", "session/robot.toml", RUN, "--horizon", "0.5", "--out", "p.csv"]);
    let (run, predicted) = (bench.read(RUN), bench.read("p.csv"));
    let ((names, rows), (out_names, out_rows)) = (table(&run), table(&predicted));
    let measured: Vec<&str> = names.iter().copied().filter(|n| !n.starts_with('u')).collect();
    assert_eq!(out_names, measured);
    assert_eq!(out_rows.len(), rows.len());
    for (row, out) in rows.iter().zip(&out_rows) {
        assert_eq!(row[0], out[0], "the same times");
        assert!(out.iter().all(|x| x.parse::<f64>().is_ok_and(f64::is_finite)), "{out:?}");
    }
    // and it is near what was measured, as a file within its stated uncertainty predicts
    let at = |names: &[&str], name| names.iter().position(|n| *n == name).unwrap();
    let (w, out_w) = (at(&names, "w1_rad_s"), at(&out_names, "w1_rad_s"));
    let number = |x: &str| x.parse::<f64>().unwrap();
    let square = |of: &dyn Fn(&[&str], &[&str]) -> f64| -> f64 {
        rows.iter().zip(&out_rows).map(|(r, o)| of(r, o).powi(2)).sum()
    };
    let (off, all) = (square(&|r, o| number(r[w]) - number(o[out_w])), square(&|r, _| number(r[w])));
    assert!(off < 0.02 * all, "{off} of {all}");
}

#[test]
fn only_what_was_measured_is_predicted() {
    let bench = Bench::with_session();
    let text = bench.read(RUN);
    let (names, rows) = table(&text);
    let keep: Vec<usize> = (0..names.len()).filter(|k| !names[*k].starts_with('i')).collect();
    let cut = |row: &[&str]| keep.iter().map(|k| row[*k]).collect::<Vec<_>>().join(",");
    let lines: Vec<String> =
        std::iter::once(cut(&names) + ",gyro_rad_s").chain(rows.iter().map(|row| cut(row) + ",0.1")).collect();
    bench.write(RUN, &(lines.join("\n") + "\n"));
    bench.done(&["predict", "session/robot.toml", RUN, "--out", "p.csv"]);
    let predicted = bench.read("p.csv");
    assert_eq!(table(&predicted).0.join(","), "t_s,w0_rad_s,w1_rad_s,w2_rad_s,w3_rad_s,x_m,y_m,theta_rad,gyro_rad_s");
}

#[test]
fn columns_that_are_blank_throughout_are_predicted_too() {
    let bench = Bench::with_session();
    let text = bench.read(RUN);
    let (names, rows) = table(&text);
    let blank = |row: &Vec<&str>| -> String {
        let field = |(k, x): (usize, &&str)| if names[k].starts_with('i') { "" } else { *x }.to_owned();
        row.iter().enumerate().map(field).collect::<Vec<_>>().join(",")
    };
    let lines: Vec<String> = std::iter::once(names.join(",")).chain(rows.iter().map(blank)).collect();
    bench.write("blank.csv", &lines.join("\n"));
    bench.done(&["predict", "session/robot.toml", "blank.csv", "--out", "from blank.csv"]);
    bench.done(&["predict", "session/robot.toml", RUN, "--out", "p.csv"]);
    assert_eq!(bench.read("from blank.csv"), bench.read("p.csv"), "voltages and starts are the same");
}

#[test]
fn a_simulation_is_the_same_for_the_same_seed_and_seen_where_its_input_was() {
    let bench = Bench::with_session();
    let simulate = |seed: &str, noise: &str, out: &str| {
        let args = ["simulate", "session/robot.toml", "--input", RUN, "--seed", seed, "--noise", noise, "--out", out];
        bench.done(&args);
        bench.read(out)
    };
    let one = simulate("1", "true", "one.csv");
    assert_eq!(one, simulate("1", "true", "again.csv"));
    assert_ne!(one, simulate("2", "true", "two.csv"));
    let still = simulate("1", "false", "still.csv");
    assert_eq!(still, simulate("2", "false", "still too.csv"));

    let input = bench.read(RUN);
    let ((names, rows), (out_names, out_rows)) = (table(&input), table(&still));
    assert_eq!(names, out_names);
    let x = names.iter().position(|n| *n == "x_m").unwrap();
    assert!(rows.iter().any(|r| r[x].is_empty()) && rows.iter().any(|r| !r[x].is_empty()));
    assert!(rows.iter().zip(&out_rows).all(|(r, o)| r[x].is_empty() == o[x].is_empty() && r[..5] == o[..5]));
}

#[test]
fn a_simulated_run_is_predicted_by_its_own_model() {
    let bench = Bench::with_session();
    let out = ["--noise", "false", "--out", "s.csv"];
    bench.done(&[&["simulate", "session/robot.toml", "--input", RUN], &out[..]].concat());
    bench.done(&["predict", "session/robot.toml", "s.csv", "--out", "p.csv"]);
    let (simulated, predicted) = (bench.read("s.csv"), bench.read("p.csv"));
    let (names, rows) = table(&simulated);
    let (_, out) = table(&predicted);
    let w = names.iter().position(|n| *n == "w0_rad_s").unwrap();
    let number = |x: &str| x.parse::<f64>().unwrap();
    // in the first window, which begins at rest, only the step of integration differs
    let far = rows.iter().zip(&out).take(29).map(|(r, o)| (number(r[w]) - number(o[w - 4])).abs()).fold(0.0, f64::max);
    assert!(far < 0.05, "{far} rad/s apart");
}

#[test]
fn identify_writes_a_robot_file_that_fits_and_says_how_sure_it_is() {
    let bench = Bench::with_session();
    let said = bench.done(&["identify", "session", "--out", "fitted.toml"]);
    for part in ["mass_kg", "no surer than stated", "resistance_ohm", "fit error", "written to fitted.toml"] {
        assert!(said.out.contains(part), "{part}: {}", said.out);
    }
    // the stage's true robot has the example's resistance
    let of = |text: &str| -> f64 {
        let line = text.lines().find(|l| l.starts_with("resistance_ohm")).unwrap();
        line.split('=').nth(1).unwrap().trim().parse().unwrap()
    };
    let (nominal, fitted) = (of(&bench.read("session/robot.toml")), of(&bench.read("fitted.toml")));
    assert!((fitted - 4.3111).abs() < 0.2 * (nominal - 4.3111).abs(), "nominal {nominal}, fitted {fitted}");
    bench.done(&["predict", "fitted.toml", RUN, "--out", "p.csv"]);
    // it says what it was identified from, and `check` holds other recordings to that
    assert!(bench.read("fitted.toml").contains("[identified]\nrate_hz = 100.0"), "{}", bench.read("fitted.toml"));
    bench.write("session/robot.toml", &bench.read("fitted.toml").replace("rate_hz = 100.0", "rate_hz = 50.0"));
    let said = bench.done(&["check", "session"]).out;
    assert!(said.contains("identified at 50 rows a second, this run has 100"), "{said}");
}

#[test]
fn check_finds_no_fault_in_a_sound_session() {
    let bench = Bench::with_session();
    bench.write("session/runs/notes.txt", "sunny");
    let said = bench.done(&["check", "session", "--exit-code"]);
    assert!(said.out.contains("3 run(s) checked: no fault found"), "{}", said.out);
    assert!(said.out.contains("notice: ") && said.out.contains("notes.txt: not a run log"), "{}", said.out);
}

#[test]
fn check_says_how_well_the_recordings_could_tell_each_number() {
    let bench = Bench::with_session();
    let said = bench.done(&["check", "session"]).out;
    let line = |key: &str| said.lines().find(|line| line.starts_with(key)).unwrap_or_else(|| panic!("{key}: {said}"));
    assert!(line("resistance_ohm").contains("10 %") && !line("resistance_ohm").contains("no trace"), "{said}");

    // wheels alone: neither where the camera is nor what it lags moves anything that is measured
    let wheels: Vec<String> = ["u", "i", "w"]
        .iter()
        .zip(["V", "A", "rad_s"])
        .flat_map(|(stem, unit)| (0..4).map(move |j| format!("{stem}{j}_{unit} = {{ from = \"{stem}{j}_{unit}\" }}\n")))
        .collect();
    bench.write("session/columns.toml", &format!("[columns]\nt_s = {{ from = \"t_s\" }}\n{}", wheels.concat()));
    let robot = bench.read("session/robot.toml");
    bench.write("session/robot.toml", &format!("{robot}\n[effects.camera_latency]\nlatency_s = 0.02\n"));
    let said = bench.done(&["check", "session"]).out;
    assert!(said.contains("latency_s of camera_latency: all that is allowed of it"), "{said}");
}

#[test]
fn sensitivity_says_the_terms_and_ranks_the_numbers_with_and_without_files() {
    let bench = Bench::empty();
    bench.write("robot.toml", crate::bench::ROBOT);
    let said = bench.done(&["sensitivity", "robot.toml"]);
    // 2·(Kt·l/r)²/(R·M), Bv/M, 2·l·Kt/(r·R·M)·6 V, Cv/M
    assert!(said.out.contains("dv/dt = 4.74 − 3.15·v − 0.213·v − 0.801 m/s²"), "{}", said.out);
    assert_eq!(bench.all().len(), 1, "without --out nothing is written");
    let args = ["sensitivity", "robot.toml", "--voltage", "3", "--time", "0.5", "--out", "deep/out"];
    let said = bench.done(&args);
    assert!(said.out.contains("written to deep/out"), "{}", said.out);
    let read: serde_json::Value = serde_json::from_str(&bench.read("deep/out/sensitivity.json")).unwrap();
    assert_eq!((read["voltage_V"].as_f64(), read["time_s"].as_f64()), (Some(3.0), Some(0.5)));
    let slopes: Vec<f64> =
        read["axes"][0]["influences"].as_array().unwrap().iter().map(|i| i["speed"].as_f64().unwrap().abs()).collect();
    assert!(slopes.len() == 13 && slopes.is_sorted_by(|a, b| a >= b), "{slopes:?}");
    assert!(bench.read("deep/out/sensitivity.html").contains("<svg"));
    let first = bench.read("deep/out/sensitivity.html");
    bench.done(&args);
    assert_eq!(first, bench.read("deep/out/sensitivity.html"), "the same again, bit for bit");
}

#[test]
fn a_prediction_is_written_as_mcap_with_what_was_measured_and_what_is_left() {
    let bench = Bench::with_session();
    bench.done(&["predict", "session/robot.toml", RUN, "--out", "p.mcap"]);
    bench.done(&["predict", "session/robot.toml", RUN, "--out", "p.parquet"]);
    let bytes = std::fs::read(bench.at("p.mcap")).unwrap();
    let mut last: std::collections::BTreeMap<String, f64> = std::collections::BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let said: serde_json::Value = serde_json::from_slice(&message.data).unwrap();
        if let Some(speed) = said.get("w0_rad_s") {
            last.insert(message.channel.topic.clone(), speed.as_f64().unwrap());
        }
    }
    let of = |topic: &str| last[&format!("/{topic}/wheel_speed")];
    assert!((of("measured") - of("predicted") - of("residual")).abs() < 1e-12, "{last:?}");
    // the Parquet file is the prediction alone, as the CSV is
    bench.done(&["convert", "session/robot.toml", "p.parquet", "--out", "back.csv"]);
    bench.done(&["predict", "session/robot.toml", RUN, "--out", "p.csv"]);
    assert_eq!(bench.read("back.csv"), bench.read("p.csv"));
}
