//! Which shifts are tried, and on how many windows of a run.

/// Shifts are tried this far apart [s], to this far on either side [s], and over no more than this share of a run [1].
const APART_S: f64 = 0.04;
const FARTHEST_S: f64 = 2.0;
const SHARE: f64 = 0.25;

/// Windows of a run that are looked at, and the fewest that tell anything.
pub(super) const MOST_WINDOWS: usize = 1000;
pub(super) const FEWEST_WINDOWS: usize = 40;

/// Shifts, by how much the signal that follows is later [s], and the share of it that each leaves unexplained [1].
pub(super) type LeftByShift = Vec<(f64, f64)>;

/// The shifts that are tried in a run of this length [s].
pub(super) fn shifts(duration_s: f64) -> Vec<f64> {
    let farthest = FARTHEST_S.min(SHARE * duration_s);
    let steps = (farthest / APART_S) as i32;
    (-steps..=steps).map(|k| f64::from(k) * APART_S).collect()
}
