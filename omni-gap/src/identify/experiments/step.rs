//! Experiment 3: a driven step with an initial ramp, one axis at a time.
//!
//! ```text
//! M·dv/dt + C_v·sign(v) = (1/R)·(U − b·v) − B_v·v                  U = Σ_j g_j·l·K_t·u_j/r,  b = l²·K_t·K_v/r²·Σ_j g_j²
//!   dω/dt = (1/J)·(U − b·ω)/R − (B_ω/J)·ω − (C_ω/J)·sign(ω)        with R of the axes v and vn
//! θ = (XᵀX)⁻¹·Xᵀ·y     (eq. 38–40)          θ = (ZᵀX)⁻¹·Zᵀ·y     (eq. 41–42)
//! ```
//!
//! Velocities are noisy, and they stand in X: least squares is drawn down by that. The instruments Z are the same columns
//! made of a simulation with the numbers found so far, which has no part in the noise. C_v and C_vn are those of
//! experiment 2, as in the paper.
//!
//! Velocities and their differences belong to stretches that follow one another (trapezoid rule). What that rule costs
//! is seen on the simulation, whose numbers are known: it is asked the same way, and by how much it is misread is taken
//! off. What is left of an error is the noise's.

use super::bins::{Bin, bins};
use super::regress::{Estimate, Rows, jackknife};
use crate::simulate::{AXES, AlignedRun, FreeRun, Model, SignalGroup, Slot};
use model_core::plant::robot::{Nominal, Robot};

/// Length of a stretch over which a velocity is taken [s]: by a camera, by wheel speeds
const STRETCH: (f64, f64) = (0.12, 0.04);
/// A simulated stretch slower than this share of the run's fastest is left out: its friction may have changed sign.
const SLOWEST: f64 = 0.1;
/// Times that the simulation is made again with what it gave.
const ROUNDS: usize = 4;

/// What experiment 3 says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepped {
    /// R [Ω]
    pub resistance: Estimate,
    /// J [kg·m²]
    pub inertia: Estimate,
    /// B_v, B_vn, B_ω [N·s/m, N·s/m, N·m·s]
    pub viscous: [Estimate; 3],
    /// C_ω [N·m]
    pub coulomb_w: Estimate,
}

/// How the equations are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Least squares.
    LeastSquares,
    /// Instrumental variables.
    Instrumental,
}

/// The numbers in the order R, J, B_v, B_vn, B_ω, C_ω.
type Six = [f64; 6];

/// R, J, B and C_ω from steps; `friction` are C_v and C_vn of experiment 2 [N], whose uncertainty goes on into these.
pub fn step<const N: usize>(
    model: &Model<N>,
    runs: &[&AlignedRun<N>],
    friction: [Estimate; 2],
    method: Method,
) -> Option<Stepped> {
    let coulomb = friction.map(|c| c.value);
    let robot = *model.plant().robot();
    let measured: Vec<Vec<Bin<N>>> = runs.iter().map(|run| bins(run, &robot.wheels, stretch(run))).collect();
    let solve = |bins: &[Vec<Bin<N>>], simulated: &[Vec<[f64; 3]>], coulomb, without| {
        let kept = bins.iter().zip(simulated).zip(runs).enumerate().filter(|(k, _)| Some(*k) != without);
        let kept: Vec<_> =
            kept.map(|(_, ((bins, simulated), run))| (bins.as_slice(), simulated, axis_of(run))).collect();
        solved(&robot, &kept, coulomb, method)
    };
    // the signs of friction and the instruments are those of a simulation, first of the model as it is known
    let (mut known, mut instruments, mut misread) = (model.clone(), Vec::new(), [0.0; 6]);
    for _ in 0..ROUNDS {
        instruments = runs.iter().zip(&measured).map(|(run, bins)| simulated(&known, run, bins)).collect::<Vec<_>>();
        let replayed: Vec<Vec<Bin<N>>> = measured.iter().zip(&instruments).map(|(b, x)| with_twists(b, x)).collect();
        let truth = six_of(&known);
        let friction = known.plant().robot().friction.coulomb;
        let read = solve(&replayed, &instruments, [friction[0], friction[1]], None)?;
        misread = std::array::from_fn(|k| read[k] - truth[k]);
        let raw = solve(&measured, &instruments, coulomb, None)?;
        known = with(model, raw[0] - misread[0], raw[1] - misread[1]);
    }
    let corrected = |raw: Six| std::array::from_fn(|k| raw[k] - misread[k]);
    let mut six = jackknife(runs.len(), |without| solve(&measured, &instruments, coulomb, without).map(corrected))?;
    for axis in [0, 1].into_iter().filter(|axis| friction[*axis].std.is_finite()) {
        let mut other = coulomb;
        other[axis] += friction[axis].std;
        let moved: Six = corrected(solve(&measured, &instruments, other, None)?);
        for (e, moved) in six.iter_mut().zip(moved) {
            e.std = e.std.hypot(moved - e.value);
        }
    }
    let [resistance, inertia, v, vn, w, coulomb_w] = six;
    Some(Stepped { resistance, inertia, viscous: [v, vn, w], coulomb_w })
}

/// The same stretches with other twists.
fn with_twists<const N: usize>(bins: &[Bin<N>], twists: &[[f64; 3]]) -> Vec<Bin<N>> {
    bins.iter().zip(twists).map(|(bin, twist)| Bin { twist: *twist, ..*bin }).collect()
}

/// A model's own numbers.
fn six_of<const N: usize>(model: &Model<N>) -> Six {
    let robot = *model.plant().robot();
    let [v, vn, w] = robot.friction.viscous;
    [robot.motor.resistance, robot.inertia, v, vn, w, robot.friction.coulomb[2]]
}

fn stretch<const N: usize>(run: &AlignedRun<N>) -> f64 {
    if run.has_group(SignalGroup::WheelSpeed) { STRETCH.1 } else { STRETCH.0 }
}

/// The axis that a run is about: `step-vn-50-1` is about vn.
fn axis_of<const N: usize>(run: &AlignedRun<N>) -> Option<usize> {
    let word = run.name.split('-').nth(1)?;
    AXES.iter().position(|axis| *axis == word)
}

/// The model with this R and J, as far as they are believable (a factor of five). The rest of what steps say is too
/// uncertain to make instruments better by it: v and vn have R and friction all but in one.
fn with<const N: usize>(model: &Model<N>, resistance: f64, inertia: f64) -> Model<N> {
    let robot = *model.plant().robot();
    let mut model = model.clone();
    for (p, new, old) in
        [(Nominal::Resistance, resistance, robot.motor.resistance), (Nominal::Inertia, inertia, robot.inertia)]
    {
        let slot = Slot::Nominal(p);
        model.set(slot, model.get(slot) * (new / old).clamp(0.2, 5.0));
    }
    model
}

/// Mean twists over the stretches, by a free run of the model from rest.
fn simulated<const N: usize>(model: &Model<N>, run: &AlignedRun<N>, bins: &[Bin<N>]) -> Vec<[f64; 3]> {
    let plant = model.plant();
    let mut on_the_way = FreeRun::new(&plant, run);
    // ∫ twist dt up to each row
    let mut way = vec![[0.0; 3]; run.rows() + 1];
    for row in 0..run.rows() {
        let before = on_the_way.state().twist;
        on_the_way.pass(row, &run.input(row));
        let mean = before.mean(on_the_way.state().twist).to_array();
        way[row + 1] = std::array::from_fn(|a| way[row][a] + mean[a] * run.dt[row]);
    }
    let mean = |bin: &Bin<N>| std::array::from_fn(|a| (way[bin.rows.1][a] - way[bin.rows.0][a]) / bin.dt);
    bins.iter().map(mean).collect()
}

/// A run as the equations see it: its stretches, their simulated twists, its axis.
type Seen<'a, const N: usize> = (&'a [Bin<N>], &'a Vec<[f64; 3]>, Option<usize>);

fn solved<const N: usize>(
    robot: &Robot<N, f64>,
    runs: &[Seen<'_, N>],
    coulomb: [f64; 2],
    method: Method,
) -> Option<Six> {
    let along = |axis: usize| -> Option<[f64; 2]> {
        let mut rows = Rows::<2>::default();
        for p in pairs(runs, axis) {
            let (force, braking) = push(robot, axis, &p.volts);
            let x = |speed: f64| [force - braking * speed, -speed];
            rows.push(robot.mass * p.slope + coulomb[axis] * p.way, x(p.speed), x(p.simulated));
        }
        by(&rows, method)
    };
    let [per_v, viscous_v] = along(0)?;
    let [per_vn, viscous_vn] = along(1)?;
    let resistance = 2.0 / (per_v + per_vn);
    let mut rows = Rows::<3>::default();
    for p in pairs(runs, 2) {
        let (torque, braking) = push(robot, 2, &p.volts);
        let x = |speed: f64| [(torque - braking * speed) / resistance, -speed, -p.way];
        rows.push(p.slope, x(p.speed), x(p.simulated));
    }
    let [per_inertia, viscous_w, coulomb_w] = by(&rows, method)?;
    let inertia = 1.0 / per_inertia;
    Some([resistance, inertia, viscous_v, viscous_vn, viscous_w * inertia, coulomb_w * inertia])
}

fn by<const K: usize>(rows: &Rows<K>, method: Method) -> Option<[f64; K]> {
    match method {
        Method::LeastSquares => rows.least_squares(),
        Method::Instrumental => rows.instrumental(),
    }
}

/// R times the force of these voltages on an axis, and R times its braking by back-EMF per speed: U and b above.
fn push<const N: usize>(robot: &Robot<N, f64>, axis: usize, volts: &[f64; N]) -> (f64, f64) {
    let (kt, kv) = (robot.motor.wheel_torque_constant(), robot.motor.wheel_emf_constant());
    let (mut force, mut braking) = (0.0, 0.0);
    for ((row, wheel), u) in robot.wheels.rows().iter().zip(robot.wheels.wheels()).zip(volts) {
        force += row[axis] * kt * u / wheel.radius;
        braking += row[axis] * row[axis] * kt * kv / (wheel.radius * wheel.radius);
    }
    (force, braking)
}

/// Two stretches that follow one another in which the robot goes on in one direction.
struct Pair<const N: usize> {
    speed: f64,
    simulated: f64,
    slope: f64,
    way: f64,
    volts: [f64; N],
}

fn pairs<const N: usize>(runs: &[Seen<'_, N>], axis: usize) -> Vec<Pair<N>> {
    let mut all = Vec::new();
    for (bins, simulated, _) in runs.iter().filter(|run| run.2 == Some(axis)) {
        let fastest = simulated.iter().fold(0.0, |most: f64, x| most.max(x[axis].abs()));
        for (w, s) in bins.windows(2).zip(simulated.windows(2)) {
            let (a, b, sa, sb) = (w[0].twist[axis], w[1].twist[axis], s[0][axis], s[1][axis]);
            let slow = sa.abs().min(sb.abs()) < SLOWEST * fastest || sa * sb <= 0.0;
            if slow || w[0].rows.1 != w[1].rows.0 || w[0].open != Some(false) || w[1].open != Some(false) {
                continue;
            }
            let length = 0.5 * (w[0].dt + w[1].dt);
            all.push(Pair {
                speed: 0.5 * (a + b),
                simulated: 0.5 * (sa + sb),
                slope: (b - a) / length,
                way: sa.signum(),
                volts: std::array::from_fn(|j| 0.5 * (w[0].volts[j] + w[1].volts[j])),
            });
        }
    }
    all
}
