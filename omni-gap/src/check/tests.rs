use super::synthetic::{Made, robot, run};
use super::*;
use crate::log::{Channel, Group};

pub(super) fn fatal(run: &Run, wheels: usize) -> Vec<String> {
    let faults = check_run(run, &robot(wheels));
    faults.iter().filter(|f| f.fatal).map(|f| format!("{} {}: {}", f.code, f.signal, f.sentence)).collect()
}

pub(super) fn any(run: &Run, wheels: usize) -> Vec<String> {
    check_run(run, &robot(wheels)).iter().map(|f| format!("{} {}: {}", f.code, f.signal, f.sentence)).collect()
}

/// Each way of logging: which groups are there.
fn with_and_without(whole: &Run) -> Vec<(&'static str, Run)> {
    vec![
        ("all", whole.clone()),
        ("no pose", Run { pose: None, ..whole.clone() }),
        ("no current", Run { i: None, ..whole.clone() }),
        ("no voltage", Run { u: None, ..whole.clone() }),
        ("no speed", Run { w: None, ..whole.clone() }),
        ("only pose", Run { u: None, i: None, w: None, ..whole.clone() }),
        ("only speed", Run { u: None, i: None, pose: None, ..whole.clone() }),
        ("only current", Run { u: None, w: None, pose: None, ..whole.clone() }),
    ]
}

#[test]
fn clean_runs_raise_nothing_with_any_groups_missing() {
    for wheels in [3, 4] {
        for straight in [false, true] {
            let whole = run(&Made { wheels, straight, ..Made::default() });
            for (name, run) in with_and_without(&whole) {
                assert_eq!(any(&run, wheels), [""; 0], "{wheels} wheels, {name}, straight {straight}");
            }
        }
    }
}

#[test]
fn a_robot_at_rest_raises_nothing_with_noise_or_without() {
    for noise in [0.0, 1.0] {
        let rest = run(&Made { drive: 0.0, noise, ..Made::default() });
        for (name, run) in with_and_without(&rest) {
            assert_eq!(any(&run, 4), [""; 0], "{name}, noise {noise}");
        }
    }
}

#[test]
fn a_robot_too_weakly_driven_to_move_raises_nothing() {
    for noise in [0.0, 1.0] {
        let stuck = run(&Made { drive: 0.8, noise, ..Made::default() });
        assert_eq!(any(&stuck, 4), [""; 0], "noise {noise}");
    }
}

#[test]
fn effects_and_wrong_parameters_are_no_faults_of_the_log() {
    let made = Made::default();
    let cases = [
        ("dead zone", Made { dead_volts: 0.5, ..made.clone() }),
        ("weak motor", Made { weak: 0.7, ..made.clone() }),
        ("slip", Made { slip: 1.35, ..made.clone() }),
        ("latency", Made { latency_s: 0.1, ..made.clone() }),
        ("slope", Made { slope: 0.3, ..made.clone() }),
        ("offset", Made { offset_a: 0.1, ..made.clone() }),
        ("30 % more", Made { wrong: 1.3, ..made.clone() }),
        ("30 % less", Made { wrong: 0.7, ..made.clone() }),
        ("noisy", Made { noise: 5.0, ..made.clone() }),
        ("noiseless", Made { noise: 0.0, ..made.clone() }),
        ("slow log", Made { step_s: 0.03, ..made.clone() }),
        ("fast log", Made { step_s: 0.002, ..made.clone() }),
        ("gentle", Made { drive: 3.0, ..made.clone() }),
        (
            "everything",
            Made {
                dead_volts: 0.5,
                weak: 0.7,
                slip: 1.2,
                latency_s: 0.1,
                slope: 0.3,
                offset_a: 0.1,
                wrong: 1.3,
                ..made
            },
        ),
    ];
    for (name, made) in cases {
        for wheels in [3, 4] {
            for straight in [false, true] {
                let whole = run(&Made { wheels, straight, ..made.clone() });
                for (groups, run) in with_and_without(&whole) {
                    assert_eq!(fatal(&run, wheels), [""; 0], "{name}, {wheels} wheels, {groups}, straight {straight}");
                }
            }
        }
    }
}

pub(super) fn changed(run: &Run, group: &str, change: impl Fn(usize, &Channel) -> Channel) -> Run {
    let mut run = run.clone();
    let group: &mut Group = match group {
        "u" => &mut run.u,
        "i" => &mut run.i,
        "w" => &mut run.w,
        _ => &mut run.pose,
    }
    .as_mut()
    .unwrap();
    group.channels = group.channels.iter().enumerate().map(|(j, c)| change(j, c)).collect();
    run
}

pub(super) fn swapped(run: &Run, group: &str, a: usize, b: usize) -> Run {
    let before = changed(run, group, |_, c| c.clone());
    let mut run = before;
    let channels = match group {
        "u" => &mut run.u,
        "i" => &mut run.i,
        _ => &mut run.w,
    };
    channels.as_mut().unwrap().channels.swap(a, b);
    run
}

/// A fatal fault of this code and signal, and no other fatal one.
pub(super) fn expect(run: &Run, wheels: usize, code: &str, signal: &str, what: &str) {
    let faults = check_run(run, &robot(wheels));
    let fatal: Vec<_> =
        faults.iter().filter(|f| f.fatal).map(|f| (f.code, f.signal.as_str(), f.sentence.as_str())).collect();
    assert!(!fatal.is_empty() && fatal.iter().all(|f| f.0 == code && f.1.contains(signal)), "{what}: {fatal:?}");
}

#[test]
fn a_drive_that_answers_late_is_no_fault_of_the_log() {
    for (wheels, rows) in [(3, 2), (4, 5), (4, 8)] {
        let clean = run(&Made { wheels, ..Made::default() });
        let early = changed(&clean, "u", |_, c| (0..c.len()).map(|row| c.get((row + rows).min(c.len() - 1))).collect());
        for (groups, run) in with_and_without(&early) {
            assert_eq!(fatal(&run, wheels), [""; 0], "{rows} rows late, {groups}");
        }
    }
}
