//! Signals beside currents, wheel speeds and pose, and a command that the drive does not follow: what the diagnosis says.

use host_tests::catalogue::sessions::truth;
use model_core::effects::EffectKind;
use model_core::plant::Input;
use omni_gap::log::{Channel, Group, RobotFile, Run, Session};
use omni_gap::report::terminal;
use omni_gap::simulate::{EffectInstance, Excitation, Model, SensorSetup, excite, record};
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::vocabulary::Stage;
use omni_gap::{Options, Report, Verdict, diagnose, known_effects};

/// A robot that logs yaw rate and battery voltage too, and hides these effects.
fn session(wheels: usize, hidden: Vec<EffectInstance>) -> Session {
    let plan =
        Scenario { hidden, runs: 8, duration: 3.0, rate: 200.0, seed: 7100, beside: true, ..Scenario::default() };
    synthesize(truth(wheels), &plan, &known_effects()).expect("an example is a sound robot file")
}

fn answer(session: &Session) -> Report {
    let report = diagnose(session, &Options::default());
    assert_eq!(report.violations(), Vec::<String>::new());
    report
}

#[track_caller]
fn answers(report: &Report, verdict: Verdict) {
    assert_eq!(report.verdict, verdict, "{:?} {:?} {:?}", report.causes, report.gap.signals, report.shrink);
}

fn each_run(mut session: Session, change: impl Fn(&mut Run)) -> Session {
    session.runs.iter_mut().for_each(change);
    session
}

/// Every sample of a channel moved by so much.
fn moved(channel: &mut Option<Channel>, by: f64) {
    *channel = channel.as_ref().map(|channel| channel.map(|_, x| x + by));
}

#[test]
fn yaw_rate_and_battery_are_groups_of_the_gap_beside_the_totals() {
    for wheels in [3, 4] {
        let with = session(wheels, vec![]);
        let report = answer(&with);
        answers(&report, Verdict::NoGap);
        assert_eq!(report.gap.signals.keys().collect::<Vec<_>>(), ["gyro", "i", "pose", "vbat", "w"]);
        // the total is the root mean square over the three that every simulator has
        let three = ["i", "w", "pose"].map(|group| report.gap.signals[group].before.powi(2));
        let total = (three.iter().sum::<f64>() / 3.0).sqrt();
        assert!((report.shrink.before.expect("a gap is measured") - total).abs() < 1e-12);
    }
}

#[test]
fn a_battery_that_is_less_full_than_the_file_says_is_no_gap() {
    let session = each_run(session(4, vec![]), |run| moved(&mut run.vbat, -0.8));
    answers(&answer(&session), Verdict::NoGap);
}

#[test]
fn a_gyro_with_an_offset_is_named_and_never_no_gap() {
    // 3 and 6 degrees a second
    for (wheels, offset) in [(3, 0.05), (4, 0.05), (4, -0.1)] {
        let report = answer(&each_run(session(wheels, vec![]), |run| moved(&mut run.gyro, offset)));
        answers(&report, Verdict::Effect);
        assert_eq!(report.causes, ["gyro_bias"], "{offset} rad/s on {wheels} wheels");
        let gyro = report.gap.signals["gyro"];
        // windows start from the gyro and forget it within them: what is left is a third over the floor, not the offset
        assert!(gyro.before > 1.15 * gyro.noise_floor, "{gyro:?}");
        assert_eq!(report.where_.iter().map(|place| place.stage).collect::<Vec<_>>(), [Stage::Sensing]);
    }
}

#[test]
fn what_stays_in_the_gyro_beside_a_cause_that_is_named_is_said() {
    let hidden = vec![EffectInstance::typical(EffectKind::DeadTime.card(), None)];
    let alone = answer(&session(4, hidden.clone()));
    answers(&alone, Verdict::Effect);
    assert!(!terminal(&alone, None).contains("A gap stays"));
    let both = answer(&each_run(session(4, hidden.clone()), |run| moved(&mut run.gyro, 0.1)));
    answers(&both, Verdict::Effect);
    assert_eq!(both.causes, ["gyro_bias", "dead_time"]);
    // a bias that wanders from one second to the next is none of the catalogue's
    let wandering = |channel: &Channel| channel.map(|row, x| x + if row % 400 < 200 { 0.05 } else { -0.05 });
    let both = answer(&each_run(session(4, hidden), |run| run.gyro = run.gyro.as_ref().map(wandering)));
    answers(&both, Verdict::Effect);
    assert!(both.causes.iter().any(|cause| cause == "dead_time"), "{:?}", both.causes);
    assert!(terminal(&both, None).contains("A gap stays in the yaw rate: "), "{}", terminal(&both, None));
}

#[test]
fn a_battery_that_sags_is_seen_in_its_group_and_named() {
    for (wheels, ohms) in [(3, 0.3), (4, 0.3), (4, 0.1)] {
        let mut sag = EffectInstance::typical(EffectKind::SupplySag.card(), None);
        sag.params[0] = ohms;
        let report = answer(&session(wheels, vec![sag]));
        answers(&report, Verdict::Effect);
        assert_eq!(report.causes, ["supply_sag"], "{ohms} Ω on {wheels} wheels");
        let (vbat, found) = (report.gap.signals["vbat"], report.cause("supply_sag").expect("it is named"));
        assert!(vbat.before > 1.15 * vbat.after, "{vbat:?}");
        let told = found.parameters["internal_resistance_ohm"].value;
        assert!((told / ohms - 1.0).abs() < 0.2, "{told} Ω of {ohms} Ω");
    }
}

/// A robot whose drive is given wheel speeds, and reaches them so much later [s].
fn by_set_speed(late_s: f64) -> Session {
    const RATE: f64 = 100.0;
    let text = truth(4);
    let robot = RobotFile::parse(text, "robot.toml".as_ref(), &known_effects()).expect("an example is sound");
    let model = Model::<4>::nominal(&robot, 12.0);
    let (plant, wheels) = (model.plant(), model.robot().wheels);
    let wish = Excitation { duration: 4.0, rate: RATE, voltage: 30.0 };
    let late = (late_s * RATE).round() as usize;
    let runs = (0..6).map(|k| {
        let asked = excite(&wheels, &wish, 7200 + k);
        // at rest until the first is heard
        let heard = |row: usize| row.checked_sub(late).map_or([0.0; 4], |row| asked[row]);
        let reached: Vec<_> = (0..asked.len()).map(|row| Input::Speed(heard(row))).collect();
        let t: Vec<f64> = (0..asked.len()).map(|row| row as f64 / RATE).collect();
        let mut run = record(&plant, &format!("run{k}"), &t, &reached, &SensorSetup::default(), 7300 + k);
        let column = |j: usize| asked.iter().map(|speeds| speeds[j]).collect();
        run.wset = Some(Group::from_columns((0..4).map(column).collect()));
        run
    });
    Session {
        robot,
        robot_text: text.to_owned(),
        runs: runs.collect(),
        heldout: Vec::new(),
        files: Vec::new(),
        notices: Vec::new(),
    }
}

#[test]
fn a_drive_that_follows_its_set_speed_is_no_gap_and_one_that_follows_late_is_named() {
    answers(&answer(&by_set_speed(0.0)), Verdict::NoGap);
    for late_s in [0.05, 0.2] {
        let report = answer(&by_set_speed(late_s));
        answers(&report, Verdict::Effect);
        assert_eq!(report.causes, ["speed_loop"], "{late_s} s late");
        assert!(report.gap.signals.contains_key("w"), "wheel speeds are compared with the set speeds");
        let found = &report.cause("speed_loop").expect("it is named").parameters;
        // within a row of 10 ms: speeds that jump in rows are read alike whenever within one they are heard
        let late = found["dead_time_s"].value + found["lag_s"].value;
        assert!((late - late_s).abs() < 0.01 && found["lag_s"].value < 0.01, "{found:?} of {late_s} s");
    }
}

#[test]
fn dead_time_and_lag_of_a_drive_are_told_apart() {
    // as of a robot of 27 kg
    let truth_of_it = [0.08, 0.14, 0.0];
    let mut hidden = EffectInstance::typical(EffectKind::SpeedLoop.card(), None);
    hidden.params = truth_of_it.to_vec();
    let plan = Scenario {
        hidden: vec![hidden],
        by_set_speed: true,
        rate: 100.0,
        duration: 4.0,
        runs: 6,
        seed: 7400,
        ..Scenario::default()
    };
    let report = answer(&synthesize(truth(4), &plan, &known_effects()).expect("an example is sound"));
    answers(&report, Verdict::Effect);
    assert_eq!(report.causes, ["speed_loop"]);
    let found = &report.cause("speed_loop").expect("it is named").parameters;
    for (key, wanted) in [("dead_time_s", 0.08), ("lag_s", 0.14), ("droop", 0.0)] {
        assert!((found[key].value - wanted).abs() < 0.005, "{key}: {} of {wanted}", found[key].value);
    }
}

#[test]
fn a_drive_that_leaves_out_small_speeds_is_named() {
    let hidden = vec![EffectInstance::typical(EffectKind::CommandDeadband.card(), None)];
    let plan = Scenario {
        hidden,
        by_set_speed: true,
        rate: 100.0,
        duration: 4.0,
        runs: 6,
        voltage: 4.0,
        seed: 7500,
        ..Scenario::default()
    };
    let report = answer(&synthesize(truth(4), &plan, &known_effects()).expect("an example is sound"));
    answers(&report, Verdict::Effect);
    assert_eq!(report.causes, ["command_deadband"]);
    let found = report.cause("command_deadband").expect("it is named").parameters["threshold_rad_s"].value;
    assert!((found - 2.0).abs() < 0.1, "{found} rad/s of 2");
}
