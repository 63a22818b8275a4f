//! One run: what was measured beside what the model says, signal by signal.

use model_core::plant::Plant;

use super::body_speed::{body_speeds, source};
use super::figures::{Pair, Sums};
use super::model::{RunFigures, SpeedsFrom};
use super::signal::Signal;
use crate::simulate::{AlignedRun, Chain, SignalGroup, predict, start_at, within_half_turn};

/// One signal over the rows of a run, in its SI unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The signal.
    pub signal: Signal,
    /// Measured; none on rows without a sample.
    pub measured: Vec<Option<f64>>,
    /// Simulated; none on rows on which it was not derived.
    pub simulated: Vec<Option<f64>>,
    /// One sigma of the measurement on each row; of no meaning on rows without a sample.
    pub sigma: Vec<f64>,
}

/// A run compared.
#[derive(Clone, Debug)]
pub(super) struct Compared {
    /// The signals that were compared.
    pub traces: Vec<Trace>,
    speeds_from: Option<SpeedsFrom>,
    not_compared: Vec<String>,
}

impl Compared {
    /// Lets the plant run freely along the whole run.
    pub(super) fn of<const N: usize>(plant: &Plant<N, f64>, run: &AlignedRun<N>) -> Compared {
        // longer than the run: nothing restarts
        let whole = run.t.last().map_or(1.0, |last| last + 1.0);
        let simulated = AlignedRun { measured: predict(plant, run, whole).rows, ..run.clone() };
        let mut not_compared = Vec::new();
        let mut traces = Vec::new();

        let speeds_from = source(run);
        if let Some(from) = speeds_from {
            let wheels = &plant.robot().wheels;
            let (measured, said) = (body_speeds(run, wheels, from), body_speeds(&simulated, wheels, from));
            traces.extend(Signal::AXES.into_iter().enumerate().map(|(axis, signal)| Trace {
                signal,
                measured: measured.iter().map(|row| row.map(|s| s.speed[axis])).collect(),
                simulated: said.iter().map(|row| row.map(|s| s.speed[axis])).collect(),
                sigma: measured.iter().map(|row| row.map_or(1.0, |s| s.sigma[axis])).collect(),
            }));
        }
        let begins_somewhere = start_at(run, 0).pose.is_some();
        if !begins_somewhere && run.has_group(SignalGroup::Pose) {
            not_compared.push("x_m, y_m, theta_rad: no pose was measured where the run begins".to_owned());
        }
        for c in 0..AlignedRun::<N>::channels().count() {
            let signal = Signal::of_channel(c, N);
            let seen = (0..run.rows()).any(|row| run.saw(row, c));
            if seen && (begins_somewhere || !signal.is_pose()) {
                traces.push(Trace {
                    signal,
                    measured: (0..run.rows()).map(|row| run.saw(row, c).then(|| run.measured[row][c])).collect(),
                    simulated: simulated.measured.iter().map(|row| Some(row[c])).collect(),
                    sigma: vec![run.sigma[c]; run.rows()],
                });
            }
        }
        traces.sort_by_key(|trace| trace.signal);
        Compared { traces, speeds_from, not_compared }
    }

    /// The sums behind the figures of each signal.
    pub(super) fn sums(&self) -> Vec<(Signal, Sums)> {
        self.traces.iter().map(|trace| (trace.signal, Sums::of(&trace.pairs()))).collect()
    }

    /// The figures of the run.
    pub(super) fn figures<const N: usize>(
        self,
        run: &AlignedRun<N>,
        held_out: bool,
        sums: &[(Signal, Sums)],
    ) -> RunFigures {
        let driven_by = match run.chain {
            Chain::Voltage => "u",
            Chain::Current => "i",
            Chain::WheelSpeed => "w",
            Chain::SetSpeed => "wset",
        };
        RunFigures {
            run: run.name.clone(),
            held_out,
            rows: run.rows(),
            duration_s: run.t.last().copied().unwrap_or(0.0),
            driven_by: driven_by.to_owned(),
            speeds_from: self.speeds_from,
            signals: sums.iter().map(|(signal, sums)| sums.figures(*signal)).collect(),
            not_compared: self.not_compared,
        }
    }
}

impl Trace {
    /// The rows that have both.
    fn pairs(&self) -> Vec<Pair> {
        let both = self.measured.iter().zip(&self.simulated).zip(&self.sigma);
        both.filter_map(|((measured, simulated), sigma)| {
            let measured = (*measured)?;
            let error = measured - (*simulated)?;
            let error = if self.signal == Signal::Heading { within_half_turn(error) } else { error };
            Some(Pair { measured, error, sigma: *sigma })
        })
        .collect()
    }
}
