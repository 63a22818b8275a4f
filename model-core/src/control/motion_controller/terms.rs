//! What is folded of the effects that a controller undoes.

use crate::control::compensation::Compensation;
use crate::effects::undoing::Place;
use crate::number::linalg::Mat3;

/// The robot cannot move.
pub(super) const IMMOBILE: u32 = 1;
/// Forces on the body are given.
pub(super) const FORCES: u32 = 1 << 1;
/// What moves couples the axes; where it does not, it is in the mass.
pub(super) const COUPLING: u32 = 1 << 2;
/// Contacts give way.
pub(super) const CONTACT: u32 = 1 << 3;
/// Gears lose a share of the torque, or windings of theirs.
pub(super) const RATIO: u32 = 1 << 4;
/// Bridges lose a voltage, or sensors read another current: undone last.
pub(super) const LAST: u32 = 1 << 5;

/// The effects that are undone, and what they are given of the robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompensationTerms<const N: usize, T> {
    /// The effects
    pub effects: Compensation<N, T>,
    /// Which of them are undone at each place: bit k is the effect that was added k-th
    pub places: [u32; Place::COUNT],
    /// M of the body alone, which forces on the body are counted on [kg]
    pub mass: T,
    /// Torque about the centre over what accelerates every part of it alike along (v, vn) [kg·m]
    pub moment: [T; 2],
    /// Half a turn [s]
    pub half: T,
    /// Each wheel's share of the body's Coulomb friction [N·m]
    pub coulomb_share: [T; N],
    /// G_j/r_j of every wheel, a lost one too [1/m, 1/m, 1]
    pub rows: [[T; 3]; N],
    /// Speed of each contact along its axle over body twist [1, 1, m]
    pub axles: [[T; 3]; N],
    /// r [m]
    pub radius: [T; N],
    /// 1/r [1/m]
    pub per_radius: [T; N],
    /// What couples the axes, as a mass matrix of the body; its diagonal is in the mass
    pub coupling: Mat3<T>,
    /// Force on the floor over current, l·K_t/r [N/A]
    pub push: [T; N],
    /// What of it turns the wheel, over the wheel's acceleration, J_w/r [N/(rad/s²)]
    pub spin: [T; N],
}
