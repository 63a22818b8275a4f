//! Starts: from which state each window begins, by the measurements alone and by the model that is tried.

use model_core::effects::card::Seam;
use nalgebra::DVector;

use super::begun::{Begun, part_of_the_way};
use super::linear::linearise;
use super::misfit::Misfit;
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
            let start = start_at(run, windows.rows(k).start);
            if !start.prolonged {
                continue;
            }
            [*v, *vn] = [0.0; 2];
            // what a gyro says is no prolonged line
            if start.gyro.is_none() {
                *w = 0.0;
            }
            uncertain = true;
        }
    }
    if uncertain { Begun::of(model, shots, at_rest).or(Begun::of(model, shots, measured)).starts } else { measured }
}

/// From where a fit begins that goes on `from` starts that suited another model: from these, but where wheels may slip each
/// window takes what suits it better. Behind wheels that spin a robot may be far slower than one whose wheels roll.
pub(super) fn starts_after<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, from: &[Starts]) -> Vec<Starts> {
    if model.plant().effects().none_at(Seam::Contact) { from.to_vec() } else { better_starts(model, shots, from) }
}

/// Starts `from` another model; in each window that measured ones suit better, these.
fn better_starts<const N: usize>(model: &Model<N>, shots: Shots<'_, N>, from: &[Starts]) -> Vec<Starts> {
    Begun::of(model, shots, from.to_vec()).or(Begun::of(model, shots, starts_of(model, shots))).starts
}

/// The best starts for a model as it is, and how far each window is missed: how well whole runs are predicted. `from` are
/// starts that suited another model, if any; each window takes what suits it better.
pub fn profile<const N: usize>(
    model: &Model<N>,
    shots: Shots<'_, N>,
    from: Option<&[Starts]>,
    settings: &FitSettings,
) -> (Vec<Starts>, Vec<Vec<Misfit>>) {
    let none = DVector::zeros(0);
    let mut starts = from.map_or_else(|| starts_of(model, shots), |from| better_starts(model, shots, from));
    let mut linear = linearise(model, shots, &starts, &[], false);
    let mut part: Vec<Vec<f64>> = starts.iter().map(|run| vec![1.0; run.len()]).collect();
    for _ in 0..settings.start_rounds {
        let moved = part_of_the_way(&starts, &linear.starts_after(&starts, &none), |run, k| part[run][k]);
        let trial = linearise(model, shots, &moved, &[], false);
        // each window on its own: a start that got worse stays, and goes a part of the way in the next round
        let (old, new) = (linear.misfits(), trial.misfits());
        let (mut gained, mut all_better) = (0.0, true);
        for (run, (old, new)) in old.iter().zip(&new).enumerate() {
            for (k, (old, new)) in old.iter().zip(new).enumerate() {
                if new.cost() < old.cost() {
                    starts[run][k] = moved[run][k];
                    gained += old.cost() - new.cost();
                } else {
                    part[run][k] *= settings.start_part;
                    all_better = false;
                }
            }
        }
        linear = if all_better { trial } else { linearise(model, shots, &starts, &[], false) };
        if gained < settings.least_gain {
            break;
        }
    }
    let misfits = linear.misfits();
    (starts, misfits)
}

#[cfg(test)]
mod tests {
    use model_core::plant::Input;

    use super::super::shoot::Windows;
    use super::super::staged::{Staging, robot, staged};
    use super::*;
    use crate::simulate::{SensorSetup, SignalGroup, record};

    /// From this time on the wheels turn fast enough to be seen [s].
    const FIRST_SEEN: f64 = 0.1;

    #[test]
    fn a_robot_that_no_sensor_sees_before_it_moves_starts_at_rest() {
        let (file, rate) = (robot(), 250.0);
        let model = Model::<4>::nominal(&file, 12.0);
        let t: Vec<f64> = (0..250).map(|row| f64::from(row) / rate).collect();
        let sensors = SensorSetup { sensors: file.sensors, ..SensorSetup::default() };
        let run = record(&model.plant(), "step", &t, &[Input::Voltage([6.0, 3.0, -6.0, -3.0]); 250], &sensors, 1);
        let mut run = AlignedRun::<4>::new(&run, &file).unwrap();
        let wheels = AlignedRun::<4>::channels().mask(SignalGroup::WheelSpeed);
        for (has, t) in run.has.iter_mut().zip(&t) {
            *has &= if *t < FIRST_SEEN { 0 } else { wheels };
        }
        let windows = [Windows::new(&run, 0.5)];
        let measured = first_starts(&model.plant(), &run, &windows[0]);
        let starts = starts_of(&model, Shots { runs: &[&run], windows: &windows });
        // the line through what was seen, prolonged over a motion that bends
        assert!(measured[0][3].hypot(measured[0][4]) > 0.1, "{:?}", measured[0]);
        assert_eq!(starts[0][0][3..], [0.0; 3]);
        assert_eq!(starts[0][1..], measured[1..]);
    }

    #[test]
    fn starts_that_suit_another_model_are_taken_where_they_suit_better() {
        let truth = Model::<4>::nominal(&robot(), 12.0);
        let runs = staged(&truth, &Staging { runs: 2, ..Staging::default() });
        let runs: Vec<&AlignedRun<4>> = runs.iter().collect();
        let windows: Vec<Windows> = runs.iter().map(|run| Windows::new(run, 0.5)).collect();
        let shots = Shots { runs: &runs, windows: &windows };
        // no round of its own: what it begins with is what it comes to
        let settings = FitSettings { start_rounds: 0, ..FitSettings::default() };
        let (best, _) = profile(&truth, shots, None, &FitSettings::default());
        let cost = |from: Option<&[Starts]>| {
            profile(&truth, shots, from, &settings).1.into_iter().flatten().fold(Misfit::default(), Misfit::and).cost()
        };
        let mut far = best.clone();
        far.iter_mut().flatten().for_each(|start| start[3] += 5.0);
        assert!(cost(Some(&best)) < 0.95 * cost(None), "{} of {}", cost(Some(&best)), cost(None));
        assert_eq!(cost(Some(&far)), cost(None));
    }
}
