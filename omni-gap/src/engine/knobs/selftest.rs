//! The thresholds of a self-test.

use super::Knobs;

/// How a self-test looks at causes.
#[derive(Clone, Debug, PartialEq)]
pub struct SelftestKnobs {
    /// The engine whose findings are foretold.
    pub engine: Knobs,
    /// A nominal number is looked at when it is wrong by this much [1]: what a fit takes for a straight line.
    pub wrong: f64,
    /// A rival may turn its shapes too: the share of a shape's typical value by which it is moved to see what that does [1].
    pub shape_moved: f64,
    /// A signature of which the nominal numbers imitate this share is looked at once more, with the numbers moved there [1]:
    /// a straight line leaves the square of their move, which is little of a share that is not the whole.
    pub look_twice: f64,
    /// A number that moves less than this share of the one that moves most is not said to imitate [1].
    pub hardly_moved: f64,
    /// Two causes at this angle, or nearer, are the same to the recordings [rad]: signatures are rounded and their starts are
    /// noisy.
    pub same_angle_rad: f64,
    /// Share by which a rival's own products are raised so that their equations can be solved [1].
    pub regular: f64,
    /// How near a size has to come to what is looked for, as a ratio of what it does [1].
    pub near: f64,
    /// The least multiple of the typical size that is looked at [1]: what is seen there is said to be seen from there on.
    pub least_times: f64,
    /// Sizes that are tried for it.
    pub tries: usize,
    /// The most by which the first try changes the size, to learn which way it does more [1].
    pub first_try: f64,
    /// The most by which a later one does [1].
    pub most_a_try: f64,
    /// The least power of a size that is believed [1]: below it, two tries did much the same.
    pub least_power: f64,
    /// A signature of nothing counts as this [σ²], so that it has a logarithm.
    pub least_size: f64,
}

impl Default for SelftestKnobs {
    fn default() -> Self {
        Self {
            engine: Knobs::default(),
            wrong: 0.1,
            shape_moved: 0.2,
            look_twice: 0.5,
            hardly_moved: 0.1,
            same_angle_rad: 1e-3,
            regular: 1e-9,
            near: 1.1,
            least_times: 1e-3,
            tries: 12,
            first_try: 2.0,
            most_a_try: 8.0,
            least_power: 0.1,
            least_size: 1e-12,
        }
    }
}
