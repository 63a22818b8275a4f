//! The body: Newton and Euler about any point of it.
//!
//! Followed is a point P with the twist (v, vn, ω) along the body's axes; c is the centre of mass and g the robot's centre,
//! both from P:
//!
//! ```text
//! M·(v̇ − ω·vn − ω̇·c₂ − ω²·c₁) = F₁
//! M·(v̇n + ω·v + ω̇·c₁ − ω²·c₂) = F₂
//! (J + M·|c|²)·ω̇ + M·(c₁·(v̇n + ω·v) − c₂·(v̇ − ω·vn)) = T
//! ```

use nalgebra::{Matrix3, Vector2, Vector3};

use crate::body_friction::BodyFriction;
use crate::twist_at::twist_at;

/// Mass, and the friction that the paper gives to the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Chassis {
    /// M [kg]
    pub mass: f64,
    /// J about the vertical through the centre of mass [kg·m²]
    pub inertia: f64,
    /// The centre of mass, from the robot's centre, along (v, vn) [m]
    pub centre_of_mass: Vector2<f64>,
    /// Its height over the floor [m]
    pub height: f64,
    /// How much of ω × velocity there is: 1 in nature, 0 in the paper's equations 10 and 11 [1]
    pub transport: f64,
    /// Friction along v, vn and about the centre.
    pub friction: BodyFriction,
}

/// A chassis, seen from the point that is followed.
#[derive(Clone, Copy, Debug)]
pub struct SeenFrom {
    /// The centre of mass, from there [m]
    pub com: Vector2<f64>,
    /// M [kg]
    mass: f64,
    /// How much of ω × velocity there is [1]
    transport: f64,
    /// The matrix of the inertia.
    pub inertia: Matrix3<f64>,
    /// The matrix of viscous friction.
    pub viscous: Matrix3<f64>,
    /// The rows along which Coulomb friction acts: the twist of the robot's centre.
    pub centre: Matrix3<f64>,
}

impl SeenFrom {
    /// `point`: what is followed, from the robot's centre [m].
    pub fn new(chassis: &Chassis, point: Vector2<f64>) -> Self {
        let com = chassis.centre_of_mass - point;
        let (m, j) = (chassis.mass, chassis.inertia + chassis.mass * com.norm_squared());
        let inertia = Matrix3::new(m, 0.0, -m * com.y, 0.0, m, m * com.x, -m * com.y, m * com.x, j);
        let centre = twist_at(-point);
        let viscous = centre.transpose() * Matrix3::from_diagonal(&chassis.friction.viscous) * centre;
        Self { com, mass: m, transport: chassis.transport, inertia, viscous, centre }
    }

    /// What turning the body's axes does to its twist: the forces that a standing observer does not see [N, N, N·m].
    pub fn apparent(&self, twist: Vector3<f64>) -> Vector3<f64> {
        let [v, vn, w] = twist.into();
        let (c, k) = (self.com, self.transport);
        self.mass * Vector3::new(k * w * vn + w * w * c.x, -k * w * v + w * w * c.y, -w * (c.x * v + c.y * vn))
    }
}
