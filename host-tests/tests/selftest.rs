//! The self-test against what it speaks of: recordings, and what a diagnosis finds in them.

use std::path::Path;

use host_tests::paper_source::tree;
use omni_gap::api::{Driven, PlannedRuns, SelfTest, SelftestKnobs, selftest, verify};
use omni_gap::engine::findings::SeenCause;
use omni_gap::identify::{Extent, FreedPrior, Prior};
use omni_gap::log::{Channel, Group, RobotFile, Run};
use omni_gap::simulate::{EffectInstance, SignalGroup};
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Options, diagnose, known_effects};

/// What is planned: runs, length [s], rows a second [1/s], camera frames a second [1/s] and largest voltage [V].
const RUNS: usize = 6;
const DURATION: f64 = 6.0;
const RATE: f64 = 100.0;
const CAMERA: f64 = 60.0;
const VOLTAGE: f64 = 8.0;

fn text(name: &str) -> String {
    std::fs::read_to_string(tree().join("examples").join(name).join("robot.toml")).expect("an example")
}

fn robot(text: &str) -> RobotFile {
    RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).unwrap_or_else(|why| panic!("{why}"))
}

/// The same robot with so many times the noise.
fn with_noise(file: &RobotFile, times: f64) -> RobotFile {
    let mut file = file.clone();
    let s = &mut file.sensors;
    for noise in
        [&mut s.current_noise_a, &mut s.wheel_speed_noise_rad_s, &mut s.position_noise_m, &mut s.heading_noise_rad]
    {
        *noise *= times;
    }
    file
}

fn planned() -> PlannedRuns {
    let driven = Driven::Random { runs: RUNS, duration: DURATION, rate: RATE, voltage: VOLTAGE };
    PlannedRuns {
        driven,
        logged: vec![SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose],
        camera_rate: CAMERA,
    }
}

fn said(file: &RobotFile, plan: &PlannedRuns) -> SelfTest {
    selftest(file, plan, &SelftestKnobs::default()).unwrap_or_else(|why| panic!("{why}"))
}

fn of<'a>(said: &'a SelfTest, id: &str) -> &'a SeenCause {
    said.causes.iter().find(|cause| cause.cause == id).unwrap_or_else(|| panic!("{id} is not judged"))
}

/// A script of ten seconds: voltages (u₀, u₁, u₂, u₃) by time, with currents, wheel speeds and poses logged.
fn script(u: impl Fn(f64) -> [f64; 4]) -> PlannedRuns {
    let t: Vec<f64> = (0..(10.0 * RATE) as u32).map(|row| f64::from(row) / RATE).collect();
    let volts: Vec<Channel> = (0..4).map(|j| Channel::from_values(t.iter().map(|t| u(*t)[j]))).collect();
    let logged = |count: usize| Some(Group::new(vec![Channel::from_values(t.iter().map(|_| 0.0)); count]));
    let run = Run { u: Some(Group::new(volts)), i: logged(4), w: logged(4), pose: logged(3), ..Run::default() };
    PlannedRuns::of_scripts(vec![Run { name: "script".to_owned(), t_s: t.clone(), ..run }])
}

#[test]
fn lost_commands_are_seen_where_four_that_change_anything_are_lost() {
    let file = robot(&text("feup-4w"));
    // a change every quarter of a second, the first of which changes nothing that was heard before
    let turns =
        |changes: f64| script(move |t| [if ((t * changes / 10.0) as usize).is_multiple_of(2) { 5.0 } else { 2.0 }; 4]);
    for changes in [40.0, 80.0] {
        let loss = of(&said(&file, &turns(changes)), "command_loss").seen_from;
        let expected = 4.0 / (changes - 1.0);
        assert!(loss.is_some_and(|share| (share - expected).abs() < 1e-9), "{loss:?} against {expected}");
    }
    // with fifteen, more would have to be lost than may be
    assert_eq!(of(&said(&file, &turns(15.0)), "command_loss").seen_from, None);
}

#[test]
fn motion_along_one_axis_does_not_show_coriolis_and_motion_along_all_does() {
    let file = robot(&text("feup-4w"));
    // wheels at 90°, 180°, 270°, 0°: forwards, wheels 1 and 3 turn against each other
    let ahead = |t: f64| 6.0 * (1.3 * t).sin();
    let straight = said(&file, &script(|t| [0.0, -ahead(t), 0.0, ahead(t)]));
    let turning = said(&file, &script(|t| [4.0, 4.0 - ahead(t), 4.0, 4.0 + ahead(t)]));
    // a robot that does not turn has no Coriolis force, but for the noise in its starts
    assert!(of(&straight, "coriolis").sigma < 0.1 * of(&turning, "coriolis").sigma);
    assert_eq!(of(&straight, "coriolis").seen_times, None);
    assert!(of(&turning, "coriolis").seen_times.is_some());
}

#[test]
fn half_the_noise_shows_twice_as_much_where_nothing_is_stated_to_hide_behind() {
    let coarse = robot(&text("feup-4w"));
    let fine = with_noise(&coarse, 0.5);
    let (coarse, fine) = (said(&coarse, &planned()), said(&fine, &planned()));
    for id in ["dead_time", "floor_tilt", "encoder_scale", "marker_offset"] {
        let ratio = of(&fine, id).sigma / of(&coarse, id).sigma;
        // what starts and numbers imitate, and starts read off noisy recordings, move by a few per cent
        assert!((1.8..2.2).contains(&ratio), "{id}: {ratio}");
    }
}

#[test]
fn a_sensor_that_is_not_there_shows_nothing_and_is_what_to_add() {
    let said = said(&robot(&text("feup-3w")), &planned());
    assert_eq!(of(&said, "gyro_bias").sigma, 0.0);
    let gyro = said.with_sensor.iter().find(|with| with.sensor == "gyro").expect("a sensor to add");
    assert!(gyro.seen.contains(&"gyro_bias") && gyro.named.contains(&"gyro_bias"), "{gyro:?}");
}

/// The id that a diagnosis gives to recordings as planned of a robot that hides an effect whose first number is `size`.
fn named(text: &str, cause: &SeenCause, size: f64, seed: u64) -> Option<String> {
    let card = model_core::effects::EffectKind::find(cause.cause).expect("an effect").card();
    let mut hidden = EffectInstance::typical(card, cause.wheel);
    let first = card.param(cause.parameter).expect("its own number");
    hidden.params[first] = size;
    let plan = Scenario {
        hidden: vec![hidden],
        uncertain: false,
        runs: RUNS,
        duration: DURATION,
        rate: RATE,
        voltage: VOLTAGE,
        seed,
        ..Scenario::default()
    };
    let session = synthesize(text, &plan, &known_effects()).expect("a sound robot file");
    diagnose(&session, &Options::default()).causes.first().cloned()
}

#[test]
fn a_diagnosis_names_what_is_thrice_the_size_to_be_named_and_not_what_is_half_of_that_to_be_seen() {
    let text = text("feup-4w");
    let said = said(&robot(&text), &planned());
    for id in ["dead_time", "floor_tilt", "encoder_scale"] {
        let cause = of(&said, id);
        let (Some(seen_from), Some(named_from)) = (cause.seen_from, cause.named_from) else {
            panic!("{id} is never named: {cause:?}");
        };
        assert_eq!(named(&text, cause, 3.0 * named_from, 5).as_deref(), Some(id));
        assert_eq!(named(&text, cause, 0.5 * seen_from, 5), None, "{id} at half of {seen_from}");
    }
}

/// The robot file with numbers that are stated to be just so.
fn exactly(text: &str, keys: &[&str]) -> String {
    let lines: String = keys.iter().map(|key| format!("{key} = 0.0001\n")).collect();
    format!("{text}\n[uncertainty]\n{lines}")
}

#[test]
fn what_the_robots_own_numbers_imitate_is_not_foretold_and_the_number_that_would_show_it_does() {
    let text = text("feup-4w");
    let usual = said(&robot(&text), &planned());
    for id in ["rotor_inertia", "roller_friction"] {
        let hidden = of(&usual, id);
        assert!(!hidden.is_seen() && hidden.imitated > 0.95, "{hidden:?}");
        assert_eq!(named(&text, hidden, hidden.typical, 5), None, "{id}");
    }
    // a rotor's inertia is the body's mass and inertia to every sensor, or weaker motors and less friction
    let best = &of(&usual, "rotor_inertia").imitated_by[0];
    let known = exactly(&text, &[best.number]);
    let told = said(&robot(&known), &planned());
    let (foretold, then) = (best.sigma_if_exact, of(&told, "rotor_inertia").sigma);
    assert!((0.8..1.25).contains(&(then / foretold)), "{}: {foretold} σ foretold, {then} σ then", best.number);
    assert_eq!(of(&told, "rotor_inertia").is_seen(), best.then_seen);
}

/// Short recordings, and what they show of these causes beside what was foretold.
fn verified(file: &RobotFile, ids: &[&str]) -> SelfTest {
    let driven = Driven::Random { runs: 3, duration: 3.0, rate: RATE, voltage: VOLTAGE };
    let plan = PlannedRuns { driven, ..planned() };
    let mut said = said(file, &plan);
    said.causes.retain(|cause| ids.contains(&cause.cause));
    verify(file, &plan, &mut said, &SelftestKnobs::default(), &|_| ()).expect("a sound plan");
    said
}

fn found(said: &SelfTest, id: &str) -> Option<f64> {
    of(said, id).verified.expect("it was looked for").from
}

#[test]
fn simulated_recordings_show_an_offset_from_the_size_on_that_its_closed_form_says() {
    let file = robot(&text("feup-4w"));
    let said = verified(&file, &["current_sensor_offset", "gyro_bias", "wheel_radius"]);
    // b²/(σ² + b²) = share     an offset b of every current that nothing imitates takes this share of Σ error²
    let share = SelftestKnobs::default().engine.search.relevant;
    let offset = file.sensors.current_noise_a * (share / (1.0 - share)).sqrt();
    let times = found(&said, "current_sensor_offset").expect("it is seen") / offset;
    assert!((0.9..1.1).contains(&times), "{times} times {offset} A");
    // without a gyro
    assert_eq!(found(&said, "gyro_bias"), None);
    // (ln(1 + x)/σ)² − (ln(1 + x)/loose)² = gain     a radius that recordings tell well, and a statement of σ struck out
    let SelftestKnobs { engine, .. } = SelftestKnobs::default();
    let gain = engine.search.convincing + engine.search.convincing_each + engine.search.price_of_freedom;
    let stated = Prior::stated(&file);
    let release = FreedPrior { cause: "wheel_radius", extent: Extent::Each };
    let sigma = stated.rows[stated.rows_of(release)[0]].sigma;
    let weight = sigma.powi(-2) - engine.fit.released_sigma.powi(-2);
    let wrong = (gain / weight).sqrt().exp_m1();
    let times = found(&said, "wheel_radius").expect("it is seen") / wrong;
    assert!((0.9..1.1).contains(&times), "{times} times {wrong}");
}

#[test]
fn twice_the_noise_needs_twice_the_size_in_simulated_recordings() {
    let fine = robot(&text("feup-3w"));
    let coarse = with_noise(&fine, 2.0);
    let ids = ["cog_offset", "floor_tilt"];
    let (fine, coarse) = (verified(&fine, &ids), verified(&coarse, &ids));
    for id in ids {
        let ratio = found(&coarse, id).zip(found(&fine, id)).map(|(coarse, fine)| coarse / fine);
        assert!(ratio.is_some_and(|ratio| (1.7..2.3).contains(&ratio)), "{id}: {ratio:?}");
    }
}
