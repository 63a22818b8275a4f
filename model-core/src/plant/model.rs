//! The plant: a robot, its effects, and what every step needs of them, worked out once.

use super::body::couples;
use super::robot::Robot;
use super::state::State;
use super::support::Support;
use super::traction::Floor;
use crate::effects::active::Effects;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, EffectContext, STANDARD_GRAVITY, Shaft};
use crate::effects::{Effect, EffectSet, Needs};
use crate::geometry::frames::{BodyTwist, Pose};
use crate::number::linalg::mirror;
use crate::number::scalar::Real;

/// A model ready to run: a robot and the effects that it carries.
#[derive(Clone, Copy, Debug)]
pub struct Plant<const N: usize, T: Real, E: EffectSet<T> = Effect<T>> {
    pub(super) robot: Robot<N, T>,
    pub(super) effects: Effects<N, T, E>,
    /// True if there is no effect
    pub(super) bare: bool,
    /// True if no effect stands between the command and the wheels' forces
    pub(super) plain: bool,
    /// True if an effect may make something turn with the wheels that has inertia
    pub(super) turns: bool,
    /// l·K_v [V·s]
    pub(super) emf: T,
    /// l·K_t [N·m/A]
    pub(super) kt: T,
    /// 1/R [1/Ω]
    pub(super) per_resistance: T,
    /// −∂current/∂(wheel speed) and −∂torque/∂(wheel speed) of the plain motor [A·s] [N·m·s]
    pub(super) plain_current_slope: T,
    pub(super) plain_slope: T,
    /// True if an effect is told anything in a step
    pub(super) tells: bool,
    /// What is kept up for the effects
    pub(super) needs: Needs,
    /// True if a shaft yields
    pub(super) yields: bool,
    /// The contacts as the robot's parameters describe them.
    pub(super) contact: [Contact<T>; N],
    /// The shafts with what the effects make of them
    pub(super) shafts: [Shaft<T>; N],
    /// The contacts with what the effects make of them, and what they take, where that is the same in every step
    pub(super) settled: Option<Settled<N, T>>,
    /// Mean distance of the wheels' contacts from the centre [m]
    pub(super) reach: T,
    /// Each wheel's share of the body's Coulomb friction, as a torque at its shaft [N·m]
    pub(super) coulomb_share: [T; N],
    /// The body's mass matrix
    pub(super) mass: [[T; 3]; 3],
    /// Damping of the plain model's motors in body axes
    pub(super) motor_rate: [[T; 3]; 3],
    /// The same with the body's viscous friction
    pub(super) plain_rate: [[T; 3]; 3],
    /// True if it couples no axes
    pub(super) plain_decoupled: bool,
}

/// The contacts of a model in which they are the same in every step, and what they take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settled<const N: usize, T> {
    pub contact: [Contact<T>; N],
    pub floors: [Floor<T>; N],
}

/// The shafts as effects describe them, which depends on nothing but their parameters.
fn shafts<const N: usize, T: Real, E: EffectSet<T>>(effects: &Effects<N, T, E>) -> [Shaft<T>; N] {
    core::array::from_fn(|j| {
        let at = EffectContext { wheel: j, ..EffectContext::default() };
        let mut shaft = Shaft::default();
        effects.on(Seam::Shaft, j).for_each(|active| active.effect.shaft(&[], &at, &mut shaft));
        if shaft.stiffness > T::zero() && shaft.inertia <= T::zero() {
            // an inertia of zero may still have derivatives
            shaft.inertia += shaft.rotor;
        }
        shaft
    })
}

/// The mean distance of the contacts from the centre [m].
fn mean_distance<const N: usize, T: Real>(contact: &[Contact<T>; N]) -> T {
    let distance = |[x, y]: [T; 2]| (x * x + y * y).sqrt();
    contact.iter().fold(T::zero(), |sum, c| sum + distance(c.position)) / T::lit(N as f64)
}

/// The contacts as effects change them that look at nothing but their parameters; `None` where one looks at more.
fn settled<const N: usize, T: Real, E: EffectSet<T>>(
    effects: &Effects<N, T, E>,
    mut contact: [Contact<T>; N],
) -> Option<Settled<N, T>> {
    if !effects.at(Seam::Contact).all(|active| active.effect.settles_contact()) {
        return None;
    }
    for active in effects.at(Seam::Contact) {
        for (j, contact) in contact.iter_mut().enumerate().filter(|(j, _)| active.on(*j)) {
            active.effect.contact(&[], &EffectContext { wheel: j, ..EffectContext::default() }, contact);
            contact.complete();
        }
    }
    let floors = core::array::from_fn(|j| Floor::of(&contact[j]));
    Some(Settled { contact, floors })
}

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// A model of this robot with these effects.
    pub fn new(robot: Robot<N, T>, effects: Effects<N, T, E>) -> Self {
        let rows = robot.wheels.rows();
        let weight = robot.mass * T::lit(STANDARD_GRAVITY);
        let support = Support::of(&robot.wheels.contact_points().map(<[T; 2]>::from));
        let mut contact = [Contact { shape: T::one(), ..Contact::default() }; N];
        let coulomb_share = robot.coulomb_shares();
        let zero = T::zero();
        let mut motor_rate = [[zero; 3]; 3];
        let (emf, kt) = (robot.motor.wheel_emf_constant(), robot.motor.wheel_torque_constant());
        let per_resistance = T::one() / robot.motor.resistance;
        let electric = kt * emf * per_resistance;
        for j in 0..N {
            contact[j].row = rows[j];
            let wheel = robot.wheels.wheels()[j];
            contact[j].position = wheel.contact_point().into();
            let share = support.share(contact[j].position);
            (contact[j].load, contact[j].load_shift) = (weight * share.at_rest, share.shift);
            let radius = wheel.radius;
            contact[j].radius = radius;
            contact[j].complete();
            // k = (l²·K_t·K_v/R)/r²
            let per_radius = contact[j].per_radius;
            contact[j].add_rate(&mut motor_rate, electric * (per_radius * per_radius));
        }
        mirror(&mut motor_rate);
        let mut plain_rate = motor_rate;
        for (axis, viscous) in robot.friction.viscous.into_iter().enumerate() {
            plain_rate[axis][axis] += viscous;
        }
        let mass = [[robot.mass, zero, zero], [zero, robot.mass, zero], [zero, zero, robot.inertia]];
        let chain = [Seam::Supply, Seam::Bridge, Seam::Winding, Seam::Shaft, Seam::Gear, Seam::Contact];
        let plain = chain.into_iter().all(|seam| effects.none_at(seam));
        let turns = !effects.none_at(Seam::Shaft) || !effects.none_at(Seam::Gear);
        let settled = settled(&effects, contact);
        let shafts = shafts(&effects);
        let needs = effects.iter().fold(Needs::NOTHING, |all, active| all.or(active.effect.needs()));
        let told = [Seam::SpeedDrive, Seam::Supply, Seam::Bridge, Seam::Winding, Seam::Gear, Seam::Body, Seam::Sense];
        let tells = settled.is_none()
            || !told.into_iter().all(|seam| effects.none_at(seam))
            || effects.with_memory().next().is_some();
        let yields = shafts.iter().any(|shaft| shaft.stiffness > T::zero());
        Self {
            robot,
            bare: effects.is_empty(),
            effects,
            plain,
            turns,
            emf,
            kt,
            per_resistance,
            plain_current_slope: emf * per_resistance,
            plain_slope: electric,
            tells,
            needs,
            yields,
            contact,
            shafts,
            settled,
            reach: mean_distance(&contact),
            coulomb_share,
            plain_decoupled: !couples(|a, b| motor_rate[a][b].plain()),
            mass,
            motor_rate,
            plain_rate,
        }
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

    /// What its effects need to be kept up.
    pub fn needs(&self) -> Needs {
        self.needs
    }

    /// The states of effects that a run begins with; a host keeps them in a list, and gives them to every step.
    pub fn memory(&self) -> impl Iterator<Item = E::State> {
        self.effects.memory()
    }

    /// The contacts as effects describe them that look at nothing but their parameters, else as the robot's do.
    pub(super) fn usual_contacts(&self) -> &[Contact<T>; N] {
        self.settled.as_ref().map_or(&self.contact, |settled| &settled.contact)
    }

    /// A state with this pose and velocity, the wheels rolling without slip and the motors without current.
    pub fn start(&self, time: T, pose: Pose<T>, twist: BodyTwist<T>) -> State<N, T> {
        let wheel_speed = self.usual_contacts().each_ref().map(|c| c.rim_speed(twist) * c.per_radius);
        let kept = |needed| if needed { T::zero() } else { T::lit(f64::NAN) };
        State {
            time,
            pose,
            twist,
            wheel_speed,
            slip: [T::zero(); N],
            acceleration: [kept(self.needs.acceleration); 3],
            wheel_angle: [kept(self.needs.angle); N],
            rotor_speed: wheel_speed,
            shaft_twist: [T::zero(); N],
            heat: [kept(self.needs.heat); N],
            current: [T::zero(); N],
            bus: self.robot.supply,
        }
    }

    /// The same, where what cannot be seen goes on from another state: slip, angles, twists, heat, currents, the bus; a
    /// rotor stays as much faster than its wheel as it was.
    pub fn start_from(&self, hidden: &State<N, T>, time: T, pose: Pose<T>, twist: BodyTwist<T>) -> State<N, T> {
        let start = self.start(time, pose, twist);
        let ahead = |j: usize| {
            if self.yields_at(j) { hidden.rotor_speed[j] - hidden.wheel_speed[j] } else { T::zero() }
        };
        let wheel_speed = core::array::from_fn(|j| start.wheel_speed[j] + hidden.slip[j]);
        State {
            rotor_speed: core::array::from_fn(|j| wheel_speed[j] + ahead(j)),
            time,
            pose,
            twist,
            wheel_speed,
            ..*hidden
        }
    }

    /// Tells the effects with memory that the motion goes on from this state.
    pub fn restart(&self, state: &State<N, T>, memory: &mut [E::State]) {
        let mut at = self.at(state, T::zero());
        for active in self.effects.with_memory() {
            if active.whole() {
                at.leave_wheel();
                active.effect.restart(&mut memory[active.memory(0)], &at);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                self.enter_wheel(&mut at, state, j, (state.wheel_speed[j], self.rim_speed(state, j)));
                active.effect.restart(&mut memory[active.memory(j)], &at);
            }
        }
    }

    /// What an effect is told in a step from this state.
    #[inline]
    pub(super) fn at(&self, state: &State<N, T>, dt: T) -> EffectContext<T> {
        let mut at = EffectContext { dt, ..EffectContext::default() };
        if self.tells {
            at.time = state.time;
            at.gear_ratio = self.robot.motor.gear_ratio;
            at.reach = self.reach;
            at.pose = state.pose;
            at.twist = state.twist;
            at.acceleration = state.acceleration;
            at.bus = state.bus;
            at.nominal_supply = self.robot.supply;
        }
        at
    }

    /// How fast the rim of wheel `j` passes the floor if it rolls, by the robot's own geometry [m/s].
    #[inline]
    pub(super) fn rim_speed(&self, state: &State<N, T>, j: usize) -> T {
        self.contact[j].rim_speed(state.twist)
    }

    /// Goes on to wheel `j`, which turns at this speed [rad/s] and whose rim would pass the floor at this one [m/s].
    #[inline]
    pub(super) fn enter_wheel(
        &self,
        at: &mut EffectContext<T>,
        state: &State<N, T>,
        j: usize,
        (wheel_speed, rim_speed): (T, T),
    ) {
        at.wheel = j;
        at.wheel_speed = wheel_speed;
        at.rotor_speed = if self.yields_at(j) { state.rotor_speed[j] } else { wheel_speed };
        at.rim_speed = rim_speed;
        if self.tells {
            at.wheel_angle = state.wheel_angle[j];
            at.rotor_angle = state.wheel_angle[j];
            if self.yields {
                at.rotor_angle += state.shaft_twist[j];
            }
            at.heat = state.heat[j];
        }
    }

    /// True if the shaft of wheel `j` yields.
    #[inline]
    pub(super) fn yields_at(&self, j: usize) -> bool {
        self.yields && self.shafts[j].stiffness > T::zero()
    }
}
