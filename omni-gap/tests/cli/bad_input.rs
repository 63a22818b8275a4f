//! Bad input: one clear message, exit code 2, nothing written.

use crate::bench::{Bench, refused};

const RUN: &str = "session/runs/run01.csv";

/// A session that cannot be read, refused by every command that reads sessions.
#[track_caller]
fn session_refused(bench: &Bench, says: &[&str]) {
    refused(bench, &["diagnose", "session", "--out", "out/deep"], says);
    refused(bench, &["identify", "session", "--out", "fitted.toml"], says);
    refused(bench, &["check", "session"], says);
    refused(bench, &["validate", "session", "--out", "out/deep"], says);
}

/// A run that cannot be read, refused by all that read runs.
#[track_caller]
fn run_refused(bench: &Bench, says: &[&str]) {
    session_refused(bench, says);
    refused(bench, &["predict", "session/robot.toml", RUN, "--out", "p.csv"], says);
    refused(bench, &["simulate", "session/robot.toml", "--input", RUN, "--seed", "1", "--out", "s.csv"], says);
}

/// A robot file that cannot be read, refused by all that read robot files.
#[track_caller]
fn robot_refused(bench: &Bench, says: &[&str]) {
    run_refused(bench, says);
}

#[test]
fn an_empty_file() {
    let bench = Bench::with_session();
    bench.write(RUN, "");
    run_refused(&bench, &["run01.csv: the file is empty", "Record the run again"]);
}

#[test]
fn a_header_only() {
    let bench = Bench::with_session();
    let header = bench.read(RUN).lines().next().unwrap().to_owned();
    bench.write(RUN, &(header + "\n"));
    run_refused(&bench, &["run01.csv: there is a header and no rows", "at least two rows", "Record the run again"]);
}

#[test]
fn a_missing_column() {
    let bench = Bench::with_session();
    bench.change(RUN, "w2_rad_s", "wheel two");
    let says = ["run01.csv: column `w2_rad_s`: the column is missing", "3 of 4 wheels", "columns.toml"];
    run_refused(&bench, &says);
    bench.change(RUN, "t_s", "time");
    run_refused(&bench, &["column `t_s`: the column is missing"]);
}

#[test]
fn text_nan_and_infinity_in_the_place_of_a_number() {
    for found in ["fast", "NaN", "inf", "-Infinity"] {
        let bench = Bench::with_session();
        bench.set_field(RUN, 17, "w0_rad_s", found);
        let told = format!("found `{found}`, expected a finite number");
        run_refused(&bench, &["run01.csv:17: column `w0_rad_s`", &told, "leave it empty"]);
    }
}

#[test]
fn unsorted_and_repeated_time() {
    let bench = Bench::with_session();
    bench.set_field(RUN, 30, "t_s", "0.001");
    run_refused(&bench, &["run01.csv:30: column `t_s`", "time that runs back", "Sort the rows"]);
    bench.set_field(RUN, 30, "t_s", "0.27");
    run_refused(&bench, &["run01.csv:30: column `t_s`", "repeated time"]);
}

#[test]
fn a_row_that_is_cut_short() {
    let bench = Bench::with_session();
    let text = bench.read(RUN);
    bench.write(RUN, &text[..text.len() - 60]);
    run_refused(&bench, &["run01.csv:201: found ", "expected 16", "Complete or remove the row"]);
}

#[test]
fn two_wheels_in_the_robot_file() {
    let bench = Bench::with_session();
    let text = bench.read("session/robot.toml");
    let parts: Vec<&str> = text.split("[[wheel]]").collect();
    let two =
        [parts[0], "[[wheel]]", parts[1], "[[wheel]]", parts[2], "[motor]", text.split("[motor]").nth(1).unwrap()];
    bench.write("session/robot.toml", &two.concat());
    robot_refused(&bench, &["robot.toml:6: two wheels", "expected three or four", "own [[wheel]] table"]);
}

#[test]
fn a_negative_mass() {
    let bench = Bench::with_session();
    let text = bench.read("session/robot.toml");
    let line = text.lines().position(|l| l.starts_with("mass_kg")).unwrap();
    bench.change("session/robot.toml", "mass_kg = ", "mass_kg = -");
    let place = format!("robot.toml:{}: column `mass_kg`", line + 1);
    robot_refused(&bench, &[&place, "expected a number above zero", "Correct the value"]);
}

#[test]
fn an_unknown_effect() {
    let bench = Bench::with_session();
    let text = bench.read("session/robot.toml");
    bench.write("session/robot.toml", &format!("{text}\n[effects.dead_tim]\nvoltage_loss_V = 0.3\n"));
    let place = format!("robot.toml:{}", text.lines().count() + 2);
    robot_refused(&bench, &[&place, "unknown effect `dead_tim`", "Did you mean `dead_time`?"]);
}

#[test]
fn an_effect_in_the_wrong_place_twice_or_one_too_many() {
    let slip = |wheel: usize| format!("[[effects.wheel_slip]]\nwheel = {wheel}\nfriction_coefficient = 0.4\n");
    let weak = |wheel: usize| format!("[[effects.motor_mismatch]]\nwheel = {wheel}\ntorque_constant_ratio = 0.9\n");
    let on_all = |table: &dyn Fn(usize) -> String| (0..4).map(table).collect::<String>();
    let creep = |wheel: usize| format!("[[effects.creep]]\nwheel = {wheel}\ncreep_m_s_per_N = 0.01\n");
    let gear = |wheel: usize| format!("[[effects.gear_efficiency]]\nwheel = {wheel}\nefficiency = 0.9\n");
    let dead = |wheel: usize| format!("[[effects.dead_time]]\nwheel = {wheel}\nvoltage_loss_V = 0.2\n");
    let rotor = |wheel: usize| format!("[[effects.rotor_inertia]]\nwheel = {wheel}\ninertia_at_wheel_kg_m2 = 1e-5\n");
    let twenty = on_all(&slip) + &on_all(&weak) + &on_all(&creep) + &on_all(&gear) + &on_all(&dead);
    let many = twenty + &on_all(&rotor) + "[effects.coriolis]\n";
    for (effects, line, says) in [
        ("[effects.coriolis]\nwheel = 1\n".to_owned(), 2, "acts on the whole robot"),
        ("[effects.motor_mismatch]\ntorque_constant_ratio = 0.9\n".to_owned(), 1, "sits on one wheel"),
        (slip(7), 2, "the robot has wheels 0 to 3"),
        (slip(1).replace("0.4", "1e200"), 3, "expected a value from"),
        (slip(1).replace("friction_coefficient", "friction_coeficient"), 3, "Did you mean `friction_coefficient`?"),
        (slip(1) + &slip(1), 4, "on wheel 1 stands twice"),
        (many, 73, "a model has room for 24 effects"),
    ] {
        let bench = Bench::with_session();
        let text = bench.read("session/robot.toml");
        bench.write("session/robot.toml", &format!("{text}{effects}"));
        robot_refused(&bench, &[&format!("robot.toml:{}: column `", text.lines().count() + line), says]);
    }
}

#[test]
fn numbers_that_no_small_robot_has() {
    for (key, wrong, says) in [
        ("mass_kg", "2340", "expected a number from 0.02 to 1000 kg. Write 2.34, if the number is in g"),
        ("radius_m", "30", "expected a number from 0.002 to 0.6 m"),
        ("emf_constant_V_s", "368.7", "Write 0.0259, if the number is in rpm/V"),
        ("torque_constant_Nm_per_A", "25.9", "Write 0.0259, if the number is in mN·m/A"),
        ("gear_ratio", "0.2", "Write 5, if the number is in wheel turns in a turn of the motor"),
        ("inertia_kg_m2", "1e200", "found 1e200, expected a number from"),
    ] {
        let bench = Bench::with_session();
        let text = bench.read("session/robot.toml");
        let at = text.lines().position(|line| line.starts_with(key)).expect("the key is there");
        let with = |(k, line): (usize, &str)| if k == at { format!("{key} = {wrong}\n") } else { format!("{line}\n") };
        bench.write("session/robot.toml", &text.lines().enumerate().map(with).collect::<String>());
        robot_refused(&bench, &[&format!("robot.toml:{}: column `{key}`: found ", at + 1), says]);
    }
}

#[test]
fn a_robot_file_of_a_newer_form() {
    let bench = Bench::with_session();
    bench.change("session/robot.toml", "schema = 1", "schema = 9");
    robot_refused(&bench, &["robot.toml:3: column `schema`", "form 9", "Use a newer program"]);
}

#[test]
fn a_folder_where_a_file_is_due_and_a_file_where_a_folder_is_due() {
    let bench = Bench::with_session();
    refused(&bench, &["predict", "session", RUN, "--out", "p.csv"], &["session: this is a folder", "a robot file"]);
    let args = ["predict", "session/robot.toml", "session/runs", "--out", "p.csv"];
    refused(&bench, &args, &["runs: this is a folder", "a run log", "Name a file"]);
    let says = ["robot.toml: this is a file, expected a session folder", "Give a folder"];
    refused(&bench, &["diagnose", "session/robot.toml", "--out", "out"], &says);
    std::fs::remove_file(bench.at("session/robot.toml")).unwrap();
    std::fs::create_dir(bench.at("session/robot.toml")).unwrap();
    session_refused(&bench, &["robot.toml: this is a folder, expected a robot file"]);
}

#[test]
fn nothing_where_something_is_due() {
    let bench = Bench::with_session();
    refused(&bench, &["diagnose", "elsewhere"], &["elsewhere: no such folder", "robot.toml and runs/"]);
    refused(&bench, &["check", "session", "session"], &["several paths", "--robot"]);
    std::fs::remove_dir_all(bench.at("session/runs")).unwrap();
    session_refused(&bench, &["runs: there is no such folder", "Put the run logs"]);
    std::fs::remove_file(bench.at("session/robot.toml")).unwrap();
    session_refused(&bench, &["robot.toml: no such file", "Check the path"]);
}

#[test]
fn an_output_that_cannot_be_written() {
    let bench = Bench::with_session();
    bench.write("plain", "mine");
    std::fs::create_dir_all(bench.at("taken/report.json")).unwrap();
    let below = ["cannot be written", "plain is a file, not a folder", "--out"];
    refused(&bench, &["diagnose", "session", "--out", "plain/out"], &below);
    refused(&bench, &["diagnose", "session", "--out", "plain"], &["plain: cannot be written", "--out"]);
    refused(&bench, &["diagnose", "session", "--out", "taken"], &["report.json: cannot be written", "folder"]);
    refused(&bench, &["demo", "--out", "plain/out"], &below);
    for command in [
        vec!["predict", "session/robot.toml", RUN],
        vec!["simulate", "session/robot.toml", "--input", RUN, "--seed", "1"],
        vec!["identify", "session"],
    ] {
        let to = |out| [command.as_slice(), &["--out", out]].concat();
        refused(&bench, &to("plain/out"), &below);
        refused(&bench, &to("taken"), &["taken: cannot be written: it is a folder", "Name a file"]);
        refused(&bench, &to("nowhere/out"), &["there is no folder nowhere", "Make the folder first"]);
        refused(&bench, &to("session/robot.toml"), &["it is an input and would be lost", "--out"]);
    }
    assert_eq!(bench.read("plain"), "mine");
}

#[test]
fn the_demo_does_not_write_over_a_session_of_somebody_else() {
    let bench = Bench::with_session();
    refused(&bench, &["demo", "--out", "."], &["files that the demo did not make", "--out"]);
}

#[test]
fn a_recording_that_nothing_can_be_fitted_on() {
    let bench = Bench::with_session();
    let text = bench.read(RUN);
    let lines = text.lines().enumerate().map(|(k, line)| {
        let field = |(at, x): (usize, &str)| match x.parse::<f64>() {
            Ok(volts) if k > 0 && (1..=4).contains(&at) => (1000.0 * volts).to_string(),
            _ => x.to_owned(),
        };
        line.split(',').enumerate().map(field).collect::<Vec<_>>().join(",")
    });
    bench.write(RUN, &(lines.collect::<Vec<_>>().join("\n") + "\n"));
    let says = ["run01.csv: lines 2 to 201", "millivolts", "Convert the columns"];
    refused(&bench, &["identify", "session", "--out", "fitted.toml"], &says);
    assert_eq!(bench.run(&["check", "session", "--exit-code"]).code, 40);
    let said = bench.done(&["check", "session"]);
    assert!(said.out.contains("fault: session/runs/run01.csv, lines 2 to 201"), "{}", said.out);
    assert!(said.out.contains("To mend it:"), "{}", said.out);
    assert_eq!(bench.run(&["diagnose", "session", "--exit-code"]).code, 40);
}

#[test]
fn numbers_on_the_command_line() {
    let bench = Bench::with_session();
    for horizon in ["0", "-1", "NaN", "inf", "soon"] {
        let said = bench.run(&["diagnose", "session", &format!("--horizon={horizon}")]);
        assert_eq!(said.code, 2);
        assert!(said.err.contains("--horizon") && said.err.contains("above zero"), "{}", said.err);
    }
    assert_eq!(bench.run(&["simulate", "r", "--input", "i", "--out", "o", "--seed", "x"]).code, 2);
    assert_eq!(bench.run(&[]).code, 2);
}

#[test]
fn a_step_that_cannot_be_taken() {
    let bench = Bench::with_session();
    let robot = "session/robot.toml";
    refused(
        &bench,
        &["sensitivity", "nowhere.toml", "--out", "out"],
        &["nowhere.toml: no such file", "Check the path"],
    );
    refused(&bench, &["sensitivity", "session", "--out", "out"], &["session: this is a folder", "a robot file"]);
    let much = ["sensitivity", robot, "--voltage", "100", "--out", "out/deep"];
    refused(&bench, &much, &["robot.toml: its supply gives 12", "asks for 100 V", "no more than"]);
    bench.write("plain", "mine");
    std::fs::create_dir_all(bench.at("taken/sensitivity.html")).unwrap();
    let below = ["cannot be written", "plain is a file, not a folder", "--out"];
    refused(&bench, &["sensitivity", robot, "--out", "plain/out"], &below);
    refused(&bench, &["sensitivity", robot, "--out", "taken"], &["sensitivity.html: cannot be written", "folder"]);
    let before = bench.all();
    for (option, values, told) in [
        ("--voltage", &["0", "-6", "NaN", "inf", "much"][..], "above zero"),
        ("--time", &["0", "-1", "NaN", "1e9", "soon"], "from 0.01 to 60 seconds"),
    ] {
        for value in values {
            let said = bench.run(&["sensitivity", robot, &format!("{option}={value}"), "--out", "out"]);
            assert_eq!((said.code, said.out.as_str()), (2, ""), "{option}={value}");
            assert!(said.err.contains(option) && said.err.contains(told), "{}", said.err);
        }
    }
    assert_eq!(bench.all(), before);
}

#[test]
fn noise_without_a_seed_says_both_ways_out() {
    let bench = Bench::with_session();
    let args = ["simulate", "session/robot.toml", "--input", RUN, "--out", "s.csv"];
    refused(&bench, &args, &["none is given", "--seed N", "--noise false"]);
}
