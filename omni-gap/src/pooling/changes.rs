//! Changes over time: for each robot and cause the day from which on it is otherwise, if there is one.
//!
//! Every split of a robot's sessions is tried, the largest step in standard errors is kept, and the chance of it is held to all that
//! was tried (Bonferroni). Sessions that scatter among themselves by more than their errors make a step less sure.

use statrs::distribution::{ContinuousCDF, Normal};

use super::answer::{ChangePoint, CourseDay};
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::Place;
use super::population::Stated;
use super::quadratic::Quadratic;
use super::robots::{Robots, random_effects};
use super::steps::step;

/// All that are surer than chance, the surest first.
pub(super) fn changes(
    places: &[Place],
    robots: &Robots<'_>,
    stated: &Stated,
    knobs: &PoolingKnobs,
) -> Vec<ChangePoint> {
    let splits = |sessions: &Vec<&SessionEvidence>| splits(sessions, knobs.least_sessions).count();
    let tests = (places.len() * robots.all().map(splits).sum::<usize>()).max(1) as f64;
    let mut all = Vec::new();
    for (robot, sessions) in robots.named() {
        for place in places {
            let Some(found) = largest(place, sessions, stated, knobs.least_sessions) else { continue };
            if chance(found.z) * tests < knobs.false_alarms {
                all.push(told(place, robot, sessions, &found));
            }
        }
    }
    all.sort_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
    all
}

/// How probable so many standard errors are by chance, either way [1].
pub(super) fn chance(z: f64) -> f64 {
    2.0 * Normal::standard().sf(z.abs())
}

/// Where a robot's sessions may be split: between two days.
fn splits<'a>(sessions: &'a [&SessionEvidence], least: usize) -> impl Iterator<Item = usize> + 'a {
    (least..(sessions.len() + 1).saturating_sub(least)).filter(|k| sessions[k - 1].date != sessions[*k].date)
}

struct Found {
    split: usize,
    step: (f64, f64),
    z: f64,
    /// What each session says alone.
    each: Vec<Option<(f64, f64)>>,
}

fn largest(place: &Place, sessions: &[&SessionEvidence], stated: &Stated, least: usize) -> Option<Found> {
    let nothing = || Quadratic::nothing(place.coordinates());
    let seen: Vec<Quadratic> = sessions.iter().map(|session| place.seen_in(session).unwrap_or_else(nothing)).collect();
    let each: Vec<Option<(f64, f64)>> = seen.iter().map(|seen| alone(place, seen, stated)).collect();
    let sum = |part: &[Quadratic]| Quadratic::sum(part).unwrap_or_else(nothing);
    let look = |split: usize| {
        let (value, std) = step(place, &sum(&seen[..split]), &sum(&seen[split..]), stated)?;
        let scatter = [&each[..split], &each[split..]].map(|part| scatter(part) / part.len() as f64);
        let std = (std * std + scatter.iter().sum::<f64>()).sqrt();
        Some((split, (value, std), value / std))
    };
    let looked = splits(sessions, least).filter_map(look);
    let (split, step, z) = looked.reduce(|best, other| if other.2.abs() > best.2.abs() { other } else { best })?;
    Some(Found { split, step, z, each })
}

/// What one session says of a place, with the robot file's statements.
fn alone(place: &Place, seen: &Quadratic, stated: &Stated) -> Option<(f64, f64)> {
    let mut held = stated.of_file(place);
    held.add(seen);
    held.estimate(place.coordinate())
}

/// The variance by which sessions scatter beyond their errors.
fn scatter(each: &[Option<(f64, f64)>]) -> f64 {
    let told: Vec<(f64, f64)> = each.iter().flatten().copied().collect();
    if told.len() < 2 { 0.0 } else { random_effects(&told).map_or(0.0, |(_, _, variance)| variance) }
}

fn told(place: &Place, robot: &str, sessions: &[&SessionEvidence], found: &Found) -> ChangePoint {
    let day = |(session, amount): (&&SessionEvidence, &Option<(f64, f64)>)| {
        let (value, std) = place.value((*amount)?);
        Some(CourseDay { date: session.date.clone(), value, std })
    };
    ChangePoint {
        robot: robot.to_owned(),
        of: place.told(),
        since: sessions[found.split].date.clone(),
        last_before: sessions[found.split - 1].date.clone(),
        by: place.difference(found.step.0),
        std: place.width(found.step.1),
        z: found.z,
        course: sessions.iter().zip(&found.each).filter_map(day).collect(),
    }
}
