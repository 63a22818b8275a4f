//! The engine's walls: what decides stands among its knobs, and a report is made of its findings alone.

use crate::code::{code_of, named};
use crate::finding::Finding;
use crate::tree::Source;

/// Where the engine is.
pub const ENGINE: &str = "omni-gap/src/engine/";

/// The one file of the engine that may hold thresholds.
const KNOBS: &str = "omni-gap/src/engine/knobs.rs";

/// Where reports are made.
pub const REPORT: &str = "omni-gap/src/report/";

/// The types of numbers that a threshold can have.
const NUMBERS: [&str; 8] = ["f64", "f32", "usize", "u64", "u32", "i64", "i32", "u8"];

/// Every constant of a file of the engine, other than its knobs, that is made of numbers.
pub fn thresholds(source: &Source) -> Vec<Finding> {
    if source.path == KNOBS {
        return Vec::new();
    }
    let code = code_of(&source.text);
    let lines = code.lines().enumerate().filter(|(_, line)| constant_of_numbers(line));
    let what = "a constant that decides: make it a field of Knobs, with its unit and why it has its value";
    lines.map(|(k, _)| Finding { file: source.path.clone(), line: k + 1, what: what.to_owned() }).collect()
}

/// True for a line such as `pub const TIE: (f64, f64) = …;` and not for `fn f<const N: usize>`.
fn constant_of_numbers(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let item = words.iter().position(|word| matches!(*word, "const" | "static"));
    let starts = item
        .is_some_and(|at| words[..at].iter().all(|word| word.starts_with("pub")) && words.get(at + 1) != Some(&"fn"));
    let Some((_, rest)) = line.split_once(':').filter(|_| starts) else { return false };
    let kind = rest.split('=').next().unwrap_or(rest);
    kind.split(|c: char| !named(c)).any(|word| NUMBERS.contains(&word))
}

/// Every word of a report about the engine that is not about its findings.
pub fn looks_into_the_engine(source: &Source) -> Vec<Finding> {
    let code = code_of(&source.text);
    let mut found = Vec::new();
    for (at, door) in code.match_indices("crate::engine") {
        let rest = &code[at + door.len()..];
        if !rest.starts_with("::findings") {
            let line = 1 + code[..at].matches('\n').count();
            let what = "a report is made of findings alone; put what it needs into crate::engine::findings";
            found.push(Finding { file: source.path.clone(), line, what: what.to_owned() });
        }
    }
    found
}

#[cfg(test)]
fn lines(path: &str, text: &str, check: fn(&Source) -> Vec<Finding>) -> Vec<usize> {
    check(&Source { path: path.into(), text: text.into() }).into_iter().map(|f| f.line).collect()
}

#[test]
fn a_threshold_outside_the_knobs_is_found_and_types_and_texts_are_none() {
    let text = "const TIE: f64 = 8.0;\n    pub(super) const BOTH: (f64, f64) = (1.0, 2.0);\nconst PARTS: [usize; 2] = [1, 2];\n\
                fn f<const N: usize>() {}\nconst NAME: &str = \"f64\";\n// const OLD: f64 = 1.0;\nconst fn g(x: f64) -> f64 { x }\n\
                static SEED: u64 = 1;\nconst WHY: Unfit = Unfit {};\n";
    assert_eq!(lines("omni-gap/src/engine/stepwise/a.rs", text, thresholds), [1, 2, 3, 8]);
    assert_eq!(lines(KNOBS, text, thresholds), [0; 0]);
}

#[test]
fn a_report_that_asks_the_engine_itself_is_found() {
    let text = "use crate::engine::findings::Which;\nuse crate::engine::Knobs;\nfn f() { crate::engine::Stepwise }\n\
                use crate::engine::{findings::Gap};\n//! [`crate::engine`]\n";
    assert_eq!(lines("omni-gap/src/report/a.rs", text, looks_into_the_engine), [2, 3, 4]);
}
