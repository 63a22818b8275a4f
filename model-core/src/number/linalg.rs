//! # Linear algebra: three-vectors, 3×3 matrices, and the rows of four wheels
//!
//! ```text
//! aᵀb = a₀·b₀ + a₁·b₁ + a₂·b₂
//! a × b = (a₁·b₂ − a₂·b₁,  a₂·b₀ − a₀·b₂,  a₀·b₁ − a₁·b₀)
//! det m = m₀·(m₁ × m₂)                      m₀, m₁, m₂ the rows
//! m⁻¹ = (m₁ × m₂ | m₂ × m₀ | m₀ × m₁)/det m   these are its columns
//! ```
//!
//! A vector is `[T; 3]`, a matrix the array of its rows. Units are the caller's: a function here takes and gives whatever
//! the equation it serves is written in. Closed forms only, no pivoting: the matrices of a robot are well conditioned once
//! they pass the door.
//!
//! Finite in, finite out: a matrix without an inverse has the zero matrix as its inverse here, and four rows that fix no
//! direction have the zero vector as their null vector. What that means is the caller's to say.
//!
//! Source: any text on linear algebra; Cramer's rule.

use crate::number::scalar::Real;

/// A column or a row of three numbers; the caller's unit.
pub type Vec3<T> = [T; 3];
/// Three rows of three numbers; the caller's unit.
pub type Mat3<T> = [[T; 3]; 3];

/// aᵀb; the unit of a times that of b.
#[inline(always)]
pub fn dot<T: Real>(a: Vec3<T>, b: Vec3<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a + k·b; the unit of a.
#[inline]
pub fn add_scaled<T: Real>(a: Vec3<T>, k: T, b: Vec3<T>) -> Vec3<T> {
    [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]]
}

/// k·a; the unit of k times that of a.
#[inline]
pub fn scaled<T: Real>(k: T, a: Vec3<T>) -> Vec3<T> {
    [k * a[0], k * a[1], k * a[2]]
}

/// a × b; the unit of a times that of b.
#[inline]
pub fn cross<T: Real>(a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// m·a; the unit of m times that of a.
#[inline]
pub fn mul_mat_vec<T: Real>(m: &Mat3<T>, a: Vec3<T>) -> Vec3<T> {
    [dot(m[0], a), dot(m[1], a), dot(m[2], a)]
}

/// m += k·row·rowᵀ, to build up a symmetric matrix; the unit of m.
#[inline]
pub fn accumulate_outer<T: Real>(m: &mut Mat3<T>, k: T, row: Vec3<T>) {
    // m_ij += k·row_i·row_j
    let factor = scaled(k, row);
    for i in 0..3 {
        m[i][i] += factor[i] * row[i];
        for j in i + 1..3 {
            let both = factor[i] * row[j];
            m[i][j] += both;
            m[j][i] += both;
        }
    }
}

/// The same on and above the diagonal; [`mirror`] does the rest once everything is in.
#[inline]
pub fn accumulate_upper<T: Real>(m: &mut Mat3<T>, k: T, row: Vec3<T>) {
    // m_ij += k·row_i·row_j
    let factor = scaled(k, row);
    for i in 0..3 {
        for j in i..3 {
            m[i][j] += factor[i] * row[j];
        }
    }
}

/// What stands above the diagonal, below it too.
#[inline]
pub fn mirror<T: Real>(m: &mut Mat3<T>) {
    (m[1][0], m[2][0], m[2][1]) = (m[0][1], m[0][2], m[1][2]);
}

/// det m; the unit of m to the third.
#[inline]
pub fn determinant3<T: Real>(m: &Mat3<T>) -> T {
    dot(m[0], cross(m[1], m[2]))
}

/// m⁻¹ by cofactors; the zero matrix where det m is zero or so small that 1/det m is not finite.
#[inline]
pub fn inverse3<T: Real>(m: &Mat3<T>) -> Mat3<T> {
    let [a, b, c] = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
    let over_det = reciprocal_or_zero(dot(m[0], a));
    // m⁻¹ = (m₁ × m₂ | m₂ × m₀ | m₀ × m₁)/det m
    let row = |i: usize| scaled(over_det, [a[i], b[i], c[i]]);
    [row(0), row(1), row(2)]
}

/// The a with m·a = b, by cofactors; the zero vector where m has no inverse (see [`inverse3`]).
#[inline]
pub fn solve3<T: Real>(m: &Mat3<T>, b: Vec3<T>) -> Vec3<T> {
    let first = cross(m[1], m[2]);
    let over_det = reciprocal_or_zero(dot(m[0], first));
    // a = (b₀·(m₁ × m₂) + b₁·(m₂ × m₀) + b₂·(m₀ × m₁))/det m
    let sum = add_scaled(add_scaled(scaled(b[0], first), b[1], cross(m[2], m[0])), b[2], cross(m[0], m[1]));
    scaled(over_det, sum)
}

/// 1/x, or zero where that is not finite.
#[inline]
fn reciprocal_or_zero<T: Real>(x: T) -> T {
    let reciprocal = T::one() / x;
    if reciprocal.value().is_finite() { reciprocal } else { T::zero() }
}

/// The four 3×3 determinants of four rows, each with one row left out, signs in turn: nᵀ·rows = 0.
///
/// Their squares sum to det(rowsᵀ·rows) (Cauchy and Binet). With one row zero, all but the determinant of the other three
/// vanish. The unit of a row to the third.
#[inline]
pub fn minors<T: Real>(rows: &[[T; 3]; 4]) -> [T; 4] {
    let [a, b, c, d] = *rows;
    let mut minors = [T::zero(); 4];
    for (minor, (sign, rest)) in minors.iter_mut().zip([
        (T::one(), [b, c, d]),
        (-T::one(), [a, c, d]),
        (T::one(), [a, b, d]),
        (-T::one(), [a, b, c]),
    ]) {
        // n_j = (−1)ʲ·det(rows without row j)
        *minor = sign * determinant3(&rest);
    }
    minors
}

/// The left null vector of four rows: nᵀ·rows = 0, |n| = 1; no unit. The zero vector where the rows have rank below 3.
///
/// Its sign: the first entry that is at least half as large as the largest one is positive.
#[inline]
pub fn left_null<T: Real>(rows: &[[T; 3]; 4]) -> [T; 4] {
    let n = minors(rows);
    let largest = n[0].abs().max(n[1].abs()).max(n[2].abs()).max(n[3].abs());
    // scaled to largest entry 1 before squaring, so that no square vanishes or overflows
    let n = n.map(|x| x * reciprocal_or_zero(largest));
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3]).sqrt();
    let half = T::lit(0.5);
    let leading = n.into_iter().find(|x| x.abs() >= half).unwrap_or(T::zero());
    // n/|n|, turned to the positive side
    let factor = reciprocal_or_zero(length) * leading.sign();
    n.map(|x| factor * x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::dual::Dual;

    const M: Mat3<f64> = [[2.0, -1.0, 0.5], [0.3, 1.5, -0.7], [-1.2, 0.4, 3.0]];
    const ROWS: [[f64; 3]; 4] = [[1.0, 0.2, 0.1], [-0.5, 0.9, 0.2], [-0.3, -1.1, 0.3], [0.8, -0.4, 0.15]];

    /// Tolerance: a few dozen roundings of numbers below 10.
    const CLOSE: f64 = 1.0e-14;

    #[test]
    fn products_are_those_of_a_hand_case() {
        assert_eq!(dot([1.0, 2.0, 3.0], [4.0, -5.0, 6.0]), 12.0);
        assert_eq!(add_scaled([1.0, 2.0, 3.0], 2.0, [4.0, -5.0, 6.0]), [9.0, -8.0, 15.0]);
        assert_eq!(cross([1.0, 2.0, 3.0], [4.0, -5.0, 6.0]), [27.0, 6.0, -13.0]);
        assert_eq!(
            mul_mat_vec(&[[1.0, 2.0, 3.0], [0.0, 1.0, 0.0], [4.0, 0.0, 0.0]], [1.0, 2.0, 3.0]),
            [14.0, 2.0, 4.0]
        );
        assert_eq!(determinant3(&[[2.0, 0.0, 1.0], [0.0, 3.0, 0.0], [1.0, 0.0, 4.0]]), 21.0);
    }

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let inverse = inverse3(&M);
        for unit in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let (right, left) =
                (mul_mat_vec(&M, mul_mat_vec(&inverse, unit)), mul_mat_vec(&inverse, mul_mat_vec(&M, unit)));
            for i in 0..3 {
                assert!((right[i] - unit[i]).abs() < CLOSE && (left[i] - unit[i]).abs() < CLOSE, "{right:?}, {left:?}");
            }
        }
    }

    #[test]
    fn the_solution_solves_and_is_that_of_the_inverse() {
        let b = [0.7, -2.0, 1.1];
        let a = solve3(&M, b);
        let (back, by_inverse) = (mul_mat_vec(&M, a), mul_mat_vec(&inverse3(&M), b));
        for i in 0..3 {
            assert!((back[i] - b[i]).abs() < CLOSE && (a[i] - by_inverse[i]).abs() < CLOSE);
        }
    }

    #[test]
    fn the_solution_carries_its_derivative() {
        // m·a = b, so ∂a/∂m₀₀ = −m⁻¹·e₀·a₀
        let mut m = M.map(|row| row.map(Dual::<1>::constant));
        m[0][0] = Dual::variable(M[0][0], 0);
        let a = solve3(&m, [0.7, -2.0, 1.1].map(Dual::constant));
        let inverse = inverse3(&M);
        for i in 0..3 {
            assert!((a[i].eps[0] + inverse[i][0] * a[0].re).abs() < CLOSE);
        }
    }

    #[test]
    fn a_matrix_without_inverse_gives_zeros() {
        for m in [[[0.0; 3]; 3], [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 0.0]], [[1.0e-110; 3]; 3]] {
            assert_eq!(inverse3(&m), [[0.0; 3]; 3]);
            assert_eq!(solve3(&m, [1.0, 2.0, 3.0]), [0.0; 3]);
        }
        assert_eq!(inverse3(&[[1.0e-20_f32, 0.0, 0.0], [0.0, 1.0e-20, 0.0], [0.0, 0.0, 1.0]]), [[0.0; 3]; 3]);
    }

    #[test]
    fn outer_products_add_up_to_rows_transposed_times_rows() {
        let mut m = [[0.0; 3]; 3];
        for row in ROWS {
            accumulate_outer(&mut m, 2.0, row);
        }
        for i in 0..3 {
            for j in 0..3 {
                let want: f64 = ROWS.iter().map(|row| 2.0 * row[i] * row[j]).sum();
                assert!((m[i][j] - want).abs() < CLOSE);
            }
        }
    }

    #[test]
    fn the_squares_of_the_minors_sum_to_the_determinant_of_the_product() {
        let mut m = [[0.0; 3]; 3];
        for row in ROWS {
            accumulate_outer(&mut m, 1.0, row);
        }
        let sum: f64 = minors(&ROWS).iter().map(|n| n * n).sum();
        assert!((sum - determinant3(&m)).abs() < CLOSE);
    }

    #[test]
    fn the_left_null_vector_is_orthogonal_to_every_column_and_of_length_one() {
        let n = left_null(&ROWS);
        let products = n.iter().zip(ROWS).fold([0.0; 3], |sum, (n, row)| add_scaled(sum, *n, row));
        assert!(products.iter().all(|p| p.abs() < CLOSE), "{products:?}");
        assert!((n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < CLOSE);
        let largest = n.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(*n.iter().find(|x| x.abs() >= 0.5 * largest).unwrap() > 0.0);
    }

    #[test]
    fn the_sign_of_the_null_vector_does_not_depend_on_that_of_the_rows() {
        let turned = ROWS.map(|row| scaled(-1.0, row));
        assert_eq!(left_null(&ROWS), left_null(&turned));
    }

    #[test]
    fn rows_that_fix_no_direction_have_no_null_vector() {
        assert_eq!(left_null(&[[1.0, 2.0, 3.0]; 4]), [0.0; 4]);
        assert_eq!(left_null(&[[0.0_f32; 3]; 4]), [0.0; 4]);
    }
}
