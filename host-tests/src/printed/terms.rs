//! Section 5.4: the terms of dv/dt at 6 V on two motors, and where the printed ones come from.

use std::fmt::Write;

use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{AxisSensitivity, NominalKey, StepPlan, sensitivity};

use super::averages::capital;
use super::tables::{FOUR, Printed, R_STEADY, THREE};
use crate::matrices::Matrices;
use crate::paper::{FOUR_HEADINGS_DEG, PaperRobot, THREE_HEADINGS_DEG};
use crate::paper_source::{ROBOTS, tree};

/// The paper's step [V].
const VOLTS: f64 = 6.0;
/// Half of the last place of the printed figures.
const HALF: f64 = 0.5e-4;
/// Names of the four terms, and their units.
const TERMS: [(&str, &str); 4] =
    [("back-EMF", "1/s"), ("viscous, Bv/M", "1/s"), ("drive at 6 V", "m/s²"), ("Coulomb, Cv/M", "m/s²")];

/// A robot of section 5.4: Table 3 with this R [Ω], and Bv [N/(m/s)] and Cv [N] in their places.
fn robot_with(printed: &Printed, r: f64, bv: f64, cv: f64) -> PaperRobot {
    let [_, bvn, bw] = printed.table3.viscous;
    let [_, cvn, cw] = printed.table3.coulomb;
    PaperRobot { resistance: r, ..printed.table3 }.with_friction([bv, bvn, bw], [cv, cvn, cw])
}

/// The four terms of the v axis of a robot, from its derived matrices: 6 V on the two motors that drive v most.
fn of_matrices<const N: usize>(robot: &PaperRobot, headings: [f64; N]) -> [f64; 4] {
    let m = Matrices::derived(&robot.generic(headings));
    let viscous = robot.viscous[0] / robot.mass;
    let mut along: Vec<f64> = m.b.row(0).iter().map(|b| b.abs()).collect();
    along.sort_by(|a, b| b.total_cmp(a));
    [-m.a[(0, 0)] - viscous, viscous, (along[0] + along[1]) * VOLTS, -m.k[0]]
}

/// The four terms with this R [Ω] and the frictions of Table 1, as printed or with its hidden digits.
pub fn computed(printed: &Printed, r: f64, hidden: bool) -> [f64; 4] {
    let [bv, cv] = [1, 4].map(|k| if hidden { printed.rows[k].hidden() } else { printed.rows[k].table1 });
    let robot = robot_with(printed, r, bv, cv);
    if *printed == THREE { of_matrices(&robot, THREE_HEADINGS_DEG) } else { of_matrices(&robot, FOUR_HEADINGS_DEG) }
}

/// All R [Ω] with which a term (0: back-EMF, 2: drive) rounds to the printed figure.
pub fn resistances(printed: &Printed, term: usize) -> (f64, f64) {
    // both terms go with 1/R
    let of = |figure: f64| R_STEADY * computed(printed, R_STEADY, false)[term] / figure;
    (of(printed.terms[term] + HALF), of(printed.terms[term] - HALF))
}

/// The R [Ω] that all four figures allow.
pub fn common_resistance() -> (f64, f64) {
    let all = [resistances(&THREE, 0), resistances(&THREE, 2), resistances(&FOUR, 0), resistances(&FOUR, 2)];
    all.into_iter().fold((f64::NEG_INFINITY, f64::INFINITY), |(lo, hi), (a, b)| (lo.max(a), hi.min(b)))
}

/// One friction over one mass or inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct Ratio {
    /// In words.
    pub name: String,
    /// Its value.
    pub value: f64,
}

/// Every friction of Tables 1, 2, 3 and the hidden Table 1, of either robot and any axis, over every mass and inertia of
/// either robot.
pub fn ratios() -> Vec<Ratio> {
    let robots = [&THREE, &FOUR];
    let mut over: Vec<(String, f64)> = Vec::new();
    let mut frictions: Vec<(String, f64)> = Vec::new();
    for p in robots {
        over.push((format!("M of {}", p.name), p.table3.mass));
        for (k, row) in p.rows.iter().enumerate() {
            let tables = [("Table 1", Some(row.table1)), ("Table 2", row.table2), ("Table 3", Some(row.table3))];
            let hidden = row.table2.map(|_| row.hidden());
            for (table, x) in tables.into_iter().chain([("hidden Table 1", hidden)]) {
                let Some(x) = x else { continue };
                let list = if k == 0 { &mut over } else { &mut frictions };
                list.push((format!("{} of {} ({table})", row.name, p.name), x));
            }
        }
    }
    let ratio = |(f, x): &(String, f64), (m, y): &(String, f64)| Ratio { name: format!("{f} over {m}"), value: x / y };
    frictions.iter().flat_map(|f| over.iter().map(move |m| ratio(f, m))).collect()
}

/// The ratios that round to a printed figure.
pub fn sources(figure: f64) -> Vec<Ratio> {
    // 1e-9: a half that is one in decimals
    ratios().into_iter().filter(|r| (r.value - figure).abs() <= HALF + 1e-9).collect()
}

/// How many ratios would print a figure by chance, as densely as they lie within a fifth of it.
pub fn by_chance(figure: f64) -> f64 {
    let near = ratios().into_iter().filter(|r| (r.value / figure - 1.0).abs() < 0.2).count();
    near as f64 * 2.0 * HALF / (0.4 * figure)
}

fn terms_table(page: &mut String, printed: &Printed) {
    let r = 0.5 * (common_resistance().0 + common_resistance().1);
    let columns = [computed(printed, R_STEADY, false), computed(printed, r, false), computed(printed, r, true)];
    let _ = writeln!(
        page,
        "\n{}:\n\n| term | unit | printed | R {R_STEADY}, Table 1 | R {r:.5}, Table 1 | R {r:.5}, hidden Table 1 | |\n\
         |---|---|---|---|---|---|---|",
        capital(printed.name)
    );
    for (k, (name, unit)) in TERMS.iter().enumerate() {
        let fits = |x: f64| (x - printed.terms[k]).abs() <= HALF;
        let note = if fits(columns[2][k]) { "" } else { "**does not follow**" };
        let [a, b, c] = columns.map(|column| format!("{:.4}", column[k]));
        let _ = writeln!(page, "| {name} | {unit} | {:.4} | {a} | {b} | {c} | {note} |", printed.terms[k]);
    }
}

fn mismatches(page: &mut String) {
    *page += "\n| printed | would need | ratios that print it | expected by chance |\n|---|---|---|---|\n";
    for (p, k, symbol) in [(&THREE, 1, "Bv"), (&THREE, 3, "Cv"), (&FOUR, 1, "Bv"), (&FOUR, 3, "Cv")] {
        let found: Vec<String> =
            sources(p.terms[k]).into_iter().map(|r| format!("{} = {:.5}", r.name, r.value)).collect();
        let found = if found.is_empty() { "none".into() } else { found.join("; ") };
        let need = p.terms[k] * p.table3.mass;
        let chance = by_chance(p.terms[k]);
        let _ = writeln!(page, "| {}, {:.4} | {symbol} = {need:.4} | {found} | {chance:.3} |", p.name, p.terms[k]);
    }
}

/// The v axis of an example with R of either experiment.
fn influences(robot: usize, r: f64) -> AxisSensitivity {
    let mut file = RobotFile::load(&tree().join(ROBOTS[robot].0), &known_effects()).expect("an example");
    file.motor.resistance_ohm = r;
    sensitivity(&file, &StepPlan::usual(&file)).axes.swap_remove(0)
}

fn tool(page: &mut String) {
    *page += "\nWhat `omni-gap sensitivity` says of the v axis of both robots with Table 3 (6 V, speed after 1 s and in the end): per\n";
    *page += "cent of speed for one per cent of the number.\n\n";
    *page += "| number | three, 1 s | three, end | four, 1 s | four, end |\n|---|---|---|---|---|\n";
    let axes = [0, 1].map(|k| influences(k, THREE.table3.resistance));
    for first in axes[0].influences.iter().filter(|i| i.speed.abs() >= 0.005) {
        let of = |k: usize| axes[k].influences.iter().find(|i| i.key == first.key).expect("the same numbers");
        let number = |x: f64| format!("{:+.2}", if x.abs() < 0.005 { 0.0 } else { x });
        let unit = NominalKey::of(first.key).expect("a key").unit;
        let cells = [0, 1].map(|k| (number(of(k).speed), number(of(k).final_speed.unwrap_or(f64::NAN))));
        let [(a, b), (c, d)] = cells;
        let _ = writeln!(page, "| `{}` [{unit}] | {a} | {b} | {c} | {d} |", first.key);
    }
    let change = |k: usize| influences(k, THREE.table3.resistance).speed / influences(k, R_STEADY).speed - 1.0;
    let _ = write!(
        page,
        "
The two values of R alone, {R_STEADY} Ω and {} Ω, are worth {:.0} % of speed after 1 s on three wheels and {:.0} % on four.
",
        THREE.table3.resistance,
        -100.0 * change(0),
        -100.0 * change(1)
    );
}

/// The section of the page.
pub fn section() -> String {
    let mut page = "## Sensitivity, section 5.4\n\n".to_owned();
    page += "The v axis from rest, 6 V on the two motors that drive it: dv/dt = drive − back-EMF·v − viscous·v − Coulomb. Back-EMF is\n";
    page += "3·Kt²·l²/(2·r²·R·M) on three wheels, 2·Kt²·l²/(r²·R·M) on four.\n";
    terms_table(&mut page, &THREE);
    terms_table(&mut page, &FOUR);
    let (lo, hi) = common_resistance();
    let first = ratios().len();
    let _ = write!(
        page,
        "
- Back-EMF and drive: both are off by the same factor, on both robots. A wrong Kt, r or l would show twice as large in the
  first as in the second; what is left is R (or M, by the same factor for two different robots). All four figures round
  right for R from {lo:.6} to {hi:.6} Ω: they were computed with 3.7 Ω or a hair more, not with {R_STEADY}. (With 3.7
  exactly the three-wheel figures round to {:.4} and {:.4}.)
- The four-wheel viscous term needs Bv between {:.4} and {:.4}: not the {:.3} of Table 1, but its hidden {:.4}. The figures of
  section 5.4 were computed before Table 1 lost its digits.
- Three figures follow from neither. Tried: every friction of any axis, table and robot over every mass and inertia of either
  robot, {first} ratios.
",
        computed(&THREE, 3.7, false)[0],
        computed(&THREE, 3.7, false)[2],
        (FOUR.terms[1] - HALF) * FOUR.table3.mass,
        (FOUR.terms[1] + HALF) * FOUR.table3.mass,
        FOUR.rows[1].table1,
        FOUR.rows[1].hidden(),
    );
    mismatches(&mut page);
    let vn = &THREE.rows[5];
    let _ = write!(
        page,
        "
- {:.4} is {} of Table 3 over the mass of the *four*-wheel robot, {:.4}/{:.2}: the wrong axis and the wrong mass at once. It
  fits to the last digit, chance alone would do that once in {:.0} such figures, and it may be what happened. It is a guess.
- {:.4} and {:.4}: no explanation found. Table 1 gives {:.4} and {:.4}.
",
        THREE.terms[3],
        vn.name,
        vn.table3,
        FOUR.table3.mass,
        1.0 / by_chance(THREE.terms[3]),
        THREE.terms[1],
        FOUR.terms[3],
        computed(&THREE, R_STEADY, false)[1],
        computed(&FOUR, R_STEADY, false)[3],
    );
    tool(&mut page);
    page
}
