//! Fleets with one weak effect, and fleets with none: what pooling says of them.

use model_core::effects::EffectKind;
use model_core::effects::card::Role;
use nalgebra::{DMatrix, DVector};
use omni_gap::Error;
use omni_gap::engine::Knobs;
use omni_gap::engine::findings::SessionEquations;
use omni_gap::pooling::{Pooled, PoolingKnobs, SessionEvidence, pooled};
use omni_gap::simulate::EffectInstance;

use super::kind::Kind;

/// Robots of a fleet.
pub const ROBOTS: usize = 30;

/// A cause of this probability counts as found.
pub const FOUND: f64 = 0.9;

/// A fleet and what was said of it.
#[derive(Clone, Debug)]
pub struct Trial {
    /// What all robots have, and how much of its typical size; none of a healthy fleet.
    pub hidden: Option<(&'static str, f64)>,
    /// Standard errors by which one session shows it if nothing is stated of the numbers; zero of a healthy fleet \[1\]
    pub beyond_free_numbers: f64,
    /// Sessions that named it on their own.
    pub named_alone: usize,
    /// What pooling says.
    pub pooled: Pooled,
}

impl Trial {
    /// The probability of what is there; of a healthy fleet, of the most probable that is not.
    pub fn probability(&self) -> f64 {
        let common = self.pooled.common.iter();
        let own = common.filter(|cause| self.hidden.is_none_or(|(id, _)| cause.of.id == id));
        own.map(|cause| cause.probability).fold(0.0, f64::max)
    }

    /// The probability of what is there and of what its card says it can be taken for.
    pub fn with_look_alikes(&self) -> f64 {
        let Some(card) = self.hidden.and_then(|(id, _)| EffectKind::find(id)).map(EffectKind::card) else { return 0.0 };
        let alike = |id: &str| id == card.id || card.look_alikes.iter().any(|other| other.with == id);
        self.pooled.common.iter().filter(|cause| alike(&cause.of.id)).map(|cause| cause.probability).sum()
    }

    /// The cause that is named as found.
    pub fn named(&self) -> Option<&str> {
        self.pooled.common.first().filter(|cause| cause.probability >= FOUND).map(|cause| cause.of.id.as_str())
    }
}

/// A fleet in which each session shows an effect by so many standard errors, or a healthy one.
///
/// # Errors
/// Where the robot file is none.
pub fn trial(kind: &Kind, hidden: Option<(&'static str, f64)>) -> Result<Trial, Error> {
    let (hidden, beyond_free_numbers) = match hidden {
        None => (None, 0.0),
        Some((id, errors)) => {
            let [stated, free] = shown(kind, id)?;
            (Some((id, errors / stated)), errors / stated * free)
        }
    };
    let instance = |(id, share): (&str, f64)| EffectKind::find(id).map(|effect| sized(effect, share));
    let kind = Kind { hidden: hidden.and_then(instance).into_iter().collect(), ..kind.clone() };
    let evidence = kind.evidence(&Knobs::default())?;
    let named =
        |session: &&SessionEvidence| hidden.is_some_and(|(id, _)| session.named.iter().any(|named| named == id));
    let named_alone = evidence.iter().filter(named).count();
    let pooled = pooled(&evidence.iter().collect::<Vec<_>>(), &PoolingKnobs::default());
    Ok(Trial { hidden, beyond_free_numbers, named_alone, pooled })
}

/// An effect with its sizes at so much of what is typical.
fn sized(effect: EffectKind, share: f64) -> EffectInstance {
    let card = effect.card();
    let mut instance = EffectInstance::typical(card, None);
    let has_size = card.params.iter().any(|number| number.role == Role::Size);
    for (number, value) in card.params.iter().zip(&mut instance.params) {
        if number.role == Role::Size || !has_size {
            *value = number.absent + share * (number.typical - number.absent);
        }
    }
    instance
}

/// Standard errors by which one session of a healthy robot of the kind would show the effect at its typical size, the median:
/// with what is stated of the numbers, and with nothing stated.
fn shown(kind: &Kind, id: &str) -> Result<[f64; 2], Error> {
    let healthy = Kind { robots: 7, hidden: Vec::new(), ..kind.clone() };
    let sessions = healthy.evidence(&Knobs::default())?;
    let shown = |stated: f64| {
        let each = sessions.iter().filter_map(|session| signal_to_noise(session.equations.as_ref()?, id, stated));
        median(each.collect())
    };
    Ok([1.0, NOTHING_STATED].map(shown))
}

/// The middle one; of none, no number.
pub(super) fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of.get(of.len() / 2).copied().unwrap_or(f64::NAN)
}

/// So little of Λ that the numbers are all but free, and the equations still have a solution.
const NOTHING_STATED: f64 = 1e-6;

/// √(s − wᵀ·(A + c·Λ)⁻¹·w): what of the effect's signature the numbers cannot imitate within so much of what is stated of them.
fn signal_to_noise(equations: &SessionEquations, id: &str, stated: f64) -> Option<f64> {
    let direction = equations.directions.iter().find(|d| d.id == id && d.wheel.is_none() && !d.carried)?;
    let n = equations.toward.len();
    let held = DMatrix::from_fn(n, n, |r, c| equations.numbers[r][c] + stated * equations.stated[r][c]);
    let shared = DVector::from_column_slice(&direction.with_numbers);
    let taken = held.cholesky()?.solve(&shared).dot(&shared);
    Some((direction.size - taken).max(0.0).sqrt())
}
