use super::synthetic::{Made, robot, run};
use super::tests::{any, changed, expect, fatal};
use super::*;
use crate::log::{Channel, Missing};

#[test]
fn a_frozen_channel_is_named_with_its_rows() {
    let clean = run(&Made::default());
    for (group, wheel, signal) in [("w", 2, "w2_rad_s"), ("i", 1, "i1_A"), ("pose", 0, "x_m"), ("pose", 2, "theta_rad")]
    {
        let frozen = changed(&clean, group, |j, c| {
            let at = c.present().find(|(row, _)| *row >= 400).unwrap().1;
            c.map(|row, v| if j == wheel && row >= 400 { at } else { v })
        });

        let faults = check_run(&frozen, &robot(4));
        let fault = faults.iter().find(|f| f.code == "frozen");
        let fault = fault.unwrap_or_else(|| panic!("{signal}: {faults:?}"));
        assert!(fault.fatal && fault.signal == signal && fault.rows.0 >= 390, "{fault:?}");
    }
    let dead = changed(&clean, "w", |_, c| c.map(|_, _| 0.0));
    assert!(check_run(&dead, &robot(4)).iter().any(|f| f.code == "frozen" && f.fatal));
}

#[test]
fn a_saturated_channel_is_named() {
    let clean = run(&Made::default());
    let clipped = changed(&clean, "i", |_, c| c.map(|_, v| v.clamp(-0.35, 0.35)));
    expect(&clipped, 4, "saturated", "i", "current");
    let clipped = changed(&clean, "w", |_, c| c.map(|_, v| v.clamp(-12.0, 12.0)));
    expect(&clipped, 4, "saturated", "w", "speed");
}

#[test]
fn bunched_samples_are_a_warning_and_many_are_fatal() {
    for (every, is_fatal) in [(97, false), (7, true)] {
        let clean = run(&Made::default());
        let late = changed(&clean, "w", |_, c| {
            c.map(|row, v| match row % every {
                3 => 0.0,
                4 => v + c.get(row - 1).unwrap(),
                _ => v,
            })
        });
        let faults = check_run(&late, &robot(4));
        let fault = faults.iter().find(|f| f.code == "bunched").unwrap();
        assert_eq!(fault.fatal, is_fatal, "{faults:?}");
    }
}

#[test]
fn a_push_is_found_and_coasting_is_not() {
    let pushed = run(&Made { drive: 0.0, hand: Some((3.0, 1.0, 0.8)), ..Made::default() });
    for (name, run) in [
        ("all", pushed.clone()),
        ("no pose", Run { pose: None, ..pushed.clone() }),
        ("no speed", Run { w: None, ..pushed }),
    ] {
        let faults = check_run(&run, &robot(4));
        let fault = faults.iter().find(|f| f.code == "pushed").unwrap_or_else(|| panic!("{name}: {faults:?}"));
        assert!(!fault.fatal && fault.rows.0 > 250 && fault.rows.0 < 400, "{name}: {fault:?}");
    }
    let long = run(&Made { drive: 0.0, seconds: 8.0, hand: Some((2.0, 4.0, 2.0)), ..Made::default() });
    let faults = check_run(&long, &robot(4));
    assert!(faults.iter().any(|f| f.code == "pushed" && f.fatal), "{faults:?}");
}

#[test]
fn gaps_duplicates_and_a_clock_that_runs_back_are_found() {
    let clean = run(&Made::default());
    let mut gap = clean.clone();
    gap.t_s.iter_mut().skip(500).for_each(|t| *t += 0.4);
    assert!(check_run(&gap, &robot(4)).iter().any(|f| f.code == "time_gap" && !f.fatal && f.rows == (499, 500)));
    let mut back = clean.clone();
    back.t_s.iter_mut().skip(500).for_each(|t| *t -= 1.0);
    assert!(check_run(&back, &robot(4)).iter().any(|f| f.code == "clock_runs_back" && f.fatal));
    let twice = |c: &Channel| {
        c.iter().enumerate().map(|(row, v)| if row % 10 == 5 { c.get(row - 1) } else { v }).collect::<Channel>()
    };
    let mut doubled = clean.clone();
    for group in [&mut doubled.u, &mut doubled.i, &mut doubled.w, &mut doubled.pose] {
        let group = group.as_mut().unwrap();
        group.channels = group.channels.iter().map(twice).collect();
    }
    assert!(check_run(&doubled, &robot(4)).iter().any(|f| f.code == "duplicate_rows" && !f.fatal));
}

#[test]
fn short_runs_and_runs_full_of_holes_do_not_trip_the_checks() {
    let clean = run(&Made { seconds: 0.05, ..Made::default() });
    assert_eq!(any(&clean, 4), [""; 0]);
    let holes = changed(&run(&Made::default()), "w", |_, c| {
        c.iter().enumerate().map(|(row, v)| if row % 3 == 0 { v } else { Err(Missing::Lost) }).collect()
    });
    assert_eq!(fatal(&holes, 4), [""; 0]);
}
