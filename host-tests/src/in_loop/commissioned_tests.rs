use super::super::commissioned_page::broken_promises;
use super::*;
use crate::virtual_board::wiring::WIRINGS;

#[test]
fn each_of_48_wirings_is_found_and_the_robot_driven() {
    let mut motors = Vec::new();
    for first in (0..WIRINGS).step_by(4) {
        motors.extend(commission([0, 1, 2, 3].map(|k| first + k), 1).expect("a motor that can be commissioned"));
    }
    assert_eq!(motors.len(), WIRINGS);
    assert_eq!(broken_promises(&motors), [] as [String; 0]);
}

#[test]
fn what_is_wrong_besides_is_told_and_the_bridge_is_open() {
    let says = [
        "its halls do not change while the vector turns",
        "its halls do not change while the vector turns",
        "a hall sensor gave a code that does not exist",
        "a phase current was above what the bridge bears",
        "the bus voltage was below its limit",
    ];
    for (case, says) in SPOILED.iter().zip(says) {
        let (told, open) = spoiled(case);
        assert!(told.contains("motor 0: ") && told.contains(says) && open, "{}: {told}", case.what);
    }
}
