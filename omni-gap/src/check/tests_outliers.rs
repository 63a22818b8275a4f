use std::borrow::Cow;

use super::outliers::set_aside;
use super::synthetic::{Made, robot, run};
use super::tests::{any, changed};
use crate::log::{Missing, Run};

/// Where samples were set aside: column and row.
fn holes(run: &Run) -> Vec<(String, usize)> {
    let of = |(name, channel): (String, &crate::log::Channel)| {
        let rows = (0..channel.len()).filter(|row| channel.get(*row) == Err(Missing::Outlier));
        rows.map(|row| (name.clone(), row)).collect::<Vec<_>>()
    };
    run.signals().into_iter().flat_map(of).collect()
}

#[test]
fn frames_that_show_something_else_go_whole_and_nothing_else_does() {
    let clean = run(&Made::default());
    let frames: Vec<usize> = clean.pose.as_ref().unwrap().channels[0].present().map(|(row, _)| row).collect();
    let jumped = [frames[20], frames[50], frames[53]];
    let spoiled = changed(&clean, "pose", |axis, channel| {
        channel.map(|row, value| if axis == 1 && jumped.contains(&row) { value + 0.3 } else { value })
    });
    let mended = set_aside(&spoiled, &robot(4));
    let expected: Vec<(String, usize)> =
        ["x_m", "y_m", "theta_rad"].iter().flat_map(|name| jumped.map(|row| ((*name).to_owned(), row))).collect();
    assert_eq!(holes(&mended), expected);
    let all_but = |row: usize| (!jumped.contains(&row)).then(|| clean.pose.as_ref().unwrap().channels[1].get(row));
    let y = &mended.pose.as_ref().unwrap().channels[1];
    assert!((0..clean.rows()).all(|row| all_but(row).is_none_or(|value| value == y.get(row))));
    let told = any(&spoiled, 4);
    assert!(
        told.len() == 1 && told[0].contains("The pose jumps away and back within one row in 3 place(s)"),
        "{told:?}"
    );
}

#[test]
fn speeds_and_currents_go_one_by_one() {
    let clean = run(&Made::default());
    let spoiled = changed(&clean, "i", |wheel, c| c.map(|row, i| if (wheel, row) == (2, 333) { 65535.0 } else { i }));
    let spoiled = changed(&spoiled, "w", |wheel, c| c.map(|row, w| if (wheel, row) == (0, 211) { 400.0 } else { w }));
    let expected = [("i2_A".to_owned(), 333), ("w0_rad_s".to_owned(), 211)];
    assert_eq!(holes(&set_aside(&spoiled, &robot(4))), expected);
}

#[test]
fn hard_driving_and_coarse_speeds_are_no_jumps() {
    for step_s in [0.002, 0.01, 0.02] {
        for noise in [0.0, 1.0, 2.5] {
            let hard = run(&Made { step_s, noise, drive: 12.0, slip: 1.2, ..Made::default() });
            let coarse = changed(&hard, "w", |_, c| c.map(|_, w| 1.2 * (w / 1.2).round()));
            for run in [&hard, &coarse] {
                assert!(matches!(set_aside(run, &robot(4)), Cow::Borrowed(_)), "{step_s} s, noise {noise}");
            }
        }
    }
}

#[test]
fn what_jumps_too_often_is_something_else() {
    let clean = run(&Made::default());
    let wild = changed(&clean, "w", |wheel, c| c.map(|row, w| if wheel == 1 && row % 9 == 4 { 300.0 } else { w }));
    assert!(matches!(set_aside(&wild, &robot(4)), Cow::Borrowed(_)));
}
