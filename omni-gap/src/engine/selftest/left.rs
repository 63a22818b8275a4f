//! What is left of signatures once starts and nominal numbers have taken their share.

use nalgebra::{DMatrix, DVector};

use super::suspects::Suspect;
use super::view::Seen;
use crate::identify::{Overlap, Products};
use crate::simulate::MAX_CHANNELS;

/// What imitates signatures already: numbers that are moved.
#[derive(Clone)]
pub(in crate::engine) struct Imitated {
    /// By how much each number is moved, one column a signature.
    pub moved: DMatrix<f64>,
    /// How far each statement is violated by that [σ], one column a signature.
    pub violated: DMatrix<f64>,
    /// |s|² of the signatures before any number was moved [σ²]; none: they are as they were.
    pub whole: Option<DVector<f64>>,
}

impl Imitated {
    /// No number is moved.
    pub fn nothing(signatures: usize, numbers: usize, statements: usize) -> Self {
        let still = |rows| DMatrix::zeros(rows, signatures);
        Self { moved: still(numbers), violated: still(statements), whole: None }
    }
}

/// What holds the numbers of a robot while they imitate.
pub(in crate::engine) struct Held<'a> {
    /// What is seen.
    pub seen: &'a Seen,
    /// Their equations: J'ᵀJ' and what was stated.
    pub equations: DMatrix<f64>,
    /// d violation / d number: a row for each statement.
    pub slopes: DMatrix<f64>,
}

/// The products of what is left.
pub(in crate::engine) struct Left {
    /// Over all numbers and statements.
    all: Products,
    /// |s⊥|² of each signature per number measured, in the channel where it is largest [σ²]
    most_in_a_channel: DVector<f64>,
    /// By how much the numbers are moved to imitate each signature, one column a signature.
    moved: DMatrix<f64>,
    /// The share of the products that they take by their last step [σ²]
    taken: DMatrix<f64>,
    /// |s|² of each signature before any number was moved [σ²]
    whole: DVector<f64>,
    /// How far each statement is violated by what imitates a signature [σ], one column a signature.
    violated: DMatrix<f64>,
    /// a·H⁻¹·aᵀ of each statement, a its slopes: how far it moves where everything else gives way [σ²]
    gives: DVector<f64>,
}

/// What is left of a suspect beside a rival.
pub(in crate::engine) struct Remainder {
    /// Of what is measured and what was stated [σ²]
    pub all: f64,
    /// Of what was stated alone [σ²]
    pub stated: f64,
}

impl Left {
    /// What is left of signatures from which what [`Imitated`] predicts is taken away already.
    pub fn new(overlap: &Overlap, before: &Imitated, held: &Held<'_>) -> Self {
        let mut all = overlap.sum();
        // a statement that is violated is a number that is missed
        all.signatures += before.violated.tr_mul(&before.violated);
        all.shared -= held.slopes.tr_mul(&before.violated);
        let n = held.equations.nrows();
        let inverse = held.equations.clone().cholesky().map_or_else(|| DMatrix::zeros(n, n), |c| c.inverse());
        let step = &inverse * &all.shared;
        Self {
            violated: &before.violated + &held.slopes * &step,
            gives: (&held.slopes * inverse * held.slopes.transpose()).diagonal(),
            taken: all.shared.tr_mul(&step),
            whole: before.whole.clone().unwrap_or_else(|| all.signatures.diagonal()),
            most_in_a_channel: most_in_a_channel(overlap.channels(), &held.seen.channels, &step),
            moved: &before.moved + step,
            all,
        }
    }

    fn at(&self, a: usize, b: usize) -> f64 {
        self.all.signatures[(a, b)] - self.taken[(a, b)]
    }

    /// |s|² of each signature before any number was moved [σ²]
    pub fn whole(&self) -> &DVector<f64> {
        &self.whole
    }

    /// |s⊥|² of one column [σ²]
    pub fn size_of(&self, column: usize) -> f64 {
        self.at(column, column).max(0.0)
    }

    /// |s⊥|² of one column per number measured, in the channel where it is largest [σ²].
    pub fn most_in_a_channel(&self, column: usize) -> f64 {
        self.most_in_a_channel[column]
    }

    /// The share of |s|² that the nominal numbers take of a column, within what is stated of them [1].
    pub fn share_taken(&self, column: usize) -> f64 {
        let whole = self.whole[column];
        if whole > 0.0 { (1.0 - self.size_of(column) / whole).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// By how much each number is moved to imitate a column.
    pub fn moved(&self, column: usize) -> DVector<f64> {
        self.moved.column(column).into_owned()
    }

    /// How far each statement is violated by what imitates a column [σ].
    pub fn violated(&self, column: usize) -> Vec<f64> {
        self.violated.column(column).iter().copied().collect()
    }

    /// The share of |s⊥|² of a column that is what was stated, and is violated [1].
    pub fn share_stated(&self, column: usize) -> f64 {
        let size = self.size_of(column);
        if size > 0.0 { (self.violated.column(column).norm_squared() / size).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// What |s⊥|² of a column counts [1]: what is measured counts by the share of the runs that is held out, what was stated
    /// counts whole.
    pub fn counts(&self, column: usize, held: f64) -> f64 {
        held + (1.0 - held) * self.share_stated(column)
    }

    /// |s⊥|² of a column if a number were known just as it is stated [σ²]: v²/(a·H⁻¹·aᵀ) more, the least that it costs to
    /// imitate without violating the statement.
    pub fn size_if_exact(&self, column: usize, statement: usize) -> f64 {
        let (violated, gives) = (self.violated[(statement, column)], self.gives[statement]);
        self.size_of(column) + if gives > 0.0 { violated * violated / gives } else { 0.0 }
    }

    /// What is left of a suspect beside the best that a rival can make of its free numbers [σ²]; the rival's own products
    /// are raised by a share so that their equations can be solved.
    pub fn beside(&self, suspect: &Suspect, rival: &Suspect, regular: f64) -> f64 {
        self.remainder(suspect, rival, regular).all
    }

    /// The same, and how much of it is what was stated.
    pub fn remainder(&self, suspect: &Suspect, rival: &Suspect, regular: f64) -> Remainder {
        let free: Vec<usize> = rival.free.clone().collect();
        let mut own = DMatrix::from_fn(free.len(), free.len(), |a, b| self.at(free[a], free[b]));
        let most = own.diagonal().max();
        for k in 0..free.len() {
            own[(k, k)] += regular * most + f64::MIN_POSITIVE;
        }
        let shared = DVector::from_fn(free.len(), |k, _| self.at(free[k], suspect.typical));
        let by = own.cholesky().map_or_else(|| DVector::zeros(free.len()), |c| c.solve(&shared));
        let all = (self.size_of(suspect.typical) - shared.dot(&by)).max(0.0);
        let violated = self.violated.column(suspect.typical) - self.violated.select_columns(&free) * &by;
        Remainder { all, stated: violated.norm_squared().min(all) }
    }
}

/// |s' − J'·step|² of each signature per number measured, in the channel where it is largest [σ²].
fn most_in_a_channel(
    overlap: &[Products; MAX_CHANNELS],
    numbers: &[(DMatrix<f64>, usize); MAX_CHANNELS],
    step: &DMatrix<f64>,
) -> DVector<f64> {
    let of = |column: usize| {
        let step = step.column(column);
        let measured = overlap.iter().zip(numbers).filter(|(_, (_, measured))| *measured > 0);
        let each = measured.map(|(of, (products, measured))| {
            let left = of.signatures[(column, column)] - 2.0 * step.dot(&of.shared.column(column))
                + step.dot(&(products * step));
            left / *measured as f64
        });
        each.fold(0.0, f64::max)
    };
    DVector::from_fn(step.ncols(), |column, _| of(column))
}
