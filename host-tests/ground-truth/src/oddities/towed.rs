//! A weight on a string that the robot drags behind it.
//!
//! ```text
//! T = min(k·max(d − l, 0), F)        towards the weight; it gives way as far as T would be more
//! ```
//!
//! Within the string's length it lies still and does nothing; a robot that turns round crosses twice that before it pulls
//! again.

use nalgebra::Vector2;

/// A weight that lies on the floor behind the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Towed {
    /// Where the string is tied, from the robot's centre along (v, vn) [m]; there the weight lies at first
    pub hitch: Vector2<f64>,
    /// l [m]
    pub length: f64,
    /// F, the weight's friction on the floor [N]
    pub friction: f64,
    /// k, of the string [N/m]
    pub stiffness: f64,
}

impl Towed {
    /// Where the weight is [m] once the hitch has come to a place in the world [m].
    pub fn dragged(&self, weight: Vector2<f64>, hitch: Vector2<f64>) -> Vector2<f64> {
        let (away, reach) = (hitch - weight, self.length + self.friction / self.stiffness);
        let distance = away.norm();
        if distance > reach { hitch - reach / distance * away } else { weight }
    }

    /// The force on the hitch [N], both places in the world [m].
    pub fn pull(&self, weight: Vector2<f64>, hitch: Vector2<f64>) -> Vector2<f64> {
        let away = hitch - self.dragged(weight, hitch);
        let distance = away.norm();
        if distance > self.length {
            -self.stiffness * (distance - self.length) / distance * away
        } else {
            Vector2::zeros()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOWED: Towed = Towed { hitch: Vector2::new(0.0, 0.0), length: 0.3, friction: 0.6, stiffness: 6e6 };

    #[test]
    fn the_weight_of_a_hitch_that_goes_straight_runs_along_a_tractrix() {
        let mut weight = Vector2::new(0.0, 0.3);
        let steps = 40_000;
        for k in 1..=steps {
            weight = TOWED.dragged(weight, Vector2::new(0.5 * f64::from(k) / f64::from(steps), 0.0));
        }
        // y = l/cosh(s/l), x = s − l·tanh(s/l), s what the hitch went
        let (grown, shrunk) = (libm::exp(0.5 / 0.3), libm::exp(-0.5 / 0.3));
        let expected = Vector2::new(0.5 - 0.3 * (grown - shrunk) / (grown + shrunk), 0.6 / (grown + shrunk));
        assert!((weight - expected).norm() < 1e-5, "{weight} against {expected}");
    }

    #[test]
    fn it_pulls_with_its_friction_and_not_at_all_on_the_way_back() {
        let soft = Towed { stiffness: 200.0, ..TOWED };
        let hitch = Vector2::new(0.9, 0.0);
        let weight = soft.dragged(Vector2::zeros(), hitch);
        assert!((soft.pull(Vector2::zeros(), hitch) + Vector2::new(0.6, 0.0)).norm() < 1e-12);
        for back in [0.004, 0.3, 0.59] {
            assert_eq!(soft.pull(weight, hitch - Vector2::new(back, 0.0)), Vector2::zeros(), "{back}");
        }
        // l + F/k on the one side, as much on the other
        assert!((soft.pull(weight, hitch - Vector2::new(0.606, 0.0)) - Vector2::new(0.6, 0.0)).norm() < 1e-9);
    }

    #[test]
    fn round_a_closed_way_it_only_takes_energy() {
        let soft = Towed { stiffness: 200.0, ..TOWED };
        let (mut weight, mut hitch) = (Vector2::zeros(), Vector2::zeros());
        let strained = |weight, hitch| 0.5 * soft.pull(weight, hitch).norm_squared() / soft.stiffness;
        let mut all = 0.0;
        for k in 1..=20_000 {
            let (sin, cos) = libm::sincos(1e-3 * f64::from(k));
            let next = Vector2::new(0.7 * sin, 0.4 * (1.0 - cos));
            let taken = -0.5 * (soft.pull(weight, hitch) + soft.pull(weight, next)).dot(&(next - hitch));
            let dragged = soft.dragged(weight, next);
            let lost = taken - (strained(dragged, next) - strained(weight, hitch));
            // the mean of two forces stands for all between them
            assert!(lost >= -1e-6, "{lost} J are given at {k}");
            all += lost;
            (weight, hitch) = (dragged, next);
        }
        assert!(all > 1.0, "{all} J");
    }
}
