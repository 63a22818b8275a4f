//! # The paper's robots as Rust, from their robot files
//!
//! The numbers of Table 3 are written once, in `examples/feup-3w/robot.toml` and `examples/feup-4w/robot.toml`. What the
//! core ships as `model_core::plant::paper` is made from them here, so that a robot without a file system has them too.

use std::path::Path;

use omni_gap::known_effects;
use omni_gap::log::{RobotFile, WheelFile};

/// The robot files, from the top of the tree, and the functions that they become.
pub const ROBOTS: [(&str, &str); 2] =
    [("examples/feup-3w/robot.toml", "three_wheels"), ("examples/feup-4w/robot.toml", "four_wheels")];

/// Where the source stands, from the top of the tree.
pub const OUTPUT_PATH: &str = "model-core/src/plant/paper.rs";

const HEAD: &str = "\
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
";

/// The top of the tree.
pub fn tree() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a folder above this crate")
}

/// The source of `model_core::plant::paper`, as rustfmt leaves it.
///
/// # Panics
/// If a robot file cannot be read, or states no supply.
pub fn paper_source() -> String {
    let function = |(path, name): (&str, &str)| {
        let file = RobotFile::load(&tree().join(path), &known_effects()).unwrap_or_else(|why| panic!("{why}"));
        robot(&file, path, name)
    };
    HEAD.to_owned() + &ROBOTS.map(function).concat()
}

/// One robot as a function. The comments between the fields keep every field on a line of its own.
fn robot(file: &RobotFile, path: &str, name: &str) -> String {
    let RobotFile { motor, body, friction: f, .. } = file;
    let list = |numbers: [f64; 3]| numbers.map(|x| format!("T::lit({x:?})")).join(", ");
    let viscous = list([f.viscous_v_n_s_per_m, f.viscous_vn_n_s_per_m, f.viscous_w_nm_s]);
    let coulomb = list([f.coulomb_v_n, f.coulomb_vn_n, f.coulomb_w_nm]);
    let supply = file.supply.expect("the examples state their supply").voltage_v;
    let wheel = |w: &WheelFile| {
        let WheelFile { drive_angle_deg, distance_m, radius_m } = w;
        format!("            Wheel::from_degrees({drive_angle_deg:?}, T::lit({distance_m:?}), T::lit({radius_m:?})),\n")
    };
    let wheels: String = file.wheel.iter().map(wheel).collect();
    let count = file.wheel.len();
    format!(
        "
/// The robot of `{path}`.
pub fn {name}<T: Real>() -> Robot<{count}, T> {{
    Robot {{
        // α [°], d [m], r [m]
        wheels: Wheels::new([
{wheels}        ]),
        motor: Motor {{
            // l [1]
            gear_ratio: T::lit({:?}),
            // R [Ω]
            resistance: T::lit({:?}),
            // K_v [V/(rad/s)]
            emf_constant: T::lit({:?}),
            // K_t [N·m/A]
            torque_constant: T::lit({:?}),
        }},
        // M [kg]
        mass: T::lit({:?}),
        // J [kg·m²]
        inertia: T::lit({:?}),
        friction: Friction {{
            // (B_v, B_vn, B_ω) [N·s/m, N·s/m, N·m·s]
            viscous: [{viscous}],
            // (C_v, C_vn, C_ω) [N, N, N·m]
            coulomb: [{coulomb}],
        }},
        // bus voltage [V]
        supply: T::lit({supply:?}),
    }}
}}
",
        motor.gear_ratio,
        motor.resistance_ohm,
        motor.emf_constant_v_s,
        motor.torque_constant_nm_per_a,
        body.mass_kg,
        body.inertia_kg_m2,
    )
}
