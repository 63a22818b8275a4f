use super::super::robot_read::tests::{GOOD, read, refusal};

const SLIP: &str = "[[effects.wheel_slip]]\nfriction_coefficient = 0.4\n";

fn on(wheel: usize) -> String {
    format!("{SLIP}wheel = {wheel}\n")
}

/// The lines of the shortest robot file; what is added begins on the next.
const LINES: usize = 21;

#[test]
fn an_effect_must_sit_where_its_card_says() {
    assert_eq!(GOOD.lines().count(), LINES);
    for (added, line, expected) in [
        (
            "[effects.coriolis]\nwheel = 1\n".to_string(),
            2,
            "column `wheel`: `coriolis` acts on the whole robot, expected no wheel. Remove the key",
        ),
        (
            "[effects.motor_mismatch]\ntorque_constant_ratio = 0.9\n".to_string(),
            1,
            "column `wheel`: `motor_mismatch` sits on one wheel, expected `wheel` to say which. Add `wheel = …`, from 0 to 2",
        ),
        (on(7), 3, "column `wheel`: found wheel 7, the robot has wheels 0 to 2"),
        (format!("{SLIP}wheel = -1\n"), 3, "column `wheel`: expected a whole number from 0 up"),
        (format!("{SLIP}wheels = 1\n"), 3, "unknown key in [effects.wheel_slip]. Did you mean `wheel`?"),
        ("[effects.wheel_slip]\nfriction_coefficient = 1e200\n".to_string(), 2, "expected a value from 0.05 to 2"),
    ] {
        let told = refusal(&format!("{GOOD}{added}"));
        let place = format!("robot.toml:{}", LINES + line);
        assert!(told.starts_with(&place) && told.contains(expected), "expected {place}: {expected}\n    told: {told}");
    }
}

#[test]
fn an_effect_acts_once_on_a_wheel() {
    for (added, line, expected) in [
        (on(1) + &on(1), 4, "`wheel_slip` on wheel 1 stands twice. Keep one of the two tables"),
        (SLIP.to_string() + SLIP, 3, "`wheel_slip` stands twice"),
        (SLIP.to_string() + &on(2), 3, "`wheel_slip` stands on all wheels and on wheel 2 too"),
        (on(2) + SLIP, 4, "`wheel_slip` stands on all wheels and on wheel 2 too"),
    ] {
        let told = refusal(&format!("{GOOD}{added}"));
        let place = format!("robot.toml:{}", LINES + line);
        assert!(told.starts_with(&place) && told.contains(expected), "expected {place}: {expected}\n    told: {told}");
    }
    assert_eq!(read(&format!("{GOOD}{}{}{}", on(0), on(1), on(2))).unwrap().effects.len(), 3);
}

#[test]
fn more_effects_than_a_model_has_room_for_are_refused_and_not_dropped() {
    let text = format!("{GOOD}{}{}{}[effects.coriolis]\n", on(0), on(1), on(2));
    let told = refusal(&text);
    assert!(told.starts_with("robot.toml:31: column `coriolis`: a model has room for 3 effects"), "{told}");
}
