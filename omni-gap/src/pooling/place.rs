//! What may be pooled: an effect at a place, or a number of the robot file.

use model_core::effects::EffectKind;
use model_core::plant::robot::Nominal;

use super::evidence::SessionEvidence;
use super::pooled_number::PooledNumber;
use super::quadratic::Quadratic;
use crate::engine::findings::{Direction, SessionEquations};
use nalgebra::{DMatrix, DVector};

/// A cause that robots may share.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// An effect of the catalogue, in one of its numbers.
    Effect { id: String, wheel: Option<usize>, key: String, unit: String, absent: f64, typical: f64, either_way: bool },
    /// The factor on a number of the robot file.
    Number(Nominal),
}

impl Place {
    /// Every one that the sessions speak of, effects in the order in which they come first.
    pub fn all(sessions: &[&SessionEvidence]) -> Vec<Place> {
        let mut all: Vec<Place> = Vec::new();
        let told = sessions.iter().filter_map(|session| session.equations.as_ref());
        for direction in told.flat_map(|equations| &equations.directions) {
            if !all.iter().any(|place| place.is(direction)) {
                all.push(Place::of(direction));
            }
        }
        all.extend(Nominal::ALL.map(Place::Number));
        all
    }

    fn of(direction: &Direction) -> Self {
        let Direction { id, wheel, key, unit, absent, typical, either_way, .. } = direction.clone();
        Place::Effect { id, wheel, key, unit, absent, typical, either_way }
    }

    fn is(&self, direction: &Direction) -> bool {
        match self {
            Place::Effect { id, wheel, key, .. } => {
                (id, wheel, key) == (&direction.id, &direction.wheel, &direction.key)
            }
            Place::Number(_) => false,
        }
    }

    /// Id of the cause.
    pub fn id(&self) -> &str {
        match self {
            Place::Effect { id, .. } => id,
            Place::Number(number) => number.cause(),
        }
    }

    /// The cause's name for people.
    pub fn title(&self) -> &'static str {
        match self {
            Place::Effect { id, .. } => {
                EffectKind::find(id).map_or("an effect of another catalogue", |e| e.card().title)
            }
            Place::Number(number) => number.card().title,
        }
    }

    /// What it is, for those who read of it.
    pub fn told(&self) -> PooledNumber {
        let (id, wheel, key, unit) = match self {
            Place::Effect { id, wheel, key, unit, .. } => (id.as_str(), *wheel, key.as_str(), unit.as_str()),
            Place::Number(number) => (number.cause(), None, number.number().key, "1"),
        };
        PooledNumber { id: id.to_owned(), wheel, key: key.to_owned(), unit: unit.to_owned() }
    }

    /// What is told of so much of it, ± one standard error: in the effect's unit; of a number, the factor on it.
    pub fn value(&self, (amount, std): (f64, f64)) -> (f64, f64) {
        match self {
            Place::Effect { absent, typical, .. } => {
                (absent + amount * (typical - absent), (std * (typical - absent)).abs())
            }
            Place::Number(_) => (amount.exp(), amount.exp() * std),
        }
    }

    /// So much more of it, in the effect's unit; of a number, in the logarithm of its factor.
    pub fn difference(&self, amount: f64) -> f64 {
        match self {
            Place::Effect { absent, typical, .. } => amount * (typical - absent),
            Place::Number(_) => amount,
        }
    }

    /// So much of a spread, in the same unit.
    pub fn width(&self, spread: f64) -> f64 {
        match self {
            Place::Effect { absent, typical, .. } => (spread * (typical - absent)).abs(),
            Place::Number(_) => spread,
        }
    }

    /// Whether so much of it can be.
    pub fn allows(&self, amount: f64) -> bool {
        match self {
            Place::Effect { either_way, .. } => *either_way || amount > 0.0,
            Place::Number(_) => true,
        }
    }

    /// The coordinate that says how much of it there is.
    pub fn coordinate(&self) -> usize {
        match self {
            Place::Effect { .. } => 0,
            Place::Number(number) => *number as usize,
        }
    }

    /// How many coordinates its equations have.
    pub fn coordinates(&self) -> usize {
        self.own() + Nominal::COUNT
    }

    /// How many stand before the numbers of the robot file.
    pub fn own(&self) -> usize {
        usize::from(matches!(self, Place::Effect { .. }))
    }

    /// What a session says of it.
    pub fn seen_in(&self, session: &SessionEvidence) -> Option<Quadratic> {
        let equations = session.equations.as_ref()?;
        match self {
            Place::Number(_) => Some(numbers(equations)),
            Place::Effect { .. } => {
                let direction = equations.directions.iter().find(|direction| self.is(direction))?;
                Some(with_effect(direction, equations))
            }
        }
    }

    /// A matrix over the numbers of the robot file, widened to its coordinates.
    pub fn widened(&self, of_numbers: &DMatrix<f64>, own: f64) -> DMatrix<f64> {
        let n = self.own();
        let mut wide = DMatrix::zeros(self.coordinates(), self.coordinates());
        wide.view_mut((n, n), (Nominal::COUNT, Nominal::COUNT)).copy_from(of_numbers);
        if n > 0 {
            wide[(0, 0)] = own;
        }
        wide
    }
}

/// The equations of the numbers alone.
fn numbers(equations: &SessionEquations) -> Quadratic {
    Quadratic { hess: matrix(&equations.numbers), toward: DVector::from_vec(equations.toward.clone()) }
}

fn with_effect(direction: &Direction, equations: &SessionEquations) -> Quadratic {
    let mut numbers = numbers(equations);
    if direction.carried && direction.size > 0.0 {
        let shared = DVector::from_column_slice(&direction.with_numbers);
        numbers.hess += &shared * shared.transpose() / direction.size;
        numbers.toward += shared * (direction.toward / direction.size);
    }
    let mut all = Quadratic::nothing(1 + Nominal::COUNT);
    all.hess[(0, 0)] = direction.size;
    all.toward[0] = direction.toward;
    for (k, shared) in direction.with_numbers.iter().enumerate() {
        all.hess[(0, 1 + k)] = *shared;
        all.hess[(1 + k, 0)] = *shared;
    }
    all.hess.view_mut((1, 1), (Nominal::COUNT, Nominal::COUNT)).copy_from(&numbers.hess);
    all.toward.rows_mut(1, Nominal::COUNT).copy_from(&numbers.toward);
    all
}

/// Rows as a matrix.
pub(super) fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(Nominal::COUNT, Nominal::COUNT, |r, c| {
        rows.get(r).and_then(|row| row.get(c)).copied().unwrap_or(0.0)
    })
}
