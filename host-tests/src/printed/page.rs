//! `golden/paper.md`: the sections in the order of the paper's argument, and what they come to.

use std::fmt::Write;

use super::tables::{FOUR, R_STEADY, THREE};
use super::{averages, dynamics, kinematics, terms};

/// The page.
pub fn page() -> String {
    let mut page = "# The paper's numbers, printed and computed\n\n".to_owned();
    page += "Oliveira, Sousa, Moreira, Costa, *Dynamical Models for Omni-directional Robots with 3 and 4 Wheels*, ICINCO 2008. Every\n";
    page += "printed figure stands beside the one that comes out when it is computed. This page is made by\n";
    page += "`host-tests/tests/paper_page.rs` from `host-tests/src/printed`; `cargo xtask bless` rewrites it.\n\n";
    page += &found();
    for section in [kinematics::section(), dynamics::section(), averages::section(), terms::section(), disagree()] {
        page.push('\n');
        page += &section;
    }
    page
}

/// The list of discrepancies.
fn found() -> String {
    let (three, four) = (terms::computed(&THREE, R_STEADY, false), terms::computed(&FOUR, R_STEADY, false));
    let (lo, hi) = terms::common_resistance();
    format!(
        "\
| where | printed | computed | why |
|---|---|---|---|
| eq. 33, row of vn, column of wheel 1 | +1/M | −1/M | sign error; eq. 2, 14 and 32 have it right |
| Table 1 | J {:.3} (four wheels), and others | {:.4} | cut after three places, not rounded |
| Table 3, R | {:.4} Ω | mean {:.4} Ω | experiment 3's, not a mean; Table 1 has {R_STEADY} |
| 5.4, back-EMF and drive, both robots | {:.4}, {:.4}; {:.4}, {:.4} | {:.4}, {:.4}; {:.4}, {:.4} | computed with R of {lo:.6} to {hi:.6} Ω |
| 5.4, viscous, four wheels | {:.4} | {:.4} | computed with Bv before it was cut, {:.4} |
| 5.4, viscous, three wheels | {:.4} | {:.4} | not explained |
| 5.4, Coulomb, three wheels | {:.4} | {:.4} | perhaps Cvn over the other robot's mass |
| 5.4, Coulomb, four wheels | {:.4} | {:.4} | not explained |

All else agrees: eq. 2–9, the other entries of eq. 32–37, and Table 3 as the mean of Tables 1 and 2.
",
        FOUR.rows[0].table1,
        FOUR.rows[0].hidden(),
        THREE.table3.resistance,
        0.5 * (R_STEADY + THREE.table3.resistance),
        THREE.terms[0],
        THREE.terms[2],
        FOUR.terms[0],
        FOUR.terms[2],
        three[0],
        three[2],
        four[0],
        four[2],
        FOUR.terms[1],
        four[1],
        FOUR.rows[1].hidden(),
        THREE.terms[1],
        three[1],
        THREE.terms[3],
        three[3],
        FOUR.terms[3],
        four[3],
    )
}

/// What two experiments that disagree say.
fn disagree() -> String {
    let (steady, driven) = (R_STEADY, THREE.table3.resistance);
    let j = &FOUR.rows[0];
    let (coasting, driving) = (j.hidden(), j.table2.expect("J is in both tables"));
    let (bvn, bvn3) = (&FOUR.rows[2], &THREE.rows[2]);
    let percent = |a: f64, b: f64| 100.0 * (b / a - 1.0);
    let mut page = "## Two experiments that disagree\n\n".to_owned();
    let _ = write!(
        page,
        "\
A number of a model has one value. Where two experiments, each fitted well, give two, the model lacks something that the
experiments have in different amounts; the mean, which Table 3 takes of all but R, hides it. The paper shows two cases. R is
{steady} Ω from the steady motor line and {driven} Ω from the driven step, {:.0} % more; the four-wheel J is {coasting:.4} kg·m² where the robot
coasts (printed {:.3}) and {driving:.4} where it is driven, {:.0} % more. (Bvn falls from {:.4} to {:.4} on three wheels and rises from
{:.4} to {:.4} on four, so it is not one wrong scale either.) What could do it, and what these numbers cannot tell apart: a
voltage lost in the bridge (dead time, transistors, brushes) makes less current than the command says and passes for a larger
R, the more the lower the voltage; a gear that passes less torque when driven than when coasting passes for a larger R too,
and for a larger J; the winding's inductance delays the current after a step, which a fit without it books as inertia, but
its few milliseconds are small beside the robot's time constants of 170 to 320 ms; slip under full drive passes for a larger J; and
the rotors, whose inertia counts l² times, are in both experiments and explain no difference. The paper's data do not say
which. What does is a recording with reversals, rests and several voltages: a lost voltage shows at small currents, a gear's
loss with the torque, an inductance right after the step. That is what `omni-gap diagnose` looks for.
",
        percent(steady, driven),
        j.table1,
        percent(coasting, driving),
        bvn3.hidden(),
        bvn3.table2.unwrap_or(f64::NAN),
        bvn.hidden(),
        bvn.table2.unwrap_or(f64::NAN),
    );
    page
}
