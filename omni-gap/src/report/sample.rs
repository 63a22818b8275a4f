//! One report of each verdict, for the tests of this room.

use super::model::*;
use super::picture::{MEASURED, Panel, Pictures, Series};
use crate::engine::findings::*;
use crate::log::WheelFile;
use crate::vocabulary::{Kind, Stage, Verdict};

/// All samples with the name of their golden file.
pub fn all() -> [(&'static str, Report); 6] {
    [
        ("effect", effect()),
        ("parameter", parameter()),
        ("unknown", unknown()),
        ("no_gap", no_gap()),
        ("own_numbers", own_numbers()),
        ("unfit_data", unfit_data()),
    ]
}

/// A wheel slips.
pub fn effect() -> Report {
    Report {
        gap: gap([3.9, 1.11, 1.02], [3.1, 1.05, 1.0], [3.2, 1.08, 0.98]),
        where_: vec![
            place(Stage::Contact, Some(2), 0.81, Some(regime())),
            place(Stage::Electrical, None, 0.10, None),
            place(Stage::Drivetrain, None, 0.06, None),
            place(Stage::Body, None, 0.02, None),
            place(Stage::Sensing, None, 0.01, None),
        ],
        which: vec![
            Which {
                wheel: Some(2),
                parameters: [
                    ("friction_coefficient".into(), estimate(0.41, 0.02, "1")),
                    ("curve_stiffness".into(), estimate(11.3, 1.9, "1")),
                ]
                .into(),
                not_told_apart_from: vec!["load_transfer".into()],
                settle_by: Some("hard diagonal acceleration and braking".into()),
                ..cause("wheel_slip", "Wheel slip", Some(Kind::Effect), 0.93)
            },
            cause("load_transfer", "Load transfer", Some(Kind::Effect), 0.041),
            cause("creep", "Creep of the rollers", Some(Kind::Effect), 0.012),
            cause("mass", "Mass", Some(Kind::Parameter), 0.008),
            Which { title: None, ..cause("unknown", "", None, 0.006) },
            cause("gear_efficiency", "Gear efficiency", Some(Kind::Effect), 0.002),
            Which { title: None, ..cause("no_gap", "", None, 0.001) },
        ],
        causes: vec!["wheel_slip".into()],
        evidence: super::sample_evidence::shapes(),
        noise: Vec::new(),
        shrink: Shrink {
            before: Some(3.4),
            after: Some(1.08),
            noise_floor: Some(1.0),
            closed: Some(0.967),
            reason: None,
            closed_ci95: Some([0.94, 0.98]),
            closed_by_refit_alone: Some(0.21),
            closed_by_runner_up: Some(0.55),
            closed_by_flexible_model: Some(0.98),
            excess: Some(1.02),
        },
        parameters: vec![
            corrected("body.mass_kg", "kg", Some(2.34), 0.0234, 2.351, 0.012),
            corrected("motor.resistance_ohm", "ohm", Some(4.3111), 0.1293, 4.402, 0.031),
            corrected("friction.coulomb_v_N", "N", Some(1.8738), 0.375, 1.93, 0.06),
            corrected("effects.wheel_slip[2].friction_coefficient", "1", None, 0.0, 0.41, 0.02),
        ],
        not_seen: vec![
            "winding_inductance: below the noise at this log rate".into(),
            "cogging: needs current or wheel speed at 1 kHz".into(),
            "friction_warmup: the runs last 24 s".into(),
        ],
        next_experiment: Some(NextExperiment {
            why:
                "accelerate and brake hard along both diagonals: slip stays with wheel 2, load transfer moves with the \
                  direction"
                    .into(),
            tells_apart: vec!["wheel_slip".into(), "load_transfer".into()],
            file: Some("next_experiment.csv".into()),
        }),
        notices: vec!["runs/03.csv: the extra column temperature_C is ignored".into()],
        ..named(Verdict::Effect)
    }
}

/// Two numbers of the robot file are wrong.
pub fn parameter() -> Report {
    Report {
        gap: gap([2.4, 1.04, 1.02], [1.9, 1.02, 1.0], [1.3, 1.01, 0.98]),
        where_: vec![place(Stage::Body, None, 0.7, None), place(Stage::Electrical, None, 0.3, None)],
        which: vec![
            Which {
                parameters: [("mass_kg".into(), estimate(2.81, 0.03, "kg"))].into(),
                not_told_apart_from: vec!["rotor_inertia".into(), "kt_over_kv".into(), "current_sensor_gain".into()],
                settle_by: Some("weigh the robot".into()),
                ..cause("mass", "Mass", Some(Kind::Parameter), 0.72)
            },
            Which {
                parameters: [("resistance_ohm".into(), estimate(5.02, 0.04, "ohm"))].into(),
                ..cause("resistance", "Winding resistance", Some(Kind::Parameter), 0.28)
            },
        ],
        causes: vec!["mass".into(), "resistance".into()],
        noise: Vec::new(),
        shrink: Shrink {
            before: Some(1.92),
            after: Some(1.02),
            noise_floor: Some(1.0),
            closed: Some(0.978),
            closed_by_refit_alone: Some(0.978),
            ..Shrink::default()
        },
        parameters: vec![
            corrected("body.mass_kg", "kg", Some(2.34), 0.0234, 2.81, 0.03),
            corrected("motor.resistance_ohm", "ohm", Some(4.3111), 0.1293, 5.02, 0.04),
        ],
        ..named(Verdict::Parameter)
    }
}

/// Nothing in the catalogue explains the gap.
pub fn unknown() -> Report {
    Report {
        gap: gap([1.2, 1.15, 1.02], [4.4, 3.9, 1.0], [2.6, 2.2, 0.98]),
        where_: vec![place(Stage::Drivetrain, Some(0), 0.88, None), place(Stage::Sensing, None, 0.12, None)],
        which: vec![
            Which { title: None, ..cause("unknown", "", None, 0.83) },
            cause("backlash", "Backlash", Some(Kind::Effect), 0.11),
            cause("stribeck", "Stribeck friction", Some(Kind::Effect), 0.06),
        ],
        noise: Vec::new(),
        shrink: Shrink {
            before: Some(3.1),
            after: Some(2.7),
            noise_floor: Some(1.0),
            closed: Some(0.19),
            closed_by_flexible_model: Some(0.91),
            excess: Some(2.7),
            ..Shrink::default()
        },
        not_seen: vec!["current_sensor_gain: no independent torque was applied".into()],
        next_experiment: Some(NextExperiment {
            why: "lift the robot and run the same voltages: what stays is in the drivetrain".into(),
            tells_apart: vec!["backlash".into(), "stribeck".into()],
            file: None,
        }),
        ..named(Verdict::Unknown)
    }
}

/// The simulator is right.
pub fn no_gap() -> Report {
    Report {
        gap: gap([1.03, 1.02, 1.02], [1.01, 1.0, 1.0], [1.0, 0.99, 0.98]),
        which: vec![
            Which { title: None, ..cause("no_gap", "", None, 0.97) },
            cause("creep", "Creep of the rollers", Some(Kind::Effect), 0.03),
        ],
        noise: Vec::new(),
        shrink: Shrink {
            before: Some(1.01),
            after: Some(1.01),
            noise_floor: Some(1.0),
            reason: Some("too close to the noise floor to divide".into()),
            ..Shrink::default()
        },
        not_seen: vec!["stribeck: no run passes slowly through standstill".into()],
        ..named(Verdict::NoGap)
    }
}

/// The simulator is right but for numbers that are wrong by what is stated of them.
pub fn own_numbers() -> Report {
    Report {
        gap: gap([4.37, 0.94, 0.99], [5.2, 1.5, 1.5], [9.61, 3.0, 3.1]),
        which: vec![
            Which { title: None, ..cause("no_gap", "", None, 0.73) },
            Which { title: None, ..cause("unknown", "", None, 0.21) },
            cause("resistance", "Winding resistance", Some(Kind::Parameter), 0.06),
        ],
        noise: Vec::new(),
        shrink: Shrink {
            before: Some(7.47),
            after: Some(2.22),
            noise_floor: Some(2.30),
            closed: Some(1.016),
            closed_by_refit_alone: Some(1.016),
            ..Shrink::default()
        },
        parameters: vec![
            corrected("body.mass_kg", "kg", Some(5.0), 0.05, 5.02, 0.03),
            corrected("motor.torque_constant_Nm_per_A", "N·m/A", Some(0.02778), 0.00083, 0.02607, 0.0001),
            corrected("motor.resistance_ohm", "Ω", Some(1.927), 0.1927, 2.503, 0.01),
        ],
        ..named(Verdict::NoGap)
    }
}

/// The log is broken.
pub fn unfit_data() -> Report {
    Report {
        noise: Vec::new(),
        shrink: Shrink { reason: Some("the log is not fit to measure a gap".into()), ..Shrink::default() },
        faults: vec![
            Fault {
                code: "wheel_order".into(),
                file: Some("runs/01.csv".into()),
                column: None,
                rows: Some([2, 4801]),
                what: "wheels 1 and 2 are swapped between speeds and voltages".into(),
                fix: "swap w1_rad_s and w2_rad_s, or say so in columns.toml".into(),
            },
            Fault {
                code: "clock_runs_back".into(),
                file: Some("runs/02.csv".into()),
                column: Some("t_s".into()),
                rows: Some([317, 317]),
                what: "time falls from 1.580 to 1.560 s".into(),
                fix: "sort the rows, or cut the run in two there".into(),
            },
        ],
        ..named(Verdict::UnfitData)
    }
}

fn named(verdict: Verdict) -> Report {
    let about = About { robot: "feup-4w".into(), session: Some("tuesday".into()), ..About::default() };
    Report::of(&Findings { verdict, ..Findings::unfit() }, about)
}

fn cause(id: &str, title: &str, kind: Option<Kind>, probability: f64) -> Which {
    Which {
        cause: id.into(),
        title: Some(title.into()),
        kind,
        probability,
        wheel: None,
        axis: None,
        parameters: Default::default(),
        not_told_apart_from: Vec::new(),
        settle_by: None,
    }
}

fn place(stage: Stage, wheel: Option<usize>, share: f64, regime: Option<Regime>) -> Where {
    Where { stage, axis: None, wheel, share, regime }
}

fn regime() -> Regime {
    Regime {
        feature: "wheel_speed".into(),
        low: Some(-0.4),
        high: Some(0.4),
        share: 0.7,
        text: "|wheel speed| < 0.4 rad/s, after reversals".into(),
    }
}

fn estimate(value: f64, std: f64, unit: &str) -> Estimate {
    Estimate { value, std: Some(std), unit: unit.into() }
}

fn corrected(key: &str, unit: &str, nominal: Option<f64>, nominal_std: f64, corrected: f64, std: f64) -> Corrected {
    let nominal_std = nominal.map(|_| nominal_std);
    Corrected { key: key.into(), unit: unit.into(), nominal, nominal_std, corrected, std: Some(std) }
}

fn gap(i: [f64; 3], w: [f64; 3], pose: [f64; 3]) -> Gap {
    let signal = |[before, after, noise_floor]: [f64; 3]| SignalGap { before, after, noise_floor };
    let horizons_s = vec![0.1, 0.25, 0.5, 1.0, 2.0];
    let grown = |at_half: f64, h: f64| (1e3 * (1.0 + (at_half - 1.0) * (2.0 * h).powf(0.8))).round() / 1e3;
    let curve = |&horizon_s: &f64| HorizonError {
        horizon_s,
        before: grown(w[0], horizon_s),
        after: grown(w[1], horizon_s),
        noise_floor: Some(1.0 + 0.02 * horizon_s),
    };
    Gap {
        signals: [("i", i), ("w", w), ("pose", pose)].map(|(key, g)| (key.to_string(), signal(g))).into(),
        curves: horizons_s.iter().map(curve).collect(),
        horizons_s,
    }
}

/// Wheel speeds, currents and pose of two seconds of a run.
pub fn pictures() -> Pictures {
    let t_s: Vec<f64> = (0..400).map(|k| 4.0 + 0.005 * k as f64).collect();
    let restarts_s = vec![4.0, 4.5, 5.0, 5.5];
    // A noise that is the same on every machine.
    let noise = |k: usize, j: usize| ((k * 2_654_435 + j * 40_503) % 1009) as f64 / 504.0 - 1.0;
    let truth = |t: f64, j: usize| (2.1 * t + 1.6 * j as f64).sin() + 0.3 * (5.0 * t).cos();
    let mut panels = Vec::new();
    let mut panel = |title: String, unit: &str, scale: f64, sigma: f64, j: usize, error: f64, every: usize| {
        let since = |t: f64| (t - 4.0).rem_euclid(0.5);
        let measured = t_s.iter().enumerate().map(|(k, &t)| {
            (k % every == 0 && !(j == 1 && (150..190).contains(&k))).then(|| scale * truth(t, j) + sigma * noise(k, j))
        });
        let model = |error: f64| {
            t_s.iter().map(|&t| Some(scale * (truth(t, j) + error * since(t) * truth(t, j + 1)))).collect::<Vec<_>>()
        };
        let series = vec![
            Series { name: MEASURED.into(), values: measured.collect() },
            Series { name: "nominal".into(), values: model(error) },
            Series { name: "corrected".into(), values: model(0.05) },
        ];
        panels.push(Panel { title, unit: unit.into(), t_s: t_s.clone(), series, ..Panel::default() });
    };
    for j in 0..4 {
        panel(format!("Wheel {j} speed"), "rad/s", 18.0, 0.4, j, if j == 2 { 0.9 } else { 0.2 }, 1);
    }
    for j in 0..4 {
        panel(format!("Wheel {j} current"), "A", 1.3, 0.05, j + 3, if j == 2 { 0.5 } else { 0.15 }, 1);
    }
    for (j, (title, unit)) in [("Position x", "m"), ("Position y", "m"), ("Heading", "rad")].into_iter().enumerate() {
        panel(title.into(), unit, 0.4, 0.004, j + 5, 0.3, 4);
    }
    Pictures {
        caption: "Run heldout/05.csv, 4.0 to 6.0 s, where the nominal error is largest".into(),
        restarts_s,
        panels,
        wheels: [90.0, 180.0, 270.0, 0.0]
            .map(|drive_angle_deg| WheelFile { drive_angle_deg, distance_m: 0.089, radius_m: 0.0325 })
            .to_vec(),
    }
}
