//! # Feedforward: wanted motion → wheel torque → current → voltage
//!
//! ```text
//! F   = M·a + B·x + C·sign(x)                 (eq. 10–12, turned round)
//! f   = G·(GᵀG)⁻¹·F                           the wheel forces of least square sum
//! τ_j = r_j·f_j,  i_j = τ_j/(l·K_t)           (eq. 16–17, 22)
//! u_j = R·i_j + l·K_v·ω_j                     (eq. 21)
//! ```
//!
//! The inverse of the plain model, as it is read. [`Controller::feedforward`](crate::control::motion_controller::Controller::feedforward)
//! is the same folded for a turn of the loop, and a test holds them together: what to ask of the motors so that the body accelerates as wanted. At rest the
//! friction to overcome is that of the direction in which the body is to start, sign(a).

use crate::geometry::frames::BodyTwist;
use crate::number::scalar::Real;
use crate::plant::robot::Robot;

/// What the motors have to do for a wanted motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feedforward<const N: usize, T = f32> {
    /// Torque at each wheel shaft [N·m]
    pub wheel_torque: [T; N],
    /// Motor currents [A]
    pub current: [T; N],
    /// Motor voltages [V]
    pub voltage: [T; N],
}

impl<const N: usize, T: Real> Robot<N, T> {
    /// Force that accelerates the body as wanted, friction included, in body axes [N, N, N·m].
    ///
    /// `acceleration` is d/dt of the body twist [m/s², m/s², rad/s²].
    pub fn body_force_for(&self, twist: BodyTwist<T>, acceleration: BodyTwist<T>) -> [T; 3] {
        let (x, a) = (twist.to_array(), acceleration.to_array());
        let mass = [self.mass, self.mass, self.inertia];
        core::array::from_fn(|axis| {
            let going = if x[axis] == T::zero() { a[axis].sign() } else { x[axis].sign() };
            // F = M·a + B·x + C·sign(x)
            mass[axis] * a[axis] + self.friction.viscous[axis] * x[axis] + self.friction.coulomb[axis] * going
        })
    }

    /// What the motors have to do so that the body, moving with `twist`, accelerates as wanted.
    pub fn inverse_dynamics(&self, twist: BodyTwist<T>, acceleration: BodyTwist<T>) -> Feedforward<N, T> {
        let force = self.wheels.wheel_forces(self.body_force_for(twist, acceleration));
        let speed = self.wheels.wheel_speeds(twist);
        // τ_j = r_j·f_j
        let wheel_torque: [T; N] = core::array::from_fn(|j| self.wheels.wheels()[j].rim().wheel_torque(force[j]));
        let current: [T; N] = wheel_torque.map(|torque| self.motor.current_for_torque(torque));
        let voltage = core::array::from_fn(|j| self.motor.voltage(current[j], speed[j]));
        Feedforward { wheel_torque, current, voltage }
    }
}
