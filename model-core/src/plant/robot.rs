//! # Robot: the parameters of the plain model
//!
//! What the paper's equations need to know of a robot: where its wheels are, its motors, its body and the body's
//! friction. The model without effects is the paper's: quasi-static motors, rigid rolling, no velocity cross terms.
//!
//! ```text
//! M·v̇  = ΣF_v  − B_v·v   − C_v·sign(v)         (eq. 10)
//! M·v̇n = ΣF_vn − B_vn·vn − C_vn·sign(vn)       (eq. 11)
//! J·ω̇  = ΣΓ    − B_ω·ω   − C_ω·sign(ω)         (eq. 12)
//! ```

use crate::geometry::kinematics::Wheels;
use crate::number::scalar::Real;
use crate::plant::winding::Motor;

/// Viscous and Coulomb friction of the body, axis by axis (eq. 10–12).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Friction<T = f32> {
    /// (B_v, B_vn, B_ω) [N·s/m, N·s/m, N·m·s]
    pub viscous: [T; 3],
    /// (C_v, C_vn, C_ω) [N, N, N·m]
    pub coulomb: [T; 3],
}

/// The plain model of one robot with `N` wheels, three or four.
#[derive(Clone, Copy, Debug)]
pub struct Robot<const N: usize, T = f32> {
    /// Where the wheels are.
    pub wheels: Wheels<N, T>,
    /// The motors, one model for all wheels.
    pub motor: Motor<T>,
    /// M [kg]
    pub mass: T,
    /// J [kg·m²]
    pub inertia: T,
    /// Friction of the body.
    pub friction: Friction<T>,
    /// Bus voltage that the commanded voltages refer to [V]
    pub supply: T,
}

/// What a nominal value may be wrong by: a factor on each, one where it is right.
///
/// These are the free numbers of a re-fit; what each one is called and how it is measured says its card in
/// [`effects::nominal`](crate::effects::nominal). Radius and distance are common to all wheels: what sets one wheel apart
/// is an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nominal {
    /// M
    Mass,
    /// J
    Inertia,
    /// R
    Resistance,
    /// K_t and K_v together
    TorqueConstant,
    /// K_t alone: K_t over K_v
    KtOverKv,
    /// B_v
    ViscousV,
    /// B_vn
    ViscousVn,
    /// B_ω
    ViscousW,
    /// C_v
    CoulombV,
    /// C_vn
    CoulombVn,
    /// C_ω
    CoulombW,
    /// r of all wheels
    WheelRadius,
    /// d of all wheels
    CenterDistance,
}

impl Nominal {
    /// How many there are.
    pub const COUNT: usize = 13;

    /// All of them; the order is that of [`Robot::scaled`]'s factors.
    pub const ALL: [Nominal; Self::COUNT] = [
        Nominal::Mass,
        Nominal::Inertia,
        Nominal::Resistance,
        Nominal::TorqueConstant,
        Nominal::KtOverKv,
        Nominal::ViscousV,
        Nominal::ViscousVn,
        Nominal::ViscousW,
        Nominal::CoulombV,
        Nominal::CoulombVn,
        Nominal::CoulombW,
        Nominal::WheelRadius,
        Nominal::CenterDistance,
    ];
}

impl<const N: usize, T: Real> Robot<N, T> {
    /// Each wheel's share of the body's Coulomb friction, as a torque at its shaft [N·m].
    ///
    /// The force that each wheel would have to give for the body's (C_v, C_vn) to come from the wheels alone.
    pub fn coulomb_shares(&self) -> [T; N] {
        let mut reach = T::zero();
        for row in self.wheels.rows() {
            reach += row[0].abs() + row[1].abs();
        }
        // F_c = (C_v + C_vn) / Σ_j (|cos α_j| + |sin α_j|),  τ_c = r_j·F_c
        let coulomb = (self.friction.coulomb[0] + self.friction.coulomb[1]) / reach;
        self.wheels.wheels().map(|wheel| coulomb * wheel.radius)
    }

    /// Mechanical time constants: how fast a motion along each body axis decays while the motors' voltages are held, dry
    /// friction left out [s].
    pub fn time_constants(&self) -> [T; 3] {
        let mut rate = self.friction.viscous;
        for (row, wheel) in self.wheels.rows().iter().zip(self.wheels.wheels()) {
            for (rate, along) in rate.iter_mut().zip(row) {
                // A_kk = B_k + Σ_j (l²·K_t·K_v/R)·(d_jk/r_j)²
                let per_radius = *along / wheel.radius;
                *rate += self.motor.damping() * per_radius * per_radius;
            }
        }
        // T_k = M_kk/A_kk
        [self.mass / rate[0], self.mass / rate[1], self.inertia / rate[2]]
    }

    /// The robot with every nominal value multiplied by its factor, in the order of [`Nominal::ALL`].
    pub fn scaled(&self, factor: &[T; Nominal::COUNT]) -> Self {
        let f = |p: Nominal| factor[p as usize];
        let mut viscous = self.friction.viscous;
        let mut coulomb = self.friction.coulomb;
        for axis in 0..3 {
            viscous[axis] *= factor[Nominal::ViscousV as usize + axis];
            coulomb[axis] *= factor[Nominal::CoulombV as usize + axis];
        }
        let torque_constant = self.motor.torque_constant * f(Nominal::TorqueConstant) * f(Nominal::KtOverKv);
        Self {
            wheels: self.wheels.scaled(f(Nominal::WheelRadius), f(Nominal::CenterDistance)),
            motor: Motor {
                resistance: self.motor.resistance * f(Nominal::Resistance),
                emf_constant: self.motor.emf_constant * f(Nominal::TorqueConstant),
                torque_constant,
                ..self.motor
            },
            mass: self.mass * f(Nominal::Mass),
            inertia: self.inertia * f(Nominal::Inertia),
            friction: Friction { viscous, coulomb },
            supply: self.supply,
        }
    }
}
