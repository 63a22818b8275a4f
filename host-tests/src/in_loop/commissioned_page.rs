//! # Commissioned, the page: what came of many wirings, and what is promised of each

use std::fmt::Write;

use super::commissioned::{CommissionedMotor, SPOILED, spoiled};

/// The largest error of an edge [°, electrical].
const EDGE: f64 = 1.0;
/// The largest current of a winding [A].
const CURRENT: f64 = 1.0;
/// The largest angle of a wheel, with what a person is shown [°].
const TURNED: f64 = 30.0;
/// The largest error of R and L [1].
const WINDING: f64 = 0.03;
/// How far a wheel's speed may be from that of one that is wired right, once it drives, over that of the fastest wheel [1].
const SPEED: f64 = 0.01;

/// A number that is measured of a motor: how it is told, what it is, and the largest that is promised.
type Measured = (&'static str, fn(&CommissionedMotor) -> f64, f64);

/// What is measured of a motor, and what is promised of it.
const NUMBERS: [Measured; 7] = [
    ("worst of its edges off [°, electrical]", |motor| motor.edge_error, EDGE),
    ("R found, off by [1]", |motor| motor.winding_error[0].abs(), WINDING),
    ("L found, off by [1]", |motor| motor.winding_error[1].abs(), WINDING),
    ("largest current of a winding [A]", |motor| motor.most_current, CURRENT),
    ("wheel turned until its wiring was known [°]", |motor| motor.turned, TURNED),
    ("wheel turned with what was shown [°]", |motor| motor.shown, TURNED),
    ("driven: off what one wired right does, of the fastest [1]", |motor| motor.speed_error.abs(), SPEED),
];

/// Promises that are not kept.
pub fn broken_promises(motors: &[CommissionedMotor]) -> Vec<String> {
    let of = |motor: &CommissionedMotor| -> Vec<String> {
        let kept = |x: f64, most: f64| x <= most;
        let broken = NUMBERS.iter().filter(|(_, number, most)| !kept(number(motor), *most));
        broken
            .map(|(name, number, most)| format!("wiring {}: {name}: {} of {most}", motor.number, number(motor)))
            .collect()
    };
    motors.iter().flat_map(of).collect()
}

/// The page.
pub fn page(motors: &[CommissionedMotor], wirings: usize, seeds: usize) -> String {
    let mut text = format!(
        "# Commissioned: {wirings} wirings on {seeds} seeds\n\n\
         Every motor's order of outputs, order and signs of the current converters, order of the hall lines and their sense are\n\
         drawn; R, L, motor constants, friction and inertia are up to 30 % off, hall switches up to 5° (electrical). Commissioned\n\
         by the host over the link of the firmware's program, wheels in the air; then driven on the floor with what was found.\n\n\
         | of {} motors | median | worst | promised |\n|---|---|---|---|\n",
        motors.len()
    );
    for (name, number, most) in NUMBERS {
        let mut all: Vec<f64> = motors.iter().map(number).collect();
        all.sort_by(f64::total_cmp);
        let (median, worst) = (all[all.len() / 2], all[all.len() - 1]);
        let _ = writeln!(text, "| {name} | {median:.3} | {worst:.3} | {most} |");
    }
    let lag = motors.iter().map(|motor| motor.lag).fold(0.0, f64::max);
    let _ = write!(
        text,
        "\nThe rotors were behind the vector by up to {lag:.1}° (friction), which is not in the edges.\n\n\
         ## What else may be wrong\n\n| motor 0 | is told | bridge |\n|---|---|---|\n"
    );
    for case in &SPOILED {
        let (told, open) = spoiled(case);
        let told = told.trim_start_matches("simulated: ");
        let _ = writeln!(text, "| {} | {told} | {} |", case.what, if open { "open" } else { "CLOSED" });
    }
    text
}
