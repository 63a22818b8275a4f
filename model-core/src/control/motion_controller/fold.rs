//! From settings to a controller: everything that does not change from turn to turn, worked out once.

use core::array;

use super::undo::{self, Undo};
use super::{Controller, Drive, Settings};
use crate::control::compensation::Compensation;
use crate::control::reference::Limiter;
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
        let Settings { robot, undo, dt, .. } = settings;
        let dt = *dt;
        let shares = shares(&robot.wheels, &settings.working);
        let moves = shares.is_some();
        let Shares { rows, plane, turn } = shares.unwrap_or(Shares { rows: [[zero; 3]; N], plane: zero, turn: zero });
        let kt = robot.motor.wheel_torque_constant();
        let on = if settings.feedforward { one } else { zero };

        let mut drives = [Drive::default(); N];
        let mut all_rows = [[zero; 3]; N];
        let mut push = [zero; N];
        let mut windings = [(zero, zero); N];
        let mut turning = [[zero; 3]; 3];
        for j in 0..N {
            let rim = robot.wheels.wheels()[j].rim();
            let row = robot.wheels.rows()[j];
            let winding = motor_mismatch::odd(
                undo.torque_constant_ratio[j],
                undo.resistance_ratio[j],
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
            drives[j] = Drive {
                row: if settings.working[j] { all_rows[j] } else { [zero; 3] },
                share: rows[j].map(|share| rim.wheel_torque(share) / winding.torque_constant),
            };
            windings[j] = (winding.resistance, winding.emf_constant * on);
            push[j] = rim.force(winding.torque_constant);
            // M → M + Σ J_w/r²·G_jᵀ·G_j: a lost wheel turns along
            accumulate_outer(&mut turning, rim.mass(undo.rotor_inertia[j]), row);
        }
        let couples = |i: usize, k: usize| {
            let bound = T::lit(1e-12) * turning[i][i] * turning[k][k];
            turning[i][k] * turning[i][k] > bound
        };
        let coupled = couples(0, 1) || couples(0, 2) || couples(1, 2);
        let excess = array::from_fn(|j| undo.stribeck[j].excess * robot.coulomb_shares()[j]);
        let acceleration = settings.acceleration;
        let mass = [
            on * (robot.mass + turning[0][0]),
            on * (robot.mass + turning[1][1]),
            on * (robot.inertia + turning[2][2]),
        ];
        Self {
            flags: flags(settings, moves, coupled),
            limiter: Limiter::new([acceleration[0] * plane, acceleration[1] * plane, acceleration[2] * turn], dt),
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
            drives,
            undo: fold(undo, robot.mass, dt, &robot.wheels, Rows { windings, rows: all_rows, excess, push, turning }),
        }
    }

    /// True if the robot can move with the wheels that work.
    pub fn moves(&self) -> bool {
        self.flags & undo::STAYS == 0
    }
}

/// Which parts of a turn's `undo` there is something to do in.
fn flags<const N: usize, T: Real>(settings: &Settings<N, T>, moves: bool, coupled: bool) -> u32 {
    let undo = &settings.undo;
    let none = Compensation::<N, T>::none();
    let motion = settings.feedforward;
    let mismatch =
        undo.torque_constant_ratio != none.torque_constant_ratio || undo.resistance_ratio != none.resistance_ratio;
    let bit = |there: bool, bit: u32| if there { bit } else { 0 };
    bit(!moves, undo::STAYS)
        | bit(motion && undo.coriolis != none.coriolis, undo::CORIOLIS)
        | bit(motion && undo.tilt != none.tilt, undo::TILT)
        | bit(motion && undo.stribeck.iter().any(|s| s.excess != T::zero()), undo::STRIBECK)
        | bit(motion && coupled, undo::COUPLING)
        | bit(undo.gear_efficiency != none.gear_efficiency, undo::GEAR)
        | bit(undo.dead_time.iter().any(|d| d.voltage != T::zero()), undo::DEAD_TIME)
        | bit(motion && undo.creep != none.creep, undo::CREEP)
        | bit(mismatch, undo::MISMATCH)
        | bit(undo.current_offset != none.current_offset, undo::OFFSET)
}

/// What the wheels give to the effects.
struct Rows<const N: usize, T> {
    windings: [(T, T); N],
    rows: [[T; 3]; N],
    excess: [T; N],
    push: [T; N],
    turning: Mat3<T>,
}

fn fold<const N: usize, T: Real>(
    undo: &Compensation<N, T>,
    mass: T,
    dt: T,
    wheels: &Wheels<N, T>,
    of: Rows<N, T>,
) -> Undo<N, T> {
    let one = T::one();
    Undo {
        winding: of.windings,
        coriolis: undo.coriolis,
        mass,
        steepest: floor_tilt::steepest(undo.tilt),
        downhill: undo.downhill,
        half: T::lit(0.5) * dt,
        stribeck: undo.stribeck,
        static_excess: of.excess,
        rows: of.rows,
        radius: wheels.wheels().map(|wheel| wheel.radius),
        per_radius: wheels.wheels().map(|wheel| one / wheel.radius),
        turning: of.turning,
        // driving: τ_w = τ_m − loss, driven: τ_w = τ_m + loss, and the loss is in proportion to τ_m
        gear: undo.gear_efficiency.map(|efficiency| {
            [
                one / (one - gear_efficiency::loss(efficiency, one, one)),
                one / (one + gear_efficiency::loss(efficiency, one, -one)),
            ]
        }),
        dead_time: undo.dead_time,
        kept: undo.dead_time.iter().fold(T::zero(), |most, d| most.max(d.voltage)),
        creep: undo.creep,
        push: of.push,
        spin: array::from_fn(|j| wheels.wheels()[j].rim().force(undo.rotor_inertia[j])),
        offset: undo.current_offset,
    }
}
