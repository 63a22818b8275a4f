//! What is known before the data: the stated uncertainty of the robot file.
//!
//! Each row says that a product of nominal factors is one, within its relative sigma: Σ c·ln(factor) = 0 ± σ. (In the
//! logarithm, a file that is a third too high and a robot that is a third too low are the same distance apart.) The back-EMF constant and the torque
//! constant are stated each on its own, so the factor that they share and their ratio are known together only as well
//! as the file says of each.

use model_core::plant::robot::Nominal;

use crate::log::RobotFile;
use crate::simulate::{Model, Slot};

/// One statement: Σ coefficient·ln(factor) = 0 within sigma.
#[derive(Clone, Debug)]
pub struct PriorRow {
    /// The factors and their coefficients.
    pub terms: Vec<(Nominal, f64)>,
    /// One-sigma relative uncertainty
    pub sigma: f64,
}

/// Everything stated.
#[derive(Clone, Debug)]
pub struct Prior {
    /// The statements.
    pub rows: Vec<PriorRow>,
}

/// A nominal value that a diagnosis takes as plainly wrong: its statement is struck out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Release {
    /// The parameter cause.
    pub cause: &'static str,
    /// Of friction: the body axis (v, vn, ω: 0, 1, 2) that it is wrong on; `None`: on all.
    pub axis: Option<usize>,
}

fn row(terms: &[(Nominal, f64)], sigma: f64) -> PriorRow {
    PriorRow { terms: terms.to_vec(), sigma }
}

impl Prior {
    /// What a robot file states of its own uncertainty.
    pub fn stated(robot: &RobotFile) -> Self {
        // every key here is one of the form, which all have a default
        let s = |key: &str| robot.relative_uncertainty(key).unwrap_or(0.1);
        let one = |p: Nominal, key: &str| row(&[(p, 1.0)], s(key));
        Self {
            rows: vec![
                one(Nominal::Mass, "mass_kg"),
                one(Nominal::Inertia, "inertia_kg_m2"),
                one(Nominal::Resistance, "resistance_ohm"),
                one(Nominal::TorqueConstant, "emf_constant_V_s"),
                row(&[(Nominal::TorqueConstant, 1.0), (Nominal::KtOverKv, 1.0)], s("torque_constant_Nm_per_A")),
                one(Nominal::ViscousV, "viscous_v_N_s_per_m"),
                one(Nominal::ViscousVn, "viscous_vn_N_s_per_m"),
                one(Nominal::ViscousW, "viscous_w_Nm_s"),
                one(Nominal::CoulombV, "coulomb_v_N"),
                one(Nominal::CoulombVn, "coulomb_vn_N"),
                one(Nominal::CoulombW, "coulomb_w_Nm"),
                one(Nominal::WheelRadius, "radius_m"),
                one(Nominal::CenterDistance, "distance_m"),
            ],
        }
    }

    /// The statements that speak of a parameter cause.
    pub fn rows_of(&self, release: Release) -> Vec<usize> {
        let own = |row: &PriorRow| match (release.cause, row.terms.as_slice()) {
            ("kt_over_kv", terms) => terms.len() == 2,
            ("torque_constant", terms) => terms.iter().any(|(p, _)| *p == Nominal::TorqueConstant),
            (cause, [(p, _)]) => p.cause() == cause && (release.axis.is_none() || release.axis == p.axis()),
            _ => false,
        };
        (0..self.rows.len()).filter(|k| own(&self.rows[*k])).collect()
    }

    /// The same without what it says of a parameter cause, which stays loosely held (a factor of about two) so that a
    /// fit cannot run away. K_t and K_v stay as equal to each other as they were when only their common factor is wrong.
    pub fn without(&self, release: Release) -> Self {
        let mut prior = self.clone();
        for k in self.rows_of(release) {
            prior.rows[k].sigma = 0.7;
        }
        if release.cause == "torque_constant" {
            let each: f64 = self.rows_of(release).iter().map(|k| self.rows[*k].sigma.powi(2)).sum();
            prior.rows.push(row(&[(Nominal::KtOverKv, 1.0)], each.sqrt()));
        }
        prior
    }

    /// How far each statement is violated by a model, in sigma.
    pub fn violations<const N: usize>(&self, model: &Model<N>) -> Vec<f64> {
        self.rows
            .iter()
            .map(|row| {
                let sum: f64 = row.terms.iter().map(|(p, c)| c * model.get(Slot::Nominal(*p)).ln()).sum();
                sum / row.sigma
            })
            .collect()
    }

    /// Σ violation²: what a model costs by what was stated.
    pub fn cost<const N: usize>(&self, model: &Model<N>) -> f64 {
        self.violations(model).iter().map(|v| v * v).sum()
    }
}
