use model_core::plant::robot::Nominal;

use super::super::dispersion::nominal_free;
use super::super::prior::{Extent, FreedPrior};
use super::super::settings::FitSettings;
use super::super::shoot::Windows;
use super::super::staged::{Staging, robot, staged};
use super::*;
use crate::simulate::{AlignedRun, MAX_CHANNELS, SignalGroup};

/// Free numbers and their true factors.
const TRUTH: [(Nominal, f64); 4] =
    [(Nominal::Resistance, 1.1), (Nominal::Inertia, 0.9), (Nominal::ViscousV, 1.2), (Nominal::CoulombW, 0.85)];

fn truth() -> Model<4> {
    let mut model = Model::nominal(&robot(), 12.0);
    TRUTH.iter().for_each(|(p, factor)| model.set(Slot::Nominal(*p), *factor));
    model
}

/// A fit from the robot file's own numbers.
fn fitted(runs: &[AlignedRun<4>], windows: impl Fn(&AlignedRun<4>) -> Windows) -> Fit<4> {
    let windows: Vec<Windows> = runs.iter().map(windows).collect();
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    let free = TRUTH.map(|(p, _)| Free { slot: Slot::Nominal(p), within: (0.1, 4.0) });
    let shots = Shots { runs: &runs, windows: &windows };
    let prior = Prior::stated(&robot());
    let options = FitOptions { free: &free, prior: &prior, dispersion: 1.0, rounds: 12, by_window: 0.0 };
    fit(Model::nominal(&robot(), 12.0), shots, None, options)
}

/// How far the fitted numbers are from the truth, in their own sigma.
fn off(fit: &Fit<4>) -> [f64; 4] {
    TRUTH.map(|(p, factor)| {
        let slot = Slot::Nominal(p);
        (fit.model.get(slot) - factor) / fit.std(slot).unwrap()
    })
}

#[test]
fn windows_and_whole_runs_both_lead_to_the_truth() {
    let runs = staged(&truth(), &Staging::default());
    let windows = fitted(&runs, |run| Windows::new(run, 0.5));
    let whole = fitted(&runs, Windows::whole);
    assert_eq!(whole.starts.iter().map(Vec::len).collect::<Vec<_>>(), [1; 6]);
    for fit in [&windows, &whole] {
        assert!(off(fit).iter().all(|off| off.abs() < 4.0), "{:?}", off(fit));
        assert!((fit.cost / fit.samples as f64 - 1.0).abs() < 0.03, "{} of {}", fit.cost, fit.samples);
    }
}

#[test]
fn what_the_fit_says_it_cost_is_the_cost_of_its_model_and_starts() {
    for tau in [0.0, 0.1] {
        let how = Staging { runs: 2, correlation_time: [tau; MAX_CHANNELS], ..Staging::default() };
        let mut runs = staged(&truth(), &how);
        runs.iter_mut().for_each(|run| run.correlation_time = [tau; MAX_CHANNELS]);
        let fit = fitted(&runs, |run| Windows::new(run, 0.5));
        let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
        let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
        let shots = Shots { runs: &runs, windows: &windows };
        let plain = Begun::of(&fit.model, shots, fit.starts.clone()).cost();
        let linear = fit.linearised(shots).misfit();
        assert!((plain / fit.cost - 1.0).abs() < 1e-9 && (linear.cost() / fit.cost - 1.0).abs() < 1e-9);
        assert_eq!(linear.numbers, fit.samples);
    }
}

#[test]
fn without_currents_a_torque_constant_that_is_freed_takes_what_a_resistance_that_is_believed_cannot() {
    let mut truth = Model::nominal(&robot(), 12.0);
    truth.set(Slot::Nominal(Nominal::Resistance), 1.5);
    // F = K_t·(u − K_v·ω)/R: where no current is seen, what is stated of R says how much of the force is K_t's
    let currents = AlignedRun::<4>::channels().mask(SignalGroup::Current);
    let runs = staged(&truth, &Staging { runs: 2, channels: !currents, ..Staging::default() });
    let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
    let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
    let shots = Shots { runs: &runs, windows: &windows };
    let prior = Prior::stated(&robot()).without(FreedPrior { cause: "kt_over_kv", extent: Extent::Each }, 1.0);
    let free = nominal_free(&FitSettings::default());
    let options = FitOptions { free: &free, prior: &prior, dispersion: 1.0, rounds: 12, by_window: 0.0 };
    let found = fit(Model::nominal(&robot(), 12.0), shots, None, options).model;
    let [kt, r] = [Nominal::KtOverKv, Nominal::Resistance].map(|p| found.get(Slot::Nominal(p)));
    assert!((1.5 * kt / r - 1.0).abs() < 0.02 && (r - 1.0).abs() < 0.02, "K_t {kt}, R {r}");
}

#[test]
fn noise_that_is_correlated_and_stated_so_leaves_white_errors_and_honest_uncertainties() {
    const TAU: f64 = 0.1;
    let correlation_time = std::array::from_fn(|c| if c >= 8 { TAU } else { 0.0 });
    let mut runs = staged(&truth(), &Staging { runs: 10, correlation_time, ..Staging::default() });
    runs.iter_mut().for_each(|run| run.correlation_time = correlation_time);
    let fit = fitted(&runs, |run| Windows::new(run, 1.0));
    assert!(off(&fit).iter().all(|off| off.abs() < 4.0), "{:?}", off(&fit));
    assert!((fit.cost / fit.samples as f64 - 1.0).abs() < 0.03, "{} of {}", fit.cost, fit.samples);
}

#[test]
fn beside_others_that_are_held_a_number_is_as_sure_as_its_own_equation_says() {
    let runs = staged(&truth(), &Staging { runs: 2, ..Staging::default() });
    let (fit, prior) = (fitted(&runs, |run| Windows::new(run, 0.5)), Prior::stated(&robot()));
    for (k, free) in fit.free.iter().enumerate() {
        let usual = fit.std(free.slot).unwrap();
        let beside_none = fit.std_beside(free.slot, &[], &prior).unwrap();
        assert!((beside_none / usual - 1.0).abs() < 1e-9);
        let others: Vec<Slot> = fit.free.iter().map(|other| other.slot).filter(|slot| *slot != free.slot).collect();
        let alone = fit.std_beside(free.slot, &others, &prior).unwrap();
        // one equation: never surer than 1/√H, and no less sure than with the others free, but for how errors went on
        let hess = fit.stated(fit.equations.clone(), &prior).hess[(k, k)];
        assert!(alone >= (1.0 - 1e-9) / hess.sqrt() && alone <= 1.05 * usual, "{alone} of {usual}");
        assert_eq!(fit.std_beside(free.slot, &[free.slot], &prior), None);
    }
}
