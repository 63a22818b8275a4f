//! Eq. 2–9: what the wheels' speeds are, and the body's speeds from them.

use std::fmt::Write;

use model_core::plant::paper::{four_wheels, three_wheels};
use model_core::plant::robot::Robot;
use nalgebra::{Matrix3, SMatrix};

use crate::matrices::Matrices;
use crate::paper::{FOUR_WHEELS, THREE_WHEELS};

/// Eq. 3–5 as printed: v, vn, ω from the rim speeds of three wheels.
pub fn inverse_three(d: f64) -> SMatrix<f64, 3, 3> {
    let (third, root) = (1.0 / 3.0, 3.0_f64.sqrt() / 3.0);
    // v = (√3/3)·(v2 − v0),  vn = ⅓·(v0 + v2) − ⅔·v1,  ω = (v0 + v1 + v2)/(3·d)
    Matrix3::new(-root, 0.0, root, third, -2.0 * third, third, third / d, third / d, third / d)
}

/// Eq. 7–9 as printed: v, vn, ω from the rim speeds of four wheels.
pub fn inverse_four(d: f64) -> SMatrix<f64, 3, 4> {
    let q = 0.25 / d;
    // v = ½·(v3 − v1),  vn = ½·(v0 − v2),  ω = (v0 + v1 + v2 + v3)/(4·d)
    SMatrix::<f64, 3, 4>::from_row_slice(&[0.0, -0.5, 0.0, 0.5, 0.5, 0.0, -0.5, 0.0, q, q, q, q])
}

/// The same of the core, column by column: the body's speeds for a speed of 1 m/s of one rim alone.
pub fn inverse_of_the_core<const N: usize>(robot: &Robot<N, f64>) -> SMatrix<f64, 3, N> {
    let column = |j: usize| robot.wheels.twist(std::array::from_fn(|k| f64::from(u8::from(j == k)))).to_array();
    SMatrix::<f64, 3, N>::from_fn(|row, j| column(j)[row])
}

fn rows<const N: usize>(
    page: &mut String,
    name: &str,
    printed: &SMatrix<f64, 3, N>,
    forward: &SMatrix<f64, N, 3>,
    core: &Robot<N, f64>,
) {
    let cells = |m: &SMatrix<f64, 3, N>, row: usize| {
        // −0 is 0
        m.row(row).iter().map(|x| format!("{:.4}", x + 0.0)).collect::<Vec<_>>().join(", ").replace("-0.0000", "0.0000")
    };
    let from_core = inverse_of_the_core(core);
    for (row, axis) in ["v", "vn", "ω"].into_iter().enumerate() {
        let _ = writeln!(page, "| {name} | {axis} | {} | {} |", cells(printed, row), cells(&from_core, row));
    }
    let off = (printed * forward - Matrix3::identity()).amax();
    let said = if off < 1e-15 * 10.0 { "the identity, to rounding".to_owned() } else { format!("off by {off:.1e}") };
    let _ = writeln!(page, "| {name} | inverse × forward | {said} | |");
}

/// The section of the page.
pub fn section() -> String {
    let mut page = "## Kinematics, eq. 2–9\n\n".to_owned();
    page += "Each row gives a body speed by the rim speeds v0, v1 … [1, 1, 1/m]. Three rim speeds determine the three body speeds;\n";
    page += "of four, eq. 7–9 are the least squares, and so is the core's inverse. Nothing differs.\n\n";
    page += "| robot | speed | printed (eq. 3–5, 7–9) | core |\n|---|---|---|---|\n";
    let (three, four) = (Matrices::<3>::printed(&THREE_WHEELS), Matrices::<4>::printed(&FOUR_WHEELS));
    rows(&mut page, "three wheels", &inverse_three(THREE_WHEELS.d), &three.rim, &three_wheels());
    rows(&mut page, "four wheels", &inverse_four(FOUR_WHEELS.d), &four.rim, &four_wheels());
    page
}
