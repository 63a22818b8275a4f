//! What lies on the floor along a line, and planks.
//!
//! ```text
//! h(s) = H·e^(−(s − s₀)²/(2·w²))                  a ridge: each wheel is pushed down its slope by N·h'
//! F = −F_p·ṡ/√(ṡ² + v₀²)                          planks: friction across their joints alone
//! ```
//!
//! s: the way across the line.

use nalgebra::Vector2;

/// A cable below a carpet, over which each wheel climbs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    /// Across it, of length 1, in the world
    pub across: Vector2<f64>,
    /// s₀ [m]
    pub at: f64,
    /// H [m]
    pub height: f64,
    /// w [m]
    pub width: f64,
}

impl Ridge {
    /// h at a place in the world [m].
    pub fn height_at(&self, place: Vector2<f64>) -> f64 {
        let part = (place.dot(&self.across) - self.at) / self.width;
        self.height * libm::exp(-0.5 * part * part)
    }

    /// What pushes a wheel there [N] that carries a weight [N].
    pub fn push(&self, place: Vector2<f64>, weight: f64) -> Vector2<f64> {
        let part = (place.dot(&self.across) - self.at) / self.width;
        // −N·dh/ds
        weight * part / self.width * self.height_at(place) * self.across
    }
}

/// A floor of planks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planks {
    /// Across them, of length 1, in the world
    pub across: Vector2<f64>,
    /// F_p [N]
    pub friction: f64,
    /// v₀ [m/s]
    pub onset_speed: f64,
}

impl Planks {
    /// What holds a body back that moves with a velocity in the world [m/s] [N].
    pub fn push(&self, velocity: Vector2<f64>) -> Vector2<f64> {
        let speed = velocity.dot(&self.across);
        -self.friction * speed / (speed * speed + self.onset_speed * self.onset_speed).sqrt() * self.across
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ridge_pushes_down_its_own_slope() {
        let ridge = Ridge { across: Vector2::new(0.6, 0.8), at: 0.2, height: 0.004, width: 0.02 };
        let place = Vector2::new(0.13, 0.19);
        let by_difference = |axis: usize| {
            let step = Vector2::ith(axis, 1e-6);
            -5.0 * (ridge.height_at(place + step) - ridge.height_at(place - step)) / 2e-6
        };
        let push = ridge.push(place, 5.0);
        assert!((push - Vector2::new(by_difference(0), by_difference(1))).norm() < 1e-7, "{push}");
        // along the line nothing changes
        let beside = place + 0.3 * Vector2::new(-0.8, 0.6);
        assert!((ridge.push(beside, 5.0) - push).norm() < 1e-12 && push.norm() > 0.1);
    }

    #[test]
    fn planks_hold_what_goes_across_them_whichever_way() {
        let planks = Planks { across: Vector2::new(0.0, 1.0), friction: 0.8, onset_speed: 1e-9 };
        assert_eq!(planks.push(Vector2::new(1.0, 0.0)), Vector2::zeros());
        for speed in [0.5, -2.0] {
            let push = planks.push(Vector2::new(0.3, speed));
            assert!((push - Vector2::new(0.0, -0.8 * f64::signum(speed))).norm() < 1e-12, "{push}");
        }
    }
}
