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

use crate::frames::BodyTwist;
use crate::scalar::Real;
use crate::shafts::Rim;
use crate::small::{self, Mat3, Vec3};

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
    shares: [Vec3<T>; N],
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
        const AXES: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let (sin, cos) = self.drive_angle.sin_cos();
        for quarter in -4_i8..=4 {
            if self.drive_angle == T::lit(f64::from(quarter) * core::f64::consts::FRAC_PI_2) {
                let [x, y] = AXES[usize::from(quarter.rem_euclid(4).unsigned_abs())].map(T::lit);
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
            small::accumulate_outer(&mut gram, T::one(), row);
        }
        let four: [Vec3<T>; 4] = array::from_fn(|j| rows.get(j).copied().unwrap_or_default());

        // det(GᵀG) = Σ n_j² against the product of its diagonal, which is the most it can be
        let spanned = small::minors(&four).into_iter().fold(T::zero(), |sum, n| sum + n * n);
        let most = gram[0][0] * gram[1][1] * gram[2][2];
        let regular = spanned > T::lit(1.0e-9) * most;

        // G·(GᵀG)⁻¹, whose rows are (GᵀG)⁻¹·G_j
        let inverse: Mat3<T> = if regular { small::inverse3(&gram) } else { Default::default() };
        let shares = rows.map(|row| small::mul_mat_vec(&inverse, row));
        Self { wheels, rows, shares, parity: small::left_null(&four), regular }
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
        self.rows.map(|row| small::dot(row, twist.to_array()))
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
        for (share, speed) in self.shares.iter().zip(rim) {
            sum = small::add_scaled(sum, speed, *share);
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
            sum = small::add_scaled(sum, force, *row);
        }
        sum
    }

    /// The rim forces [N] of least sum of squares that together do (F_v, F_vn, Γ) [N, N, N·m] to the body.
    #[inline]
    pub fn wheel_forces(&self, body_force: [T; 3]) -> [T; N] {
        // f_j = ((GᵀG)⁻¹·G_j)·(F_v, F_vn, Γ)
        self.shares.map(|share| small::dot(share, body_force))
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
mod tests {
    use super::*;
    use crate::dual::Dual;
    use core::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

    const D: f64 = 0.089;
    const R: f64 = 0.0325;

    /// Tolerance: a few dozen roundings of numbers about 1.
    const CLOSE: f64 = 1.0e-14;

    fn papers_three() -> Wheels<3, f64> {
        Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, D, R)))
    }

    fn papers_four() -> Wheels<4, f64> {
        Wheels::new([90.0, 180.0, 270.0, 0.0].map(|deg| Wheel::from_degrees(deg, D, R)))
    }

    /// A number in −1 ..= 1 that looks random, the same in every run.
    fn noise(seed: &mut u32) -> f64 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(*seed >> 8) / f64::from(1_u32 << 23) - 1.0
    }

    /// Wheels near the evenly spread ones, each off by up to 17°, 20 mm and 5 mm.
    fn irregular<const N: usize>(seed: &mut u32) -> Wheels<N, f64> {
        Wheels::new(array::from_fn(|j| Wheel {
            drive_angle: 2.0 * PI * j as f64 / N as f64 + 0.3 * noise(seed),
            distance: 0.1 + 0.02 * noise(seed),
            radius: 0.03 + 0.005 * noise(seed),
        }))
    }

    fn twist(seed: &mut u32) -> BodyTwist<f64> {
        BodyTwist { v: noise(seed), vn: noise(seed), w: 5.0 * noise(seed) }
    }

    fn assert_close<const M: usize>(got: [f64; M], want: [f64; M], within: f64) {
        for (g, w) in got.into_iter().zip(want) {
            assert!((g - w).abs() <= within, "{got:?} against {want:?}");
        }
    }

    #[test]
    fn three_rim_speeds_are_those_of_equation_2() {
        let BodyTwist { v, vn, w } = BodyTwist { v: 0.7, vn: -0.4, w: 1.3 };
        let (s, c) = (libm::sin(FRAC_PI_3), libm::cos(FRAC_PI_3));
        let want = [-s * v + c * vn + D * w, -vn + D * w, s * v + c * vn + D * w];
        assert_close(papers_three().rim_speeds(BodyTwist { v, vn, w }), want, CLOSE);
    }

    #[test]
    fn the_twist_of_three_rims_is_that_of_equations_3_to_5() {
        let [v0, v1, v2] = [0.31, -0.52, 0.87];
        // v = (√3/3)·(v₂ − v₀),  vn = (v₀ + v₂)/3 − 2·v₁/3,  ω = (v₀ + v₁ + v₂)/(3·d)
        let want = [libm::sqrt(3.0) / 3.0 * (v2 - v0), (v0 + v2) / 3.0 - 2.0 / 3.0 * v1, (v0 + v1 + v2) / (3.0 * D)];
        assert_close(papers_three().twist([v0, v1, v2]).to_array(), want, CLOSE);
    }

    #[test]
    fn four_rim_speeds_are_those_of_equation_6_to_the_last_bit() {
        let BodyTwist { v, vn, w } = BodyTwist { v: 0.7, vn: -0.4, w: 1.3 };
        let want = [vn + D * w, -v + D * w, -vn + D * w, v + D * w];
        assert_eq!(papers_four().rim_speeds(BodyTwist { v, vn, w }), want);
    }

    #[test]
    fn the_twist_of_four_rims_is_that_of_equations_7_to_9() {
        let [v0, v1, v2, v3] = [0.31, -0.52, 0.87, 0.11];
        // v = ½·(v₃ − v₁),  vn = ½·(v₀ − v₂),  ω = (v₀ + v₁ + v₂ + v₃)/(4·d)
        let want = [0.5 * (v3 - v1), 0.5 * (v0 - v2), (v0 + v1 + v2 + v3) / (4.0 * D)];
        assert_close(papers_four().twist([v0, v1, v2, v3]).to_array(), want, CLOSE);
    }

    #[test]
    fn three_forces_do_to_the_body_what_equations_13_to_15_say() {
        let [f0, f1, f2] = [1.1, -2.0, 0.6];
        // F_v = (f₂ − f₀)·sin 60°,  F_vn = −f₁ + (f₂ + f₀)·cos 60°,  Γ = (f₀ + f₁ + f₂)·d
        let (s, c) = (libm::sin(FRAC_PI_3), libm::cos(FRAC_PI_3));
        let want = [(f2 - f0) * s, -f1 + (f2 + f0) * c, (f0 + f1 + f2) * D];
        assert_close(papers_three().body_force([f0, f1, f2]), want, CLOSE);
    }

    #[test]
    fn four_forces_do_to_the_body_what_equations_18_to_20_say() {
        let [f0, f1, f2, f3] = [1.1, -2.0, 0.6, 0.3];
        // F_v = f₃ − f₁,  F_vn = f₀ − f₂,  Γ = (f₀ + f₁ + f₂ + f₃)·d
        let want = [f3 - f1, f0 - f2, (f0 + f1 + f2 + f3) * D];
        assert_close(papers_four().body_force([f0, f1, f2, f3]), want, CLOSE);
    }

    #[test]
    fn wheels_at_any_angles_give_back_the_motion_they_were_given() {
        fn check<const N: usize>(seed: &mut u32) {
            let (wheels, twist) = (irregular::<N>(seed), twist(seed));
            assert!(wheels.is_regular());
            // conditioning of GᵀG below 1000 in these geometries
            let within = 1000.0 * 4.0 * f64::EPSILON * 5.0;
            assert_close(wheels.twist(wheels.rim_speeds(twist)).to_array(), twist.to_array(), within);
            assert_close(wheels.twist_of_wheel_speeds(wheels.wheel_speeds(twist)).to_array(), twist.to_array(), within);
            let force = [noise(seed), noise(seed), 0.1 * noise(seed)];
            assert_close(wheels.body_force(wheels.wheel_forces(force)), force, within);
        }
        let mut seed = 1;
        for _ in 0..200 {
            check::<3>(&mut seed);
            check::<4>(&mut seed);
        }
    }

    #[test]
    fn the_power_of_the_forces_is_the_same_at_the_rims_and_at_the_body() {
        fn check<const N: usize>(seed: &mut u32) {
            let (wheels, twist) = (irregular::<N>(seed), twist(seed));
            let forces = array::from_fn(|_| noise(seed));
            let at_rims: f64 = wheels.rim_speeds(twist).iter().zip(forces).map(|(v, f)| v * f).sum();
            let at_body = small::dot(wheels.body_force(forces), twist.to_array());
            assert!((at_rims - at_body).abs() < CLOSE, "{at_rims} against {at_body}");
        }
        let mut seed = 2;
        for _ in 0..200 {
            check::<3>(&mut seed);
            check::<4>(&mut seed);
        }
    }

    #[test]
    fn the_split_of_a_force_is_the_smallest_that_does_it() {
        let mut seed = 3;
        let wheels = irregular::<4>(&mut seed);
        let forces = wheels.wheel_forces([1.0, -2.0, 0.1]);
        // whatever could be added without effect on the body lies along n, and the split has none of it
        let idle: f64 = forces.iter().zip(wheels.parity_vector()).map(|(f, n)| f * n).sum();
        assert!(idle.abs() < CLOSE, "{idle}");
    }

    #[test]
    fn a_rigid_motion_has_no_parity_and_the_rest_of_four_rims_is_all_parity() {
        let mut seed = 4;
        for _ in 0..200 {
            let (wheels, twist) = (irregular::<4>(&mut seed), twist(&mut seed));
            assert!(wheels.parity(wheels.rim_speeds(twist)).abs() < CLOSE);
            let rim: [f64; 4] = array::from_fn(|_| noise(&mut seed));
            let (fitted, n) = (wheels.rim_speeds(wheels.twist(rim)), wheels.parity_vector());
            let parity = wheels.parity(rim);
            assert_close(array::from_fn(|j| rim[j] - fitted[j]), n.map(|n| n * parity), 100.0 * CLOSE);
        }
    }

    #[test]
    fn the_papers_four_wheels_are_checked_by_their_alternating_sum() {
        let wheels = papers_four();
        assert_close(wheels.parity_vector(), [0.5, -0.5, 0.5, -0.5], f64::EPSILON);
        assert!((wheels.parity([0.4, 0.1, 0.2, -0.1]) - 0.3).abs() < CLOSE);
        assert_eq!(wheels.parity([0.25, -0.5, -0.25, 0.5]), 0.0);
    }

    #[test]
    fn a_multiple_of_a_quarter_turn_drives_exactly_along_an_axis() {
        fn check<T: Real>() {
            for (deg, x, y) in [(0.0, 1.0, 0.0), (90.0, 0.0, 1.0), (180.0, -1.0, 0.0), (270.0, 0.0, -1.0)] {
                for turn in [-360.0, 0.0] {
                    let [cos, sin] = Wheel::<T>::from_degrees(deg + turn, T::one(), T::one()).direction();
                    assert!(cos == T::lit(x) && sin == T::lit(y), "{deg}°: {cos:?}, {sin:?}");
                }
            }
        }
        check::<f32>();
        check::<f64>();
        check::<Dual<1>>();
    }

    #[test]
    fn an_exact_direction_still_has_its_derivative() {
        let wheel = Wheel { drive_angle: Dual::<1>::variable(FRAC_PI_2, 0), ..Wheel::default() };
        let [cos, sin] = wheel.direction();
        // ∂cos α/∂α = −1 and ∂sin α/∂α = 0 at a quarter turn
        assert!(cos.re == 0.0 && (cos.eps[0] + 1.0).abs() < CLOSE);
        assert!(sin.re == 1.0 && sin.eps[0].abs() < CLOSE);
    }

    #[test]
    fn a_wheel_stands_a_quarter_turn_behind_its_drive() {
        assert_eq!(papers_four().contact_points(), [(D, 0.0), (0.0, D), (-D, 0.0), (0.0, -D)]);
        for (wheel, (x, y)) in papers_three().wheels().iter().zip(papers_three().contact_points()) {
            let angle = wheel.drive_angle - FRAC_PI_2;
            assert_close([x, y], [D * libm::cos(angle), D * libm::sin(angle)], CLOSE);
        }
    }

    #[test]
    fn turning_on_the_spot_moves_every_contact_point_along_its_drive() {
        let mut seed = 5;
        let wheels = irregular::<4>(&mut seed);
        let rim = wheels.rim_speeds(BodyTwist { v: 0.0, vn: 0.0, w: 1.0 });
        for (j, (x, y)) in wheels.contact_points().into_iter().enumerate() {
            // ω × p = (−y, x), along (cos α, sin α)
            let [cos, sin] = wheels.wheels()[j].direction();
            assert!((rim[j] - (-y * cos + x * sin)).abs() < CLOSE);
        }
    }

    #[test]
    fn wheels_that_leave_a_direction_free_are_told_and_give_zeros() {
        let parallel = Wheels::new([0.3_f64; 4].map(|a| Wheel { drive_angle: a, distance: D, radius: R }));
        assert!(!parallel.is_regular());
        assert_eq!(parallel.twist([1.0; 4]).to_array(), [0.0; 3]);
        let central = Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, 0.0_f32, 0.03)));
        assert!(!central.is_regular());
        assert_eq!(central.wheel_forces([1.0; 3]), [0.0; 3]);
        let single =
            Wheels::new([0.3_f32, 0.3, 0.3, 1.9].map(|a| Wheel { drive_angle: a, distance: 0.1, radius: 0.03 }));
        assert!(!single.is_regular(), "two directions for three unknowns");
        assert!(papers_three().is_regular() && papers_four().is_regular());
    }

    #[test]
    fn single_precision_agrees_with_double() {
        let coarse = Wheels::new([150.0, 270.0, 30.0].map(|deg| Wheel::from_degrees(deg, D as f32, R as f32)));
        let rim = coarse.rim_speeds(BodyTwist { v: 0.7, vn: -0.4, w: 1.3 });
        let fine = papers_three().rim_speeds(BodyTwist { v: 0.7, vn: -0.4, w: 1.3 });
        // three roundings of numbers below 1
        assert_close(rim.map(f64::from), fine, 3.0e-7);
        let back = coarse.twist(rim);
        assert_close(back.to_array().map(f64::from), [0.7, -0.4, 1.3], 2.0e-6);
    }
}
