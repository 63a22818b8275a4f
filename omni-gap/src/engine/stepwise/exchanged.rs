//! An effect exchanged for numbers of the robot file.
//!
//! Causes are taken up one by one, so one effect may be taken for what several numbers do that are wrong together: a camera that
//! measures too short, for wheels that are smaller and sit further in. Such an effect predicts as well, but leaves the other
//! numbers at values that nobody believes, and those cost more than to say of each which is wrong.

use super::earned::{earning_their_place, without};
use super::round::Tried;
use super::scored::{Data, Scored, error_scale};
use super::selection::Selection;
use crate::engine::knobs::SearchKnobs;
use crate::vocabulary::Progress;

/// A selection, with numbers in the place of each effect that they are more believable than: at the most as often as a model has
/// effects.
pub(super) fn exchanged_for_numbers<const N: usize>(
    data: &Data<'_, N>,
    mut selected: Selection<N>,
    refitted: &Scored<N>,
    progress: Progress<'_>,
) -> Selection<N> {
    let SearchKnobs { unbelievable, convincing, most_causes, .. } = data.knobs.search;
    for _ in 0..most_causes {
        if selected.corrected.stated < unbelievable {
            break;
        }
        let effects = (0..selected.found.len()).filter(|k| !selected.found[*k].is_parameter());
        let exchanged = effects.filter_map(|k| exchanged(data, &selected, k, progress));
        let earned = exchanged.map(|other| earning_their_place(data, other, refitted));
        let gained = earned.map(|other| (gain(&other.corrected, &selected.corrected), other));
        match gained.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((gain, best)) if gain > convincing => selected = best,
            _ => break,
        }
    }
    selected
}

/// Without one of its effects: numbers first, then whatever is left; none where numbers cannot stand in for it.
fn exchanged<const N: usize>(
    data: &Data<'_, N>,
    selected: &Selection<N>,
    effect: usize,
    progress: Progress<'_>,
) -> Option<Selection<N>> {
    let mut other = selected.clone();
    let bare = without(data, &selected.found, effect, &selected.corrected);
    other.corrected = bare.clone();
    other.found.remove(effect);
    let numbers = other.forward(data, Tried { effects: false, numbers: true }, progress);
    let models = [&bare, &numbers.corrected, &selected.corrected];
    let scale = error_scale(models);
    let [bare, by_numbers, by_effect] = models.map(|model| model.score(scale));
    // where they take back less than they leave, a search for effects beside them would only find the same one again
    let stand_in = bare - by_numbers >= by_numbers - by_effect;
    stand_in.then(|| numbers.forward(data, Tried { effects: true, numbers: true }, progress))
}

/// By how much a model is better than another.
fn gain<const N: usize>(model: &Scored<N>, than: &Scored<N>) -> f64 {
    let scale = error_scale([model, than]);
    than.score(scale) - model.score(scale)
}
