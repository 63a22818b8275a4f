//! What experiments tell of a robot, as tables and sentences for a person at a terminal.

mod sentences;
mod symbol;
mod table;

use super::number::NBSP;
use super::terminal::Page;
use crate::identify::Answer;

/// The answer in plain text.
pub fn identified_terminal(answer: &Answer) -> String {
    let mut page = Page(String::new());
    page.line("", &sentences::headline(answer));
    page.0.push('\n');
    table::tables(&mut page.0, answer);
    page.0.push('\n');
    for (label, sentence) in sentences::all(answer) {
        page.line(label, &sentence);
    }
    page.0.replace(NBSP, " ")
}

#[cfg(test)]
pub(super) mod sample {
    use crate::identify::*;

    fn number(key: &'static str, file: f64, together: f64, std: f64, word: Identifiability) -> Number {
        let value = |value| Some(Value { value, std: Some(0.02 * value) });
        Number {
            key,
            file,
            first: value(0.9 * together),
            least_squares: value(0.8 * together),
            instrumental: value(together),
            average: value(0.95 * together),
            together: Value { value: together, std: Some(std) },
            std_given: 0.5 * std,
            word,
        }
    }

    /// An answer in which everything stands.
    pub fn answer() -> Answer {
        Answer {
            schema: SCHEMA,
            robot: "r".into(),
            asked: "all",
            runs: vec![Counted { experiment: "experiment 1 (steady spin)", runs: 2 }],
            fitted_runs: 2,
            left_out: vec![LeftOut { runs: vec!["motor-load-1".into()], why: "dragging a load" }],
            not_logged: vec!["currents"],
            guessed: vec![Guessed { key: "coulomb_v_N", value: 1.15 }],
            numbers: vec![
                number("resistance_ohm", 5.0, 4.31, 0.02, Identifiability::Identified),
                number("emf_constant_V_s", 0.026, 0.0259, 0.01, Identifiability::Combined),
                number("coulomb_v_N", 0.0, 1.87, 0.4, Identifiability::Weak),
            ],
            trade_offs: vec![
                Together {
                    moves: vec![
                        Moved { key: "resistance_ohm", relative: 1.0 },
                        Moved { key: "emf_constant_V_s", relative: 0.98 },
                    ],
                    std_relative: 0.4,
                    known: Some(Product {
                        powers: [
                            Power { key: "resistance_ohm", power: 1.0 },
                            Power { key: "emf_constant_V_s", power: -1.02 },
                        ],
                        std_relative: 0.012,
                    }),
                },
                Together {
                    moves: vec![
                        Moved { key: "resistance_ohm", relative: 1.0 },
                        Moved { key: "emf_constant_V_s", relative: 1.0 },
                        Moved { key: "coulomb_v_N", relative: -12.0 },
                    ],
                    std_relative: 0.3,
                    known: None,
                },
            ],
            noise: vec![SensorNoise { key: "position_noise_m", found: 0.0104, stated: 0.01, correlation_time_s: 0.12 }],
            follows: false,
            misfit: 1.8,
            samples: 1234,
            disagreements: vec![Apart {
                key: "resistance_ohm",
                sides: [("experiment 3 (step with initial ramp)", 4.31), ("motor experiment", 3.7)]
                    .map(|(by, value)| Side { by, value: Value { value, std: Some(0.02) } }),
                sigmas: 21.6,
            }],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_answer_is_said_in_tables_and_sentences() {
        let said = identified_terminal(&sample::answer());
        let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in [
            "r: 2 runs of experiment 1 (steady spin)",
            "3.879 ± 0.078",
            "4.310 ± 0.020 −13.8 % 0.2",
            "only as a combination",
            "no currents are logged; without them C_v is weak, K_v is known only as a combination",
            "began at a guess, 1.15 N",
            "R and K_v are known only together: R/K_v to 1.2 %",
            "R +1 %, K_v +1 %, C_v −12 %",
            "position 0.0104 m (file: 0.0100 m), alike over 0.12 s",
            "cannot follow whole runs (1.80 times the noise)",
            "try omni-gap diagnose",
            "experiment 3 (step with initial ramp) says R 4.310 ± 0.020 Ω, the motor experiment 3.700 ± 0.020 Ω",
            "disagree by 22 σ",
            "K_v is known only as a combination: the file that is written keeps what it had",
            "motor-load-1",
        ] {
            assert!(flat.contains(part), "{part:?} is not in\n{said}");
        }
        assert!(said.lines().all(|l| l.chars().count() <= 110), "{said}");
    }

    #[test]
    fn the_json_has_every_number_with_its_key() {
        let json: serde_json::Value = serde_json::to_value(sample::answer()).unwrap();
        assert_eq!((json["schema"].as_u64(), json["asked"].as_str()), (Some(1), Some("all")));
        assert_eq!(json["numbers"][0]["key"], "resistance_ohm");
        assert_eq!(json["numbers"][0]["together"]["value"], 4.31);
        assert_eq!(json["numbers"][1]["word"], "combined");
        assert_eq!(json["disagreements"][0]["sides"][1]["value"], 3.7);
        assert_eq!(json["trade_offs"][0]["known"]["powers"][1]["power"], -1.02);
    }
}
