//! The figures as the paper prints them; Table 3 is [`crate::paper`].

use crate::paper::{FOUR_WHEELS, PaperRobot, THREE_WHEELS};

/// R of Table 1, from the steady motor line [Ω].
pub const R_STEADY: f64 = 3.7007;

/// One parameter of one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its symbol.
    pub name: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// Table 1: experiments 1 and 2, three places behind the point.
    pub table1: f64,
    /// Table 2: experiment 3; none where it has no such number.
    pub table2: Option<f64>,
    /// Table 3.
    pub table3: f64,
}

/// One robot's figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// What it is called.
    pub name: &'static str,
    /// Its Table 3.
    pub table3: PaperRobot,
    /// J and the frictions.
    pub rows: [Row; 7],
    /// Section 5.4, v axis at 6 V on two motors: back-EMF [1/s], viscous [1/s], drive [m/s²], Coulomb [m/s²].
    pub terms: [f64; 4],
}

const fn rows(t: &PaperRobot, table1: [f64; 7], table2: [Option<f64>; 7]) -> [Row; 7] {
    const NAMES: [(&str, &str); 7] = [
        ("J", "kg·m²"),
        ("Bv", "N/(m/s)"),
        ("Bvn", "N/(m/s)"),
        ("Bω", "N·m/(rad/s)"),
        ("Cv", "N"),
        ("Cvn", "N"),
        ("Cω", "N·m"),
    ];
    let table3 = [t.inertia, t.viscous[0], t.viscous[1], t.viscous[2], t.coulomb[0], t.coulomb[1], t.coulomb[2]];
    let mut rows = [Row { name: "", unit: "", table1: 0.0, table2: None, table3: 0.0 }; 7];
    let mut k = 0;
    while k < 7 {
        let (name, unit) = NAMES[k];
        rows[k] = Row { name, unit, table1: table1[k], table2: table2[k], table3: table3[k] };
        k += 1;
    }
    rows
}

/// Three wheels.
pub const THREE: Printed = Printed {
    name: "three wheels",
    table3: THREE_WHEELS,
    rows: rows(
        &THREE_WHEELS,
        [0.015, 0.503, 0.516, 0.011, 1.906, 2.042, 0.113],
        [Some(0.0187), Some(0.5134), Some(0.4571), Some(0.0150), None, None, Some(0.0812)],
    ),
    terms: [3.3110, 0.3245, 5.7570, 0.8728],
};

/// Four wheels.
pub const FOUR: Printed = Printed {
    name: "four wheels",
    table3: FOUR_WHEELS,
    rows: rows(
        &FOUR_WHEELS,
        [0.016, 0.477, 0.600, 0.011, 1.873, 2.219, 0.135],
        [Some(0.0288), Some(0.5181), Some(0.7518), Some(0.0165), None, None, Some(0.1411)],
    ),
    terms: [3.6676, 0.2041, 5.5227, 0.7879],
};

impl Row {
    /// What Table 1 must have been before it lost its digits: Table 3 is its mean with Table 2, or (Cv, Cvn) itself.
    pub fn hidden(&self) -> f64 {
        // T₁ = 2·T₃ − T₂
        self.table2.map_or(self.table3, |t2| 2.0 * self.table3 - t2)
    }

    /// How far that may be off, Tables 2 and 3 being rounded or cut at the fourth place: (down, up).
    pub fn hidden_within(&self) -> (f64, f64) {
        // rounded: 2·½ + ½ units either way; cut: T₃ up to two units more, T₂ up to one unit more
        if self.table2.is_some() { (-1.5e-4, 2e-4) } else { (-0.5e-4, 1e-4) }
    }
}
