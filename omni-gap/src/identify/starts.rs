//! Starts: from which state each window begins, by the measurements alone and by the model that is tried.

use nalgebra::DVector;

use super::linear::linearise;
use super::settings::FitSettings;
use super::shoot::{Shots, Starts, first_starts};
use crate::simulate::{AlignedRun, Model, start_at};

/// Starts from the smoothed measurements, for all windows of all runs; at rest where that fits better and speeds around the
/// start are told by a prolonged line alone.
pub(super) fn starts_of<const N: usize>(model: &Model<N>, shots: Shots<'_, N>) -> Vec<Starts> {
    let plant = model.plant();
    let of_run = |(run, windows): (&&AlignedRun<N>, _)| first_starts(&plant, run, windows);
    let measured: Vec<Starts> = shots.runs.iter().zip(shots.windows).map(of_run).collect();
    let mut at_rest = measured.clone();
    let mut uncertain = false;
    for ((run, windows), starts) in shots.runs.iter().zip(shots.windows).zip(&mut at_rest) {
        for (k, [.., v, vn, w]) in starts.iter_mut().enumerate() {
            if start_at(run, windows.rows(k).start).prolonged {
                [*v, *vn, *w] = [0.0; 3];
                uncertain = true;
            }
        }
    }
    if uncertain { better_starts(model, shots, &measured, at_rest) } else { measured }
}

/// The best starts for a model as it is, and each window's Σ error² and count: how well whole runs are predicted.
pub fn profile<const N: usize>(
    model: &Model<N>,
    shots: Shots<'_, N>,
    settings: &FitSettings,
) -> (Vec<Starts>, Vec<Vec<(f64, usize)>>) {
    let none = DVector::zeros(0);
    let mut starts = starts_of(model, shots);
    let mut linear = linearise(model, shots, &starts, &[], false);
    for _ in 0..settings.start_rounds {
        let moved = linear.starts_after(&starts, &none);
        let trial = linearise(model, shots, &moved, &[], false);
        // each window on its own: a start that got worse stays
        let (old, new) = (linear.cost_by_window(), trial.cost_by_window());
        for (run, (old, new)) in old.iter().zip(&new).enumerate() {
            for (k, (old, new)) in old.iter().zip(new).enumerate() {
                if new.0 < old.0 {
                    starts[run][k] = moved[run][k];
                }
            }
        }
        let gained: f64 = old.iter().flatten().zip(new.iter().flatten()).map(|(o, n)| (o.0 - n.0).max(0.0)).sum();
        linear = linearise(model, shots, &starts, &[], false);
        if gained < settings.least_gain {
            break;
        }
    }
    let cost = linear.cost_by_window();
    (starts, cost)
}

/// Of two starts of each window the better one: a robot that friction stops at once tells nothing of the speed with which
/// it began, and a step that is linear all the way goes anywhere.
pub(super) fn better_starts<const N: usize>(
    model: &Model<N>,
    shots: Shots<'_, N>,
    stayed: &[Starts],
    mut moved: Vec<Starts>,
) -> Vec<Starts> {
    let [old, new] = [stayed, &moved].map(|starts| linearise(model, shots, starts, &[], false).cost_by_window());
    for (run, (old, new)) in old.iter().zip(&new).enumerate() {
        for (k, (old, new)) in old.iter().zip(new).enumerate() {
            // a cost that is no number is worse than any
            if new.0.is_nan() || new.0 > old.0 {
                moved[run][k] = stayed[run][k];
            }
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::super::shoot::Windows;
    use super::super::staged::{Staging, robot, staged};
    use super::*;
    use crate::simulate::SignalGroup;

    /// From this time on the wheels turn fast enough to be seen [s].
    const FIRST_SEEN: f64 = 0.12;

    #[test]
    fn a_robot_that_no_sensor_sees_before_it_moves_starts_at_rest() {
        let model = Model::nominal(&robot(), 12.0);
        let wheels = AlignedRun::<4>::channels().of(SignalGroup::WheelSpeed).fold(0_u16, |mask, c| mask | 1 << c);
        let mut runs = staged(&model, &Staging { runs: 3, channels: wheels, ..Staging::default() });
        for run in &mut runs {
            let unseen = run.t.partition_point(|t| *t < FIRST_SEEN);
            run.has[..unseen].fill(0);
        }
        let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
        let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
        let shots = Shots { runs: &runs, windows: &windows };
        let plant = model.plant();
        for ((run, windows), starts) in runs.iter().zip(&windows).zip(starts_of(&model, shots)) {
            let measured = first_starts(&plant, run, windows);
            // the line through what was seen, prolonged by 0.12 s and more of a motion that bends
            assert!(measured[0][3].hypot(measured[0][4]) > 0.1, "{:?}", measured[0]);
            assert_eq!(starts[0][3..], [0.0; 3]);
            assert_eq!(starts[1..], measured[1..]);
        }
    }
}
