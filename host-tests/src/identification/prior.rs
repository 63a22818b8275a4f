//! What is believed of a robot before it is identified: its true file, wrong by what is stated of each number.

use model_core::plant::robot::Nominal;
use omni_gap::identify::IDENTIFIED;
use omni_gap::log::RobotFile;
use omni_gap::simulate::NominalKey;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// How many numbers are identified.
pub const NUMBERS: usize = IDENTIFIED.len();

/// A robot file that is wrong in what is identified; mass and geometry are right.
#[derive(Clone, Debug)]
pub struct PriorRobot {
    /// The file.
    pub file: RobotFile,
    /// Its numbers over the truth, in the order of [`IDENTIFIED`].
    pub off: [f64; NUMBERS],
}

impl PriorRobot {
    /// Draws how wrong each number is: by e^x, x Gaussian with the relative uncertainty that the file states.
    pub fn drawn(truth: &RobotFile, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x1de_a11);
        let mut file = truth.clone();
        let off = IDENTIFIED.map(|p| {
            let draw: f64 = StandardNormal.sample(&mut random);
            (draw * stated(truth, p)).exp()
        });
        let [r, k, j, bv, bvn, bw, cv, cvn, cw] = off;
        file.motor.resistance_ohm *= r;
        file.motor.emf_constant_v_s *= k;
        file.motor.torque_constant_nm_per_a *= k;
        file.body.inertia_kg_m2 *= j;
        file.friction.viscous_v_n_s_per_m *= bv;
        file.friction.viscous_vn_n_s_per_m *= bvn;
        file.friction.viscous_w_nm_s *= bw;
        file.friction.coulomb_v_n *= cv;
        file.friction.coulomb_vn_n *= cvn;
        file.friction.coulomb_w_nm *= cw;
        Self { file, off }
    }
}

/// The relative uncertainty, one sigma, that a file states of a number.
pub fn stated(file: &RobotFile, p: Nominal) -> f64 {
    file.relative_uncertainty(key_of(p).key).unwrap_or(0.0)
}

/// A number of a robot file, in its SI unit.
pub fn nominal_value(file: &RobotFile, p: Nominal) -> f64 {
    key_of(p).value(file)
}

fn key_of(p: Nominal) -> &'static NominalKey {
    NominalKey::alone(p).expect("every number has a key")
}

/// How a number is written; K_v goes along with K_t, and the two go by the latter.
pub const fn symbol(p: Nominal) -> &'static str {
    match p {
        Nominal::TorqueConstant => Nominal::KtOverKv.number().symbol,
        _ => p.number().symbol,
    }
}
