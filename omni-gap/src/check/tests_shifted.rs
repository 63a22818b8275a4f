use super::synthetic::{Made, robot, run};
use super::tests::changed;
use super::*;
use crate::log::{Channel, Missing};

/// A group whose samples are stamped so many rows later; what has no sample then is blank.
fn later(run: &Run, group: &str, rows: i32) -> Run {
    changed(run, group, |_, channel| {
        let at = |row: usize| usize::try_from(row as i32 - rows).ok().filter(|row| *row < channel.len());
        (0..channel.len()).map(|row| at(row).map_or(Err(Missing::Blank), |row| channel.get(row))).collect::<Channel>()
    })
}

/// What is said of a shift, and whether it is fatal.
fn told(run: &Run) -> Option<(String, bool)> {
    let faults = check_run(run, &robot(run.w.as_ref().unwrap().channels.len()));
    faults.into_iter().find(|fault| fault.code == "shifted_signals").map(|fault| (fault.sentence, fault.fatal))
}

fn clean(wheels: usize) -> Run {
    run(&Made { wheels, seconds: 24.0, ..Made::default() })
}

#[test]
fn wheels_that_answer_before_they_are_driven_are_named_with_the_shift() {
    for wheels in [3, 4] {
        for rows in [-30, -80] {
            let (sentence, fatal) = told(&later(&later(&clean(wheels), "w", rows), "i", rows)).unwrap();
            let seconds = format!("answer 0.{:.0}", rows.abs());
            assert!(fatal && sentence.contains(&seconds[..seconds.len() - 1]), "{wheels}, {rows}: {sentence}");
        }
        let (sentence, fatal) = told(&later(&later(&clean(wheels), "w", 120), "i", 120)).unwrap();
        assert!(!fatal && sentence.contains("after they are driven"), "{sentence}");
    }
}

#[test]
fn a_pose_that_moves_before_the_wheels_is_named() {
    for rows in [-40, 90] {
        let (sentence, fatal) = told(&later(&clean(4), "pose", rows)).unwrap();
        assert_eq!((fatal, sentence.contains("before the wheels turn")), (rows < 0, rows < 0), "{sentence}");
    }
}

#[test]
fn what_a_drive_or_a_camera_can_be_late_is_no_shift_of_the_log() {
    for wheels in [3, 4] {
        for made in [
            Made::default(),
            Made { latency_s: 0.25, ..Made::default() },
            Made { slip: 1.3, dead_volts: 1.0, weak: 0.5, slope: 0.5, ..Made::default() },
            Made { straight: true, ..Made::default() },
            Made { noise: 8.0, ..Made::default() },
            Made { drive: 0.0, ..Made::default() },
        ] {
            let made = Made { wheels, seconds: 24.0, ..made };
            assert_eq!(told(&run(&made)), None, "{made:?}");
        }
        // a drive that controls speed, and a filter of the encoders
        for late in [25, 70] {
            let late = later(&later(&later(&clean(wheels), "w", late), "i", late), "pose", late);
            assert_eq!(told(&late), None);
        }
        assert_eq!(told(&later(&later(&clean(wheels), "w", 20), "i", 20)), None);
    }
}

#[test]
fn a_command_that_repeats_itself_tells_no_shift() {
    // a sine leads to the same answer whenever it began
    let mut sine = clean(4);
    let wave = |row: usize, phase: f64| (9.0 * 0.01 * row as f64 - phase).sin();
    sine.u = Some(crate::log::Group::from_columns(
        (0..4).map(|_| (0..2400).map(|row| 6.0 * wave(row, 0.0)).collect()).collect(),
    ));
    sine.w = Some(crate::log::Group::from_columns(
        (0..4).map(|_| (0..2400).map(|row| 30.0 * wave(row, -0.8)).collect()).collect(),
    ));
    (sine.i, sine.pose) = (None, None);
    assert_eq!(told(&sine), None);
}
