//! # A, B and K, twice
//!
//! ```text
//! dx/dt = A·x + B·u + K·sign(x),   x = [v vn ω]        (eq. 30)
//! ```
//!
//! *Printed*: the closed forms of eq. 31–37, entry by entry. *Derived*: the same from virtual work, for any geometry.
//! With the rim speeds vⱼ = (G·x)ⱼ, a force fⱼ at each rim acts on the body as Gᵀ·f, so
//!
//! ```text
//! A = −m⁻¹·(Gᵀ·diag(l²·Kt·Kv/(r²·R))·G + diag(Bv, Bvn, Bω))
//! B =  m⁻¹·Gᵀ·diag(l·Kt/(r·R))
//! K = −m⁻¹·diag(Cv, Cvn, Cω),                            m = diag(M, M, J)
//! ```

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::generic_robot::{Drivetrain, GenericRobot, Wheel};
use crate::paper::PaperRobot;

/// The state space of eq. 30, with what eq. 2 or 6 and 21–22 need beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices<const N: usize> {
    /// A [1/s; where it joins ω to v and vn, m/s in ω's column, 1/(m·s) in ω's row]
    pub a: Matrix3<f64>,
    /// B [(m/s²)/V in the rows of v and vn, (rad/s²)/V in the row of ω]
    pub b: SMatrix<f64, 3, N>,
    /// Diagonal of K [m/s², m/s², rad/s²]
    pub k: Vector3<f64>,
    /// Rim speeds of x: vⱼ = (rim·x)ⱼ [m/s from m/s, m/s, rad/s]
    pub rim: SMatrix<f64, N, 3>,
    /// Diagonal of m: M, M, J [kg, kg, kg·m²]
    pub inertia: Vector3<f64>,
    /// Motor, gear and wheel of every corner.
    pub drivetrains: [Drivetrain; N],
}

/// K = diag(−Cv/M, −Cvn/M, −Cω/J) (eq. 34 and 37), its diagonal [m/s², m/s², rad/s²].
fn coulomb_diagonal(p: &PaperRobot) -> Vector3<f64> {
    let [cv, cvn, cw] = p.coulomb;
    Vector3::new(-cv / p.mass, -cvn / p.mass, -cw / p.inertia)
}

/// Eq. 33 as the paper prints it [(m/s²)/V, (m/s²)/V, (rad/s²)/V], its sign error included.
pub fn eq33_as_printed(p: &PaperRobot) -> Matrix3<f64> {
    let (m, j) = (p.mass, p.inertia);
    let (sin60, cos60) = (3.0_f64.sqrt() / 2.0, 0.5);
    // B = l·Kt/(r·R) · ⎡−sin(π/3)/M   0    sin(π/3)/M⎤
    //                  ⎢ cos(π/3)/M  1/M   cos(π/3)/M⎥
    //                  ⎣     d/J     d/J       d/J   ⎦
    Matrix3::new(-sin60 / m, 0.0, sin60 / m, cos60 / m, 1.0 / m, cos60 / m, p.d / j, p.d / j, p.d / j)
        * (p.l * p.kt / (p.r * p.resistance))
}

impl Matrices<3> {
    /// Three wheels, from the printed forms: eq. 2 and 32–34.
    pub fn printed(p: &PaperRobot) -> Self {
        let PaperRobot { d, r, l, kt, resistance, mass: m, inertia: j, .. } = *p;
        let [bv, bvn, bw] = p.viscous;
        // The closed forms are printed with Kt², for Kt = Kv.
        let kt2_l2 = kt.powi(2) * l.powi(2);
        let a = Matrix3::from_diagonal(&Vector3::new(
            // A11 = −3·Kt²·l²/(2·r²·R·M) − Bv/M                                        (eq. 32)
            -3.0 * kt2_l2 / (2.0 * r.powi(2) * resistance * m) - bv / m,
            // A22 = −3·Kt²·l²/(2·r²·R·M) − Bvn/M
            -3.0 * kt2_l2 / (2.0 * r.powi(2) * resistance * m) - bvn / m,
            // A33 = −3·d²·Kt²·l²/(r²·R·J) − Bω/J
            -3.0 * d.powi(2) * kt2_l2 / (r.powi(2) * resistance * j) - bw / j,
        ));
        let mut b = eq33_as_printed(p);
        // ERRATUM. Eq. 33 prints +1/M in the row of vn, column of wheel 1. Eq. 14 has that wheel push along −vn
        // (ΣFvn = −f1 + (f0 + f2)·cos(π/3)), and so does eq. 2 (v1 = −vn + d·ω): the sign is mended here.
        b[(1, 1)] = -b[(1, 1)];
        let (sin60, cos60) = (3.0_f64.sqrt() / 2.0, 0.5);
        // v0 = −sin(π/3)·v + cos(π/3)·vn + d·ω,  v1 = −vn + d·ω,  v2 = sin(π/3)·v + cos(π/3)·vn + d·ω     (eq. 2)
        let rim = Matrix3::new(-sin60, cos60, d, 0.0, -1.0, d, sin60, cos60, d);
        Self { a, b, k: coulomb_diagonal(p), rim, inertia: Vector3::new(m, m, j), drivetrains: [p.drivetrain(); 3] }
    }
}

impl Matrices<4> {
    /// Four wheels, from the printed forms: eq. 6 and 35–37.
    pub fn printed(p: &PaperRobot) -> Self {
        let PaperRobot { d, r, l, kt, resistance, mass: m, inertia: j, .. } = *p;
        let [bv, bvn, bw] = p.viscous;
        let kt2_l2 = kt.powi(2) * l.powi(2);
        let a = Matrix3::from_diagonal(&Vector3::new(
            // A11 = −2·Kt²·l²/(r²·R·M) − Bv/M                                          (eq. 35)
            -2.0 * kt2_l2 / (r.powi(2) * resistance * m) - bv / m,
            // A22 = −2·Kt²·l²/(r²·R·M) − Bvn/M
            -2.0 * kt2_l2 / (r.powi(2) * resistance * m) - bvn / m,
            // A33 = −4·d²·Kt²·l²/(r²·R·J) − Bω/J
            -4.0 * d.powi(2) * kt2_l2 / (r.powi(2) * resistance * j) - bw / j,
        ));
        // B = l·Kt/(r·R) · ⎡ 0   −1/M    0    1/M⎤                                      (eq. 36)
        //                  ⎢1/M    0   −1/M    0 ⎥
        //                  ⎣d/J   d/J   d/J   d/J⎦
        let b = SMatrix::<f64, 3, 4>::from_row_slice(
            &[[0.0, -1.0 / m, 0.0, 1.0 / m], [1.0 / m, 0.0, -1.0 / m, 0.0], [d / j; 4]].concat(),
        ) * (l * kt / (r * resistance));
        // v0 = vn + d·ω,  v1 = −v + d·ω,  v2 = −vn + d·ω,  v3 = v + d·ω                 (eq. 6)
        let rim = SMatrix::<f64, 4, 3>::from_row_slice(&[0.0, 1.0, d, -1.0, 0.0, d, 0.0, -1.0, d, 1.0, 0.0, d]);
        Self { a, b, k: coulomb_diagonal(p), rim, inertia: Vector3::new(m, m, j), drivetrains: [p.drivetrain(); 4] }
    }
}

impl<const N: usize> Matrices<N> {
    /// Any geometry, any mix of drives, from virtual work (the page above).
    pub fn derived(rig: &GenericRobot<N>) -> Self {
        // vⱼ = cos αⱼ·v + sin αⱼ·vn + dⱼ·ω
        let g = SMatrix::<f64, N, 3>::from_fn(|j, axis| {
            let Wheel { heading, distance, .. } = rig.wheels[j];
            [heading.cos(), heading.sin(), distance][axis]
        });
        let drives = rig.wheels.map(|wheel| wheel.drivetrain);
        let inertia = Vector3::new(rig.mass, rig.mass, rig.inertia);
        let m_inv = Matrix3::from_diagonal(&inertia.map(f64::recip));
        // fⱼ = l·Kt·iⱼ/r, iⱼ = (uⱼ − Kv·l·vⱼ/r)/R: volts push with l·Kt/(r·R), speed brakes with l²·Kt·Kv/(r²·R)
        let push = SVector::from(drives.map(|p| p.gear * p.kt / (p.radius * p.resistance)));
        let brake = SVector::from(drives.map(|p| p.gear.powi(2) * p.kt * p.kv / (p.radius.powi(2) * p.resistance)));
        let viscous = Matrix3::from_diagonal(&Vector3::from(rig.viscous));
        Self {
            a: -m_inv * (g.transpose() * SMatrix::<f64, N, N>::from_diagonal(&brake) * g + viscous),
            b: m_inv * g.transpose() * SMatrix::<f64, N, N>::from_diagonal(&push),
            k: -m_inv * Vector3::from(rig.coulomb),
            rim: g,
            inertia,
            drivetrains: drives,
        }
    }
}
