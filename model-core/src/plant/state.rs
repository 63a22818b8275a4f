//! What goes into a step of the plant, what it goes on from, and what the sensors say.

use crate::geometry::frames::{BodyTwist, Pose};
use crate::number::scalar::Real;

/// What drives the robot during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<const N: usize, T> {
    /// Mean voltage commanded to each motor [V]
    Voltage([T; N]),
    /// The same; nothing where the bridge is open and no current flows
    Bridges([Option<T>; N]),
    /// Current in each motor [A]; all zero is all bridges open
    Current([T; N]),
    /// Speed of each wheel at its shaft [rad/s], as it is: measured, or imposed
    Speed([T; N]),
    /// Speed at its shaft that each wheel's drive is asked for [rad/s]; without an effect it follows at once
    SetSpeed([T; N]),
}

/// Where the robot is in its motion.
#[derive(Clone, Copy, Debug)]
pub struct State<const N: usize, T> {
    /// Time since the start of the run [s]
    pub time: T,
    /// Pose in the world frame
    pub pose: Pose<T>,
    /// Velocity in the body frame
    pub twist: BodyTwist<T>,
    /// Speed of each wheel at its shaft as last solved for [rad/s]
    pub wheel_speed: [T; N],
    /// By how much faster each wheel turns than one that rolls, as last solved for [rad/s]
    pub slip: [T; N],
    /// Acceleration of the body's centre in the last step, along the body's axes, the turning of the axes counted in
    /// [m/s², m/s², rad/s²]; this one, the angles and the heat are NaN unless an effect [`Needs`](crate::effects::Needs) them
    pub acceleration: [T; 3],
    /// Angle that each wheel has turned through [rad]
    pub wheel_angle: [T; N],
    /// Speed of each rotor, counted at the wheel's shaft [rad/s]; kept up only where the shaft yields
    pub rotor_speed: [T; N],
    /// By how much each rotor is ahead of its wheel, counted at the wheel's shaft [rad]
    pub shaft_twist: [T; N],
    /// Heat that the current has made in each winding [J]
    pub heat: [T; N],
    /// Current in each motor at the end of the last step [A]
    pub current: [T; N],
    /// Bus voltage of the last step [V]
    pub bus: T,
}

impl<const N: usize, T: Real> State<N, T> {
    /// Lets time and pose go on to the twist at the end of a step.
    #[inline(always)]
    pub(super) fn go_on(&mut self, next: BodyTwist<T>, dt: T) {
        self.pose = self.pose.moved(self.twist.mean(next), dt);
        self.twist = next;
        self.time += dt;
    }
}

/// What the sensors say at the beginning of a step, just after its input has been applied.
#[derive(Clone, Copy, Debug)]
pub struct Reading<const N: usize, T> {
    /// Motor currents [A]
    pub current: [T; N],
    /// Wheel speeds at the wheel shafts [rad/s]
    pub wheel_speed: [T; N],
    /// Pose in the world frame
    pub pose: Pose<T>,
    /// Yaw rate [rad/s]
    pub gyro: T,
}
