//! From settings to a controller: everything that does not change from turn to turn, worked out once.

use core::array;

use super::terms::{self, CompensationTerms};
use super::{Controller, Settings, WheelMap};
use crate::control::braking::BrakingBand;
use crate::control::compensation::Compensation;
use crate::control::reference::AccelerationLimiter;
use crate::effects::EffectSet;
use crate::effects::seams::{EffectContext, Shaft, Winding};
use crate::effects::undoing::{BridgeRoom, Place};
use crate::geometry::kinematics::{Wheel, Wheels};
use crate::number::linalg::{Mat3, accumulate_outer, add_scaled};
use crate::number::scalar::Real;
use crate::plant::robot::Robot;

/// How the wheels that work share a body force, and by how much less they can do than all together.
struct Shares<const N: usize, T> {
    /// Wheel force over body force, (GᵀG)⁻¹·G_j [1, 1, 1/m]; zero for a lost wheel
    rows: [[T; 3]; N],
    /// Force in the plane, and torque, for the same largest wheel force; 1 with all wheels [1]
    plane: T,
    /// [1]
    turn: T,
}

/// The shares of the wheels that work; `None` if they cannot move the robot as it likes.
fn shares<const N: usize, T: Real>(wheels: &Wheels<N, T>, working: &[bool; N]) -> Option<Shares<N, T>> {
    let (zero, one) = (T::zero(), T::one());
    let all = wheels.force_shares();
    let count = working.iter().filter(|works| **works).count();
    if count == N {
        return wheels.is_regular().then_some(Shares { rows: all, plane: one, turn: one });
    }
    if count < 3 {
        return None;
    }
    // of four wheels one is lost
    let mut three = [Wheel::default(); 3];
    let kept = wheels.wheels().iter().zip(working).filter(|(_, works)| **works);
    three.iter_mut().zip(kept).for_each(|(slot, (wheel, _))| *slot = *wheel);
    let three = Wheels::new(three);
    if !three.is_regular() {
        return None;
    }
    let mut shares = three.force_shares().into_iter();
    let rows = working.map(|works| if works { shares.next().unwrap_or([zero; 3]) } else { [zero; 3] });
    // the largest wheel force for one newton in the plane, in its worst direction, and for one newton metre
    let plane = |rows: &[[T; 3]; N]| rows.iter().fold(zero, |most, r| most.max((r[0] * r[0] + r[1] * r[1]).sqrt()));
    let turn = |rows: &[[T; 3]; N]| rows.iter().fold(zero, |most, r| most.max(r[2].abs()));
    Some(Shares { rows, plane: (plane(&all) / plane(&rows)).min(one), turn: (turn(&all) / turn(&rows)).min(one) })
}

impl<const N: usize, T: Real> Controller<N, T> {
    /// The controller of these settings.
    ///
    /// A robot that has lost more than its wheels allow gets one that stays: see [`Controller::moves`].
    pub fn new(settings: &Settings<N, T>) -> Self {
        let (zero, one) = (T::zero(), T::one());
        let Settings { robot: nominal, compensation, dt, .. } = settings;
        let dt = *dt;
        let contacts = compensation.contacts(&nominal.wheels);
        let robot = Robot { wheels: compensation.own_wheels(&nominal.wheels), ..*nominal };
        let shares = shares(&robot.wheels, &settings.working);
        let moves = shares.is_some();
        let Shares { rows, plane, turn } = shares.unwrap_or(Shares { rows: [[zero; 3]; N], plane: zero, turn: zero });
        let kt = robot.motor.wheel_torque_constant();
        let on = if settings.feedforward { one } else { zero };

        let mut drives = [WheelMap::default(); N];
        let mut all_rows = [[zero; 3]; N];
        let mut push = [zero; N];
        let mut spin = [zero; N];
        let mut turning = [[zero; 3]; 3];
        for j in 0..N {
            let rim = robot.wheels.wheels()[j].rim();
            let row = robot.wheels.rows()[j];
            let (winding, inertia) = undone_wheel(settings, j);
            all_rows[j] = row.map(|g| rim.wheel_speed(g));
            drives[j] = WheelMap {
                row: if settings.working[j] { all_rows[j] } else { [zero; 3] },
                share: rows[j].map(|share| rim.wheel_torque(share) / winding.torque_constant),
                resistance: winding.resistance,
                emf: winding.emf_constant * on,
                per_reading: true_speed(compensation, j),
            };
            push[j] = rim.force(winding.torque_constant);
            spin[j] = rim.force(inertia);
            // M → M + Σ J_w/r²·G_jᵀ·G_j: a lost wheel turns along
            accumulate_outer(&mut turning, rim.mass(inertia), row);
        }
        let added = added_mass(compensation, nominal);
        for (sum, row) in turning.iter_mut().zip(added) {
            *sum = add_scaled(*sum, one, row);
        }
        let couples = |i: usize, k: usize| {
            let bound = T::lit(1e-12) * turning[i][i] * turning[k][k];
            turning[i][k] * turning[i][k] > bound
        };
        let coupled = couples(0, 1) || couples(0, 2) || couples(1, 2);
        let mass = [
            on * (robot.mass + turning[0][0]),
            on * (robot.mass + turning[1][1]),
            on * (robot.inertia + turning[2][2]),
        ];
        let room = bridge_room(compensation);
        let effects = compensation.in_signal_order();
        let places = places(&effects);
        let mut controller = Self {
            flags: flags(&places, settings.feedforward, moves, coupled),
            limiter: AccelerationLimiter::new([zero; 3], dt),
            reduced: [plane, turn],
            rate: one / dt,
            mass,
            viscous: robot.friction.viscous.map(|b| on * b),
            coulomb: robot.friction.coulomb.map(|c| on * c),
            gain: kt * settings.feedback,
            integral_gain: kt * settings.feedback_integral * dt,
            current_limit: [settings.current_limit; N],
            least_current: settings.current_limit,
            braking: settings.braking,
            max_duty: room.share * settings.max_duty,
            kept: room.kept,
            wheels: drives,
            compensation: CompensationTerms {
                effects,
                places,
                mass: robot.mass,
                moment: [added[2][0], added[2][1]],
                half: T::lit(0.5) * dt,
                coulomb_share: nominal.coulomb_shares(),
                rows: all_rows,
                axles: contacts.map(|contact| contact.axle_row()),
                radius: robot.wheels.wheels().map(|wheel| wheel.radius),
                per_radius: robot.wheels.wheels().map(|wheel| one / wheel.radius),
                coupling: array::from_fn(|i| array::from_fn(|k| if i == k { zero } else { turning[i][k] })),
                push,
                spin,
            },
        };
        controller.set_acceleration(settings.acceleration);
        controller
    }

    /// From now on the reference changes no faster along v, along vn and about the vertical [m/s², m/s², rad/s²]; less with
    /// a wheel lost.
    pub fn set_acceleration(&mut self, acceleration: [T; 3]) {
        let [plane, turn] = self.reduced;
        let limits = [acceleration[0] * plane, acceleration[1] * plane, acceleration[2] * turn];
        self.limiter = AccelerationLimiter::new(limits, T::lit(2.0) * self.compensation.half);
    }

    /// From now on braking currents fade so.
    pub fn set_braking(&mut self, braking: BrakingBand<T>) {
        self.braking = braking;
    }

    /// From now on no motor is asked for more than this [A].
    pub fn limit_currents(&mut self, most: [T; N]) {
        self.current_limit = most;
        self.least_current = most.iter().fold(most[0], |least, limit| least.min(*limit));
    }

    /// True if the robot can move with the wheels that work.
    pub fn moves(&self) -> bool {
        self.flags & terms::IMMOBILE == 0
    }
}

/// The winding of a wheel with its effects in it, and the inertia that they make turn with the wheel [kg·m²].
fn undone_wheel<const N: usize, T: Real>(settings: &Settings<N, T>, j: usize) -> (Winding<T>, T) {
    let zero = T::zero();
    let motor = settings.robot.motor;
    let mut winding = Winding {
        current: zero,
        speed: zero,
        resistance: motor.resistance,
        inductance: zero,
        emf_constant: motor.wheel_emf_constant(),
        torque_constant: motor.wheel_torque_constant(),
        torque: zero,
        torque_bend: zero,
    };
    let mut shaft = Shaft::default();
    let at = EffectContext { wheel: j, ..EffectContext::default() };
    for undo in settings.compensation.on(j) {
        undo.effect.winding(&[], &at, &mut winding);
        undo.effect.shaft(&[], &at, &mut shaft);
    }
    (winding, shaft.inertia)
}

/// What effects on the body add to its mass matrix.
fn added_mass<const N: usize, T: Real>(compensation: &Compensation<N, T>, robot: &Robot<N, T>) -> Mat3<T> {
    let zero = T::zero();
    let own = [[robot.mass, zero, zero], [zero, robot.mass, zero], [zero, zero, robot.inertia]];
    let mut mass = own;
    compensation.iter().for_each(|undo| undo.effect.fold_mass(&mut mass));
    array::from_fn(|i| array::from_fn(|k| mass[i][k] - own[i][k]))
}

/// True speed of a wheel over the one that is read [1].
fn true_speed<const N: usize, T: Real>(compensation: &Compensation<N, T>, j: usize) -> T {
    let mut speed = T::one();
    compensation.on(j).for_each(|undo| undo.effect.fold_reading(&mut speed));
    speed
}

/// What the bridges leave of the voltage, each wheel's own added up, and the least of them.
fn bridge_room<const N: usize, T: Real>(compensation: &Compensation<N, T>) -> BridgeRoom<T> {
    let whole = BridgeRoom { share: T::one(), kept: T::zero() };
    (0..N).fold(whole, |least, j| {
        let mut room = whole;
        compensation.on(j).for_each(|undo| undo.effect.bridge_room(&mut room));
        BridgeRoom { share: least.share.min(room.share), kept: least.kept.max(room.kept) }
    })
}

/// Which effects are undone where.
fn places<const N: usize, T: Real>(compensation: &Compensation<N, T>) -> [u32; Place::COUNT] {
    let mut places = [0; Place::COUNT];
    for (k, undo) in compensation.iter().enumerate() {
        if let Some(place) = undo.effect.kind().undone_at() {
            places[place as usize] |= 1 << k;
        }
    }
    places
}

/// Which parts of a turn's `compensation` there is something to do in.
fn flags(places: &[u32; Place::COUNT], motion: bool, moves: bool, coupled: bool) -> u32 {
    let undone = |at: &[Place]| at.iter().any(|place| places[*place as usize] != 0);
    let bit = |there: bool, bit: u32| if there { bit } else { 0 };
    bit(!moves, terms::IMMOBILE)
        | bit(motion && undone(&[Place::Body, Place::Rollers, Place::Shaft]), terms::FORCES)
        | bit(motion && coupled, terms::COUPLING)
        | bit(motion && undone(&[Place::Contact]), terms::CONTACT)
        | bit(undone(&[Place::Gear, Place::Winding]), terms::RATIO)
        | bit(undone(&[Place::Bridge, Place::Reading]), terms::LAST)
}
