//! The page of headings, and what is promised of them (`golden/heading.md`; `BLESS=1` writes it anew).

#[path = "proof/golden.rs"]
mod golden;

use host_tests::in_loop::heading::{Lap, MOST, largest, page};

#[test]
fn with_a_gyro_a_lap_leaves_a_degree_at_the_most_where_wheels_alone_leave_seven() {
    let rows: Vec<(Lap, [f64; 3])> =
        Lap::ALL.into_iter().map(|lap| (lap, largest(lap).expect("software does not fail"))).collect();
    for (lap, [without, uncalibrated, calibrated]) in &rows {
        assert!(*calibrated <= MOST, "{lap:?}: {calibrated}°");
        // one per cent of a whole turn is the gyro's own
        assert!(*uncalibrated <= 3.6 + MOST, "{lap:?}: {uncalibrated}°");
        // two per cent of a whole turn, where the lap is one
        assert!(*lap == Lap::FigureEight || (*without - 7.2).abs() < 1.5, "{lap:?}: {without}°");
    }
    golden::holds("heading.md", &page(&rows));
}
