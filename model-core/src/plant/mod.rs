//! # Plant: the signal path, one step of Δt
//!
//! ```text
//! command ─ bridge ─ winding ─ gear ─ contact ─ body ─ pose
//!             │         └ current           └ wheel speed   └ sensors → reading
//!           battery
//! ```
//!
//! The plant is a chain of seams in signal order. At each seam it describes the element as the robot's parameters say,
//! lets the effects that act there change the description ([`seams`](crate::seams)), and then solves what is described:
//!
//! 1. contact: rows, radii and loads, and whether a wheel rolls rigidly;
//! 2. battery and bridge: voltages, solved together with the currents that they depend on (`electric.rs`);
//! 3. winding and gear: current, torque, and the dry friction that each shaft can hold;
//! 4. traction: a wheel that creeps or slips turns faster than the floor passes by (`traction.rs`);
//! 5. body: all forces, one linearly implicit step, dry friction spent once ([`body`](crate::body));
//! 6. pose (eq. 1), reading, and the memory of effects.
//!
//! The command is held over the step. Error: second order in Δt while no effect switches; at a reversal, where friction
//! changes its sign within a step, first order for that step alone. `host-tests/tests/integration.rs` holds it to
//! figures against steps a hundred times smaller.

mod electric;
mod forces;
mod sensing;
mod speed_driven;
mod traction;

use crate::active::Effects;
use crate::card::Seam;
use crate::frames::{BodyTwist, Pose};
use crate::robot::Robot;
use crate::scalar::Real;
use crate::seams::{At, Contact, Gear, STANDARD_GRAVITY};
use crate::small::{accumulate_outer, dot};

/// What drives the robot during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input<const N: usize, T> {
    /// Mean voltage commanded to each motor [V]
    Voltage([T; N]),
    /// Current in each motor [A]; all zero is the bridge open
    Current([T; N]),
    /// Speed of each wheel at its shaft [rad/s], imposed by a drive that follows it exactly
    Speed([T; N]),
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
    /// Angle that each wheel has turned through [rad]; kept up only while the model has effects
    pub wheel_angle: [T; N],
    /// Current in each motor at the end of the last step [A]
    pub current: [T; N],
    /// Bus voltage of the last step [V]
    pub bus: T,
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

/// A model ready to run: a robot and the effects that it carries.
#[derive(Clone, Copy, Debug)]
pub struct Plant<const N: usize, T: Real> {
    robot: Robot<N, T>,
    effects: Effects<N, T>,
    /// True if no effect stands between the command and the wheels' forces
    plain: bool,
    /// l·K_v [V·s]
    emf: T,
    /// l·K_t [N·m/A]
    kt: T,
    /// 1/R [1/Ω]
    per_resistance: T,
    /// The contacts as the robot's parameters describe them.
    contact: [Contact<T>; N],
    /// Each wheel's share of the body's Coulomb friction, as a torque at its shaft [N·m]
    coulomb_share: [T; N],
    /// Damping of the plain model in body axes: back-EMF and viscous friction
    plain_rate: [[T; 3]; 3],
}

/// What the wheels do to the body in a step.
struct Push<T> {
    /// Force in body axes [N, N, N·m]
    force: [T; 3],
    /// −∂force/∂twist
    rate: [[T; 3]; 3],
    /// Mass matrix of what turns with the wheels, in body axes
    mass: [[T; 3]; 3],
    /// True if any shaft has a dry-friction budget
    holds: bool,
}

impl<const N: usize, T: Real> Plant<N, T> {
    /// A model of this robot with these effects.
    pub fn new(robot: Robot<N, T>, effects: Effects<N, T>) -> Self {
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
        let chain = [Seam::Supply, Seam::Drive, Seam::Winding, Seam::Gear, Seam::Contact];
        let plain = chain.into_iter().all(|seam| effects.none_at(seam));
        Self { robot, effects, plain, emf, kt, per_resistance, contact, coulomb_share, plain_rate }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot<N, T> {
        &self.robot
    }

    /// The effects.
    pub fn effects(&self) -> &Effects<N, T> {
        &self.effects
    }

    /// How many numbers of memory a run needs: zero without effects that remember. They start at zero.
    pub fn memory_len(&self) -> usize {
        self.effects.memory_len()
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
    pub fn restart(&self, state: &State<N, T>, memory: &mut [T]) {
        let at = self.at(state, T::zero());
        for active in self.effects.with_memory() {
            if active.whole() {
                active.effect.restart(active.params(), &mut memory[active.memory(0)], &at);
                continue;
            }
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(&at, state, j, state.wheel_speed[j]);
                active.effect.restart(active.params(), &mut memory[active.memory(j)], &at);
            }
        }
    }

    /// Takes one step of `dt` [s] with the input held, and returns the reading at its beginning.
    ///
    /// `memory` is [`Plant::memory_len`] long.
    #[inline]
    pub fn step(&self, state: &mut State<N, T>, memory: &mut [T], input: &Input<N, T>, dt: T) -> Reading<N, T> {
        match input {
            Input::Voltage(command) if self.plain => {
                self.step_forces::<true>(state, memory, Source::Voltage(command), dt)
            }
            Input::Voltage(command) => self.step_forces::<false>(state, memory, Source::Voltage(command), dt),
            Input::Current(current) => self.step_forces::<false>(state, memory, Source::Current(current), dt),
            Input::Speed(speed) => self.step_speed_driven(state, memory, speed, dt),
        }
    }

    /// A step in which forces move the body. `PLAIN` leaves out, when compiled, what acts before the body, where nothing
    /// does; what stays is the same arithmetic in the same order.
    #[inline]
    fn step_forces<const PLAIN: bool>(
        &self,
        state: &mut State<N, T>,
        memory: &mut [T],
        source: Source<'_, N, T>,
        dt: T,
    ) -> Reading<N, T> {
        let zero = T::zero();
        let x = state.twist.to_array();
        let mut at = self.at(state, dt);
        let hooked;
        let contact = if PLAIN || self.effects.none_at(Seam::Contact) {
            &self.contact
        } else {
            hooked = self.contacts(&at, state, memory);
            &hooked
        };
        let rim: [T; N] = core::array::from_fn(|j| dot(contact[j].row, x));
        let bus = if PLAIN { self.robot.supply } else { self.bus(&at, state, memory, &source, contact, &rim) };
        let gain = if PLAIN { T::one() } else { bus / self.robot.supply };

        let mut truth = Reading { current: [zero; N], wheel_speed: [zero; N], pose: state.pose, gyro: state.twist.w };
        let mut push = Push { force: [zero; 3], rate: [[zero; 3]; 3], mass: [[zero; 3]; 3], holds: false };
        let mut held = [([zero; 3], zero); N];
        for j in 0..N {
            let c = &contact[j];
            at.wheel = j;
            at.rim_speed = rim[j];
            at.wheel_angle = state.wheel_angle[j];
            at.wheel_speed = rim[j] * c.per_radius;
            let mut electric = self.electric::<PLAIN>(&at, state, memory, &source, j, gain);
            let (mut speed, mut starts) = (at.wheel_speed, at.wheel_speed);
            let force = if PLAIN {
                // f = τ/r
                electric.torque * c.per_radius
            } else {
                let mut gear = self.gear(&at, memory, electric.torque);
                let (force, rate) = if c.rolls() {
                    // f = τ/r,  k = −∂f/∂v_j = (−∂τ/∂ω)/r²
                    if !self.effects.none_at(Seam::Gear) {
                        accumulate_outer(&mut push.mass, gear.inertia * (c.per_radius * c.per_radius), c.row);
                    }
                    let force = (gear.torque - gear.damping * speed) * c.per_radius;
                    (force, (electric.slope + gear.damping) * (c.per_radius * c.per_radius))
                } else {
                    let grip = self.grip(&mut at, state, memory, &source, c, gain, &mut electric, &mut gear);
                    speed = grip.wheel_speed;
                    // with inertia the wheel has not moved yet when the reading is taken
                    starts = if gear.inertia > zero { state.wheel_speed[j] } else { speed };
                    (grip.force, grip.rate)
                };
                accumulate_outer(&mut push.rate, rate, c.row);
                if gear.budget > zero {
                    push.holds = true;
                    held[j] = (c.row, gear.budget * c.per_radius);
                }
                force
            };
            truth.current[j] = electric.sampled;
            truth.wheel_speed[j] = starts;
            state.wheel_speed[j] = speed;
            state.current[j] = electric.after;
            for axis in 0..3 {
                push.force[axis] += c.row[axis] * force;
            }
        }
        if PLAIN {
            push.rate = self.plain_rate;
        }
        let next = self.move_body(&at, state, memory, &push, &held, dt);
        self.finish(state, memory, truth, next, contact, &source, bus, dt)
    }

    /// Moves the pose, takes the reading and lets the effects remember.
    #[inline]
    #[allow(clippy::too_many_arguments)]
    fn finish(
        &self,
        state: &mut State<N, T>,
        memory: &mut [T],
        truth: Reading<N, T>,
        next: [T; 3],
        contact: &[Contact<T>; N],
        source: &Source<'_, N, T>,
        bus: T,
        dt: T,
    ) -> Reading<N, T> {
        let sensed = !self.effects.none_at(Seam::Sense);
        let reading = if sensed { self.read(&self.at(state, dt), state, memory, truth) } else { truth };
        let next = BodyTwist::from_array(next);
        let mean = state.twist.mean(next);
        if !self.effects.is_empty() {
            self.remember(state, memory, &truth, source, bus, dt);
            for (j, c) in contact.iter().enumerate() {
                state.wheel_angle[j] += if c.rolls() {
                    dt * dot(c.row, mean.to_array()) * c.per_radius
                } else {
                    dt * T::lit(0.5) * (truth.wheel_speed[j] + state.wheel_speed[j])
                };
            }
        }
        state.pose = state.pose.moved(mean, dt);
        state.twist = next;
        state.time += dt;
        state.bus = bus;
        reading
    }

    #[inline]
    fn at(&self, state: &State<N, T>, dt: T) -> At<T> {
        At {
            time: state.time,
            dt,
            pose: state.pose,
            twist: state.twist,
            nominal_supply: self.robot.supply,
            ..At::default()
        }
    }

    /// The same, for a hook of wheel `j`.
    #[inline]
    fn at_wheel(&self, at: &At<T>, state: &State<N, T>, j: usize, wheel_speed: T) -> At<T> {
        let rim_speed = dot(self.contact[j].row, state.twist.to_array());
        At { wheel: j, wheel_angle: state.wheel_angle[j], wheel_speed, rim_speed, ..*at }
    }

    #[inline]
    fn contacts(&self, at: &At<T>, state: &State<N, T>, memory: &[T]) -> [Contact<T>; N] {
        let mut contact = self.contact;
        for active in self.effects.at(Seam::Contact) {
            for j in (0..N).filter(|j| active.on(*j)) {
                let at = self.at_wheel(at, state, j, state.wheel_speed[j]);
                active.effect.contact(active.params(), &memory[active.memory(j)], &at, &mut contact[j]);
            }
        }
        for c in &mut contact {
            c.per_radius = T::one() / c.radius;
        }
        contact
    }

    #[inline]
    fn gear(&self, at: &At<T>, memory: &[T], torque: T) -> Gear<T> {
        let zero = T::zero();
        let mut gear = Gear {
            motor_torque: torque,
            coulomb_share: self.coulomb_share[at.wheel],
            torque,
            budget: zero,
            damping: zero,
            inertia: zero,
        };
        for active in self.effects.on(Seam::Gear, at.wheel) {
            active.effect.gear(active.params(), &memory[active.memory(at.wheel)], at, &mut gear);
        }
        gear
    }
}

/// The input of a step in which forces move the body.
#[derive(Clone, Copy)]
enum Source<'a, const N: usize, T> {
    Voltage(&'a [T; N]),
    Current(&'a [T; N]),
    Speed,
}

impl<const N: usize, T: Real> Source<'_, N, T> {
    fn command(&self, wheel: usize) -> T {
        match self {
            Self::Voltage(u) => u[wheel],
            Self::Current(_) | Self::Speed => T::zero(),
        }
    }
}
