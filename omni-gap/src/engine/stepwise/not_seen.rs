//! What recordings could not have shown: signals that are not logged, and effects too small to move what is.

use model_core::effects::EffectKind;

use super::scored::Data;
use super::search::Search;
use crate::simulate::{Chain, SignalGroup};

/// What this recording could not have shown.
pub(super) fn not_seen<const N: usize>(search: &Search<N>, data: &Data<'_, N>) -> Vec<String> {
    let mut lines = Vec::new();
    let missing = |group: SignalGroup| !data.fit.iter().any(|run| run.has_group(group));
    let by_speed = matches!(data.fit[0].chain, Chain::WheelSpeed | Chain::SetSpeed);
    if by_speed {
        lines.push(
            "voltages, currents and forces: the model is driven by wheel speeds and says nothing of them".to_owned(),
        );
    } else if missing(SignalGroup::Current) {
        lines.push("the electrical stage by itself: no current to compare is logged".to_owned());
    }
    if missing(SignalGroup::WheelSpeed) {
        lines.push("slip and drivetrain apart from the body: no measured wheel speed to compare".to_owned());
    }
    if missing(SignalGroup::Pose) {
        lines.push("the contact and the camera: no pose is logged".to_owned());
    }
    let screened = &search.rounds[0].screened;
    let mut named: Vec<&str> = Vec::new();
    // what a record shows event by event, it shows where there is none too
    for card in EffectKind::ALL.iter().map(|effect| effect.card()).filter(|card| !card.shows_event_by_event()) {
        let best = screened.iter().filter(|s| s.candidate.card.id == card.id).map(|s| s.visible).fold(0.0, f64::max);
        let tried = screened.iter().any(|s| s.candidate.card.id == card.id);
        if tried && best < data.knobs.screen.visible && !named.contains(&card.id) {
            named.push(card.id);
            lines
                .push(format!("{}: at its typical size it would move these recordings by {best:.1} σ in all", card.id));
        }
    }
    lines
}
