//! The hierarchical model: robots scatter about what they have in common.
//!
//! Robot r says A_r and b_r of its own x_r = u + ζ_r. With ζ_r integrated out it says of u
//!
//! ```text
//! A'_r = (I + A_r·S)⁻¹·A_r        b'_r = (I + A_r·S)⁻¹·b_r
//! ln(evidence) = Σ_r [−½·ln det(I + A_r·S) + ½·b_rᵀ·S·b'_r] + ½·bᵀ·P⁻¹·b − ½·ln det P + ½·ln det Λ_u
//! P = Σ A'_r + Λ_u        b = Σ b'_r
//! ```
//!
//! (Gelman et al., *Bayesian Data Analysis*, chapter 5 and 15: the normal hierarchical linear model.)

use model_core::plant::robot::Nominal;
use nalgebra::DMatrix;

use super::place::Place;
use super::quadratic::Quadratic;

/// What robots say of what they have in common.
#[derive(Clone, Debug)]
pub(super) struct Population {
    /// P and b.
    pub common: Quadratic,
    /// The robots' part of ln(evidence): Σ_r.
    of_robots: f64,
}

impl Population {
    /// Of robots that scatter with covariance S about u, of which a precision is stated; none where that cannot be.
    pub fn of(robots: &[Quadratic], spread: &DMatrix<f64>, stated: &DMatrix<f64>) -> Option<Self> {
        let n = stated.nrows();
        let mut common = Quadratic::nothing(n);
        common.hess += stated;
        let mut of_robots = 0.0;
        for robot in robots {
            let mixed = (DMatrix::identity(n, n) + &robot.hess * spread).lu();
            let toward = mixed.solve(&robot.toward)?;
            common.hess += mixed.solve(&robot.hess)?;
            of_robots += 0.5 * (spread * &robot.toward).dot(&toward) - 0.5 * mixed.determinant().abs().ln();
            common.toward += toward;
        }
        common.hess = 0.5 * (&common.hess + common.hess.transpose());
        of_robots.is_finite().then_some(Self { common, of_robots })
    }

    /// ln(evidence) where only these coordinates are not zero, but for ln det Λ_u.
    pub fn evidence(&self, coordinates: &[usize]) -> Option<f64> {
        let hess = self.common.hess.select_rows(coordinates).select_columns(coordinates).cholesky()?;
        let toward = self.common.toward.select_rows(coordinates);
        let half_log_det: f64 = hess.l().diagonal().iter().map(|x| x.ln()).sum();
        Some(self.of_robots + 0.5 * toward.dot(&hess.solve(&toward)) - half_log_det)
    }
}

/// How the stated uncertainty of the robot file divides: Λ, and the share ρ of it that robots have in common.
#[derive(Clone, Debug)]
pub(super) struct Stated {
    /// Λ
    pub precision: DMatrix<f64>,
    /// Λ⁻¹
    pub covariance: DMatrix<f64>,
    /// ρ [1]
    pub in_common: f64,
}

impl Stated {
    /// With the share that the robots' numbers themselves tell; none where Λ is singular.
    pub fn of(robots: &[Quadratic], precision: &DMatrix<f64>, shares: &[f64]) -> Option<Self> {
        let covariance = precision.clone().cholesky()?.inverse();
        let all: Vec<usize> = (0..Nominal::COUNT).collect();
        let evidence = |share: f64| {
            let population = Population::of(robots, &(&covariance * (1.0 - share)), &(precision / share))?;
            // ½·ln det(Λ/ρ), but for what does not depend on ρ
            Some(population.evidence(&all)? - 0.5 * Nominal::COUNT as f64 * share.ln())
        };
        let told = shares.iter().filter_map(|share| evidence(*share).map(|evidence| (*share, evidence)));
        let (in_common, _) = told.reduce(|best, other| if other.1 > best.1 { other } else { best })?;
        Some(Self { precision: precision.clone(), covariance, in_common })
    }

    /// S of a place whose amount scatters by τ from robot to robot.
    pub fn spread(&self, place: &Place, tau: f64) -> DMatrix<f64> {
        place.widened(&(&self.covariance * (1.0 - self.in_common)), tau * tau)
    }

    /// Λ_u of a place: nothing of an effect; of a number nothing where it is the place itself.
    pub fn of_common(&self, place: &Place) -> Option<DMatrix<f64>> {
        let covariance = &self.covariance * self.in_common;
        let struck = match place {
            Place::Effect { .. } => None,
            Place::Number(number) => Some(*number as usize),
        };
        let kept: Vec<usize> = (0..Nominal::COUNT).filter(|k| Some(*k) != struck).collect();
        let inverse = covariance.select_rows(&kept).select_columns(&kept).cholesky()?.inverse();
        let mut precision = DMatrix::zeros(Nominal::COUNT, Nominal::COUNT);
        for (r, row) in kept.iter().enumerate() {
            for (c, column) in kept.iter().enumerate() {
                precision[(*row, *column)] = inverse[(r, c)];
            }
        }
        Some(place.widened(&precision, 0.0))
    }

    /// What the file says of a place's coordinates: Λ about no departure, of an effect nothing.
    pub fn of_file(&self, place: &Place) -> Quadratic {
        Quadratic { hess: place.widened(&self.precision, 0.0), ..Quadratic::nothing(place.coordinates()) }
    }

    /// One standard error that the file states of a number, in the logarithm [1].
    pub fn std(&self, number: Nominal) -> f64 {
        self.covariance[(number as usize, number as usize)].sqrt()
    }
}
