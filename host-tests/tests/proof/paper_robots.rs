//! The core's two robots of the paper: made from the robot files, and right.

use host_tests::matrices::Matrices;
use host_tests::paper::{self, FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::paper_source::{OUTPUT_PATH, paper_source, tree};
use host_tests::printed::of_the_core;
use model_core::plant::paper::{four_wheels, three_wheels};
use model_core::plant::robot::Robot;

use crate::golden;

#[test]
fn the_cores_robots_are_made_from_the_robot_files() {
    golden::holds_at(&tree().join(OUTPUT_PATH), &paper_source());
}

/// Every number against those of Table 3 as typed in for the reference, bit for bit.
fn same_numbers<const N: usize>(core: &Robot<N, f64>, table: &paper::PaperRobot, headings_deg: [f64; N]) {
    for (wheel, heading) in core.wheels.wheels().iter().zip(headings_deg) {
        assert_eq!((wheel.distance, wheel.radius), (table.d, table.r));
        // one rounding of an angle of up to 5 rad on either way from degrees
        assert!((wheel.drive_angle - heading.to_radians()).abs() < 1e-15, "{wheel:?}");
    }
    let motor = core.motor;
    assert_eq!([motor.gear_ratio, motor.resistance], [table.l, table.resistance]);
    assert_eq!([motor.emf_constant, motor.torque_constant], [table.kv, table.kt]);
    assert_eq!([core.mass, core.inertia], [table.mass, table.inertia]);
    assert_eq!([core.friction.viscous, core.friction.coulomb], [table.viscous, table.coulomb]);
}

#[test]
fn the_cores_robots_have_the_numbers_of_table_3() {
    same_numbers(&three_wheels(), &THREE_WHEELS, THREE_HEADINGS_DEG);
    same_numbers(&four_wheels(), &FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn the_cores_robots_move_by_the_derived_matrices() {
    fn check<const N: usize>(core: &Matrices<N>, derived: &Matrices<N>) {
        // some ten roundings of entries of up to 60, and A from a step that is a tenth of a second long
        let within = 1e-12;
        assert!((core.a - derived.a).amax() < within, "A: {} against {}", core.a, derived.a);
        assert!((core.b - derived.b).amax() < within, "B: {} against {}", core.b, derived.b);
        assert!((core.k - derived.k).amax() < within, "K: {} against {}", core.k, derived.k);
        assert!((core.rim - derived.rim).amax() < within, "rim: {} against {}", core.rim, derived.rim);
    }
    check(&of_the_core(three_wheels()), &Matrices::derived(&THREE_WHEELS.generic(THREE_HEADINGS_DEG)));
    check(&of_the_core(four_wheels()), &Matrices::derived(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG)));
}
