//! A validation made up, for the tests of its pages.

use crate::localise::validation::{
    GroupError, HorizonFigures, RunFigures, RunTraces, SCHEMA, Signal, SignalFigures, SpeedsFrom, Trace, Validation,
    Worst,
};

fn figures(signal: Signal, fit: Option<f64>, rms_si: f64) -> SignalFigures {
    SignalFigures {
        signal,
        samples: 600,
        fit_percent: fit,
        no_fit: fit.is_none().then(|| "it hardly varies: 0.010 about its mean, noise 0.009".into()),
        noise_allows_percent: fit.map(|_| 98.0),
        rms_si,
        rms_sigma: 4.0,
        largest_error_si: 3.0 * rms_si,
        sigma_si: 0.25 * rms_si,
    }
}

fn run(name: &str, held_out: bool, vn: f64) -> RunFigures {
    RunFigures {
        run: name.into(),
        held_out,
        rows: 600,
        duration_s: 3.0,
        driven_by: "u".into(),
        speeds_from: Some(SpeedsFrom::WheelSpeeds),
        signals: vec![
            figures(Signal::V, Some(97.0), 0.02),
            figures(Signal::Vn, Some(vn), 0.03),
            figures(Signal::Omega, None, 0.01),
            figures(Signal::WheelSpeed(0), Some(95.0), 0.6),
            figures(Signal::Current(1), Some(71.0), 0.1),
        ],
        not_compared: vec!["x_m, y_m, theta_rad: no pose was measured where the run begins".into()],
    }
}

/// Two runs, the second held out; ω stands still.
pub fn validation() -> Validation {
    let error = |rms_sigma: f64, noise_floor_sigma: f64| GroupError { rms_sigma, noise_floor_sigma };
    let horizon = |horizon_s: f64, total: GroupError| HorizonFigures {
        horizon_s,
        total,
        groups: [("i".to_owned(), total), ("w".to_owned(), total)].into(),
    };
    Validation {
        schema: SCHEMA,
        robot: "feup-4w".into(),
        session: Some("session".into()),
        runs: vec![run("run00", false, 89.0), run("run01", true, 87.0)],
        all_runs: vec![
            figures(Signal::V, Some(96.0), 0.02),
            figures(Signal::Vn, Some(88.0), 0.03),
            figures(Signal::Omega, None, 0.01),
        ],
        worst: Some(Worst {
            signal: Signal::Current(1),
            run: "run01".into(),
            fit_percent: 71.0,
            noise_allows_percent: 97.0,
        }),
        horizons: vec![horizon(0.5, error(2.4, 1.1)), horizon(2.0, error(4.8, 1.3))],
        notices: vec!["run01.csv: columns left out: `note`".into()],
    }
}

/// Signals to go with it.
pub fn traces() -> Vec<RunTraces> {
    let t_s: Vec<f64> = (0..600).map(|k| 0.005 * f64::from(k)).collect();
    let wave = |signal: Signal, shift: f64| {
        let of = |shift: f64| t_s.iter().map(|t| Some((t - shift).sin())).collect();
        Trace { signal, measured: of(0.0), simulated: of(shift), sigma: vec![0.01; 600] }
    };
    let signals = [Signal::V, Signal::Vn, Signal::Omega, Signal::WheelSpeed(0), Signal::Current(1)];
    (0..2)
        .map(|run| RunTraces { run, t_s: t_s.clone(), traces: signals.iter().map(|s| wave(*s, 0.1)).collect() })
        .collect()
}

#[test]
fn figures_come_back_from_json_as_they_went_in() {
    let text = validation().to_json().unwrap();
    assert_eq!(serde_json::from_str::<Validation>(&text).unwrap(), validation());
}
