//! Support: what each wheel presses on the floor with.
//!
//! ```text
//! Σ N_j = M·g,  Σ N_j·p_j = −M·h·a        N_j = M·g·(1/n − p̄·S⁻¹·(p_j − p̄)) − M·h·a·S⁻¹·(p_j − p̄)
//! S = Σ (p_j − p̄)·(p_j − p̄)ᵀ
//! ```
//!
//! Weight and moments are in balance about the centre, which is that of mass. Three wheels have only these loads; of four
//! the balance leaves one open, and these are the loads of least squares, which are those of wheels on equal springs.
//! Wheels around the centre at equal angles carry the same. A centre of mass that sits elsewhere (`cog_offset`) is not looked
//! at here.

use crate::effects::seams::STANDARD_GRAVITY;
use crate::number::scalar::Real;

/// The least that a wheel carries, over the robot's weight [1]: a wheel pushes at the floor and never pulls.
const LEAST: f64 = 1e-6;

/// Wheels whose contacts stand on one line, to this share of their spread, carry the same [1]: no balance tells more.
const ON_A_LINE: f64 = 1e-9;

/// The feet on which a robot stands.
pub(super) struct Support<T> {
    /// 1/n [1]
    even: T,
    /// p̄, mean of the contacts from the centre [m]
    mean: [T; 2],
    /// S⁻¹: (v, v), (v, vn), (vn, vn) [1/m²]
    per_spread: [T; 3],
}

/// What a wheel carries.
pub(super) struct Share<T> {
    /// At rest, over the robot's weight [1]
    pub at_rest: T,
    /// By how much that changes, over itself, with the acceleration along (v, vn) and the height of the centre of mass
    /// [1/(m·m/s²)]
    pub shift: [T; 2],
}

impl<T: Real> Support<T> {
    /// Of contacts at these places from the centre, in body axes (v, vn) [m].
    pub fn of<const N: usize>(places: &[[T; 2]; N]) -> Self {
        let zero = T::zero();
        let even = T::one() / T::lit(N as f64);
        let sum = places.iter().fold([zero; 2], |sum, p| [sum[0] + p[0], sum[1] + p[1]]);
        let mean = sum.map(|sum| sum * even);
        let [mut xx, mut xy, mut yy] = [zero; 3];
        for p in places {
            let [x, y] = [p[0] - mean[0], p[1] - mean[1]];
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        let (determinant, size) = (xx * yy - xy * xy, xx + yy);
        let per_spread = if determinant > T::lit(ON_A_LINE) * size * size {
            [yy / determinant, -(xy / determinant), xx / determinant]
        } else {
            [zero; 3]
        };
        Self { even, mean, per_spread }
    }

    /// What a wheel at this place carries.
    pub fn share(&self, place: [T; 2]) -> Share<T> {
        let [xx, xy, yy] = self.per_spread;
        let [x, y] = [place[0] - self.mean[0], place[1] - self.mean[1]];
        // S⁻¹·(p_j − p̄)
        let lever = [xx * x + xy * y, xy * x + yy * y];
        // s_j = 1/n − p̄·S⁻¹·(p_j − p̄)
        let at_rest = (self.even - (self.mean[0] * lever[0] + self.mean[1] * lever[1])).max(T::lit(LEAST));
        // ΔN_j/N_j = −h·a·S⁻¹·(p_j − p̄)/(g·s_j)
        let per_share = T::one() / (T::lit(STANDARD_GRAVITY) * at_rest);
        Share { at_rest, shift: lever.map(|lever| -(lever * per_share)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contacts at these angles [°] and distances [m] from the centre.
    fn places<const N: usize>(feet: [(f64, f64); N]) -> [[f64; 2]; N] {
        feet.map(|(angle, distance)| [distance * angle.to_radians().cos(), distance * angle.to_radians().sin()])
    }

    /// Weight, moment at rest, and moment by an acceleration over −M·h: what statics says is 1, 0, a.
    fn balance<const N: usize>(places: [[f64; 2]; N], acceleration: [f64; 2]) -> (f64, [f64; 2], [f64; 2]) {
        let support = Support::of(&places);
        let (mut weight, mut at_rest, mut moved) = (0.0, [0.0; 2], [0.0; 2]);
        for place in places {
            let Share { at_rest: share, shift } = support.share(place);
            weight += share;
            let more = share * STANDARD_GRAVITY * (shift[0] * acceleration[0] + shift[1] * acceleration[1]);
            for axis in 0..2 {
                at_rest[axis] += share * place[axis];
                moved[axis] -= more * place[axis];
            }
        }
        (weight, at_rest, moved)
    }

    fn balances<const N: usize>(places: [[f64; 2]; N]) {
        let acceleration = [1.5, -0.8];
        let (weight, at_rest, moved) = balance(places, acceleration);
        assert!((weight - 1.0).abs() < 1e-12);
        for axis in 0..2 {
            assert!(at_rest[axis].abs() < 1e-12 && (moved[axis] - acceleration[axis]).abs() < 1e-12);
        }
    }

    #[test]
    fn weight_and_moments_balance_for_any_feet() {
        balances(places([(60.0, 0.09), (180.0, 0.09), (300.0, 0.09)]));
        balances(places([(50.0, 0.11), (190.0, 0.07), (290.0, 0.1)]));
        balances(places([(-16.0, 0.1), (96.0, 0.1), (182.0, 0.12), (272.0, 0.1)]));
    }

    #[test]
    fn wheels_at_equal_angles_carry_the_same_and_shift_by_twice_their_lever() {
        let (distance, feet) = (0.09, places([(45.0, 0.09), (135.0, 0.09), (225.0, 0.09), (315.0, 0.09)]));
        let support = Support::of(&feet);
        for place in feet {
            let share = support.share(place);
            assert!((share.at_rest - 0.25).abs() < 1e-15);
            // −2·p/(g·d²)
            let wanted = place.map(|p| -2.0 * p / (STANDARD_GRAVITY * distance * distance));
            assert!((0..2).all(|axis| (share.shift[axis] - wanted[axis]).abs() < 1e-12));
        }
    }

    #[test]
    fn the_foot_below_the_centre_carries_all() {
        let feet = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]];
        let shares = feet.map(|place| Support::of(&feet).share(place).at_rest);
        assert!((shares[0] - 1.0).abs() < 1e-12 && shares[1..].iter().all(|share| *share <= LEAST + 1e-12));
    }

    #[test]
    fn feet_on_one_line_carry_the_same() {
        let feet = [[0.1, 0.0], [-0.05, 0.0], [-0.1, 0.0]];
        let shares = feet.map(|place| Support::of(&feet).share(place));
        assert!(shares.iter().all(|share| (share.at_rest - 1.0 / 3.0).abs() < 1e-15 && share.shift == [0.0, 0.0]));
    }
}
