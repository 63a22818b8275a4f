//! The experiments on a rehearsed robot: what the paper's estimators and the joint one make of them, and when two
//! experiments are said to disagree.

use std::path::Path;

use host_tests::catalogue::sessions::truth;
use model_core::plant::robot::Nominal;
use omni_gap::identify::experiments::classic;
use omni_gap::identify::{disagreements, joint};
use omni_gap::known_effects;
use omni_gap::log::{RobotFile, SensorsFile};
use omni_gap::simulate::{AlignedRun, Experiment, Model, NominalKey, Plan, Sensing, SensorSetup};
use omni_gap::simulate_experiments::simulate_experiments;

fn file(wheels: usize, more: &str) -> RobotFile {
    let text = format!("{}\n{more}", truth(wheels));
    RobotFile::parse(&text, Path::new("robot.toml"), &known_effects()).expect("the example is sound")
}

fn plan(rate: f64) -> Plan {
    Plan { rate, voltage: 8.0, field: 3.0, repeats: 1, loads: 3 }
}

/// What a robot of this file records, 200 rows a second with encoders, as a model of `known` sees it.
fn played<const N: usize>(truth: &RobotFile, known: &RobotFile, sensors: SensorsFile) -> Vec<AlignedRun<N>> {
    let how = SensorSetup { steps_a_row: 20, sensors, ..Sensing::Modern.recording() };
    let runs = simulate_experiments(truth, &plan(200.0), &how, 7);
    runs.iter().filter_map(|run| AlignedRun::new(run, known)).collect()
}

fn value(file: &RobotFile, nominal: Nominal) -> f64 {
    NominalKey::alone(nominal).expect("a number of the file").value(file)
}

#[test]
fn without_noise_the_papers_experiments_find_the_robot_again() {
    let truth = file(4, "");
    let runs = played::<4>(&truth, &truth, SensorsFile::SILENT);
    let found = classic(&Model::nominal(&truth, 8.0), &runs);
    let near = |nominal: Nominal, found: f64, within: f64| {
        let off = found / value(&truth, nominal) - 1.0;
        assert!(off.abs() < within, "{nominal:?}: {found} is {:.2} % off", 100.0 * off);
    };
    for nominal in [Nominal::Resistance, Nominal::TorqueConstant, Nominal::ViscousW, Nominal::CoulombW] {
        // a hold of 2 s has settled to e^(−6) of its step at its middle; a mean over the rest has a tenth of that left
        near(nominal, found.first(nominal).unwrap().value, 2e-3);
    }
    for nominal in [Nominal::ViscousV, Nominal::ViscousVn, Nominal::CoulombV, Nominal::CoulombVn, Nominal::Inertia] {
        // the trapezoid over stretches of 40 ms, and a decay that ends between two of them
        near(nominal, found.first(nominal).unwrap().value, 1e-2);
    }
    for stepped in [found.least_squares.unwrap(), found.instrumental.unwrap()] {
        for nominal in [Nominal::Resistance, Nominal::Inertia, Nominal::ViscousW, Nominal::CoulombW] {
            near(nominal, stepped.of(nominal).unwrap().value, 5e-3);
        }
        // R and B are all but one on an axis: what is left of C is felt tenfold in B
        near(Nominal::ViscousV, stepped.of(Nominal::ViscousV).unwrap().value, 3e-2);
        near(Nominal::ViscousVn, stepped.of(Nominal::ViscousVn).unwrap().value, 3e-2);
    }
}

#[test]
fn experiments_of_a_robot_that_is_its_model_agree() {
    let truth = file(3, "");
    let mut known = truth.clone();
    known.motor.resistance_ohm *= 1.1;
    known.friction.coulomb_v_n *= 0.8;
    let runs = played::<3>(&truth, &known, truth.sensors);
    let runs: Vec<&AlignedRun<3>> = runs.iter().collect();
    let found = disagreements(&Model::nominal(&known, 8.0), &known, &runs);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn experiments_of_a_robot_whose_bridge_loses_voltage_disagree() {
    let truth = file(3, "[effects.dead_time]\nvoltage_loss_V = 0.4\n");
    let known = file(3, "");
    let runs = played::<3>(&truth, &known, truth.sensors);
    let runs: Vec<&AlignedRun<3>> = runs.iter().collect();
    let model = Model::nominal(&known, 8.0);
    let found = disagreements(&model, &known, &runs);
    let electrical = [Nominal::Resistance, Nominal::TorqueConstant];
    assert!(found.iter().any(|d| electrical.contains(&d.nominal)), "{found:?}");
    let driven: Vec<_> =
        runs.iter().copied().filter(|run| Experiment::of(&run.name) != Some(Experiment::Motor)).collect();
    assert!(!joint(&model, &known, &driven).unwrap().follows, "whole runs are not predicted to within noise");
}
