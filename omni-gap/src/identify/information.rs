//! Information matrices.

use nalgebra::DMatrix;

/// The inverse of an information matrix; directions without information become very uncertain, not infinitely so.
pub(super) fn invert(information: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = information.clone().symmetric_eigen();
    let floor = 1e-12 * eigen.eigenvalues.max();
    let inverse = DMatrix::from_diagonal(&eigen.eigenvalues.map(|x| 1.0 / x.max(floor).max(f64::MIN_POSITIVE)));
    &eigen.eigenvectors * inverse * eigen.eigenvectors.transpose()
}
