//! Robots one by one: how much each has of every cause, and which stand out from their kind.
//!
//! ```text
//! z_r = (x_r − m_₋r)/√(σ_r² + τ²_₋r + σ²(m_₋r))
//! ```
//!
//! m and τ² are those of the other robots by random effects (DerSimonian and Laird, *Controlled Clinical Trials* 7, 1986); z is
//! held to Student's t with R − 2 degrees of freedom.

use std::collections::BTreeMap;

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::answer::RobotEstimate;
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::Place;
use super::population::{Population, Stated};
use super::quadratic::Quadratic;

/// The sessions of a kind, robot by robot, each robot's in the order of their dates.
pub(super) struct Robots<'a> {
    by_name: BTreeMap<&'a str, Vec<&'a SessionEvidence>>,
}

impl<'a> Robots<'a> {
    /// Of sessions of one kind of robot, those without equations left out.
    pub fn of(sessions: &[&'a SessionEvidence]) -> Self {
        let mut by_name: BTreeMap<&str, Vec<&SessionEvidence>> = BTreeMap::new();
        for session in sessions.iter().filter(|session| session.equations.is_some()) {
            by_name.entry(&session.robot).or_default().push(session);
        }
        for sessions in by_name.values_mut() {
            sessions.sort_by(|a, b| (&a.date, &a.session).cmp(&(&b.date, &b.session)));
        }
        Self { by_name }
    }

    /// The sessions of each.
    pub fn all(&self) -> impl Iterator<Item = &Vec<&'a SessionEvidence>> {
        self.by_name.values()
    }

    /// Each with its sessions.
    pub fn named(&self) -> impl Iterator<Item = (&'a str, &Vec<&'a SessionEvidence>)> {
        self.by_name.iter().map(|(name, sessions)| (*name, sessions))
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.by_name.len()
    }
}

/// What all sessions of a robot say of a place; none where none does.
pub(super) fn of_robot(place: &Place, sessions: &[&SessionEvidence]) -> Option<Quadratic> {
    let seen: Vec<Quadratic> = sessions.iter().filter_map(|session| place.seen_in(session)).collect();
    Quadratic::sum(&seen)
}

/// Every place on every robot.
pub(super) fn estimates(
    places: &[Place],
    robots: &Robots<'_>,
    stated: &Stated,
    knobs: &PoolingKnobs,
) -> Vec<RobotEstimate> {
    let tests = (places.len() * robots.count()).max(1) as f64;
    let of_place = |place: &Place| {
        let seen = of_each(place, robots, stated);
        let amounts: Vec<(f64, f64)> = seen.iter().map(|(_, amount)| *amount).collect();
        let mut all = Vec::new();
        for (k, (robot, amount)) in seen.iter().enumerate() {
            let others: Vec<(f64, f64)> =
                amounts.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, a)| *a).collect();
            let apart = (amounts.len() >= knobs.least_robots).then(|| apart_from(*amount, &others)).flatten();
            let stands_out = apart.is_some_and(|(_, chance)| chance * tests < knobs.false_alarms);
            all.push(told(place, robot, *amount, apart.map(|(z, _)| z), stands_out));
        }
        all
    };
    places.iter().flat_map(of_place).collect()
}

/// How much of a place each robot has, its numbers held by what the others share.
fn of_each<'a>(place: &Place, robots: &Robots<'a>, stated: &Stated) -> Vec<(&'a str, (f64, f64))> {
    let seen: Vec<(&str, Quadratic)> =
        robots.named().filter_map(|(name, sessions)| Some((name, of_robot(place, sessions)?))).collect();
    let quadratics: Vec<Quadratic> = seen.iter().map(|(_, seen)| seen.clone()).collect();
    let Some(held) = held(place, &quadratics, stated) else { return Vec::new() };
    let amount = |(name, mut seen): (&'a str, Quadratic)| {
        seen.add(&held);
        Some((name, seen.estimate(place.coordinate())?))
    };
    seen.into_iter().filter_map(amount).collect()
}

/// What the kind says of the other numbers of one of its robots: about δ̂, within its own share of what is stated.
fn held(place: &Place, seen: &[Quadratic], stated: &Stated) -> Option<Quadratic> {
    let others: Vec<usize> = (place.own()..place.coordinates()).filter(|k| *k != place.coordinate()).collect();
    let population = Population::of(seen, &stated.spread(place, 0.0), &stated.of_common(place)?)?;
    let solved = population.common.hess.clone().cholesky()?;
    let (mean, covariance) = (solved.solve(&population.common.toward), solved.inverse());
    let own = stated.spread(place, 0.0) + covariance;
    let precision = own.select_rows(&others).select_columns(&others).cholesky()?.inverse();
    let mut held = Quadratic::nothing(place.coordinates());
    let toward = &precision * mean.select_rows(&others);
    let at: Vec<[usize; 1]> = others.iter().map(|k| [*k]).collect();
    held.add_at(&Quadratic { hess: precision, toward }, &at.iter().map(|k| &k[..]).collect::<Vec<_>>());
    Some(held)
}

/// The mean of estimates that scatter by more than their errors, its standard error, and that scatter's variance.
pub(super) fn random_effects(estimates: &[(f64, f64)]) -> Option<(f64, f64, f64)> {
    let weighted = |extra: f64| {
        let weights = estimates.iter().map(|(_, std)| 1.0 / (std * std + extra));
        let (sum, squares) = weights.clone().fold((0.0, 0.0), |(sum, squares), w| (sum + w, squares + w * w));
        let mean = estimates.iter().zip(weights).map(|((x, _), w)| w * x).sum::<f64>() / sum;
        (mean, sum, squares)
    };
    let (mean, sum, squares) = weighted(0.0);
    let q: f64 = estimates.iter().map(|(x, std)| ((x - mean) / std).powi(2)).sum();
    let room = sum - squares / sum;
    let beyond = q - (estimates.len() as f64 - 1.0);
    let variance = if room > 0.0 { (beyond / room).max(0.0) } else { 0.0 };
    let (mean, sum, _) = weighted(variance);
    (mean.is_finite() && sum > 0.0).then(|| (mean, sum.sqrt().recip(), variance))
}

/// How far it is from the others, in standard errors, and how probable that is by chance [1].
fn apart_from((value, std): (f64, f64), others: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (mean, error, variance) = random_effects(others)?;
    let z = (value - mean) / (std * std + variance + error * error).sqrt();
    let student = StudentsT::new(0.0, 1.0, (others.len() as f64 - 1.0).max(1.0)).ok()?;
    Some((z, 2.0 * student.sf(z.abs())))
}

fn told(place: &Place, robot: &str, amount: (f64, f64), z: Option<f64>, stands_out: bool) -> RobotEstimate {
    let (value, std) = place.value(amount);
    RobotEstimate {
        robot: robot.to_owned(),
        of: place.told(),
        absent: place.value((0.0, 0.0)).0,
        value,
        std,
        from_kind: z,
        stands_out,
    }
}
