//! Causes that all robots of a kind share, each against nothing shared.
//!
//! ```text
//! ln(BF) = max_τ [L₀(τ) + ½·z(τ)²] − max_τ L₀(τ) − ½·ln R
//! z = μ̂/σ(μ̂)                                            of an effect
//! z = δ̂/√(σ(δ̂)² + σ_stated²), δ̂ with its statement struck out      of a number
//! ```
//!
//! L₀ is the evidence with μ = 0, an effect that differs from robot to robot allowed; R is the number of robots (Schwarz's
//! criterion). One cause at a time: probabilities are those of the hypotheses "this one is shared" and "none is".

use model_core::plant::robot::Nominal;

use super::answer::CommonCause;
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::Place;
use super::population::{Population, Stated};
use super::quadratic::Quadratic;
use super::robots::{Robots, of_robot};

/// The causes of a kind whose probability is at least this [1].
const WORTH_TELLING: f64 = 0.01;

/// All that are worth telling, the most probable first.
pub(super) fn common_causes(
    places: &[Place],
    robots: &Robots<'_>,
    stated: &Stated,
    knobs: &PoolingKnobs,
) -> Vec<CommonCause> {
    let tested: Vec<(&Place, Shared)> =
        places.iter().filter_map(|place| Some((place, Shared::of(place, robots, stated, knobs)?))).collect();
    let each = (1.0 - knobs.nothing_shared) / tested.len().max(1) as f64;
    let weight = |shared: &Shared| each * shared.bayes_factor;
    let all: f64 = knobs.nothing_shared + tested.iter().map(|(_, shared)| weight(shared)).sum::<f64>();
    let told = tested.iter().map(|(place, shared)| told(place, shared, weight(shared) / all, robots));
    let mut told: Vec<CommonCause> = told.collect();
    told.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let mut causes = one_of_each(told);
    causes.retain(|cause| cause.probability >= WORTH_TELLING);
    causes.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    causes
}

/// Each cause at its most probable place, with the probability of all its places and numbers.
fn one_of_each(places: Vec<CommonCause>) -> Vec<CommonCause> {
    let mut causes: Vec<CommonCause> = Vec::new();
    for place in places {
        match causes.iter_mut().find(|cause| cause.of.id == place.of.id) {
            Some(cause) => cause.probability += place.probability,
            None => causes.push(place),
        }
    }
    causes
}

/// How much of a cause robots share.
struct Shared {
    amount: (f64, f64),
    spread: f64,
    z: f64,
    bayes_factor: f64,
}

impl Shared {
    fn of(place: &Place, robots: &Robots<'_>, stated: &Stated, knobs: &PoolingKnobs) -> Option<Self> {
        let seen: Vec<Quadratic> = robots.all().filter_map(|sessions| of_robot(place, sessions)).collect();
        let precision = stated.of_common(place)?;
        let at = place.coordinate();
        let others: Vec<usize> = (0..place.coordinates()).filter(|k| *k != at).collect();
        let look = |tau: f64| {
            let population = Population::of(&seen, &stated.spread(place, tau), &precision)?;
            let amount = population.common.estimate(at)?;
            let z = match place {
                Place::Effect { .. } => amount.0 / amount.1,
                Place::Number(number) => amount.0 / amount.1.hypot(stated.std(*number)),
            };
            Some((population.evidence(&others)?, Self { amount, spread: tau, z, bayes_factor: 0.0 }))
        };
        let spreads: &[f64] = if place.own() > 0 { &knobs.spreads } else { &[0.0] };
        let looked: Vec<(f64, Self)> = spreads.iter().filter_map(|tau| look(*tau)).collect();
        let without = looked.iter().map(|(evidence, _)| *evidence).fold(f64::NEG_INFINITY, f64::max);
        let with = |(evidence, shared): &(f64, Self)| evidence + 0.5 * shared.z * shared.z;
        let best = looked.into_iter().reduce(|best, other| if with(&other) > with(&best) { other } else { best })?;
        let gain = with(&best) - without - 0.5 * (seen.len() as f64).ln();
        let bayes_factor = if place.allows(best.1.amount.0) { gain.min(500.0).exp() } else { 0.0 };
        Some(Self { bayes_factor, ..best.1 })
    }
}

fn told(place: &Place, shared: &Shared, probability: f64, robots: &Robots<'_>) -> CommonCause {
    let (value, std) = place.value(shared.amount);
    let named = |session: &&&SessionEvidence| session.named.iter().any(|id| id == place.id());
    CommonCause {
        of: place.told(),
        title: place.title().to_owned(),
        value,
        std,
        spread: place.width(shared.spread),
        z: shared.z,
        probability,
        named_alone: robots.all().flatten().filter(named).count(),
    }
}

/// What all robots say of the numbers of the robot file alone.
pub(super) fn of_numbers(robots: &Robots<'_>) -> Vec<Quadratic> {
    robots.all().filter_map(|sessions| of_robot(&Place::Number(Nominal::Mass), sessions)).collect()
}
