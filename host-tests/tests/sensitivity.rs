//! The sensitivities of a robot's motion against the paper's closed forms and the exact reference.

use std::path::Path;

use host_tests::generic_robot::GenericRobot;
use host_tests::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, PaperRobot, THREE_HEADINGS_DEG, THREE_WHEELS};
use host_tests::paper_source::tree;
use host_tests::reference::Reference;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{AxisSensitivity, Sensitivity, StepPlan, sensitivity};

/// An example's text.
fn text(name: &str) -> String {
    std::fs::read_to_string(tree().join("examples").join(name).join("robot.toml")).expect("an example")
}

fn parsed(text: &str) -> RobotFile {
    RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).unwrap_or_else(|why| panic!("{why}"))
}

/// The paper's step on a robot file's text, with lines replaced.
fn changed(text: &str, lines: &[(&str, f64)]) -> RobotFile {
    let line = |old: &str| match lines.iter().find(|(key, _)| old.starts_with(&format!("{key} ="))) {
        Some((key, value)) => format!("{key} = {value:?}\n"),
        None => format!("{old}\n"),
    };
    parsed(&text.lines().map(line).collect::<String>())
}

fn usual(file: &RobotFile) -> Sensitivity {
    sensitivity(file, &StepPlan::usual(file))
}

/// d ln(speed, distance, final speed) / d ln(number).
fn slopes(axis: &AxisSensitivity, key: &str) -> [f64; 3] {
    let i = axis.influences.iter().find(|i| i.key == key).unwrap_or_else(|| panic!("{key} on {}", axis.axis));
    [i.speed, i.distance, i.final_speed.expect("a plain robot settles")]
}

#[test]
fn the_terms_are_the_papers_closed_forms() {
    // section 5.4: R of the steady line, friction of Table 1 (de-averaged where that tells more)
    let lines = |bv: f64, cv: f64| [("resistance_ohm", 3.7007), ("viscous_v_N_s_per_m", bv), ("coulomb_v_N", cv)];
    let (kt, l, r) = (0.0259_f64, 5.0, 0.0325_f64);
    for (name, wheels, mass, bv, cv) in [("feup-3w", 3, 1.944, 0.503, 1.906), ("feup-4w", 4, 2.34, 0.4775, 1.873)] {
        let v = &usual(&changed(&text(name), &lines(bv, cv))).axes[0];
        // Σ cos²α: 3/2 for three wheels, 2 for four; Σ |cos α| of the two motors: 2·sin(π/3), 2
        let (squares, reach) = if wheels == 3 { (1.5, 3.0_f64.sqrt()) } else { (2.0, 2.0) };
        let expected = [
            squares * (kt * l / r).powi(2) / (3.7007 * mass),
            bv / mass,
            reach * l * kt / (r * 3.7007 * mass) * 6.0,
            cv / mass,
        ];
        let terms = [v.terms.back_emf_per_s, v.terms.viscous_per_s, v.terms.drive, v.terms.coulomb];
        for (got, want) in terms.into_iter().zip(expected) {
            assert!((got - want).abs() < 1e-13 * want, "{name}: {terms:?} against {expected:?}");
        }
        // as a person works it out
        let by_hand = if wheels == 3 { [3.3104, 0.2587, 5.7560, 0.9805] } else { [3.6669, 0.2041, 5.5216, 0.8004] };
        assert_eq!(terms.map(|x| format!("{x:.4}")), by_hand.map(|x: f64| format!("{x:.4}")));
        let driven: Vec<f64> = v.motors.iter().copied().filter(|u| u.abs() > 1e-9).collect();
        assert!(driven.len() == 2 && driven.iter().all(|u| (u.abs() - 6.0).abs() < 1e-12), "6 V on two motors");
    }
}

/// Speed after a second, distance by then and final speed of the exact robot, on an axis.
fn exact<const N: usize>(rig: &GenericRobot<N>, motors: &[f64], axis: usize) -> [f64; 3] {
    let u: [f64; N] = motors.try_into().expect("a voltage a wheel");
    let mut robot = Reference::derived(rig);
    robot.advance(u, 1.0);
    let (speed, distance) = (robot.twist[axis], robot.pose[axis]);
    robot.advance(u, 30.0);
    [speed, distance, robot.twist[axis]]
}

fn agrees_with_differences<const N: usize>(name: &str, table: PaperRobot, headings: [f64; N]) {
    /// A number of the reference by the key of the robot file.
    fn number<'a>(p: &'a mut PaperRobot, key: &str) -> &'a mut f64 {
        match key {
            "distance_m" => &mut p.d,
            "radius_m" => &mut p.r,
            "resistance_ohm" => &mut p.resistance,
            "emf_constant_V_s" => &mut p.kv,
            "torque_constant_Nm_per_A" => &mut p.kt,
            "mass_kg" => &mut p.mass,
            "inertia_kg_m2" => &mut p.inertia,
            "viscous_v_N_s_per_m" => &mut p.viscous[0],
            "viscous_vn_N_s_per_m" => &mut p.viscous[1],
            "viscous_w_Nm_s" => &mut p.viscous[2],
            "coulomb_v_N" => &mut p.coulomb[0],
            "coulomb_vn_N" => &mut p.coulomb[1],
            "coulomb_w_Nm" => &mut p.coulomb[2],
            other => panic!("the reference has no {other}"),
        }
    }
    let said = usual(&parsed(&text(name)));
    for (axis, of) in said.axes.iter().enumerate() {
        assert_eq!(of.influences.len(), 13, "every number of the file");
        let whole = exact(&table.generic(headings), &of.motors, axis);
        // the plant's step: (λ·Δt)²/12·λt with λ of 6/s and Δt of 1 ms
        for (got, want) in [of.speed, of.distance, of.final_speed.unwrap()].into_iter().zip(whole) {
            assert!((got / want - 1.0).abs() < 2e-5, "{name}, axis {axis}: {got} against {want}");
        }
        for i in &of.influences {
            let h = 1e-4;
            let [up, down] = [h, -h].map(|h| {
                let mut p = table;
                *number(&mut p, i.key) *= 1.0 + h;
                exact(&p.generic(headings), &of.motors, axis)
            });
            let got = slopes(of, i.key);
            for k in 0..3 {
                let want = (up[k] / down[k]).ln() / ((1.0 + h) / (1.0 - h)).ln();
                // h²/6 of a third derivative of order one: 1e-8; the step's error as above, or what is left of a motion
                // that was called settled
                assert!((got[k] - want).abs() < 2e-5, "{name}, axis {axis}, {}: {} against {want}", i.key, got[k]);
            }
        }
    }
}

#[test]
fn the_sensitivities_are_the_differences_of_the_exact_robot() {
    agrees_with_differences("feup-3w", THREE_WHEELS, THREE_HEADINGS_DEG);
    agrees_with_differences("feup-4w", FOUR_WHEELS, FOUR_HEADINGS_DEG);
}

#[test]
fn numbers_that_scale_together_cancel() {
    for name in ["feup-3w", "feup-4w"] {
        let said = usual(&parsed(&text(name)));
        let groups = |mass, viscous, coulomb| {
            [
                // the motor's force is K_t/R·(…): both together change nothing
                vec!["resistance_ohm", "torque_constant_Nm_per_A"],
                // all forces and the mass: the same acceleration
                vec!["torque_constant_Nm_per_A", mass, viscous, coulomb],
                // l·K/r is all that is seen of gear, constants and wheel
                vec!["radius_m", "emf_constant_V_s", "torque_constant_Nm_per_A"],
            ]
        };
        let axes = [
            groups("mass_kg", "viscous_v_N_s_per_m", "coulomb_v_N"),
            groups("mass_kg", "viscous_vn_N_s_per_m", "coulomb_vn_N"),
            groups("inertia_kg_m2", "viscous_w_Nm_s", "coulomb_w_Nm"),
        ];
        for (axis, groups) in said.axes.iter().zip(axes) {
            for group in groups {
                let sum =
                    group.iter().map(|key| slopes(axis, key)).fold([0.0; 3], |s, x| [0, 1, 2].map(|k| s[k] + x[k]));
                // roundings of a thousand steps; they cancel in every step, not only in the end
                assert!(sum.iter().all(|x| x.abs() < 1e-9), "{name}, {}: {group:?} sum to {sum:?}", axis.axis);
            }
        }
    }
}

#[test]
fn at_first_all_is_mass_and_in_the_end_none_is() {
    let file = parsed(&text("feup-4w"));
    let said = sensitivity(&file, &StepPlan { voltage: 6.0, time: 0.01 });
    for (axis, mass) in said.axes.iter().zip(["mass_kg", "mass_kg", "inertia_kg_m2"]) {
        let [speed, distance, last] = slopes(axis, mass);
        // v = a·t·(1 − λt/2 …), with λt of 0.06 at the most; a goes with 1/M
        assert!((speed + 1.0).abs() < 0.04 && (distance + 1.0).abs() < 0.04, "{}: {speed} {distance}", axis.axis);
        assert!(last.abs() < 1e-5, "{}: {last}", axis.axis);
    }
}

#[test]
fn a_quarter_turn_of_four_wheels_is_no_difference() {
    let same = [("viscous_vn_N_s_per_m", 0.4978), ("coulomb_vn_N", 1.8738)];
    let said = usual(&changed(&text("feup-4w"), &same));
    let [v, vn, _] = &said.axes[..] else { panic!("three axes") };
    for i in &v.influences {
        let twin = i.key.replace("_v_", "_vn_");
        // roundings
        let apart = [0, 1, 2].map(|k| slopes(v, i.key)[k] - slopes(vn, &twin)[k]);
        assert!(i.key.contains("_vn_") || apart.iter().all(|x| x.abs() < 1e-9), "{}: {apart:?}", i.key);
    }
}

#[test]
fn effects_of_the_file_take_part() {
    let plain = text("feup-3w");
    let lossy = parsed(&(plain.clone() + "\n[effects.dead_time]\nvoltage_loss_V = 0.35\n"));
    let said = usual(&lossy);
    assert_eq!(said.effects, ["dead_time"]);
    // every driven motor's current is far from zero on the way: it loses 0.35 V of its 6 V, and nothing else changes
    let less = sensitivity(&parsed(&plain), &StepPlan { voltage: 5.65, time: 1.0 });
    let (lossy, less) = (&said.axes[0], &less.axes[0]);
    assert!((lossy.speed / less.speed - 1.0).abs() < 1e-3, "{} against {}", lossy.speed, less.speed);
    for key in ["mass_kg", "emf_constant_V_s", "coulomb_v_N"] {
        assert!((slopes(lossy, key)[0] - slopes(less, key)[0]).abs() < 1e-3, "{key}");
    }
}

#[test]
fn an_axis_that_friction_holds_has_no_sensitivities() {
    let said = usual(&changed(&text("feup-3w"), &[("coulomb_v_N", 90.0)]));
    let (v, vn) = (&said.axes[0], &said.axes[1]);
    assert_eq!((v.speed, v.distance, v.final_speed), (0.0, 0.0, None));
    assert!(v.influences.is_empty() && vn.speed > 0.0);
}
