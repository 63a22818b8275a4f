use model_core::plant::Input;

use super::super::fit::{FitOptions, fit};
use super::super::staged::{Staging, robot, staged};
use super::*;
use crate::simulate::{SensorSetup, record};

fn of(runs: &[AlignedRun<4>]) -> Informativity {
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    informativity(&runs, &robot(), &Prior::stated(&robot()))
}

fn prospect(told: &Informativity, key: &str) -> Prospect {
    told.numbers.iter().find(|number| number.key == key).unwrap().prospect
}

/// A run of 6 s in which the wheels push along one body axis (v, vn, ω: 0, 1, 2), to and fro, so many volts at the most.
fn along(axis: usize, volts: f64) -> AlignedRun<4> {
    let (file, rate) = (robot(), 200.0);
    let model = Model::<4>::nominal(&file, 12.0);
    let t: Vec<f64> = (0..1200).map(|row| f64::from(row) / rate).collect();
    let push = |t: &f64| -> [f64; 4] {
        let wheel = |k: usize| {
            let (sin, cos) = file.wheel[k].drive_angle_deg.to_radians().sin_cos();
            volts * (1.7 * t).sin() * [cos, sin, 1.0][axis]
        };
        std::array::from_fn(wheel)
    };
    let input: Vec<Input<4, f64>> = t.iter().map(|t| Input::Voltage(push(t))).collect();
    let setup = SensorSetup { sensors: file.sensors, ..SensorSetup::default() };
    AlignedRun::new(&record(&model.plant(), "run", &t, &input, &setup, 3), &file).unwrap()
}

#[test]
fn the_bound_is_what_a_fit_to_a_true_model_ends_with() {
    let runs = staged(&Model::nominal(&robot(), 12.0), &Staging::default());
    let told = of(&runs);
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, WINDOW_S)).collect();
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    let free: Vec<Free> = Nominal::ALL.map(|p| Free { slot: Slot::Nominal(p), within: (0.1, 4.0) }).to_vec();
    let prior = Prior::stated(&robot());
    let options = FitOptions { free: &free, prior: &prior, dispersion: 1.0, rounds: 12, by_window: 0.0 };
    let fitted = fit(Model::nominal(&robot(), 12.0), Shots { runs: &runs, windows: &windows }, None, options);
    assert_eq!(told.numbers.len(), NOMINAL_KEYS.len());
    for (key, number) in NOMINAL_KEYS.iter().zip(&told.numbers) {
        // the fit's uncertainty is robust, of these runs' noise alone, and thereby uncertain itself
        let ratio = fitted.relative_std(key).unwrap() / number.relative_std;
        assert!((0.7..1.4).contains(&ratio), "{}: {ratio}", key.key);
    }
}

#[test]
fn friction_of_an_axis_that_is_never_driven_leaves_no_trace() {
    for (axis, seen, unseen) in [
        (0, ["viscous_v_N_s_per_m", "coulomb_v_N"], ["viscous_vn_N_s_per_m", "viscous_w_Nm_s"]),
        (1, ["viscous_vn_N_s_per_m", "coulomb_vn_N"], ["viscous_v_N_s_per_m", "viscous_w_Nm_s"]),
    ] {
        let told = of(&[along(axis, 8.0)]);
        assert!(seen.iter().all(|key| prospect(&told, key) != Prospect::NoTrace), "{axis}: {told:#?}");
        assert!(unseen.iter().all(|key| prospect(&told, key) == Prospect::NoTrace), "{axis}: {told:#?}");
    }
}

#[test]
fn a_robot_at_rest_tells_nothing_and_what_is_stated_stays() {
    let told = of(&[along(0, 0.0)]);
    for number in &told.numbers {
        assert!(number.prospect != Prospect::Told, "{number:?}");
        assert!((number.relative_std / number.stated_relative - 1.0).abs() < 0.1, "{number:?}");
    }
}

#[test]
fn without_currents_and_a_scale_all_forces_trade_off_and_a_weighed_mass_settles_it() {
    let weighed = |sigma: f64| {
        let mut file = robot();
        file.uncertainty.clear();
        for key in NOMINAL_KEYS.iter().filter(|key| !["wheel", "motor"].contains(&key.table)) {
            file.uncertainty.insert(key.key.into(), 0.3);
        }
        file.uncertainty.insert("resistance_ohm".into(), 0.3);
        file.uncertainty.insert("mass_kg".into(), sigma);
        let how = Staging { channels: !0b1111, ..Staging::default() };
        let runs = staged(&Model::nominal(&file, 12.0), &how);
        let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
        informativity(&runs, &file, &Prior::stated(&file))
    };
    let (rough, sure) = (weighed(0.3), weighed(0.01));
    let std = |told: &Informativity| told.numbers.iter().find(|n| n.key == "inertia_kg_m2").unwrap().relative_std;
    assert!(std(&sure) < 0.3 * std(&rough), "{} {}", std(&sure), std(&rough));
}
