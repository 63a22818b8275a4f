//! # The paper's two robots (Table 3)
//!
//! Generated from `examples/feup-3w/robot.toml` and `examples/feup-4w/robot.toml` by `cargo xtask bless`; to change a
//! number, change it there. Both are one prototype that carries three or four wheels.
//!
//! Source: Oliveira, Sousa, Moreira, Costa, ICINCO 2008, Table 3, figures 2 and 3. The paper takes K_t = K_v; the bus
//! voltage is not the paper's.

use crate::geometry::kinematics::{Wheel, Wheels};
use crate::number::scalar::Real;
use crate::plant::robot::{Friction, Robot};
use crate::plant::winding::Motor;

/// The robot of `examples/feup-3w/robot.toml`.
pub fn three_wheels<T: Real>() -> Robot<3, T> {
    Robot {
        // α [°], d [m], r [m]
        wheels: Wheels::new([
            Wheel::from_degrees(150.0, T::lit(0.089), T::lit(0.0325)),
            Wheel::from_degrees(270.0, T::lit(0.089), T::lit(0.0325)),
            Wheel::from_degrees(30.0, T::lit(0.089), T::lit(0.0325)),
        ]),
        motor: Motor {
            // l [1]
            gear_ratio: T::lit(5.0),
            // R [Ω]
            resistance: T::lit(4.3111),
            // K_v [V/(rad/s)]
            emf_constant: T::lit(0.0259),
            // K_t [N·m/A]
            torque_constant: T::lit(0.0259),
        },
        // M [kg]
        mass: T::lit(1.944),
        // J [kg·m²]
        inertia: T::lit(0.0169),
        friction: Friction {
            // (B_v, B_vn, B_ω) [N·s/m, N·s/m, N·m·s]
            viscous: [T::lit(0.5082), T::lit(0.487), T::lit(0.013)],
            // (C_v, C_vn, C_ω) [N, N, N·m]
            coulomb: [T::lit(1.9068), T::lit(2.0423), T::lit(0.0971)],
        },
        // bus voltage [V]
        supply: T::lit(12.0),
    }
}

/// The robot of `examples/feup-4w/robot.toml`.
pub fn four_wheels<T: Real>() -> Robot<4, T> {
    Robot {
        // α [°], d [m], r [m]
        wheels: Wheels::new([
            Wheel::from_degrees(90.0, T::lit(0.089), T::lit(0.0325)),
            Wheel::from_degrees(180.0, T::lit(0.089), T::lit(0.0325)),
            Wheel::from_degrees(270.0, T::lit(0.089), T::lit(0.0325)),
            Wheel::from_degrees(0.0, T::lit(0.089), T::lit(0.0325)),
        ]),
        motor: Motor {
            // l [1]
            gear_ratio: T::lit(5.0),
            // R [Ω]
            resistance: T::lit(4.3111),
            // K_v [V/(rad/s)]
            emf_constant: T::lit(0.0259),
            // K_t [N·m/A]
            torque_constant: T::lit(0.0259),
        },
        // M [kg]
        mass: T::lit(2.34),
        // J [kg·m²]
        inertia: T::lit(0.0228),
        friction: Friction {
            // (B_v, B_vn, B_ω) [N·s/m, N·s/m, N·m·s]
            viscous: [T::lit(0.4978), T::lit(0.6763), T::lit(0.0141)],
            // (C_v, C_vn, C_ω) [N, N, N·m]
            coulomb: [T::lit(1.8738), T::lit(2.2198), T::lit(0.1385)],
        },
        // bus voltage [V]
        supply: T::lit(12.0),
    }
}
