//! The page of the paper's numbers, and the findings on it one by one.

#[path = "proof/golden.rs"]
mod golden;

use host_tests::matrices::Matrices;
use host_tests::paper::{FOUR_WHEELS, THREE_WHEELS};
use host_tests::printed::averages::{Cut, cut, means_that_miss};
use host_tests::printed::kinematics::{inverse_four, inverse_of_the_core, inverse_three};
use host_tests::printed::tables::{FOUR, Printed, R_STEADY, THREE};
use host_tests::printed::terms::{common_resistance, computed, sources};
use host_tests::printed::{dynamics, page};
use model_core::plant::paper::{four_wheels, three_wheels};
use nalgebra::Matrix3;

#[test]
fn the_page_is_made_from_the_computations() {
    golden::holds("paper.md", &page());
}

#[test]
fn the_printed_inverses_undo_the_printed_kinematics_and_are_the_cores() {
    // a few roundings of numbers up to 4
    let within = 1e-14;
    let three = inverse_three(THREE_WHEELS.d);
    assert!((three * Matrices::<3>::printed(&THREE_WHEELS).rim - Matrix3::identity()).amax() < within);
    assert!((three - inverse_of_the_core(&three_wheels())).amax() < within);
    let four = inverse_four(FOUR_WHEELS.d);
    assert!((four * Matrices::<4>::printed(&FOUR_WHEELS).rim - Matrix3::identity()).amax() < within);
    assert!((four - inverse_of_the_core(&four_wheels())).amax() < within);
}

#[test]
fn of_all_entries_of_the_matrices_one_differs() {
    let names = |entries: Vec<dynamics::Entry>| -> (usize, Vec<String>) {
        let differs = entries.iter().filter(|e| !e.agrees()).map(|e| e.name.clone()).collect();
        (entries.len(), differs)
    };
    assert_eq!(names(dynamics::three()), (9 + 9 + 3, vec!["B22".to_owned()]));
    assert_eq!(names(dynamics::four()), (9 + 12 + 3, vec![]));
    // Kt²·l²/(r²·R·M) with Table 3, 3/2 of it; eq. 33 as printed has wheel 1 push where it should brake: (½ − 1)
    let one = (0.0259_f64 * 5.0 / 0.0325).powi(2) / (4.3111 * 1.944);
    let [printed, mended] = dynamics::sideways_brake();
    assert!((mended + 1.5 * one).abs() < 1e-12 && (printed - 0.5 * one).abs() < 1e-12, "{printed} {mended}");
}

#[test]
fn table_3_is_the_mean_and_table_1_is_cut() {
    // 2·Table 3 − Table 2 by hand, and whether rounding it could give Table 1's third place
    let by_hand: [(&Printed, [(f64, bool); 7]); 2] = [
        (
            &THREE,
            [
                (0.0151, false),
                (0.5030, false),
                (0.5169, true),
                (0.0110, false),
                (1.9068, true),
                (2.0423, false),
                (0.1130, false),
            ],
        ),
        (
            &FOUR,
            [
                (0.0168, true),
                (0.4775, false),
                (0.6008, true),
                (0.0117, true),
                (1.8738, true),
                (2.2198, true),
                (0.1359, true),
            ],
        ),
    ];
    for (printed, rows) in by_hand {
        for (row, (hidden, truncated)) in printed.rows.iter().zip(rows) {
            assert!((row.hidden() - hidden).abs() < 1e-9, "{}: {}", row.name, row.hidden());
            assert_eq!(cut(row) == Cut::Truncated, truncated, "{} of {}", row.name, printed.name);
            // cutting, unlike rounding, gives every printed number, within what the unknown digits allow
            let (down, up) = row.hidden_within();
            let low = row.hidden() + down < row.table1 + 1e-3;
            assert!(low && row.hidden() + up >= row.table1, "{} of {}", row.name, printed.name);
        }
    }
    // printed means against Table 3, by hand: 0.48655 and 0.4870; 0.0224 and 0.0228; 0.49755 and 0.4978; 0.6759 and
    // 0.6763; 0.01375 and 0.0141; 0.13805 and 0.1385
    assert_eq!(means_that_miss(), 6);
}

#[test]
fn the_traction_figures_were_computed_with_3_7_ohm() {
    let (lo, hi) = common_resistance();
    assert!(lo < hi, "no R gives all four: {lo} {hi}");
    assert!((lo - 3.7).abs() < 2e-5 && (hi - 3.7).abs() < 5e-5, "{lo} {hi}");
    for printed in [&THREE, &FOUR] {
        let at = |r: f64| computed(printed, r, false);
        for term in [0, 2] {
            let text = |x: f64| format!("{x:.4}");
            assert_eq!(text(at(0.5 * (lo + hi))[term]), text(printed.terms[term]));
            assert_ne!(text(at(R_STEADY)[term]), text(printed.terms[term]));
        }
    }
}

#[test]
fn of_the_friction_figures_one_follows_from_hidden_digits_and_one_perhaps_from_two_slips() {
    let names = |figure: f64| sources(figure).into_iter().map(|r| r.name).collect::<Vec<_>>();
    assert_eq!(names(FOUR.terms[1]), ["Bv of four wheels (hidden Table 1) over M of four wheels"]);
    assert_eq!(names(THREE.terms[3]), ["Cvn of three wheels (Table 3) over M of four wheels"]);
    assert_eq!(names(THREE.terms[1]), [""; 0]);
    assert_eq!(names(FOUR.terms[3]), [""; 0]);
    // 0.503/1.944, 1.906/1.944, 0.477/2.34, 1.873/2.34 by hand
    let table1 = [computed(&THREE, R_STEADY, false), computed(&FOUR, R_STEADY, false)];
    let by_hand = [["0.2587", "0.9805"], ["0.2038", "0.8004"]];
    assert_eq!(table1.map(|t| [1, 3].map(|k| format!("{:.4}", t[k]))), by_hand.map(|t| t.map(str::to_owned)));
}
