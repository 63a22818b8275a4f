//! A morning of experiments: scripts written, played by a robot that is just what its file says, and identified.

use crate::bench::{Bench, ROBOT, table};
use omni_gap::known_effects;
use omni_gap::log::{RobotFile, Run};

const OUT: [&str; 2] = ["--out", "morning"];

fn with_robot(text: &str) -> Bench {
    let bench = Bench::empty();
    bench.write("robot.toml", text);
    bench
}

/// A rehearsal of these experiments, once each, in `morning`.
fn rehearsed(only: &str) -> Bench {
    let bench = with_robot(ROBOT);
    let args = ["experiment", "robot.toml", "--only", only, "--repeats", "1", "--rehearse", "paper"];
    bench.done(&[args.as_slice(), &OUT].concat());
    bench
}

#[track_caller]
fn refused(bench: &Bench, args: &[&str], says: &[&str]) {
    let before = bench.all();
    let said = bench.run(args);
    assert_eq!(said.code, 2, "{args:?} said {}{}", said.out, said.err);
    for part in says {
        assert!(said.err.contains(part), "{args:?}: {part:?} is not in {:?}", said.err);
    }
    assert_eq!(bench.all(), before, "{args:?} left something behind");
}

fn robot(bench: &Bench, path: &str) -> RobotFile {
    RobotFile::load(&bench.at(path), &known_effects()).expect("a sound robot file")
}

#[test]
fn scripts_read_back_as_runs_and_the_page_says_what_to_do() {
    let bench = with_robot(ROBOT);
    let said = bench.done(&["experiment", "robot.toml", "--repeats", "1", "--out", "morning"]);
    assert!(said.out.contains("18 scripts of up to 8.00 V") && said.out.contains("README.md"), "{}", said.out);
    let coast = bench.read("morning/scripts/coast-v-1.csv");
    let (header, _) = table(&coast);
    assert_eq!(header, ["t_s", "u0_V", "u1_V", "u2_V", "u3_V", "enable"]);
    for entry in std::fs::read_dir(bench.at("morning/scripts")).unwrap() {
        let path = entry.unwrap().path();
        let (run, notices) = Run::load(&path, 4, None).unwrap();
        assert_eq!(notices, Vec::<String>::new(), "{}", path.display());
        let volts = run.u.iter().flat_map(|u| &u.channels).flat_map(|c| c.present());
        assert!(volts.into_iter().all(|(_, u)| u.abs() <= 8.0), "{}", path.display());
        let opened = run.open_rows().contains(&true);
        assert_eq!(opened, run.name.starts_with("coast"), "{}", run.name);
    }
    assert_eq!(bench.read("morning/session/robot.toml"), ROBOT);
    assert_eq!(std::fs::read_dir(bench.at("morning/session/runs")).unwrap().count(), 0);
    let page = bench.read("morning/README.md");
    for part in ["wheels off the ground", "`motor-load-3`", "session/runs/<name>.csv", "--experiment all", "m ahead"] {
        assert!(page.contains(part), "{part}: {page}");
    }
    refused(&bench, &["experiment", "robot.toml", "--out", "morning"], &["README.md", "there already", "--out"]);
}

#[test]
fn limits_of_the_robot_file_lower_the_voltage_and_are_told() {
    let limits = "\n[limits]\ncurrent_A = 1.5\nspeed_m_s = 0.8\nfield_m = 1.5\n";
    let bench = with_robot(&format!("{ROBOT}{limits}"));
    let said = bench.done(&["experiment", "robot.toml", "--only", "step", "--repeats", "1", "--out", "morning"]);
    assert!(said.out.contains("current_A = 1.5 A") && said.out.contains("speed_m_s = 0.8 m/s"), "{}", said.out);
    let (run, _) = Run::load(&bench.at("morning/scripts/step-v-100-1.csv"), 4, None).unwrap();
    let most =
        run.u.iter().flat_map(|u| &u.channels).flat_map(|c| c.present()).fold(0.0_f64, |m, (_, u)| m.max(u.abs()));
    assert!(most > 3.0 && most < 1.5 * 4.3111, "{most}");
    bench.change("robot.toml", "current_A = 1.5", "current_A = 0.1");
    let args = ["experiment", "robot.toml", "--out", "other"];
    refused(&bench, &args, &["robot.toml: at 0.2", "does not move along v", "[limits]"]);
}

#[test]
fn a_rich_excitation_is_written_rehearsed_and_judged_by_the_self_test() {
    let bench = with_robot(ROBOT);
    let ask = ["experiment", "robot.toml", "--rich", "--scripts", "2", "--duration", "8"];
    let said = bench.done(&[&ask[..], &OUT].concat());
    assert!(said.out.contains("2 scripts of up to 8.00 V") && said.out.contains("README.md"), "{}", said.out);
    let page = bench.read("morning/README.md");
    assert!(page.contains("omni-gap diagnose morning/session") && page.contains("`rich-2`, 8 s"), "{page}");
    let scripts = ["morning/scripts/rich-1.csv", "morning/scripts/rich-2.csv"];
    let judge = ["selftest", "robot.toml", "--script", scripts[0], scripts[1], "--sensors", "i,w", "--json"];
    let judged: serde_json::Value = serde_json::from_str(&bench.done(&judge).out).expect("JSON");
    // two scripts of 8 s, 100 rows a second, a current and a speed of each of four wheels
    assert_eq!(judged["numbers"], 2 * 800 * 8);
    let rehearse = [&ask[..], &["--rehearse", "paper", "--out", "played"]].concat();
    assert!(bench.done(&rehearse).out.contains("next: omni-gap diagnose played/session"));
    let (run, notices) = Run::load(&bench.at("played/session/runs/rich-1.csv"), 4, None).unwrap();
    assert_eq!((run.rows(), notices), (200, Vec::new()));
    for (more, told) in [
        (["--only", "step"], "'--rich' cannot be used with '--only"),
        (["--repeats", "2"], "'--rich' cannot be used with '--repeats"),
        (["--duration", "2"], "expected seconds, from 8 to 120"),
    ] {
        refused(&bench, &[&["experiment", "robot.toml", "--rich", "--out", "other"], &more[..]].concat(), &[told]);
    }
    refused(&bench, &["experiment", "robot.toml", "--scripts", "2", "--out", "other"], &["--rich"]);
}

#[test]
fn what_cannot_be_asked_of_the_experiments_is_refused() {
    let bench = with_robot(ROBOT);
    let with = |more: &[&'static str]| [&["experiment", "robot.toml"][..], &OUT, more].concat();
    refused(&bench, &with(&["--voltage", "14"]), &["its supply gives 12.0 V", "no more than"]);
    refused(&bench, &with(&["--only", "jump"]), &["jump", "expected spin (or 1)"]);
    refused(&bench, &with(&["--rehearse", "well"]), &["well", "paper, modern, halls"]);
    refused(&bench, &with(&["--rate", "0"]), &["--rate", "from 10 to 10000"]);
    refused(&bench, &["experiment", "nowhere.toml", "--out", "morning"], &["nowhere.toml: no such file"]);
    refused(&bench, &["experiment", "robot.toml", "--out", "robot.toml"], &["it is a file, not a folder"]);
}

#[test]
fn a_rehearsed_robot_is_found_again_though_its_file_was_wrong_by_a_fifth() {
    let bench = rehearsed("spin,step");
    for (key, wrong) in [("resistance_ohm = 4.3111", "5.17332"), ("inertia_kg_m2 = 0.0228", "0.01824")] {
        let name = key.split(' ').next().unwrap();
        bench.change("morning/session/robot.toml", key, &format!("{name} = {wrong}"));
    }
    let args = ["identify", "morning/session", "--experiment", "all", "--out", "found.toml", "--json", "found.json"];
    let said = bench.done(&args);
    for part in [
        "2 runs of experiment 1",
        "9 of experiment 3",
        "exp. 3, IV",
        "identified",
        "no wheel speeds are logged",
        "follows",
    ] {
        assert!(said.out.contains(part), "{part}: {}", said.out);
    }
    let (truth, found) = (robot(&bench, "robot.toml"), robot(&bench, "found.toml"));
    let near = |found: f64, truth: f64, within: f64| assert!((found / truth - 1.0).abs() < within, "{found} {truth}");
    // about three sigma of what the fit states for these few runs
    near(found.motor.resistance_ohm, truth.motor.resistance_ohm, 0.01);
    near(found.motor.emf_constant_v_s, truth.motor.emf_constant_v_s, 0.01);
    near(found.body.inertia_kg_m2, truth.body.inertia_kg_m2, 0.01);
    near(found.friction.coulomb_w_nm, truth.friction.coulomb_w_nm, 0.03);
    assert!(found.uncertainty["resistance_ohm"] < 0.01 && found.uncertainty.contains_key("torque_constant_Nm_per_A"));
    let json: serde_json::Value = serde_json::from_str(&bench.read("found.json")).unwrap();
    let resistance = json["numbers"][0]["together"]["value"].as_f64().unwrap();
    near(found.motor.resistance_ohm, resistance, 1e-5);
    assert_eq!(json["numbers"][0]["key"], "resistance_ohm");
}

#[test]
fn one_experiment_alone_keeps_what_it_does_not_see_and_says_so() {
    let bench = rehearsed("spin");
    let said = bench.done(&["identify", "morning/session", "--experiment", "1", "--out", "found.toml"]);
    let kept = said.out.lines().find(|line| line.starts_with("kept")).expect("a line of what is kept");
    assert!(kept.contains("B_v, B_vn, C_v, C_vn are not seen"), "{kept}");
    let (before, after) = (robot(&bench, "robot.toml"), robot(&bench, "found.toml"));
    assert_eq!(after.friction.coulomb_v_n, before.friction.coulomb_v_n);
    assert_ne!(after.friction.coulomb_w_nm, before.friction.coulomb_w_nm);
    assert!(!after.uncertainty.contains_key("coulomb_v_N"));
}

#[test]
fn friction_that_the_file_states_as_zero_begins_at_a_guess() {
    let bench = rehearsed("spin");
    bench.change("morning/session/robot.toml", "coulomb_w_Nm = 0.1385", "coulomb_w_Nm = 0.0");
    let said = bench.done(&["identify", "morning/session", "--experiment", "spin", "--out", "found.toml"]);
    assert!(said.out.contains("C_ω is zero in the file and began at a guess, 0.102 N·m"), "{}", said.out);
    let found = robot(&bench, "found.toml").friction.coulomb_w_nm;
    assert!((found / 0.1385 - 1.0).abs() < 0.03, "{found}");
}

#[test]
fn a_robot_that_stands_still_is_refused_with_the_reason() {
    let bench = with_robot(ROBOT);
    bench.write("session/robot.toml", ROBOT);
    let mut text = "t_s,u0_V,u1_V,u2_V,u3_V,x_m,y_m,theta_rad\n".to_owned();
    for row in 0..200 {
        let wobble = 0.002 * f64::from(row * 7 % 5 - 2);
        text += &format!("{},0,0,0,0,{wobble},{},{wobble}\n", 0.04 * f64::from(row), -wobble);
    }
    bench.write("session/runs/spin-left.csv", &text);
    let args = ["identify", "session", "--experiment", "all", "--out", "found.toml", "--json", "found.json"];
    refused(&bench, &args, &["never moves", "motors were enabled"]);
}

#[test]
fn an_experiment_without_runs_is_refused_with_the_names_that_are_looked_for() {
    let bench = Bench::with_session();
    let ask = |which: &'static str| ["identify", "session", "--experiment", which, "--out", "found.toml"];
    refused(&bench, &ask("2"), &["no run of experiment 2", "coast-v-1", "omni-gap experiment"]);
    refused(&bench, &ask("all"), &["no run of any of the experiments", "spin-…, coast-…", "omni-gap experiment"]);
    refused(&bench, &ask("4"), &["'4'", "1 (or spin)"]);
    let both = ["identify", "session", "--experiment", "1", "--out", "found", "--json", "found"];
    refused(&bench, &both, &["named by --json and by --out"]);
    refused(&bench, &["identify", "session", "--experiment", "1", "--out", "session"], &["it is a folder"]);
}
