//! The plant: a robot, its effects, and what every step needs of them, worked out once.

use super::robot::Robot;
use super::state::State;
use crate::effects::active::Effects;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext, STANDARD_GRAVITY};
use crate::effects::{Effect, EffectSet};
use crate::geometry::frames::{BodyTwist, Pose};
use crate::number::linalg::{accumulate_outer, dot};
use crate::number::scalar::Real;

/// A model ready to run: a robot and the effects that it carries.
#[derive(Clone, Copy, Debug)]
pub struct Plant<const N: usize, T: Real, E: EffectSet<T> = Effect<T>> {
    pub(super) robot: Robot<N, T>,
    pub(super) effects: Effects<N, T, E>,
    /// True if no effect stands between the command and the wheels' forces
    pub(super) plain: bool,
    /// l·K_v [V·s]
    pub(super) emf: T,
    /// l·K_t [N·m/A]
    pub(super) kt: T,
    /// 1/R [1/Ω]
    pub(super) per_resistance: T,
    /// The contacts as the robot's parameters describe them.
    pub(super) contact: [Contact<T>; N],
    /// The contacts with what the effects make of them, where that is the same in every step
    pub(super) settled: Option<[Contact<T>; N]>,
    /// Each wheel's share of the body's Coulomb friction, as a torque at its shaft [N·m]
    pub(super) coulomb_share: [T; N],
    /// Damping of the plain model in body axes: back-EMF and viscous friction
    pub(super) plain_rate: [[T; 3]; 3],
}

/// The contacts as effects change them that look at nothing but their parameters; `None` where one looks at more.
fn settled<const N: usize, T: Real, E: EffectSet<T>>(
    effects: &Effects<N, T, E>,
    mut contact: [Contact<T>; N],
) -> Option<[Contact<T>; N]> {
    if !effects.at(Seam::Contact).all(|active| active.effect.settles_contact()) {
        return None;
    }
    for active in effects.at(Seam::Contact) {
        for (j, contact) in contact.iter_mut().enumerate().filter(|(j, _)| active.on(*j)) {
            active.effect.contact(&[], &EffectContext { wheel: j, ..EffectContext::default() }, contact);
            contact.per_radius = T::one() / contact.radius;
        }
    }
    Some(contact)
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// A model of this robot with these effects.
    pub fn new(robot: Robot<N, T>, effects: Effects<N, T, E>) -> Self {
        let rows = robot.wheels.rows();
        let zero = T::zero();
        let load = robot.mass * T::lit(STANDARD_GRAVITY) / T::lit(N as f64);
        let mut contact = [Contact {
            row: [zero; 3],
            radius: zero,
            per_radius: zero,
            load,
            creep: zero,
            grip: zero,
            stiffness: zero,
            shape: T::one(),
        }; N];
        let coulomb_share = robot.coulomb_shares();
        let mut plain_rate = [[zero; 3]; 3];
        let (emf, kt) = (robot.motor.wheel_emf_constant(), robot.motor.wheel_torque_constant());
        let per_resistance = T::one() / robot.motor.resistance;
        let electric = kt * emf * per_resistance;
        for j in 0..N {
            contact[j].row = rows[j];
            let radius = robot.wheels.wheels()[j].radius;
            contact[j].radius = radius;
            contact[j].per_radius = T::one() / radius;
            // k = (l²·K_t·K_v/R)/r²
            let per_radius = contact[j].per_radius;
            accumulate_outer(&mut plain_rate, electric * (per_radius * per_radius), rows[j]);
        }
        let chain = [Seam::Supply, Seam::Bridge, Seam::Winding, Seam::Gear, Seam::Contact];
        let plain = chain.into_iter().all(|seam| effects.none_at(seam));
        let settled = settled(&effects, contact);
        Self { robot, effects, plain, emf, kt, per_resistance, contact, settled, coulomb_share, plain_rate }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot<N, T> {
        &self.robot
    }

    /// The effects.
    pub fn effects(&self) -> &Effects<N, T, E> {
        &self.effects
    }

    /// How many states of effects a run keeps: none without effects that remember.
    pub fn memory_len(&self) -> usize {
        self.effects.memory_len()
    }

    /// The states of effects that a run begins with; a host keeps them in a list, and gives them to every step.
    pub fn memory(&self) -> impl Iterator<Item = E::State> {
        self.effects.memory()
    }

    /// A state with this pose and velocity, the wheels rolling without slip and the motors without current.
    pub fn start(&self, time: T, pose: Pose<T>, twist: BodyTwist<T>) -> State<N, T> {
        State {
            time,
            pose,
            twist,
            wheel_speed: self.robot.wheels.wheel_speeds(twist),
            wheel_angle: [T::zero(); N],
            current: [T::zero(); N],
            bus: self.robot.supply,
        }
    }

    /// Tells the effects with memory that the motion goes on from this state.
    pub fn restart(&self, state: &State<N, T>, memory: &mut [E::State]) {
        let at = self.at(state, T::zero());
        for active in self.effects.with_memory() {
            if active.whole() {
                active.effect.restart(&mut memory[active.memory(0)], &at);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(&at, state, j, state.wheel_speed[j]);
                active.effect.restart(&mut memory[active.memory(j)], &at);
            }
        }
    }

    #[inline]
    pub(super) fn at(&self, state: &State<N, T>, dt: T) -> EffectContext<T> {
        EffectContext {
            time: state.time,
            dt,
            pose: state.pose,
            twist: state.twist,
            nominal_supply: self.robot.supply,
            ..EffectContext::default()
        }
    }

    /// The same, for a hook of wheel `j`.
    #[inline]
    pub(super) fn at_wheel(
        &self,
        at: &EffectContext<T>,
        state: &State<N, T>,
        j: usize,
        wheel_speed: T,
    ) -> EffectContext<T> {
        let rim_speed = dot(self.contact[j].row, state.twist.to_array());
        EffectContext { wheel: j, wheel_angle: state.wheel_angle[j], wheel_speed, rim_speed, ..*at }
    }
}
