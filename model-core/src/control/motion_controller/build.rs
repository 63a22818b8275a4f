//! From settings to a controller: everything that does not change from turn to turn, worked out once.

use core::array;

use super::compensate::{self, CompensationTerms};
use super::{Controller, Settings, WheelMap};
use crate::control::compensation::Compensation;
use crate::control::reference::AccelerationLimiter;
use crate::effects::body::floor_tilt;
use crate::effects::drivetrain::gear_efficiency;
use crate::effects::electrical::motor_mismatch;
use crate::effects::seams::Winding;
use crate::geometry::kinematics::Wheels;
use crate::number::linalg::{Mat3, accumulate_outer, determinant3, inverse3, mul_mat_vec};
use crate::number::scalar::Real;

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
    let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    let columns = axes.map(|axis| wheels.wheel_forces(axis));
    let all: [[T; 3]; N] = array::from_fn(|j| columns.map(|column| column[j]));
    let lost = working.iter().filter(|works| !**works).count();
    if lost == 0 {
        return wheels.is_regular().then_some(Shares { rows: all, plane: one, turn: one });
    }
    if N - lost < 3 {
        return None;
    }
    let mut gram = [[zero; 3]; 3];
    for (row, _) in wheels.rows().iter().zip(working).filter(|(_, works)| **works) {
        accumulate_outer(&mut gram, one, *row);
    }
    // as for all wheels: det(GᵀG) against the most that columns so long can span
    let regular = determinant3(&gram) > T::lit(1.0e-9) * gram[0][0] * gram[1][1] * gram[2][2];
    if !regular {
        return None;
    }
    let inverse = inverse3(&gram);
    let rows = array::from_fn(|j| if working[j] { mul_mat_vec(&inverse, wheels.rows()[j]) } else { [zero; 3] });
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
        let Settings { robot, compensation, dt, .. } = settings;
        let dt = *dt;
        let shares = shares(&robot.wheels, &settings.working);
        let moves = shares.is_some();
        let Shares { rows, plane, turn } = shares.unwrap_or(Shares { rows: [[zero; 3]; N], plane: zero, turn: zero });
        let kt = robot.motor.wheel_torque_constant();
        let on = if settings.feedforward { one } else { zero };

        let mut drives = [WheelMap::default(); N];
        let mut all_rows = [[zero; 3]; N];
        let mut push = [zero; N];
        let mut windings = [(zero, zero); N];
        let mut turning = [[zero; 3]; 3];
        for j in 0..N {
            let rim = robot.wheels.wheels()[j].rim();
            let row = robot.wheels.rows()[j];
            let winding = motor_mismatch::odd(
                compensation.torque_constant_ratio[j],
                compensation.resistance_ratio[j],
                Winding {
                    current: zero,
                    speed: zero,
                    resistance: robot.motor.resistance,
                    inductance: zero,
                    emf_constant: robot.motor.wheel_emf_constant(),
                    torque_constant: kt,
                },
            );
            all_rows[j] = row.map(|g| rim.wheel_speed(g));
            drives[j] = WheelMap {
                row: if settings.working[j] { all_rows[j] } else { [zero; 3] },
                share: rows[j].map(|share| rim.wheel_torque(share) / winding.torque_constant),
            };
            windings[j] = (winding.resistance, winding.emf_constant * on);
            push[j] = rim.force(winding.torque_constant);
            // M → M + Σ J_w/r²·G_jᵀ·G_j: a lost wheel turns along
            accumulate_outer(&mut turning, rim.mass(compensation.rotor_inertia[j]), row);
        }
        let couples = |i: usize, k: usize| {
            let bound = T::lit(1e-12) * turning[i][i] * turning[k][k];
            turning[i][k] * turning[i][k] > bound
        };
        let coupled = couples(0, 1) || couples(0, 2) || couples(1, 2);
        let excess = array::from_fn(|j| compensation.stribeck[j].excess * robot.coulomb_shares()[j]);
        let acceleration = settings.acceleration;
        let mass = [
            on * (robot.mass + turning[0][0]),
            on * (robot.mass + turning[1][1]),
            on * (robot.inertia + turning[2][2]),
        ];
        Self {
            flags: flags(settings, moves, coupled),
            limiter: AccelerationLimiter::new(
                [acceleration[0] * plane, acceleration[1] * plane, acceleration[2] * turn],
                dt,
            ),
            rate: one / dt,
            mass,
            push: mass.map(|m| m / dt),
            viscous: robot.friction.viscous.map(|b| on * b),
            coulomb: robot.friction.coulomb.map(|c| on * c),
            gain: kt * settings.feedback,
            integral_gain: kt * settings.feedback_integral * dt,
            current_limit: settings.current_limit,
            max_duty: settings.max_duty,
            resistance: robot.motor.resistance,
            emf: robot.motor.wheel_emf_constant() * on,
            wheels: drives,
            compensation: compensation_terms(
                compensation,
                robot.mass,
                dt,
                &robot.wheels,
                Rows { windings, rows: all_rows, excess, push, turning },
            ),
        }
    }

    /// True if the robot can move with the wheels that work.
    pub fn moves(&self) -> bool {
        self.flags & compensate::IMMOBILE == 0
    }
}

/// Which parts of a turn's `compensation` there is something to do in.
fn flags<const N: usize, T: Real>(settings: &Settings<N, T>, moves: bool, coupled: bool) -> u32 {
    let compensation = &settings.compensation;
    let none = Compensation::<N, T>::none();
    let motion = settings.feedforward;
    let mismatch = compensation.torque_constant_ratio != none.torque_constant_ratio
        || compensation.resistance_ratio != none.resistance_ratio;
    let bit = |there: bool, bit: u32| if there { bit } else { 0 };
    bit(!moves, compensate::IMMOBILE)
        | bit(motion && compensation.coriolis != none.coriolis, compensate::CORIOLIS)
        | bit(motion && compensation.tilt != none.tilt, compensate::TILT)
        | bit(motion && compensation.stribeck.iter().any(|s| s.excess != T::zero()), compensate::STRIBECK)
        | bit(motion && coupled, compensate::COUPLING)
        | bit(compensation.gear_efficiency != none.gear_efficiency, compensate::GEAR)
        | bit(compensation.dead_time.iter().any(|d| d.voltage != T::zero()), compensate::DEAD_TIME)
        | bit(motion && compensation.creep != none.creep, compensate::CREEP)
        | bit(mismatch, compensate::MISMATCH)
        | bit(compensation.current_offset != none.current_offset, compensate::OFFSET)
}

/// What the wheels give to the effects.
struct Rows<const N: usize, T> {
    windings: [(T, T); N],
    rows: [[T; 3]; N],
    excess: [T; N],
    push: [T; N],
    turning: Mat3<T>,
}

fn compensation_terms<const N: usize, T: Real>(
    compensation: &Compensation<N, T>,
    mass: T,
    dt: T,
    wheels: &Wheels<N, T>,
    of: Rows<N, T>,
) -> CompensationTerms<N, T> {
    let one = T::one();
    CompensationTerms {
        winding: of.windings,
        coriolis: compensation.coriolis,
        mass,
        steepest: floor_tilt::steepest(compensation.tilt),
        downhill: compensation.downhill,
        half: T::lit(0.5) * dt,
        stribeck: compensation.stribeck,
        static_excess: of.excess,
        rows: of.rows,
        radius: wheels.wheels().map(|wheel| wheel.radius),
        per_radius: wheels.wheels().map(|wheel| one / wheel.radius),
        turning: of.turning,
        // driving: τ_w = τ_m − loss, driven: τ_w = τ_m + loss, and the loss is in proportion to τ_m
        gear: compensation.gear_efficiency.map(|efficiency| {
            [
                one / (one - gear_efficiency::loss(efficiency, one, one)),
                one / (one + gear_efficiency::loss(efficiency, one, -one)),
            ]
        }),
        dead_time: compensation.dead_time,
        kept: compensation.dead_time.iter().fold(T::zero(), |most, d| most.max(d.voltage)),
        creep: compensation.creep,
        push: of.push,
        spin: array::from_fn(|j| wheels.wheels()[j].rim().force(compensation.rotor_inertia[j])),
        offset: compensation.current_offset,
    }
}
