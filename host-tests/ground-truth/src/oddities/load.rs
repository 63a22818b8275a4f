//! A load that swings: water in a tank, or a pack that hangs on straps.
//!
//! A point mass on a spring and a damper at the robot's centre a, of which the body moves with u at the load's place p:
//!
//! ```text
//! m·dv/dt = F + m·g,  dp/dt = v        F = −k·(p − a) − c·(v − u)
//! ```
//!
//! −F acts on the body where the load is. By the midpoint rule F of the middle of a step is linear in what is known of it.

use nalgebra::Vector2;

/// A mass that is tied to the robot's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// m, beside the chassis's [kg]
    pub mass: f64,
    /// k [N/m]
    pub stiffness: f64,
    /// c [N·s/m]
    pub damping: f64,
}

/// Where a load is in the world, and how fast.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Swing {
    /// p [m]
    pub position: Vector2<f64>,
    /// v [m/s]
    pub velocity: Vector2<f64>,
}

/// What carries a load, in the middle of a step, in the world.
#[derive(Clone, Copy, Debug)]
pub struct Carrier {
    /// a [m]
    pub centre: Vector2<f64>,
    /// Of the centre [m/s]
    pub velocity: Vector2<f64>,
    /// [rad/s]
    pub turning: f64,
    /// g along the floor [m/s²]
    pub gravity: Vector2<f64>,
}

/// The middle of a load's step, in the world.
#[derive(Clone, Copy, Debug)]
pub struct Swung {
    /// p − a [m]
    pub off: Vector2<f64>,
    /// v [m/s]
    pub velocity: Vector2<f64>,
    /// F [N]
    pub force: Vector2<f64>,
}

impl Load {
    /// The middle of a step [s].
    pub fn swung(&self, from: &Swing, by: &Carrier, step: f64) -> Swung {
        let Self { mass, stiffness, damping } = *self;
        let half = 0.5 * step;
        let about = from.position + half * from.velocity - by.centre;
        let carried = by.velocity + by.turning * Vector2::new(-about.y, about.x);
        let driven = damping * carried - stiffness * (from.position - by.centre) + mass * by.gravity;
        let velocity = (mass * from.velocity + half * driven) / (mass + half * (damping + half * stiffness));
        let off = from.position + half * velocity - by.centre;
        Swung { off, velocity, force: -stiffness * off - damping * (velocity - carried) }
    }

    /// What moves and what is strained [J], the robot's centre at a place in the world [m].
    pub fn energy(&self, swing: &Swing, centre: Vector2<f64>) -> f64 {
        0.5 * self.mass * swing.velocity.norm_squared()
            + 0.5 * self.stiffness * (swing.position - centre).norm_squared()
    }
}

impl Swing {
    /// After a step [s] with that middle.
    #[must_use]
    pub fn after(&self, middle: &Swung, step: f64) -> Self {
        Self { position: self.position + step * middle.velocity, velocity: 2.0 * middle.velocity - self.velocity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STANDS: Carrier =
        Carrier { centre: Vector2::new(0.0, 0.0), velocity: Vector2::new(0.0, 0.0), turning: 0.0, gravity: GRAVITY };
    const GRAVITY: Vector2<f64> = Vector2::new(0.0, 0.0);

    #[test]
    fn on_a_robot_that_stands_it_swings_as_a_damped_oscillator() {
        let load = Load { mass: 0.5, stiffness: 80.0, damping: 0.6 };
        let mut swing = Swing { position: Vector2::new(0.02, -0.01), velocity: Vector2::zeros() };
        let (start, step) = (swing.position, 1e-5);
        for _ in 0..50_000 {
            let middle = load.swung(&swing, &STANDS, step);
            swing = swing.after(&middle, step);
        }
        // x₀·e^(−δt)·(cos ωt + δ/ω·sin ωt), δ = c/(2m), ω² = k/m − δ²
        let (decay, time) = (0.6, 0.5);
        let frequency = f64::sqrt(160.0 - decay * decay);
        let (sin, cos) = libm::sincos(frequency * time);
        let expected = start * libm::exp(-decay * time) * (cos + decay / frequency * sin);
        assert!((swing.position - expected).norm() < 1e-8, "{swing:?} against {expected}");
    }

    #[test]
    fn a_load_that_turns_with_its_robot_feels_no_damper() {
        let load = Load { mass: 0.5, stiffness: 0.0, damping: 3.0 };
        let swing = Swing { position: Vector2::new(0.1, 0.0), velocity: Vector2::new(0.0, 0.2) };
        let middle = load.swung(&swing, &Carrier { turning: 2.0, ..STANDS }, 1e-9);
        assert!(middle.force.norm() < 1e-8, "{middle:?}");
    }
}
