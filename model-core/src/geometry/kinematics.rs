//! # Kinematics: three or four wheels and one body
//!
//! ```text
//! v_j = cos α_j·v + sin α_j·vn + d_j·ω         (eq. 2 for three wheels, eq. 6 for four)
//! v⃗ = G·(v, vn, ω),   G_j = (cos α_j, sin α_j, d_j)
//! (v, vn, ω) = (GᵀG)⁻¹·Gᵀ·v⃗                   (eq. 3–5, eq. 7–9)
//! (F_v, F_vn, Γ) = Gᵀ·f⃗                       (eq. 13–15, eq. 18–20)
//! f⃗ = G·(GᵀG)⁻¹·(F_v, F_vn, Γ)                the smallest wheel forces that do it
//! n·v⃗ = 0,   nᵀ·G = 0                          what four wheels say twice
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | α_j | [`Wheel::drive_angle`] | rad | wheel j rolls along (cos α_j, sin α_j) of the body axes (v, vn) |
//! | d_j | [`Wheel::distance`] | m | from the centre to the line on which wheel j drives |
//! | r_j | [`Wheel::radius`] | m | wheel radius |
//! | v⃗ | `rim` | m/s | speed of every rim |
//! | f⃗ | `forces` | N | force of the floor on every rim, along its drive direction |
//! | n | [`Wheels::parity_vector`] | 1 | unit vector orthogonal to the columns of G |
//!
//! Wheel j stands at d_j·(cos(α_j − 90°), sin(α_j − 90°)). The paper's three wheels drive at 150°, 270°, 30°, its four at
//! 90°, 180°, 270°, 0°.
//!
//! Least squares is exact for three wheels and for any four rim speeds of a rigid motion; what four wheels measure beyond
//! a rigid motion is the parity n·v⃗, the part that no body velocity explains.
//!
//! Exactness: a drive angle that is the rounded value of a multiple of a quarter turn has the exact direction (0 and ±1),
//! so that the paper's four wheels couple no axes that they do not have.
//!
//! Neglects: slip, creep, the width of the rollers and the jumps of the contact point between them. Fails when: the wheels
//! leave a direction free ([`Wheels::is_regular`]); then every twist and every split of a force is zero.
//!
//! How to measure d: turn the robot ten times on the spot; d is r times the wheel's angle over the body's. α: push it
//! straight ahead and sideways and take the ratio of the wheel's angles.
//!
//! Source: Oliveira, Sousa, Moreira, Costa, ICINCO 2008, eq. 2–9, 13–15, 18–20.

use core::array;

use crate::geometry::frames::BodyTwist;
use crate::geometry::shafts::Rim;
use crate::number::linalg::{self, Mat3, Vec3};
use crate::number::scalar::Real;

/// Where a wheel sits, where it drives, and how large it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wheel<T = f32> {
    /// α, the direction in which the wheel drives the body, from v towards vn [rad]
    pub drive_angle: T,
    /// d, from the body's centre to the wheel's line of drive [m]
    pub distance: T,
    /// r, wheel radius [m]
    pub radius: T,
}

/// The wheels of a robot with N of them, ready to compute with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels<const N: usize, T = f32> {
    wheels: [Wheel<T>; N],
    /// G, row by row: (cos α_j, sin α_j, d_j) [1, 1, m]
    rows: [Vec3<T>; N],
    /// G·(GᵀG)⁻¹, row by row [1, 1, 1/m]
    pseudo_inverse: [Vec3<T>; N],
    /// n, unit length; of no meaning for three wheels [1]
    parity: [T; 4],
    regular: bool,
}

impl<T: Real> Wheel<T> {
    /// A wheel from a robot file: drive angle in degrees, distance [m], radius [m].
    ///
    /// Multiples of 90° drive exactly along an axis.
    pub fn from_degrees(drive_angle_deg: f64, distance: T, radius: T) -> Self {
        // α = (α°/90°)·π/2, rounded once where α° is a multiple of 90°
        let drive_angle = T::lit(drive_angle_deg / 90.0 * core::f64::consts::FRAC_PI_2);
        Self { drive_angle, distance, radius }
    }

    /// (cos α, sin α), the wheel's direction in the body axes (v, vn) [1].
    ///
    /// Exactly 0 and ±1 where α is the rounded value of a multiple of a quarter turn, within one turn either way.
    pub fn direction(self) -> [T; 2] {
        use core::f64::consts::FRAC_PI_2;
        let (zero, one) = (T::zero(), T::one());
        // one literal each, so that no f64 is left for the robot to convert
        let quarters = [
            (T::lit(-4.0 * FRAC_PI_2), [one, zero]),
            (T::lit(-3.0 * FRAC_PI_2), [zero, one]),
            (T::lit(-2.0 * FRAC_PI_2), [-one, zero]),
            (T::lit(-FRAC_PI_2), [zero, -one]),
            (zero, [one, zero]),
            (T::lit(FRAC_PI_2), [zero, one]),
            (T::lit(2.0 * FRAC_PI_2), [-one, zero]),
            (T::lit(3.0 * FRAC_PI_2), [zero, -one]),
            (T::lit(4.0 * FRAC_PI_2), [one, zero]),
        ];
        let (sin, cos) = self.drive_angle.sin_cos();
        for (quarter, [x, y]) in quarters {
            if self.drive_angle == quarter {
                // the derivative of what was computed, the value of the axis
                return [x + (cos - cos.value()), y + (sin - sin.value())];
            }
        }
        [cos, sin]
    }

    /// The wheel's row of G: (cos α, sin α, d) [1, 1, m].
    pub fn row(self) -> [T; 3] {
        let [cos, sin] = self.direction();
        [cos, sin, self.distance]
    }

    /// Where the wheel touches the floor, in the body axes (v, vn) [m].
    pub fn contact_point(self) -> (T, T) {
        let [cos, sin] = self.direction();
        // d·(cos(α − 90°), sin(α − 90°)) = d·(sin α, −cos α)
        (self.distance * sin, -(self.distance * cos))
    }

    /// The wheel's rim, which knows how its shaft's speed and torque act there.
    #[inline]
    pub fn rim(self) -> Rim<T> {
        Rim { radius: self.radius }
    }
}

impl<const N: usize, T: Real> Wheels<N, T> {
    /// The wheels in their order.
    ///
    /// Wheels that leave a direction free are taken too; ask [`Wheels::is_regular`] where parameters enter.
    pub fn new(wheels: [Wheel<T>; N]) -> Self {
        const { assert!(N == 3 || N == 4, "an omni robot here has three or four wheels") }
        let rows = wheels.map(Wheel::row);
        let mut gram = [[T::zero(); 3]; 3];
        for row in rows {
            linalg::accumulate_outer(&mut gram, T::one(), row);
        }
        let four: [Vec3<T>; 4] = array::from_fn(|j| rows.get(j).copied().unwrap_or_default());

        // det(GᵀG) = Σ n_j² against the product of its diagonal, which is the most it can be
        let spanned = linalg::minors(&four).into_iter().fold(T::zero(), |sum, n| sum + n * n);
        let most = gram[0][0] * gram[1][1] * gram[2][2];
        let regular = spanned > T::lit(1.0e-9) * most;

        // G·(GᵀG)⁻¹, whose rows are (GᵀG)⁻¹·G_j
        let inverse: Mat3<T> = if regular { linalg::inverse3(&gram) } else { Default::default() };
        let pseudo_inverse = rows.map(|row| linalg::mul_mat_vec(&inverse, row));
        Self { wheels, rows, pseudo_inverse, parity: linalg::left_null(&four), regular }
    }

    /// The same wheels with all radii and all distances multiplied by a factor [1].
    pub fn scaled(&self, radius: T, distance: T) -> Self {
        let [r, d] = [radius, distance];
        Self::new(self.wheels.map(|w| Wheel { radius: w.radius * r, distance: w.distance * d, ..w }))
    }

    /// The wheels that these were built from.
    #[inline]
    pub fn wheels(&self) -> &[Wheel<T>; N] {
        &self.wheels
    }

    /// G, row by row: (cos α_j, sin α_j, d_j) [1, 1, m].
    #[inline]
    pub fn rows(&self) -> &[[T; 3]; N] {
        &self.rows
    }

    /// True if the wheels fix all three directions: det(GᵀG) above 10⁻⁹ of the most that columns so long can span.
    #[inline]
    pub fn is_regular(&self) -> bool {
        self.regular
    }

    /// Where the wheels touch the floor, in the body axes (v, vn) [m].
    pub fn contact_points(&self) -> [(T, T); N] {
        self.wheels.map(Wheel::contact_point)
    }

    /// Speed of every rim [m/s] when the body moves (eq. 2, eq. 6).
    #[inline]
    pub fn rim_speeds(&self, twist: BodyTwist<T>) -> [T; N] {
        // v_j = cos α_j·v + sin α_j·vn + d_j·ω
        self.rows.map(|row| linalg::dot(row, twist.to_array()))
    }

    /// Speed of every wheel's shaft [rad/s] when the body moves.
    #[inline]
    pub fn wheel_speeds(&self, twist: BodyTwist<T>) -> [T; N] {
        let rim = self.rim_speeds(twist);
        array::from_fn(|j| self.wheels[j].rim().wheel_speed(rim[j]))
    }

    /// The body velocity that comes nearest to these rim speeds [m/s] (eq. 3–5, eq. 7–9).
    #[inline]
    pub fn twist(&self, rim: [T; N]) -> BodyTwist<T> {
        // (v, vn, ω) = Σ_j (GᵀG)⁻¹·G_j·v_j
        let mut sum = [T::zero(); 3];
        for (share, speed) in self.pseudo_inverse.iter().zip(rim) {
            sum = linalg::add_scaled(sum, speed, *share);
        }
        BodyTwist::from_array(sum)
    }

    /// The body velocity that comes nearest to these speeds of the wheels' shafts [rad/s].
    #[inline]
    pub fn twist_of_wheel_speeds(&self, wheel_speeds: [T; N]) -> BodyTwist<T> {
        self.twist(array::from_fn(|j| self.wheels[j].rim().speed(wheel_speeds[j])))
    }

    /// What the rim forces [N] do to the body: (F_v, F_vn, Γ) [N, N, N·m] (eq. 13–15, eq. 18–20).
    #[inline]
    pub fn body_force(&self, forces: [T; N]) -> [T; 3] {
        // (F_v, F_vn, Γ) = Σ_j G_j·f_j
        let mut sum = [T::zero(); 3];
        for (row, force) in self.rows.iter().zip(forces) {
            sum = linalg::add_scaled(sum, force, *row);
        }
        sum
    }

    /// G·(GᵀG)⁻¹, row by row: rim force of least sum of squares over body force [1, 1, 1/m].
    #[inline]
    pub fn force_shares(&self) -> [[T; 3]; N] {
        self.pseudo_inverse
    }

    /// The rim forces [N] of least sum of squares that together do (F_v, F_vn, Γ) [N, N, N·m] to the body.
    #[inline]
    pub fn wheel_forces(&self, body_force: [T; 3]) -> [T; N] {
        // f_j = ((GᵀG)⁻¹·G_j)·(F_v, F_vn, Γ)
        self.pseudo_inverse.map(|share| linalg::dot(share, body_force))
    }
}

impl<T: Real> Wheels<4, T> {
    /// n, the one combination of rim speeds that no body velocity produces: unit length, nᵀ·G = 0 [1].
    ///
    /// For the paper's layout ½·(1, −1, 1, −1).
    #[inline]
    pub fn parity_vector(&self) -> [T; 4] {
        self.parity
    }

    /// How far four rim speeds [m/s] are from any rigid motion, with sign [m/s]; 0 where nothing slips.
    ///
    /// For the paper's layout ½·(v₀ − v₁ + v₂ − v₃).
    #[inline]
    pub fn parity(&self, rim: [T; 4]) -> T {
        // n·v⃗
        let [n, v] = [self.parity, rim];
        n[0] * v[0] + n[1] * v[1] + n[2] * v[2] + n[3] * v[3]
    }
}

#[cfg(test)]
mod tests;
