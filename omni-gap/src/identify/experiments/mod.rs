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

use crate::simulate::{AlignedRun, Experiment, Model, Slot};
use model_core::plant::robot::{Nominal, Robot};

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

/// Does every experiment that there are runs of. `model` is what is known before: geometry and mass are taken from it,
/// K_t and K_v where there is no motor experiment, and first guesses of the rest.
pub fn classic<const N: usize>(model: &Model<N>, runs: &[AlignedRun<N>]) -> Classic {
    let of = |wanted| runs.iter().filter(|r| Experiment::of(&r.name) == Some(wanted)).collect::<Vec<_>>();
    let motor = motor(model, &of(Experiment::Motor));
    let model = &with_motor(model, motor);
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
        motor,
        least_squares: step(model, &steps, coulomb, Method::LeastSquares),
        instrumental: step(model, &steps, coulomb, Method::Instrumental),
    }
}

/// The model with what the motor experiment says; the paper takes K_t = K_v.
fn with_motor<const N: usize>(model: &Model<N>, motor: Option<[Estimate; 2]>) -> Model<N> {
    let mut model = model.clone();
    let Some([resistance, emf_constant]) = motor else { return model };
    let nominal = model.plant().robot().motor;
    for (p, found, known) in [
        (Nominal::Resistance, resistance.value, nominal.resistance),
        (Nominal::TorqueConstant, emf_constant.value, nominal.emf_constant),
    ] {
        let slot = Slot::Nominal(p);
        // a motor experiment that went wrong must not take the others with it
        model.set(slot, model.get(slot) * (found / known).clamp(0.2, 5.0));
    }
    model
}

/// Force of these currents on the body [N, N, N·m] (eq. 13–20).
fn traction<const N: usize>(robot: &Robot<N, f64>, amps: &[f64; N]) -> [f64; 3] {
    let kt = robot.motor.wheel_torque_constant();
    let wheels = robot.wheels.wheels();
    // f_j = l·K_t·i_j/r
    robot.wheels.body_force(std::array::from_fn(|j| kt * amps[j] / wheels[j].radius))
}

impl Stepped {
    /// The number of experiment 3, where it has one.
    pub fn of(&self, nominal: Nominal) -> Option<Estimate> {
        match nominal {
            Nominal::Resistance => Some(self.resistance),
            Nominal::Inertia => Some(self.inertia),
            Nominal::ViscousV => Some(self.viscous[0]),
            Nominal::ViscousVn => Some(self.viscous[1]),
            Nominal::ViscousW => Some(self.viscous[2]),
            Nominal::CoulombW => Some(self.coulomb_w),
            _ => None,
        }
    }
}

impl Classic {
    /// The number of experiments 1 and 2 and of the motor's (the paper's Table 1), where there is one.
    pub fn first(&self, nominal: Nominal) -> Option<Estimate> {
        match nominal {
            Nominal::Resistance => self.motor.map(|[r, _]| r),
            Nominal::TorqueConstant => self.motor.map(|[_, k]| k),
            Nominal::Inertia => self.coast_inertia,
            Nominal::ViscousV => self.coast[0].map(|[b, _]| b),
            Nominal::ViscousVn => self.coast[1].map(|[b, _]| b),
            Nominal::CoulombV => self.coast[0].map(|[_, c]| c),
            Nominal::CoulombVn => self.coast[1].map(|[_, c]| c),
            Nominal::ViscousW => self.spin.map(|[b, _]| b),
            Nominal::CoulombW => self.spin.map(|[_, c]| c),
            _ => None,
        }
    }

    /// The paper's final number (Table 3): the mean of Table 1 and experiment 3, but R as experiment 3 has it, and what
    /// only one of them has as it is.
    pub fn table(&self, nominal: Nominal) -> Option<Estimate> {
        let (first, third) = (self.first(nominal), self.instrumental.and_then(|s| s.of(nominal)));
        match (first, third) {
            (Some(_), Some(third)) if nominal == Nominal::Resistance => Some(third),
            (Some(a), Some(b)) => Some(Estimate { value: 0.5 * (a.value + b.value), std: 0.5 * a.std.hypot(b.std) }),
            (first, third) => first.or(third),
        }
    }
}
