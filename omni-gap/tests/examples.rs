//! The examples of the library run to their end.

#[path = "../examples/diagnose.rs"]
mod diagnose;
#[path = "../examples/identify.rs"]
mod identify;
#[path = "../examples/own_effect.rs"]
mod own_effect;
#[path = "../examples/simulate.rs"]
mod simulate;

#[test]
fn an_example_of_a_diagnosis_runs() {
    diagnose::main().unwrap_or_else(|why| panic!("{why}"));
}

#[test]
fn an_example_of_an_identification_runs() {
    identify::main().unwrap_or_else(|why| panic!("{why}"));
}

#[test]
fn an_example_of_a_simulation_runs() {
    simulate::main().unwrap_or_else(|why| panic!("{why}"));
}

#[test]
fn an_example_of_an_effect_of_ones_own_runs() {
    own_effect::main().unwrap_or_else(|why| panic!("{why}"));
}
