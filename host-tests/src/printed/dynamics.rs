//! Eq. 30–37: A, B and K of both robots, three ways.

use std::fmt::Write;

use model_core::plant::paper::{four_wheels, three_wheels};
use nalgebra::Matrix3;

use super::core::of_the_core;
use crate::matrices::{Matrices, eq33_as_printed};
use crate::paper::{FOUR_HEADINGS_DEG, FOUR_WHEELS, THREE_HEADINGS_DEG, THREE_WHEELS};

/// Entries differ where they do by more than this; all are of size 60 and less.
const ROUNDING: f64 = 1e-11;

/// An entry, its unit, and its three values.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Such as `B21`.
    pub name: String,
    /// By the printed closed form.
    pub printed: f64,
    /// By virtual work.
    pub derived: f64,
    /// By the derivative of the core's step.
    pub core: f64,
}

impl Entry {
    /// True if all three agree.
    pub fn agrees(&self) -> bool {
        (self.printed - self.derived).abs() < ROUNDING && (self.core - self.derived).abs() < ROUNDING
    }
}

/// All entries of three sets of matrices; `b` is the printed B.
fn entries<const N: usize>(printed: &Matrices<N>, b: &[f64], derived: &Matrices<N>, core: &Matrices<N>) -> Vec<Entry> {
    let entry = |name: String, printed: f64, derived: f64, core: f64| Entry { name, printed, derived, core };
    let mut all = Vec::new();
    for row in 0..3 {
        for c in 0..3 {
            let name = format!("A{}{}", row + 1, c + 1);
            all.push(entry(name, printed.a[(row, c)], derived.a[(row, c)], core.a[(row, c)]));
        }
    }
    for row in 0..3 {
        for c in 0..N {
            // column by column
            all.push(entry(format!("B{}{}", row + 1, c + 1), b[3 * c + row], derived.b[(row, c)], core.b[(row, c)]));
        }
    }
    for row in 0..3 {
        all.push(entry(format!("K{0}{0}", row + 1), printed.k[row], derived.k[row], core.k[row]));
    }
    all
}

/// The entries of the robot on three wheels, eq. 33 with its sign as printed.
pub fn three() -> Vec<Entry> {
    let derived = Matrices::derived(&THREE_WHEELS.generic(THREE_HEADINGS_DEG));
    let b = eq33_as_printed(&THREE_WHEELS);
    entries(&Matrices::<3>::printed(&THREE_WHEELS), b.as_slice(), &derived, &of_the_core(three_wheels()))
}

/// The entries of the robot on four wheels.
pub fn four() -> Vec<Entry> {
    let derived = Matrices::derived(&FOUR_WHEELS.generic(FOUR_HEADINGS_DEG));
    let printed = Matrices::<4>::printed(&FOUR_WHEELS);
    entries(&printed, printed.b.as_slice(), &derived, &of_the_core(four_wheels()))
}

fn table(page: &mut String, title: &str, entries: &[Entry]) {
    let _ = writeln!(page, "\n{title}:\n\n| entry | printed form | virtual work | core | |\n|---|---|---|---|---|");
    let number = |x: f64| if x.abs() < ROUNDING { "0".to_owned() } else { format!("{x:.4}") };
    let zero = |e: &&Entry| e.agrees() && e.derived.abs() < ROUNDING;
    let idle: Vec<&str> = entries.iter().filter(zero).map(|e| e.name.as_str()).collect();
    for e in entries.iter().filter(|e| !zero(e)) {
        let note = if e.agrees() { "" } else { "**differs**" };
        let [printed, derived, core] = [e.printed, e.derived, e.core].map(number);
        let _ = writeln!(page, "| {} | {printed} | {derived} | {core} | {note} |", e.name);
    }
    let _ = writeln!(page, "\nZero all three ways: {}.", idle.join(", "));
}

/// Mechanical power that eq. 33 as printed gives to a sideways motion of 1 m/s by back-EMF alone [1/s]: A22 without viscous
/// friction, with the sign as printed and as it must be.
pub fn sideways_brake() -> [f64; 2] {
    let p = Matrices::<3>::printed(&THREE_WHEELS);
    // −B·(Kv·l/r·G), row vn, column vn
    let brake = |b: &Matrix3<f64>| -(b * p.rim)[(1, 1)] * THREE_WHEELS.kv * THREE_WHEELS.l / THREE_WHEELS.r;
    [brake(&eq33_as_printed(&THREE_WHEELS)), brake(&p.b)]
}

/// The section of the page.
pub fn section() -> String {
    let mut page = "## Dynamics, eq. 30–37\n\n".to_owned();
    page += "dx/dt = A·x + B·u + K·sign(x) with Table 3, rows and columns from 1 (wheel 0 is column 1). *Printed form*: eq. 32–37.\n";
    page += "*Virtual work*: from eq. 2 and 6, 16–17, 21–22. *Core*: dual derivatives of one step of `model-core`'s plant, by x and u.\n";
    table(&mut page, "Three wheels", &three());
    let [printed, right] = sideways_brake();
    let _ = write!(
        page,
        "
Eq. 33 prints +1/M in row 2, the row of vn, for wheel 1 (B22 above), and the sign is wrong: wheel 1 pushes along −vn in
eq. 14 and turns with −vn in eq. 2. The printed A shows it too. A22 without friction must be −B·(Kv·l/r·G): with the printed sign
that is {printed:.4} 1/s, with the mended one {right:.4} 1/s, which is what eq. 32 has. The reference uses the mended sign.
"
    );
    table(&mut page, "Four wheels", &four());
    page
}
