//! # What `check` finds in staged recordings, and what it leaves alone
//!
//! The robots are staged, so their truth is known: whatever effect they have and however wrong their file is, their
//! recordings are sound and raise nothing. Then faults of recordings are put in, and each must be found and named.

use model_core::effects::EffectKind;
use model_core::effects::card::{Role, Scope};
use omni_gap::check::{Fault, check};
use omni_gap::log::{Channel, Group, RobotFile, Run, Session};
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};

const ROBOTS: [(&str, &str, usize); 2] = [
    ("feup-3w", include_str!("../../examples/feup-3w/robot.toml"), 3),
    ("feup-4w", include_str!("../../examples/feup-4w/robot.toml"), 4),
];

fn plan() -> Scenario {
    Scenario { runs: 3, duration: 3.0, rate: 200.0, ..Scenario::default() }
}

fn staged(robot: &str, plan: &Scenario) -> Session {
    synthesize(robot, plan, &omni_gap::known_effects()).expect("an example is a sound robot file")
}

fn words(faults: &[Fault]) -> Vec<String> {
    faults.iter().map(|f| format!("{} {} {} [{}]: {}", f.fatal, f.code, f.signal, f.run, f.sentence)).collect()
}

/// Every effect at `times` its typical size, on the robot, on all wheels and on single ones.
fn effects_at(times: f64, wheels: usize) -> Vec<EffectInstance> {
    let mut all = Vec::new();
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let places = match card.scope {
            Scope::Robot => vec![None],
            Scope::Wheels => vec![None, Some(wheels - 1)],
            Scope::OneWheel => vec![Some(0), Some(wheels - 1)],
        };
        for place in places {
            let mut carried = EffectInstance::typical(card, place);
            for (param, value) in card.params.iter().zip(&mut carried.params) {
                if param.role == Role::Size {
                    let sized = param.absent + times * (param.typical - param.absent);
                    *value = sized.clamp(param.within.0, param.within.1);
                }
            }
            all.push(carried);
        }
    }
    all
}

#[test]
fn a_clean_session_raises_nothing() {
    for (name, robot, _) in ROBOTS {
        for (seed, rate, voltage) in [(1, 200.0, 4.0), (2, 500.0, 8.0), (3, 100.0, 11.0)] {
            let plan = Scenario { seed, rate, voltage, ..plan() };
            assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
        }
    }
}

#[test]
fn no_effect_of_the_robot_is_taken_for_a_fault_of_the_recording() {
    for (name, robot, wheels) in ROBOTS {
        for (times, voltage) in [(1.0, 8.0), (2.0, 11.0)] {
            for effect in effects_at(times, wheels) {
                let plan = Scenario { runs: 2, voltage, hidden: vec![effect], ..plan() };
                assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
            }
        }
    }
}

#[test]
fn no_effect_at_a_bound_of_its_card_is_taken_for_a_fault_of_the_recording() {
    for (name, robot, wheels) in ROBOTS {
        for effect in effects_at(1.0, wheels) {
            for (k, param) in effect.card().params.iter().enumerate().filter(|(_, p)| p.role == Role::Size) {
                for bound in [param.within.0, param.within.1] {
                    let mut hidden = effect.clone();
                    hidden.params[k] = bound;
                    let plan = Scenario { runs: 2, seed: 11, hidden: vec![hidden], ..plan() };
                    assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
                }
            }
        }
    }
}

#[test]
fn nothing_hidden_raises_nothing_at_any_rate_or_drive() {
    for (name, robot, _) in ROBOTS {
        for seed in 0..10 {
            let (rate, voltage) = ([25.0, 100.0, 500.0][seed as usize % 3], [3.0, 8.0][seed as usize % 2]);
            let plan = Scenario { seed, rate, voltage, ..plan() };
            assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
        }
    }
}

#[test]
fn wheels_that_slip_in_one_run_of_a_session_are_not_swapped() {
    let slip = EffectKind::find("wheel_slip").expect("the catalogue has it").card();
    for (name, robot, _) in ROBOTS {
        let hidden = vec![EffectInstance::typical(slip, None)];
        let plan = Scenario { runs: 6, duration: 4.0, seed: 2008, hidden, ..plan() };
        assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
    }
}

#[test]
fn no_wrong_parameter_is_taken_for_a_fault_of_the_recording() {
    let friction = ["coulomb_v_N", "coulomb_vn_N", "coulomb_w_Nm"];
    let keys: [&[&str]; 4] = [&["resistance_ohm"], &["mass_kg", "inertia_kg_m2"], &friction, &["emf_constant_V_s"]];
    for (name, robot, _) in ROBOTS {
        for keys in keys {
            for factor in [0.6, 1.4] {
                let wrong = keys.iter().map(|key| (*key, factor)).collect();
                let plan = Scenario { runs: 2, wrong, seed: 7, ..plan() };
                assert_eq!(words(&check(&staged(robot, &plan))), [""; 0], "{name}, {plan:?}");
            }
        }
    }
}

/// What is put into a run, and the code and signal that must name it.
type Injected = (&'static str, &'static str, &'static str, fn(&mut Run));

fn group<'a>(run: &'a mut Run, stem: &str) -> &'a mut Vec<Channel> {
    let group: &mut Option<Group> = match stem {
        "u" => &mut run.u,
        "i" => &mut run.i,
        "w" => &mut run.w,
        _ => &mut run.pose,
    };
    &mut group.as_mut().expect("a staged run has all groups").channels
}

/// Multiplies one channel of a group, or all of them.
fn times(run: &mut Run, stem: &str, only: Option<usize>, factor: f64) {
    for (j, channel) in group(run, stem).iter_mut().enumerate() {
        if only.is_none_or(|only| only == j) {
            *channel = channel.map(|_, value| factor * value);
        }
    }
}

/// From two fifths of the run on, one value.
fn freeze(run: &mut Run, stem: &str, which: usize) {
    let from = run.rows() * 2 / 5;
    let channel = &mut group(run, stem)[which];
    let stands = channel.present().find(|(row, _)| *row >= from).expect("samples to the end").1;
    *channel = channel.map(|row, value| if row >= from { stands } else { value });
}

/// Cuts a group's channels at what four fifths of their samples stay below.
fn clip(run: &mut Run, stem: &str) {
    for channel in group(run, stem) {
        let mut all: Vec<f64> = channel.present().map(|(_, value)| value.abs()).collect();
        all.sort_by(f64::total_cmp);
        let limit = all[all.len() * 4 / 5];
        *channel = channel.map(|_, value| value.clamp(-limit, limit));
    }
}

/// Every seventh sample comes with the one after it.
fn bunch(run: &mut Run) {
    for channel in group(run, "w") {
        let before = channel.clone();
        *channel = channel.map(|row, value| match row % 7 {
            3 => 0.0,
            4 => value + before.get(row - 1).expect("a wheel speed in each row"),
            _ => value,
        });
    }
}

fn clock_back(run: &mut Run) {
    let half = run.rows() / 2;
    run.t_s.iter_mut().skip(half).for_each(|t| *t -= 0.5);
}

const INJECTED: [Injected; 28] = [
    ("w0 and w1 swapped", "swapped_wheels", "w", |r| group(r, "w").swap(0, 1)),
    ("w0 and w2 swapped", "swapped_wheels", "w", |r| group(r, "w").swap(0, 2)),
    ("all w in another order", "swapped_wheels", "w", |r| group(r, "w").rotate_left(1)),
    ("i0 and i1 swapped", "swapped_wheels", "i", |r| group(r, "i").swap(0, 1)),
    ("i0 and i2 swapped", "swapped_wheels", "i", |r| group(r, "i").swap(0, 2)),
    ("u0 and u1 swapped", "swapped_wheels", "u", |r| group(r, "u").swap(0, 1)),
    ("wheels 0 and 1 swapped throughout", "swapped_wheels", "w", |r| {
        ["u", "i", "w"].into_iter().for_each(|stem| group(r, stem).swap(0, 1));
    }),
    ("w1 negated", "wrong_sign", "w", |r| times(r, "w", Some(1), -1.0)),
    ("i0 negated", "wrong_sign", "i", |r| times(r, "i", Some(0), -1.0)),
    ("all w negated", "wrong_sign", "w", |r| times(r, "w", None, -1.0)),
    ("all i negated", "wrong_sign", "i", |r| times(r, "i", None, -1.0)),
    ("heading negated", "wrong_sign", "theta_rad", |r| times(r, "pose", Some(2), -1.0)),
    ("y negated", "wrong_sign", "y_m", |r| times(r, "pose", Some(1), -1.0)),
    ("heading in degrees", "wrong_unit", "theta_rad", |r| times(r, "pose", Some(2), 1f64.to_degrees())),
    ("x and y in millimetres", "wrong_unit", "x_m", |r| {
        (0..2).for_each(|axis| times(r, "pose", Some(axis), 1000.0));
    }),
    ("millivolts", "wrong_unit", "u", |r| times(r, "u", None, 1000.0)),
    ("milliamperes", "wrong_unit", "i", |r| times(r, "i", None, 1000.0)),
    ("rpm", "wrong_unit", "w", |r| times(r, "w", None, 30.0 / std::f64::consts::PI)),
    ("degrees per second", "wrong_unit", "w", |r| times(r, "w", None, 1f64.to_degrees())),
    ("w1 freezes", "frozen", "w1_rad_s", |r| freeze(r, "w", 1)),
    ("i1 freezes", "frozen", "i1_A", |r| freeze(r, "i", 1)),
    ("heading freezes", "frozen", "theta_rad", |r| freeze(r, "pose", 2)),
    ("w2 is dead", "frozen", "w2_rad_s", |r| times(r, "w", Some(2), 0.0)),
    ("i2 is dead", "frozen", "i2_A", |r| times(r, "i", Some(2), 0.0)),
    ("w clipped", "saturated", "w", |r| clip(r, "w")),
    ("i clipped", "saturated", "i", |r| clip(r, "i")),
    ("w comes in bunches", "bunched", "w", bunch),
    ("the clock runs back", "clock_runs_back", "t_s", clock_back),
];

/// What a session raises with something put into all of its runs or into the last one alone.
fn raised(session: &Session, inject: fn(&mut Run), last_only: bool) -> Vec<Fault> {
    let mut session = session.clone();
    let first = if last_only { session.runs.len() - 1 } else { 0 };
    session.runs[first..].iter_mut().for_each(inject);
    check(&session)
}

#[test]
fn every_fault_of_the_recording_is_found_and_named_in_all_runs_and_in_one() {
    let mut missed = Vec::new();
    for (name, robot, _) in ROBOTS {
        for (seed, wrong) in [(1, vec![]), (3, vec![("resistance_ohm", 1.4), ("coulomb_v_N", 0.6)])] {
            let session = staged(robot, &Scenario { seed, wrong, ..plan() });
            for (what, code, signal, inject) in INJECTED {
                for last_only in [false, true] {
                    let faults = raised(&session, inject, last_only);
                    let fatal: Vec<&Fault> = faults.iter().filter(|f| f.fatal).collect();
                    let last = &session.runs[session.runs.len() - 1].name;
                    let named = |f: &&Fault| f.code == code && f.signal.contains(signal);
                    let in_place = |f: &&Fault| !last_only || f.run == *last;
                    if !fatal.iter().any(named) || !fatal.iter().all(in_place) {
                        missed.push(format!("{name}, {seed}, {what}, one run {last_only}: {:?}", words(&faults)));
                    }
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn a_swap_in_one_short_slow_run_is_found() {
    let plan = Scenario { duration: 2.0, rate: 100.0, ..plan() };
    for (name, robot, _) in ROBOTS {
        let session = staged(robot, &plan);
        let faults = raised(&session, |run| group(run, "w").swap(0, 1), true);
        let fatal: Vec<_> = faults.iter().filter(|f| f.fatal).map(|f| (f.code, f.signal.as_str())).collect();
        assert_eq!(fatal, [("swapped_wheels", "w")], "{name}: {:?}", words(&faults));
    }
}

/// Lets the run rest on for three seconds, in which a hand takes the robot half a metre along and lets go.
fn push(run: &mut Run, robot: &RobotFile) {
    let (step, end) = (run.median_step_s(), run.t_s[run.rows() - 1]);
    let seen = |channel: &Channel| channel.present().last().expect("a pose").1;
    let [x, y, theta] = [0, 1, 2].map(|axis| seen(&group(run, "pose")[axis]));
    let per_speed = robot.volts_per_wheel_speed() / robot.motor.resistance_ohm;
    for row in 1..=(3.0 / step) as usize {
        let t = row as f64 * step;
        let phase = ((t - 1.0) / 1.0).clamp(0.0, 1.0) * std::f64::consts::TAU;
        let (speed, way) = (0.5 * (1.0 - phase.cos()), 0.5 * (phase - phase.sin()) / std::f64::consts::TAU);
        run.t_s.push(end + t);
        for (j, wheel) in robot.wheel.iter().enumerate() {
            let turns = wheel.wheel().row()[0] * speed / wheel.radius_m;
            group(run, "u")[j].push(0.0);
            group(run, "w")[j].push(turns + 0.01 * (37.0 * t).sin());
            group(run, "i")[j].push(0.001 * (41.0 * t).cos() - per_speed * turns);
        }
        for (axis, value) in [x + way * theta.cos(), y + way * theta.sin(), theta].into_iter().enumerate() {
            group(run, "pose")[axis].push(value + 0.001 * (43.0 * t).sin());
        }
    }
}

#[test]
fn a_hand_that_pushes_is_told() {
    for (name, robot, _) in ROBOTS {
        let mut session = staged(robot, &Scenario { runs: 1, ..plan() });
        let file = session.robot.clone();
        push(&mut session.runs[0], &file);
        let faults = check(&session);
        assert!(faults.iter().any(|f| f.code == "pushed"), "{name}: {:?}", words(&faults));
        assert!(faults.iter().all(|f| f.code == "pushed" || !f.fatal), "{name}: {:?}", words(&faults));
    }
}
