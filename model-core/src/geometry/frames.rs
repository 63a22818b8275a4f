//! # Frames: the body, the world, and the one rotation between them
//!
//! ```text
//! ⎡ẋ⎤   ⎡cos θ  −sin θ  0⎤ ⎡v ⎤
//! ⎢ẏ⎥ = ⎢sin θ   cos θ  0⎥ ⎢vn⎥        (eq. 1, read from the body to the world)
//! ⎣θ̇⎦   ⎣  0       0    1⎦ ⎣ω ⎦
//! ```
//!
//! The body frame sits in the robot's centre: `v` forward, `vn` to the left, `ω` anticlockwise. The world frame is the
//! floor's (or the camera's). A twist of one frame and a twist of the other are different types, and
//! [`Pose::to_world`] and [`Pose::to_body`] are the only way across.

use crate::number::scalar::Real;

/// Velocity in the body frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyTwist<T = f32> {
    /// v, forward [m/s]
    pub v: T,
    /// vn, to the left [m/s]
    pub vn: T,
    /// ω, anticlockwise [rad/s]
    pub w: T,
}

/// Velocity in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldTwist<T = f32> {
    /// ẋ [m/s]
    pub x: T,
    /// ẏ [m/s]
    pub y: T,
    /// θ̇ [rad/s]
    pub w: T,
}

/// Where the robot is and where it looks, in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose<T = f32> {
    /// x [m]
    pub x: T,
    /// y [m]
    pub y: T,
    /// θ [rad], not wrapped: it counts turns
    pub theta: T,
}

impl<T: Real> BodyTwist<T> {
    /// The twist as a 3-vector (v, vn, ω) [m/s, m/s, rad/s].
    #[inline]
    pub fn to_array(self) -> [T; 3] {
        [self.v, self.vn, self.w]
    }

    /// The twist of a 3-vector (v, vn, ω) [m/s, m/s, rad/s].
    #[inline]
    pub fn from_array([v, vn, w]: [T; 3]) -> Self {
        Self { v, vn, w }
    }

    /// Halfway between two twists.
    #[inline(always)]
    pub fn mean(self, other: Self) -> Self {
        let half = T::Plain::lit(0.5);
        Self {
            v: (self.v + other.v).times(half),
            vn: (self.vn + other.vn).times(half),
            w: (self.w + other.w).times(half),
        }
    }
}

impl<T: Real> Pose<T> {
    /// A body velocity, seen from the world (eq. 1).
    #[inline]
    pub fn to_world(self, twist: BodyTwist<T>) -> WorldTwist<T> {
        let (sin, cos) = self.theta.sin_cos();
        // ẋ = cos θ·v − sin θ·vn,  ẏ = sin θ·v + cos θ·vn,  θ̇ = ω
        WorldTwist { x: cos * twist.v - sin * twist.vn, y: sin * twist.v + cos * twist.vn, w: twist.w }
    }

    /// A world velocity, seen from the body (the inverse of eq. 1).
    #[inline]
    pub fn to_body(self, twist: WorldTwist<T>) -> BodyTwist<T> {
        let (sin, cos) = self.theta.sin_cos();
        // v = cos θ·ẋ + sin θ·ẏ,  vn = −sin θ·ẋ + cos θ·ẏ,  ω = θ̇
        BodyTwist { v: cos * twist.x + sin * twist.y, vn: cos * twist.y - sin * twist.x, w: twist.w }
    }

    /// The pose after moving with a constant body twist for `dt` [s], the heading taken at its middle. The time has no
    /// derivatives.
    ///
    /// Second order in `dt`: on a circle of radius ρ travelled by angle φ = ω·dt the chord is too long by ρφ³/24.
    #[inline(always)]
    pub fn moved(self, twist: BodyTwist<T>, dt: T) -> Self {
        // θ½ = θ + ½·ω·Δt,  Δ(x, y) = R(θ½)·(v, vn)·Δt,  Δθ = ω·Δt
        let dt = dt.plain();
        let half = dt * T::Plain::lit(0.5);
        let turn = twist.w.plain() * dt;
        let (sin, cos) = (self.theta.plain() + turn * T::Plain::lit(0.5)).sin_cos();
        let BodyTwist { v, vn, w } = &twist;
        let (v_x, v_y) = (cos * v.plain() - sin * vn.plain(), sin * v.plain() + cos * vn.plain());
        // ∂(x, y)/∂θ½ = Δt·(−v_y, v_x)
        let by_x = [(v, cos * dt), (vn, -(sin * dt)), (&self.theta, -(v_y * dt)), (w, -(v_y * dt * half))];
        let by_y = [(v, sin * dt), (vn, cos * dt), (&self.theta, v_x * dt), (w, v_x * dt * half)];
        let mut moved = self;
        moved.x.add_chain(v_x * dt, by_x);
        moved.y.add_chain(v_y * dt, by_y);
        moved.theta.add_chain(turn, [(w, dt)]);
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rotation_undoes_itself() {
        let pose = Pose { x: 0.3, y: -2.0, theta: 2.4_f64 };
        let twist = BodyTwist { v: 0.7, vn: -0.4, w: 1.3 };
        let back = pose.to_body(pose.to_world(twist));
        for (a, b) in back.to_array().into_iter().zip(twist.to_array()) {
            assert!((a - b).abs() < 4.0 * f64::EPSILON, "{a} against {b}");
        }
    }

    #[test]
    fn forward_at_a_quarter_turn_is_the_worlds_y() {
        let pose = Pose { theta: core::f64::consts::FRAC_PI_2, ..Pose::default() };
        let world = pose.to_world(BodyTwist { v: 1.0, vn: 0.0, w: 0.0 });
        assert!(world.x.abs() < 1e-15 && (world.y - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_full_circle_closes() {
        // n chords of a polygon inscribed in no circle but equal ones: the polygon closes exactly up to rounding
        let n = 1000;
        let dt = core::f64::consts::TAU / f64::from(n);
        let mut pose = Pose::default();
        for _ in 0..n {
            pose = pose.moved(BodyTwist { v: 0.5, vn: 0.2, w: 1.0 }, dt);
        }
        assert!(pose.x.abs() < 1e-12 && pose.y.abs() < 1e-12, "{pose:?}");
    }
}
