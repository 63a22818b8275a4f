//! What is folded of the effects that a controller undoes.
//!
//! One word of flags says at which places there is anything to undo.

use crate::control::compensation::Compensation;
use crate::number::linalg::Mat3;

/// The robot cannot move.
pub(super) const IMMOBILE: u32 = 1;
/// Forces on the body or torques at the wheels' shafts are given.
pub(super) const FORCES: u32 = 1 << 1;
/// What turns with the wheels couples the axes; where it does not, it is in the mass.
pub(super) const COUPLING: u32 = 1 << 2;
/// Gears lose a share of the torque.
pub(super) const GEAR: u32 = 1 << 3;
/// Contacts give way.
pub(super) const CONTACT: u32 = 1 << 4;
/// The windings are not alike.
pub(super) const WINDINGS: u32 = 1 << 5;
/// Bridges lose a voltage, or sensors read another current: undone last.
pub(super) const LAST: u32 = 1 << 6;

/// The effects that are undone, and what they are given of the robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompensationTerms<const N: usize, T> {
    /// The effects
    pub effects: Compensation<N, T>,
    /// R [Ω] and l·K_v [V·s] of each motor
    pub winding: [(T, T); N],
    /// M of the body alone, which forces on the body are counted on [kg]
    pub mass: T,
    /// Half a turn [s]
    pub half: T,
    /// Each wheel's share of the body's Coulomb friction [N·m]
    pub coulomb_share: [T; N],
    /// G_j/r_j of every wheel, a lost one too [1/m, 1/m, 1]
    pub rows: [[T; 3]; N],
    /// r [m]
    pub radius: [T; N],
    /// 1/r [1/m]
    pub per_radius: [T; N],
    /// What turns with the wheels, as a mass matrix of the body
    pub turning: Mat3<T>,
    /// Voltage that is kept free for what the bridges lose [V]
    pub kept: T,
    /// Force on the floor over current, l·K_t/r [N/A]
    pub push: [T; N],
    /// What of it turns the wheel, over the wheel's acceleration, J_w/r [N/(rad/s²)]
    pub spin: [T; N],
}
