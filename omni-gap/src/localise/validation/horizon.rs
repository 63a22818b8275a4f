//! Errors over the length of a prediction, with the noise floor beside them.

use model_core::plant::Plant;

use super::model::{GroupError, HorizonFigures};
use crate::localise::{floor, measure};
use crate::simulate::{AlignedRun, SignalGroup};

pub(super) fn curves<const N: usize>(
    plant: &Plant<N, f64>,
    runs: &[&AlignedRun<N>],
    horizons_s: &[f64],
) -> Vec<HorizonFigures> {
    let longest = runs.iter().filter_map(|run| run.t.last()).fold(0.0, |most: f64, t| most.max(*t));
    let mut horizons: Vec<f64> = horizons_s.iter().copied().filter(|h| *h <= longest).collect();
    horizons.sort_by(f64::total_cmp);
    horizons.dedup();
    let at = |horizon_s: f64| {
        let (error, least) = (measure(plant, runs, horizon_s), floor(plant, runs, horizon_s));
        let both = error.groups().into_iter().zip(least.groups());
        let groups = SignalGroup::ALL.into_iter().zip(both).filter_map(|(group, (error, least))| {
            Some((group.name().to_owned(), GroupError { rms_sigma: error?, noise_floor_sigma: least? }))
        });
        HorizonFigures {
            horizon_s,
            total: GroupError { rms_sigma: error.total(), noise_floor_sigma: least.total() },
            groups: groups.collect(),
        }
    };
    horizons.into_iter().map(at).collect()
}
