//! # The reference robot
//!
//! The paper's model solved exactly: f64, event by event, with true sticking. It steps nothing and smooths nothing.
//!
//! Each axis k carries Coulomb friction Kₖ·sign(xₖ), which at xₖ = 0 is whatever holds the axis, up to |Kₖ| (Filippov):
//!
//! ```text
//! xₖ ≠ 0                            slides:  K·sign(xₖ)
//! xₖ = 0 and |(A·x + B·u)ₖ| ≤ |Kₖ|  sticks:  dxₖ/dt = 0
//! xₖ = 0 otherwise                  slides off, the way the other forces push
//! ```
//!
//! Two events end a stretch of constant signs: a sliding axis reaches zero, or the forces on a stuck axis outgrow what
//! holds it (which happens with u held only where A joins the axes). [`Flow`] finds the first of them.
//!
//! Errors: twist, about 1e-13 of the largest speed; heading the same, from the closed integral; x and y below 1e-12 of
//! the distance travelled, by Gauss–Legendre quadrature of eq. 1 along the exact twist and heading.

use nalgebra::{Matrix3, Rotation2, SVector, Vector2, Vector3};

use crate::flow::Flow;
use crate::generic_robot::GenericRobot;
use crate::matrices::Matrices;
use crate::paper::PaperRobot;

/// A speed past zero by less than this is rounding [m/s or rad/s].
const SPEED_ROUNDING: f64 = 1e-14;
/// An acceleration past what friction holds by less than this is rounding [1 of the forces on the axis].
const FORCE_ROUNDING: f64 = 1e-13;
/// More sign changes than this in one held voltage would be chatter, which an exact solution does not have.
const MOST_EVENTS: usize = 100;

/// Nodes and weights of the five-point Gauss–Legendre rule on −1 … 1.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// A robot of N wheels that moves as the paper's equations say.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference<const N: usize> {
    /// The equations; they never change.
    pub matrices: Matrices<N>,
    /// v, vn, ω [m/s, m/s, rad/s]
    pub twist: [f64; 3],
    /// x, y, θ in the world [m, m, rad], θ not wrapped
    pub pose: [f64; 3],
}

/// What ends a stretch of constant signs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// The sliding axis has come to zero.
    Zero { axis: usize },
    /// The stuck axis lets go, the way this sign says.
    FreedPrior { axis: usize, sign: f64 },
}

impl Reference<3> {
    /// Three wheels, at rest, from the printed matrices (eq. 32–34).
    pub fn printed(robot: &PaperRobot) -> Self {
        Self::new(Matrices::<3>::printed(robot))
    }
}

impl Reference<4> {
    /// Four wheels, at rest, from the printed matrices (eq. 35–37).
    pub fn printed(robot: &PaperRobot) -> Self {
        Self::new(Matrices::<4>::printed(robot))
    }
}

impl<const N: usize> Reference<N> {
    /// At rest in the origin.
    pub fn new(matrices: Matrices<N>) -> Self {
        Self { matrices, twist: [0.0; 3], pose: [0.0; 3] }
    }

    /// Any geometry, at rest, from virtual work.
    pub fn derived(rig: &GenericRobot<N>) -> Self {
        Self::new(Matrices::derived(rig))
    }

    /// The same robot, moving with this twist [m/s, m/s, rad/s].
    pub fn moving(self, twist: [f64; 3]) -> Self {
        Self { twist, ..self }
    }

    /// Rim speeds vⱼ [m/s] (eq. 2 and 6).
    pub fn rim_speeds(&self) -> [f64; N] {
        (self.matrices.rim * Vector3::from(self.twist)).into()
    }

    /// Wheel speeds at the wheel shaft [rad/s].
    pub fn wheel_speeds(&self) -> [f64; N] {
        let rim = self.rim_speeds();
        // wⱼ = vⱼ/r
        std::array::from_fn(|j| rim[j] / self.matrices.drivetrains[j].radius)
    }

    /// Motor currents [A] under the voltages u [V], without inductance (eq. 21 with L = 0).
    pub fn currents(&self, u: [f64; N]) -> [f64; N] {
        let w = self.wheel_speeds();
        std::array::from_fn(|j| {
            let p = self.matrices.drivetrains[j];
            // iⱼ = (uⱼ − Kv·l·wⱼ)/R
            (u[j] - p.kv * p.gear * w[j]) / p.resistance
        })
    }

    /// Traction forces at the rims [N] under the voltages u [V] (eq. 16, 17 and 22).
    pub fn tractions(&self, u: [f64; N]) -> [f64; N] {
        let i = self.currents(u);
        std::array::from_fn(|j| {
            let p = self.matrices.drivetrains[j];
            // fⱼ = l·Kt·iⱼ/r
            p.gear * p.kt * i[j] / p.radius
        })
    }

    /// Signs of Coulomb friction now, under the voltages u [V]: ±1 where an axis slides, 0 where it sticks.
    pub fn signs(&self, u: [f64; N]) -> [f64; 3] {
        let x = Vector3::from(self.twist);
        // A·x + B·u: what all but Coulomb friction would do to the axis
        let other = self.matrices.a * x + self.matrices.b * SVector::from(u);
        std::array::from_fn(|k| {
            if x[k] != 0.0 {
                x[k].signum()
            } else if other[k].abs() <= -self.matrices.k[k] {
                0.0
            } else {
                other[k].signum()
            }
        })
    }

    /// dx/dt [m/s², m/s², rad/s²] just after the voltages u [V] have been applied (eq. 30).
    pub fn acceleration(&self, u: [f64; N]) -> [f64; 3] {
        let (a, c) = self.field(u, self.signs(u));
        // dx/dt = A·x + B·u + K·sign(x)
        (a * Vector3::from(self.twist) + c).into()
    }

    /// Moves on by `dt` [s] with the voltages u [V] held.
    ///
    /// # Panics
    /// On more than a hundred sign changes within `dt`, which no voltage that is held can cause.
    pub fn advance(&mut self, u: [f64; N], dt: f64) {
        let mut left = dt;
        let mut released = None;
        for _ in 0..MOST_EVENTS {
            let mut signs = self.signs(u);
            if let Some(Event::FreedPrior { axis, sign }) = released {
                signs[axis] = sign;
            }
            let (a, c) = self.field(u, signs);
            let flow = Flow::new(&a, &self.matrices.inertia, &c, &Vector3::from(self.twist));
            let event = self.first_event(&flow, u, signs, left);
            let span = event.map_or(left, |(t, _)| t);
            self.pose = travelled(self.pose, &flow, span);
            self.twist = flow.at(span).into();
            for (x, sign) in self.twist.iter_mut().zip(signs) {
                if sign == 0.0 {
                    *x = 0.0;
                }
            }
            released = event.map(|(_, event)| event);
            match released {
                None => return,
                Some(Event::Zero { axis } | Event::FreedPrior { axis, .. }) => self.twist[axis] = 0.0,
            }
            left -= span;
        }
        panic!("{MOST_EVENTS} sign changes within {dt} s from twist {:?} under {u:?} V", self.twist);
    }

    /// `dx/dt = A·x + c` while the signs last: rows of A and c of an axis that sticks are zero.
    fn field(&self, u: [f64; N], signs: [f64; 3]) -> (Matrix3<f64>, Vector3<f64>) {
        let free = Matrix3::from_diagonal(&Vector3::from(signs.map(f64::abs)));
        let Matrices { a, b, k, .. } = &self.matrices;
        // c = B·u + K·sign(x)
        let c = b * SVector::from(u) + k.component_mul(&Vector3::from(signs));
        // An axis that sticks stays at zero, so its column of A is as idle as its row.
        (free * a * free, free * c)
    }

    /// The first event within 0 … `until` [s], and when.
    fn first_event(&self, flow: &Flow, u: [f64; N], signs: [f64; 3], until: f64) -> Option<(f64, Event)> {
        let push = self.matrices.b * SVector::from(u);
        let mut first: Option<(f64, Event)> = None;
        let mut note = |t: Option<f64>, event| {
            if let Some(t) = t
                && first.is_none_or(|(earlier, _)| t < earlier)
            {
                first = Some((t, event));
            }
        };
        for axis in 0..3 {
            let holds = -self.matrices.k[axis];
            if signs[axis] == 0.0 {
                let row = self.matrices.a.row(axis).transpose();
                for sign in [1.0, -1.0] {
                    // s·(A·x + B·u)ₖ − |Kₖ| rises through zero
                    let slack = FORCE_ROUNDING * (holds + push[axis].abs());
                    let t = flow.first_rise(&(sign * row), sign * push[axis] - holds, until, slack);
                    note(t, Event::FreedPrior { axis, sign });
                }
            } else {
                // −s·xₖ rises through zero
                let t = flow.first_rise(&(-signs[axis] * Vector3::ith(axis, 1.0)), 0.0, until, SPEED_ROUNDING);
                note(t, Event::Zero { axis });
            }
        }
        first
    }
}

/// The pose after `span` [s] of a flow (eq. 1, integrated).
fn travelled([x, y, theta]: [f64; 3], flow: &Flow, span: f64) -> [f64; 3] {
    // Panels over which nothing turns or decays by more than half: the rule's error is then below 1e-12 of the way.
    let panels = (2.0 * span * (flow.fastest() + flow.bound(2, span))).ceil().max(1.0);
    let half = 0.5 * span / panels;
    let mut way = Vector2::zeros();
    for panel in 0..panels as usize {
        for (node, weight) in GAUSS {
            let t = half * (2.0 * panel as f64 + 1.0 + node);
            // ẋ = cos θ·v − sin θ·vn,  ẏ = sin θ·v + cos θ·vn                             (eq. 1)
            way += half * weight * (Rotation2::new(theta + flow.integral(t)[2]) * flow.at(t).xy());
        }
    }
    // θ̇ = ω
    [x + way.x, y + way.y, theta + flow.integral(span)[2]]
}
