//! Words that a source must not hold, each with what to write in its place.

use crate::code::{code_of, lines_with};
use crate::finding::Finding;
use crate::tree::Source;

/// A word and what to do about it.
pub type Needle = (&'static str, &'static str);

const FUSED: &str = "rounds once where a·b + c rounds twice, so machines would differ; write the two operations";
const SOFT: &str = "computes in f64, which the robot's processor does in software; use crate::number::trig, or a·b + c";

/// What the core does without. The names of libm are looked for bare, so that an import does not hide them.
pub const CORE: &[Needle] = &[
    ("mul_add", FUSED),
    ("std", "the core runs without an operating system; take it from core, or move this to omni-gap or host-tests"),
    ("unsafe", "equations need no unsafe code; it belongs to the firmware's board"),
    ("sinf", SOFT),
    ("cosf", SOFT),
    ("sincosf", SOFT),
    ("tanf", SOFT),
    ("fmaf", SOFT),
];

const FIRST: &str =
    "what judges the first simulator takes nothing from it; write it anew, or move the test to host-tests";
const OWN_BITS: &str = "differs from machine to machine; take it from libm";

/// What the second simulator does without, its tests too.
pub const SECOND_SIMULATOR: &[Needle] = &[("model_core", FIRST), ("omni_gap", FIRST), ("host_tests", FIRST)];

/// What a recording that is made again from its seed does without.
pub const SAME_BITS: &[Needle] = &[
    ("mul_add", FUSED),
    (".sin(", OWN_BITS),
    (".cos(", OWN_BITS),
    (".sin_cos(", OWN_BITS),
    (".tan(", OWN_BITS),
    (".atan2(", OWN_BITS),
    (".tanh(", OWN_BITS),
    (".exp(", OWN_BITS),
    (".ln(", OWN_BITS),
    (".powf(", OWN_BITS),
    (".hypot(", OWN_BITS),
];

/// What no source holds when it is done.
pub const UNFINISHED: &[Needle] = &[
    ("#[ignore", "a test that does not run proves nothing; mend it, or delete it with a reason"),
    ("todo!", "finish it, or leave it out of this commit"),
    ("unimplemented!", "finish it, or make it impossible to ask for"),
];

/// What no program of the host's tests holds.
pub const UNTESTED: &[Needle] =
    &[("#[test]", "no test program is built of a program, so it would never run; test what the library does")];

/// Every needle in the code of a source, prose left out.
pub fn in_code(source: &Source, needles: &[Needle]) -> Vec<Finding> {
    let code = code_of(&source.text);
    let found = needles.iter().flat_map(|(needle, advice)| {
        lines_with(&code, needle).into_iter().map(move |line| (line, format!("`{needle}`: {advice}")))
    });
    found.map(|(line, what)| Finding { file: source.path.clone(), line, what }).collect()
}

/// Every path that only one machine has, in code and prose alike.
pub fn machine_paths(source: &Source) -> Vec<Finding> {
    let mut found = Vec::new();
    for (k, line) in source.text.lines().enumerate() {
        for folder in ["home", "tmp", "root", "Users"] {
            let path = format!("/{folder}/"); // put together here, or this file would find itself
            if line.match_indices(&path).any(|(at, _)| begins_a_path(&line[..at])) {
                let what =
                    format!("`{path}` is a folder of one machine; name it from the top of the tree, or ask for it");
                found.push(Finding { file: source.path.clone(), line: k + 1, what });
            }
        }
    }
    found
}

/// False within a longer path or an address.
fn begins_a_path(before: &str) -> bool {
    !before.chars().next_back().is_some_and(|c| c.is_alphanumeric() || "._-~}".contains(c))
}

#[cfg(test)]
fn source(text: &str) -> Source {
    Source { path: "a.rs".into(), text: text.into() }
}

#[cfg(test)]
fn lines(found: Vec<Finding>) -> Vec<usize> {
    found.into_iter().map(|finding| finding.line).collect()
}

#[test]
fn each_word_is_found_in_code() {
    for line in ["a.mul_add(b, c)", "use std::f32;", "unsafe { f() }", "libm::sinf(x)", "use libm::{cosf, sqrtf};"] {
        assert_eq!(lines(in_code(&source(&format!("// page\n{line}")), CORE)), [2], "{line}");
    }
    for line in ["libm::sincosf(x)", "libm::tanf(x)", "libm::fmaf(x, y, z)", "extern crate std;"] {
        assert_eq!(lines(in_code(&source(line), CORE)), [1], "{line}");
    }
    for line in ["#[ignore]", "#[ignore = \"slow\"]", "todo!()", "std::unimplemented!(\"later\")"] {
        assert_eq!(lines(in_code(&source(line), UNFINISHED)), [1], "{line}");
    }
    assert_eq!(lines(in_code(&source("#[test]\nfn a() {}"), UNTESTED)), [1]);
}

#[test]
fn the_second_simulator_s_words_are_found() {
    for line in ["use model_core::plant;", "omni_gap::api::diagnose()", "host_tests::paper::FOUR_WHEELS"] {
        assert_eq!(lines(in_code(&source(line), SECOND_SIMULATOR)), [1], "{line}");
    }
    for line in ["x.exp()", "(a + b).sin_cos()", "a.mul_add(b, c)", "y.atan2(x)"] {
        assert_eq!(lines(in_code(&source(line), SAME_BITS)), [1], "{line}");
    }
    for line in ["libm::exp(x)", "x.sqrt()", "x.to_radians()", "x.powi(2)"] {
        assert_eq!(in_code(&source(line), SAME_BITS), [], "{line}");
    }
}

#[test]
fn prose_and_longer_names_are_left_alone() {
    for line in ["#![no_std]", "#![forbid(unsafe_code)]", "// libm::sinf is slow", "\"unsafe\"", "libm::atan2f(y, x)"] {
        assert_eq!(in_code(&source(line), CORE), [], "{line}");
    }
}

#[test]
fn a_finding_says_what_to_do() {
    let told = in_code(&source("\n\nlibm::tanf(x)"), CORE)[0].to_string();
    assert!(told.starts_with("a.rs:3: `tanf`: ") && told.contains("crate::number::trig"), "{told}");
}

#[test]
fn machine_paths_are_found_even_in_comments_but_not_within_other_paths() {
    for folder in ["home", "tmp", "root", "Users"] {
        assert_eq!(lines(machine_paths(&source(&format!("\n// see /{folder}/x")))), [2], "{folder}");
        assert_eq!(machine_paths(&source(&format!("target/{folder}/x and https://a.org/{folder}/x"))), []);
    }
}
