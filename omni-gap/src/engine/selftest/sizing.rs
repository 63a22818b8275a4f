//! The number that sizes a cause.

use model_core::effects::card::{Card, Role};

use crate::engine::stepwise::Cause;

/// Its name, unit and values.
pub(super) struct Sizing {
    pub key: &'static str,
    pub unit: &'static str,
    absent: f64,
    pub typical: f64,
    within: (f64, f64),
}

impl Sizing {
    pub fn of(cause: &Cause, wrong: f64) -> Self {
        match cause {
            Cause::Effect(card, _) => Self::of_card(card),
            Cause::Parameter(release) => {
                Self { key: release.cause, unit: "1", absent: 0.0, typical: wrong, within: (-1.0, 1.0) }
            }
        }
    }

    /// The first size of an effect; of one without, its first number.
    fn of_card(card: &'static Card) -> Self {
        let first = card.params.iter().find(|p| p.role == Role::Size).or(card.params.first());
        match first {
            Some(p) => Self { key: p.key, unit: p.unit, absent: p.absent, typical: p.typical, within: p.within },
            None => Self { key: "", unit: "", absent: 0.0, typical: 1.0, within: (0.0, 1.0) },
        }
    }

    /// The number at a multiple of its typical departure; none where it has no such value.
    pub fn at(&self, multiple: f64) -> Option<f64> {
        let x = self.absent + multiple * (self.typical - self.absent);
        (x.is_finite() && (self.within.0..=self.within.1).contains(&x)).then_some(x)
    }
}
