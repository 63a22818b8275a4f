//! A, B and K of the core, by the derivatives of one of its steps.
//!
//! The plant has no matrices; it has a step, which for the plain model is the linearly implicit midpoint rule
//!
//! ```text
//! x⁺ = x + Δt·(1 − ½·Δt·A)⁻¹·(A·x + B·u + K·sign(x))
//! ```
//!
//! Dual numbers give G = ∂x⁺/∂x and H = ∂x⁺/∂u of the code as it runs, and the rule turned round gives
//!
//! ```text
//! A = 2/Δt·(G − 1)·(G + 1)⁻¹,   B = (1 − ½·Δt·A)·H/Δt,   K·sign(x) = (1 − ½·Δt·A)·(x⁺ − G·x − H·u)/Δt
//! ```

use model_core::effects::active::Effects;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};
use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::generic_robot::Drivetrain;
use crate::matrices::Matrices;

/// v, vn, ω and up to four voltages.
type D = Dual<7>;

/// A long step, so that differences of near numbers do not come in [s].
const STEP: f64 = 0.1;

/// A motion that no friction ends within the step, whatever the paper's robot [m/s, m/s, rad/s].
const TWIST: [f64; 3] = [1.0, 1.2, 6.0];

/// The matrices of a robot of the core.
///
/// # Panics
/// If friction stops an axis within the step.
pub fn of_the_core<const N: usize>(robot: Robot<N, D>) -> Matrices<N> {
    let rows = *robot.wheels.rows();
    let motor = robot.motor;
    let radius = robot.wheels.wheels().map(|wheel| wheel.radius);
    let inertia = Vector3::new(robot.mass.re, robot.mass.re, robot.inertia.re);
    let plant = Plant::new(robot, Effects::default());
    let twist: [D; 3] = std::array::from_fn(|axis| D::variable(TWIST[axis], axis));
    let volts: [D; N] = std::array::from_fn(|j| D::variable(0.0, 3 + j));
    let mut state = plant.start(D::constant(0.0), Pose::default(), BodyTwist::from_array(twist));
    plant.step(&mut state, &mut [], &Input::Voltage(volts), D::constant(STEP));
    let next = state.twist.to_array();
    assert!(next.iter().all(|x| x.re > 0.0), "friction has ended the motion: {next:?}");

    let g = Matrix3::from_fn(|row, column| next[row].eps[column]);
    let h = SMatrix::<f64, 3, N>::from_fn(|row, j| next[row].eps[3 + j]);
    // A = 2/Δt·(G − 1)·(G + 1)⁻¹
    let one = Matrix3::identity();
    let a = (g - one) * (g + one).try_inverse().expect("a step that damps") * (2.0 / STEP);
    let back = (one - a * (0.5 * STEP)) / STEP;
    Matrices {
        a,
        // B = (1 − ½·Δt·A)·H/Δt
        b: back * h,
        // K·sign(x) = (1 − ½·Δt·A)·(x⁺ − G·x)/Δt, with u = 0 and every sign 1
        k: back * (Vector3::from(next.map(|x| x.re)) - g * Vector3::from(TWIST)),
        rim: SMatrix::<f64, N, 3>::from_fn(|j, axis| rows[j][axis].re),
        inertia,
        drivetrains: radius.map(|r| Drivetrain {
            radius: r.re,
            gear: motor.gear_ratio.re,
            kv: motor.emf_constant.re,
            kt: motor.torque_constant.re,
            resistance: motor.resistance.re,
        }),
    }
}
