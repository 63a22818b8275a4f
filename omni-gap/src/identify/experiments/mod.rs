//! # The three experiments, as the paper did them
//!
//! Oliveira et al. identify a robot by a handful of runs, each of which leaves most of the equations out: a steady spin
//! (friction about ω), a coast-down with the bridges open (friction over mass), steady motors (R, K_v), and a driven step
//! (everything that moves, by regression). [`classic`] does all four and averages as the paper does. Each estimate has
//! the uncertainty that leaving out one run after the other shows.
//!
//! These are estimates to compare with, and a way in for somebody who knows the paper; the better one is
//! [`joint`](super::joint), which fits all runs together.

mod bins;
mod coast;
mod holds;
mod motor;
mod regress;
mod spin;
mod step;

pub use coast::{coast, coast_inertia};
pub use motor::motor;
pub use regress::Estimate;
pub use spin::spin;
pub use step::{Method, Stepped, step};

use crate::simulate::{Experiment, Model, Recorded};
use model_core::robot::Robot;

/// What the experiments say, each on its own, and their average.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Classic {
    /// Experiment 1: B_ω [N·m·s], C_ω [N·m]
    pub spin: Option<[Estimate; 2]>,
    /// Experiment 2 along v and vn: B [N·s/m], C [N]
    pub coast: [Option<[Estimate; 2]>; 2],
    /// Experiment 2 about ω, with experiment 1: J [kg·m²]
    pub coast_inertia: Option<Estimate>,
    /// Motor experiment: R [Ω], K_v [V·s]
    pub motor: Option<[Estimate; 2]>,
    /// Experiment 3 by least squares.
    pub least_squares: Option<Stepped>,
    /// Experiment 3 by instrumental variables.
    pub instrumental: Option<Stepped>,
}

/// Does every experiment that there are runs of. `model` is what is known before: geometry, mass, K_t and K_v are taken
/// from it, and first guesses of the rest.
pub fn classic<const N: usize>(model: &Model<N>, runs: &[Recorded<N>]) -> Classic {
    let of = |wanted| runs.iter().filter(|r| Experiment::of(&r.name) == Some(wanted)).collect::<Vec<_>>();
    let spun = spin(model, &of(Experiment::Spin));
    let coasts = of(Experiment::Coast);
    let coasted = coast(model, &coasts);
    let friction = model.plant().robot().friction;
    let known = |axis: usize| Estimate { value: friction.coulomb[axis], std: 0.0 };
    let coulomb = [0, 1].map(|axis| coasted[axis].map_or(known(axis), |[_, c]| c));
    let steps = of(Experiment::Step);
    Classic {
        spin: spun,
        coast: coasted,
        coast_inertia: spun.and_then(|[b, c]| coast_inertia(model, &coasts, b.value, c.value)),
        motor: motor(model, &of(Experiment::Motor)),
        least_squares: step(model, &steps, coulomb, Method::LeastSquares),
        instrumental: step(model, &steps, coulomb, Method::Instrumental),
    }
}

/// Force of these currents on the body [N, N, N·m] (eq. 13–20).
fn traction<const N: usize>(robot: &Robot<N, f64>, amps: &[f64; N]) -> [f64; 3] {
    let kt = robot.motor.wheel_torque_constant();
    let wheels = robot.wheels.wheels();
    // f_j = l·K_t·i_j/r
    robot.wheels.body_force(std::array::from_fn(|j| kt * amps[j] / wheels[j].radius))
}
