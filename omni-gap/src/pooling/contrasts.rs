//! What differs between two labels: two versions of the firmware, two floors. Robots that drove under both say so, each against itself.

use super::answer::Contrast;
use super::changes::chance;
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::Place;
use super::population::Stated;
use super::robots::{Robots, of_robot, random_effects};
use super::steps::step;

/// A label of sessions.
struct Label {
    name: &'static str,
    of: fn(&SessionEvidence) -> Option<&str>,
}

const LABELS: [Label; 2] = [
    Label { name: "firmware", of: |session| session.firmware.as_deref() },
    Label { name: "floor", of: |session| session.floor.as_deref() },
];

/// All that are surer than chance, the surest first.
pub(super) fn contrasts(places: &[Place], robots: &Robots<'_>, stated: &Stated, knobs: &PoolingKnobs) -> Vec<Contrast> {
    let pairs: Vec<(&Label, &str, &str)> = LABELS.iter().flat_map(|label| pairs(label, robots)).collect();
    let tests = (pairs.len() * places.len()).max(1) as f64;
    let mut all: Vec<Contrast> = Vec::new();
    for (label, from, to) in pairs {
        for place in places {
            let Some((step, std, robots)) = between(place, robots, stated, |session| side(label, session, from, to))
            else {
                continue;
            };
            let z = step / std;
            if chance(z) * tests < knobs.false_alarms {
                all.push(Contrast {
                    label: label.name.to_owned(),
                    from: from.to_owned(),
                    to: to.to_owned(),
                    of: place.told(),
                    by: place.difference(step),
                    std: place.width(std),
                    z,
                    robots,
                });
            }
        }
    }
    all.sort_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
    all
}

/// Each value of a label beside the next one, in their order.
fn pairs<'a>(label: &'a Label, robots: &Robots<'a>) -> Vec<(&'a Label, &'a str, &'a str)> {
    let mut values: Vec<&str> = robots.all().flatten().filter_map(|session| (label.of)(session)).collect();
    values.sort_unstable();
    values.dedup();
    values.windows(2).map(|pair| (label, pair[0], pair[1])).collect()
}

/// Whether a session is of the second value, or of the first; none of another.
fn side(label: &Label, session: &SessionEvidence, from: &str, to: &str) -> Option<bool> {
    let value = (label.of)(session)?;
    if value == to { Some(true) } else { (value == from).then_some(false) }
}

/// The step that robots take together, its standard error, and how many of them tell it.
fn between(
    place: &Place,
    robots: &Robots<'_>,
    stated: &Stated,
    is_after: impl Fn(&SessionEvidence) -> Option<bool>,
) -> Option<(f64, f64, usize)> {
    let of_robot = |sessions: &Vec<&SessionEvidence>| {
        let of = |after: bool| sessions.iter().copied().filter(|s| is_after(s) == Some(after)).collect::<Vec<_>>();
        step(place, &of_robot(place, &of(false))?, &of_robot(place, &of(true))?, stated)
    };
    let steps: Vec<(f64, f64)> = robots.all().filter_map(of_robot).collect();
    if steps.is_empty() {
        return None;
    }
    random_effects(&steps).map(|(mean, error, _)| (mean, error, steps.len()))
}
