//! What can be the cause: every effect, on every wheel where it can sit on one, and every nominal parameter.

use model_core::effects::EffectKind;
use model_core::effects::card::{Card, Param, Role, Scope};
use model_core::plant::robot::Nominal;

use crate::engine::knobs::ScreenKnobs;
use crate::identify::{Extent, FreedPrior, Prior};
use crate::simulate::{Chain, EffectInstance};
use crate::vocabulary::{Axis, Kind};

/// A cause that a report can name.
#[derive(Clone, Copy, Debug)]
pub enum Cause {
    /// An effect of the catalogue, on one wheel or on all (or on the robot).
    Effect(&'static Card, Option<usize>),
    /// A nominal value that is wrong.
    Parameter(FreedPrior),
}

impl Cause {
    /// Its id in files.
    pub fn id(&self) -> &'static str {
        match self {
            Cause::Effect(card, _) => card.id,
            Cause::Parameter(release) => release.cause,
        }
    }

    /// The wheel that it sits on alone.
    pub fn wheel(&self) -> Option<usize> {
        match self {
            Cause::Effect(_, wheel) => *wheel,
            Cause::Parameter(_) => None,
        }
    }

    /// Effect or parameter.
    pub fn kind(&self) -> Kind {
        match self {
            Cause::Effect(..) => Kind::Effect,
            Cause::Parameter(_) => Kind::Parameter,
        }
    }

    /// The body axis that it speaks of alone.
    pub fn axis(&self) -> Option<Axis> {
        match self {
            Cause::Effect(..) => None,
            Cause::Parameter(release) => release.axis().map(|axis| Axis::ALL[axis]),
        }
    }

    /// Free numbers, or statements struck out, that it adds to a model.
    pub fn freedom(&self, prior: &Prior) -> usize {
        match self {
            Cause::Effect(card, _) => card.params.iter().filter(|p| p.role != Role::Fixed).count(),
            Cause::Parameter(release) => prior.struck_out_by(*release).len(),
        }
    }

    /// What was stated, without what this cause says is wrong of it.
    pub fn struck_out_of(&self, prior: &Prior, released_sigma: f64) -> Prior {
        match self {
            Cause::Effect(..) => prior.clone(),
            Cause::Parameter(release) => prior.without(*release, released_sigma),
        }
    }

    /// What was stated, without what all of these say is wrong of it.
    pub fn all_struck_out_of<'a>(causes: impl Iterator<Item = &'a Cause>, prior: &Prior, released_sigma: f64) -> Prior {
        causes.fold(prior.clone(), |prior, cause| cause.struck_out_of(&prior, released_sigma))
    }

    /// True if both are the same cause at the same place, and of a number's wrong in the same way.
    pub fn is(&self, other: &Cause) -> bool {
        match (self, other) {
            (Cause::Parameter(release), Cause::Parameter(other)) => release == other,
            _ => self.same_id(other) && self.wheel() == other.wheel(),
        }
    }

    /// True if both name the same cause, wherever it sits.
    pub fn same_id(&self, other: &Cause) -> bool {
        self.id() == other.id()
    }
}

/// An effect to try, with the sizes to try it at.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect and where it sits.
    pub card: &'static Card,
    /// The wheel, if on one alone.
    pub wheel: Option<usize>,
    /// Parameter sets to look at, all of them real effects.
    pub trials: Vec<EffectInstance>,
    /// More of them, for a closer look: other sizes and shapes.
    pub closer: Vec<EffectInstance>,
}

/// Every nominal value that can be plainly wrong; friction on all axes by one factor or by one each, and on each axis alone.
pub fn freed_priors() -> Vec<FreedPrior> {
    let mut all: Vec<FreedPrior> = Vec::new();
    for p in Nominal::ALL {
        let extents = match p.axis() {
            None => vec![Extent::Each],
            Some(axis) => vec![Extent::Each, Extent::CommonFactor, Extent::Axis(axis)],
        };
        for extent in extents {
            let release = FreedPrior { cause: p.cause(), extent };
            if !all.contains(&release) {
                all.push(release);
            }
        }
    }
    all
}

/// True if an effect has a say in a model that is driven so and carries these effects: the drive's own speed loop, where
/// speeds are set; what shows beside another effect alone, where that is there.
pub fn has_a_say(card: &Card, chain: Chain, present: &[EffectInstance]) -> bool {
    let shows = |beside: &str| present.iter().any(|effect| effect.id == beside);
    (chain == Chain::SetSpeed || !card.of_speed_drive()) && card.physics.shows_beside.is_none_or(shows)
}

/// Every effect that has a say in a model that is driven so, and is not in it already.
pub fn candidates<const N: usize>(present: &[EffectInstance], chain: Chain, knobs: &ScreenKnobs) -> Vec<Candidate> {
    let mut all = Vec::new();
    for card in EffectKind::ALL.iter().map(|effect| effect.card()).filter(|card| has_a_say(card, chain, present)) {
        let anywhere = card.scope != Scope::OneWheel;
        let places = anywhere
            .then_some(None)
            .into_iter()
            .chain((card.scope != Scope::Robot).then_some(0..N).into_iter().flatten().map(Some));
        for wheel in places {
            // on all wheels and on one of them too it would act there twice, and no robot file may say so
            let overlaps = |p: &EffectInstance| p.wheel.is_none() || wheel.is_none() || p.wheel == wheel;
            let taken = present.iter().any(|p| p.id == card.id && overlaps(p));
            if !taken {
                // where it can sit on all wheels, the shapes are looked at on all of them together
                let closer = if wheel.is_none() || !anywhere { closer(card, wheel, knobs) } else { Vec::new() };
                all.push(Candidate { card, wheel, trials: trials(card, wheel, knobs), closer });
            }
        }
    }
    all
}

/// A parameter set: sizes absent, shapes typical, but for some.
fn with(card: &'static Card, wheel: Option<usize>, changes: &[(usize, f64)]) -> EffectInstance {
    let mut params: Vec<f64> =
        card.params.iter().map(|p| if p.role == Role::Size { p.absent } else { p.typical }).collect();
    for (k, x) in changes {
        params[*k] = x.clamp(card.params[*k].within.0, card.params[*k].within.1);
    }
    EffectInstance { id: card.id, wheel, params }
}

/// A card's parameters of one role, with their places.
fn of_role(card: &'static Card, role: Role) -> impl Iterator<Item = (usize, &'static Param)> {
    card.params.iter().enumerate().filter(move |(_, p)| p.role == role)
}

/// Parameter sets that span what the effect can look like: each size at its typical departure from absent, the others
/// absent, and each shape that is an effect of its own.
pub(super) fn trials(card: &'static Card, wheel: Option<usize>, knobs: &ScreenKnobs) -> Vec<EffectInstance> {
    let sizes = of_role(card, Role::Size).map(|(k, p)| with(card, wheel, &[(k, p.typical)]));
    let own = of_role(card, Role::Shape).filter(|(_, s)| s.absent == s.typical).map(|(s, shape)| {
        // a shape that can be an effect of its own, such as a ratio
        let away = knobs.shape_away * (shape.within.1 - shape.within.0);
        with(card, wheel, &[(s, shape.typical + away)])
    });
    let mut all: Vec<EffectInstance> = sizes.chain(own).collect();
    if all.is_empty() {
        all.push(EffectInstance::typical(card, wheel));
    }
    all
}

/// The same for a closer look: each size at multiples of its typical departure, and with each shape at a few values; with these
/// also a limit at its largest multiple, from where one that is hardly reached is not far.
fn closer(card: &'static Card, wheel: Option<usize>, knobs: &ScreenKnobs) -> Vec<EffectInstance> {
    let mut all = Vec::new();
    for (k, p) in of_role(card, Role::Size) {
        let multiples: Vec<f64> =
            knobs.size_multiples.iter().map(|share| p.absent + share * (p.typical - p.absent)).collect();
        all.extend(multiples.iter().map(|x| with(card, wheel, &[(k, *x)])));
        let hardly_reached = multiples.into_iter().reduce(f64::max).filter(|_| card.physics.is_limit);
        for size in std::iter::once(p.typical).chain(hardly_reached) {
            for (s, shape) in of_role(card, Role::Shape) {
                all.extend(others(shape, knobs).into_iter().map(|x| with(card, wheel, &[(k, size), (s, x)])));
            }
        }
    }
    all
}

/// Other values of a shape than its typical one.
fn others(shape: &Param, knobs: &ScreenKnobs) -> Vec<f64> {
    let (lo, hi, typical) = (shape.within.0, shape.within.1, shape.typical);
    if lo < 0.0 {
        // an angle: turned from the typical one
        let turned = |turn: &f64| {
            let x = typical + turn * (hi - lo);
            if x > hi { x - (hi - lo) } else { x }
        };
        knobs.shape_turns.iter().map(turned).collect()
    } else {
        knobs.shape_multiples.iter().map(|multiple| typical * multiple).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_of_a_limit_are_also_looked_at_where_it_is_hardly_reached() {
        let knobs = ScreenKnobs::default();
        let sizes_with_other_shapes = |kind: EffectKind| {
            let card = kind.card();
            let mut sizes: Vec<f64> = closer(card, None, &knobs)
                .iter()
                .filter(|trial| of_role(card, Role::Shape).any(|(k, p)| trial.params[k] != p.typical))
                .flat_map(|trial| of_role(card, Role::Size).map(|(k, p)| trial.params[k] / p.typical))
                .collect();
            sizes.sort_by(f64::total_cmp);
            sizes.dedup();
            sizes
        };
        assert_eq!(sizes_with_other_shapes(EffectKind::WheelSlip), [1.0, 2.0]);
        assert_eq!(sizes_with_other_shapes(EffectKind::FrictionWarmup), [1.0]);
    }
}
