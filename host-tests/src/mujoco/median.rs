//! What is typical of several turns, whatever a disturbed one says.

/// The middle one; of an even count, the upper of the two.
pub fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}
