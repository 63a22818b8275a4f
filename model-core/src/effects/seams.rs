//! # Seams: what an effect sees and may change, one struct a seam
//!
//! The signal path of the robot is a chain of elements. Before the plant takes a step it describes every element with
//! one of these structs, filled with what the nominal model says; the effects that act at that seam change the
//! description; then the plant solves what is described. So an effect never integrates anything and never has to know
//! which other effects are there.

use crate::geometry::frames::{BodyTwist, Pose};
use crate::number::linalg::{accumulate_upper, add_scaled, dot};
use crate::number::scalar::Real;

/// Standard gravity [m/s²].
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Where and when an effect is asked.
#[derive(Clone, Copy, Debug, Default)]
pub struct EffectContext<T> {
    /// Time since the start of the run [s]
    pub time: T,
    /// Length of the step that is about to be taken [s]
    pub dt: T,
    /// The wheel, for an effect of wheels; 0 otherwise
    pub wheel: usize,
    /// Angle of that wheel since the start of the run [rad]; see [`Needs`](crate::effects::Needs), as for every angle
    pub wheel_angle: T,
    /// Speed of that wheel at the wheel shaft [rad/s]
    pub wheel_speed: T,
    /// Angle of that wheel's rotor since the start of the run, counted at the wheel shaft as every shaft quantity here:
    /// the wheel's own, but for what a shaft that yields is twisted by. Times [`EffectContext::gear_ratio`] and the
    /// number of pole pairs it is the electrical angle [rad]
    pub rotor_angle: T,
    /// Speed of that wheel's rotor, counted at the wheel shaft [rad/s]
    pub rotor_speed: T,
    /// Speed of that wheel's rim over the floor if it rolls [m/s]
    pub rim_speed: T,
    /// Heat that the current has made in that wheel's winding since the start of the run [J]; see
    /// [`Needs`](crate::effects::Needs)
    pub heat: T,
    /// l, motor speed over wheel speed [1]
    pub gear_ratio: T,
    /// Mean distance of the wheels' contacts from the centre [m]
    pub reach: T,
    /// Pose in the world frame; at the body seam the heading is that of the middle of the step, as is
    /// [`EffectContext::midway`]
    pub pose: Pose<T>,
    /// Velocity in the body frame
    pub twist: BodyTwist<T>,
    /// Acceleration of the body's centre in the last step, along the body's axes, the turning of the axes counted in:
    /// (dv/dt − ω·vn, dvn/dt + ω·v, dω/dt) [m/s², m/s², rad/s²]; see [`Needs`](crate::effects::Needs)
    pub acceleration: [T; 3],
    /// Bus voltage of the last step [V]
    pub bus: T,
    /// Bus voltage that the nominal model assumes [V]
    pub nominal_supply: T,
}

impl<T: Real> EffectContext<T> {
    /// The same, of no wheel in particular.
    #[inline]
    pub(crate) fn leave_wheel(&mut self) {
        let zero = T::zero();
        self.wheel = 0;
        (self.wheel_angle, self.wheel_speed) = (zero, zero);
        (self.rotor_angle, self.rotor_speed) = (zero, zero);
        (self.rim_speed, self.heat) = (zero, zero);
    }

    /// Where the robot is in the middle of the step, for an effect on the body, whose heading is that of the middle already
    /// [m, m].
    #[inline]
    pub fn midway(&self) -> [T; 2] {
        let (half, way) = (T::lit(0.5) * self.dt, self.pose.to_world(self.twist));
        // p + ½·Δt·ṗ
        [self.pose.x + half * way.x, self.pose.y + half * way.y]
    }
}

/// Drive that controls wheel speed: the speed that is set in, the wheel's out. All at the wheel shaft.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpeedDrive<T> {
    /// Speed that is set [rad/s]
    pub command: T,
    /// Speed of the wheel at the step's beginning, when it is read [rad/s]
    pub before: T,
    /// Its mean over the step [rad/s]
    pub mean: T,
    /// At the step's end [rad/s]
    pub after: T,
}

impl<T: Copy> SpeedDrive<T> {
    /// One that follows at once.
    #[inline]
    pub fn following(command: T) -> Self {
        Self { command, before: command, mean: command, after: command }
    }
}

/// Battery: bus current in, bus voltage out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Supply<T> {
    /// Current that all bridges together draw from the battery [A]
    pub current: T,
    /// Bus voltage [V]
    pub voltage: T,
}

/// Bridge: commanded voltage in, terminal voltage out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bridge<T> {
    /// Mean voltage that the controller commands [V]
    pub command: T,
    /// Bus voltage [V]
    pub bus: T,
    /// Motor current [A]
    pub current: T,
    /// Mean voltage across the motor over this step [V]
    pub voltage: T,
    /// Voltage across the motor at the instant at which the current is sampled, just after the step's beginning [V]
    pub sampled: T,
    /// Voltage that is lost against the current, whichever way it flows [V]
    pub drop: T,
    /// Voltage that is lost besides against a current that brakes the rotor [V]; never more than the back-EMF, which has to
    /// drive the current through what takes it
    pub braking_drop: T,
    /// Current from which all of either is lost; below, in proportion [A]
    pub drop_current: T,
    /// Most current that the bridge lets flow, either way: it lowers its voltage for that [A]; zero: any
    pub current_limit: T,
}

/// Winding: terminal voltage in, shaft torque out. Constants are those of the wheel shaft, the gear ratio included.
#[derive(Clone, Copy, Debug, Default)]
pub struct Winding<T> {
    /// Motor current [A]
    pub current: T,
    /// Speed that the back-EMF sees, at the wheel shaft [rad/s]
    pub speed: T,
    /// Resistance [Ω]
    pub resistance: T,
    /// Inductance [H]; zero: the current follows at once
    pub inductance: T,
    /// Back-EMF over wheel speed, l·K_v [V/(rad/s)]
    pub emf_constant: T,
    /// Wheel torque over current, l·K_t [N·m/A]
    pub torque_constant: T,
    /// Torque on the rotor that no current makes, its mean over the step, at the wheel shaft [N·m]
    pub torque: T,
    /// ∂(l·K_t)/∂i of a torque constant that depends on the current [N·m/A²]
    pub torque_bend: T,
}

/// Shaft: what connects the rotor with the wheel, gear included. All at the wheel shaft.
///
/// It is rigid unless it has a stiffness. One that yields lets the rotor run ahead of the wheel by a twist φ, through the
/// play first, and has the rotor move on its own:
///
/// ```text
/// J·dω_r/dt = τ_motor − τ_s,  dφ/dt = ω_r − ω_w,  τ_s = k·(φ beyond ±½·play) + c·(ω_r − ω_w)
/// ```
///
/// with the damping where the teeth touch.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shaft<T> {
    /// J, inertia that turns with the rotor [kg·m²]
    pub inertia: T,
    /// k, torque over twist [N·m/rad]; zero: rigid
    pub stiffness: T,
    /// c, torque over the rate of twist [N·m·s]
    pub damping: T,
    /// Twist from one flank of the teeth to the other [rad]
    pub play: T,
    /// J of a rotor on a shaft that yields where no effect gives it any: it could not move on its own [kg·m²]
    pub rotor: T,
}

/// Gear: motor torque in, wheel torque out. All at the wheel shaft.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gear<T> {
    /// Torque of the motor before any loss [N·m]
    pub motor_torque: T,
    /// This wheel's share of the body's Coulomb friction, as a torque [N·m]
    pub coulomb_share: T,
    /// Torque that goes on to the wheel [N·m]
    pub torque: T,
    /// Dry friction that the shaft can hold [N·m]: a budget, spent by the plant
    pub budget: T,
    /// What the budget lies about [N·m]: friction takes bias + budget from a wheel that turns forwards, bias − budget from
    /// one that turns backwards, and what is between from one that is held. No larger than the budget, or it would drive
    pub bias: T,
    /// Viscous friction [N·m·s]
    pub damping: T,
    /// Inertia that turns with the wheel [kg·m²]
    pub inertia: T,
}

/// Contact: wheel torque in, force on the floor out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact<T> {
    /// Rim speed over body twist: (cos α, sin α, d) [1, 1, m]
    pub row: [T; 3],
    /// True if the direction (cos α, sin α) has no derivatives; the plant works it out again after the effects
    pub fixed_direction: bool,
    /// Where the wheel touches the floor, in the body's axes (v, vn) [m]
    pub position: [T; 2],
    /// Wheel radius [m]
    pub radius: T,
    /// 1/radius [1/m]; the plant works it out again after the effects
    pub per_radius: T,
    /// Normal force [N]
    pub load: T,
    /// By how much that grows, over itself, with the robot's acceleration along its axes (v, vn) and the height of its centre
    /// of mass [1/(m·m/s²)]
    pub load_shift: [T; 2],
    /// Slip speed per traction, of a contact that creeps [(m/s)/N]; zero: it rolls rigidly
    pub creep: T,
    /// Friction coefficient of a contact that can slip; zero: it holds any force
    pub grip: T,
    /// Stiffness of the slip curve [1/(m/s)]
    pub stiffness: T,
    /// Shape of the slip curve: 1 rises to the limit, above 1 falls after a peak
    pub shape: T,
    /// Curvature of the slip curve: 0 for a round knee, below 0 for a sharper one
    pub curvature: T,
    /// J of a wheel that may slip, with all that turns with it on a rigid shaft, where no effect of shaft or gear gives it any:
    /// its speed would jump with every voltage [kg·m²]
    pub inertia: T,
    /// Dry friction of the rollers, along the wheel's axle [N]: a budget, spent by the plant
    pub roller_friction: T,
    /// Viscous friction of the rollers, along the wheel's axle [N·s/m]
    pub roller_damping: T,
}

impl<T: Real> Contact<T> {
    /// True if the wheel rolls rigidly: whatever the force, its rim is as fast as the floor passes by.
    #[inline]
    pub fn rolls(&self) -> bool {
        self.grip <= T::zero() && self.creep <= T::zero()
    }

    /// Speed of the rim over the floor if the wheel rolls, at a body twist [m/s].
    #[inline(always)]
    pub fn rim_speed(&self, twist: BodyTwist<T>) -> T {
        let BodyTwist { v, vn, w } = &twist;
        if !self.fixed_direction {
            return dot(self.row, [*v, *vn, *w]);
        }
        let [cos, sin, distance] = self.row.each_ref().map(|x| x.plain());
        // cos α·v + sin α·vn + d·ω
        let speed = v.plain() * cos + vn.plain() * sin + distance * w.plain();
        T::chain(speed, [(v, cos), (vn, sin), (w, distance), (&self.row[2], w.plain())])
    }

    /// Adds a force of the rim to one on the body, in the body's axes.
    #[inline(always)]
    pub fn add_force(&self, body: &mut [T; 3], force: T) {
        if !self.fixed_direction {
            *body = add_scaled(*body, force, self.row);
            return;
        }
        let [cos, sin, distance] = self.row.each_ref().map(|x| x.plain());
        body[0].add_chain(force.plain() * cos, [(&force, cos)]);
        body[1].add_chain(force.plain() * sin, [(&force, sin)]);
        body[2].add_chain(force.plain() * distance, [(&force, distance), (&self.row[2], force.plain())]);
    }

    /// Adds something in proportion to the rim's speed, such as −∂force/∂speed or an inertia, to one of the body, which is
    /// symmetric: on its diagonal and above.
    #[inline(always)]
    pub fn add_rate(&self, body: &mut [[T; 3]; 3], rate: T) {
        if !self.fixed_direction {
            return accumulate_upper(body, rate, self.row);
        }
        let [cos, sin, distance] = self.row.each_ref().map(|x| x.plain());
        let arm = &self.row[2];
        // rate·row·rowᵀ
        let (along, across, about) = (rate.plain() * cos, rate.plain() * sin, rate.plain() * distance);
        body[0][0].add_chain(along * cos, [(&rate, cos * cos)]);
        body[0][1].add_chain(along * sin, [(&rate, cos * sin)]);
        body[1][1].add_chain(across * sin, [(&rate, sin * sin)]);
        body[0][2].add_chain(along * distance, [(&rate, cos * distance), (arm, along)]);
        body[1][2].add_chain(across * distance, [(&rate, sin * distance), (arm, across)]);
        body[2][2].add_chain(about * distance, [(&rate, distance * distance), (arm, about + about)]);
    }

    /// Works out what follows from what effects may have changed.
    #[inline]
    pub(crate) fn complete(&mut self) {
        self.per_radius = T::one() / self.radius;
        self.fixed_direction = self.row[0].is_constant() && self.row[1].is_constant();
    }

    /// How fast the contact moves along the wheel's axle, over body twist [1, 1, m]; there the rollers turn.
    #[inline]
    pub fn axle_row(&self) -> [T; 3] {
        let [cos, sin, _] = self.row;
        let [x, y] = self.position;
        // the axle points along (sin α, −cos α), the contact moves with (v − ω·y, vn + ω·x)
        [sin, -cos, -(sin * y + cos * x)]
    }

    /// True if the rollers have friction.
    #[inline]
    pub fn rollers_drag(&self) -> bool {
        !self.roller_friction.is_nothing() || !self.roller_damping.is_nothing()
    }
}

/// Body: forces in, acceleration out. Axes are those of the body: (v, vn, ω).
#[derive(Clone, Copy, Debug, Default)]
pub struct Body<T> {
    /// Mass matrix about the centre that poses and rows refer to, symmetric [kg, kg·m, kg·m²]
    pub mass: [[T; 3]; 3],
    /// Force of the wheels and of all else but dry friction [N, N, N·m]
    pub force: [T; 3],
    /// −∂force/∂twist: damping, and the rate of turning forces
    pub rate: [[T; 3]; 3],
    /// Dry friction that the floor can hold [N, N, N·m]: a budget, spent by the plant
    pub budget: [T; 3],
}

impl<T: Real> Body<T> {
    /// How much it weighs [kg].
    #[inline]
    pub fn total_mass(&self) -> T {
        self.mass[0][0]
    }

    /// Adds a force (v, vn) [N, N] and its rate −∂force/∂(v, vn) [N·s/m].
    #[inline]
    pub fn push(&mut self, force: [T; 2], rate: [[T; 2]; 2]) {
        // 0 − a, taken away: what is absent keeps even the sign of a zero
        self.force.iter_mut().zip(force).for_each(|(sum, a)| *sum -= T::zero() - a);
        let rows = self.rate.iter_mut().zip(rate).flat_map(|(sums, row)| sums.iter_mut().zip(row));
        rows.for_each(|(sum, a)| *sum -= T::zero() - a);
    }
}

/// Sensors: truth in, reading out. An effect of wheels gets its wheel's current and speed; one of the robot the rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sense<T> {
    /// Motor current [A]
    pub current: T,
    /// Wheel speed at the wheel shaft [rad/s]
    pub wheel_speed: T,
    /// Pose in the world frame
    pub pose: Pose<T>,
    /// Yaw rate [rad/s]
    pub gyro: T,
}

/// What happened in a step, for effects that remember. An effect of wheels gets its own wheel's numbers; one of the
/// robot the supply's and the body's, with `command`, `current` and `wheel_speed` zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepOutcome<T> {
    /// Commanded voltage [V]
    pub command: T,
    /// Speed that is set, where a drive controls it [rad/s]
    pub set_speed: T,
    /// Motor current [A]
    pub current: T,
    /// Wheel speed at the wheel shaft [rad/s]
    pub wheel_speed: T,
    /// Heat that the current made in this wheel's winding [J]; see [`Needs`](crate::effects::Needs)
    pub heat: T,
    /// Current drawn from the battery [A]
    pub bus_current: T,
    /// Mean of the velocity over the step, in the body frame, of an effect of the robot
    pub mean_twist: BodyTwist<T>,
    /// Bus voltage [V]
    pub bus: T,
}
