//! Tables wider and rows longer than anybody reads, and inputs without an end.

use std::fmt::Write;
use std::io;

use super::fault::Fault;
use super::outcome::{Outcome, answered, refused};
use super::process::Asked;
use super::scene::{RUN, Scene};

/// The faults.
pub const FAULTS: &[Fault] = &[
    Fault { what: "100,000 columns, 16 of them signals", inject: many_columns },
    Fault { what: "100,000 columns, the last one named as an earlier one", inject: a_column_twice_of_many },
    Fault { what: "100,000 columns, to propose a mapping", inject: a_mapping_of_many_columns },
    Fault { what: "rows of 10 MB: a field of text beside the signals", inject: long_text },
    Fault { what: "rows of 10 MB: a number of ten million digits", inject: a_long_number },
    Fault { what: "rows of 10 MB: to propose a mapping", inject: a_mapping_of_long_rows },
    Fault { what: "a quote that is never closed, 50 MB behind it", inject: an_open_quote },
    Fault { what: "a robot file without an end", inject: an_endless_robot_file },
    Fault { what: "twenty million empty lines before the rows", inject: empty_lines },
];

const COLUMNS: usize = 100_000;
const LONG: usize = 10_000_000;

/// Memory, as times what the input has \[1\]; and what any run takes \[MB\].
const TIMES: f64 = 10.0;
const ANY_MB: f64 = 60.0;

/// With no more memory than the input's bytes allow.
fn bounded(asked: Asked, bytes: usize) -> Asked {
    asked.within(ANY_MB + TIMES * bytes as f64 / 1e6)
}

/// The run of the scene with this behind its header and behind each of its first rows.
fn widened(scene: &Scene, rows: usize, header: &str, row: &str) -> io::Result<usize> {
    let text = scene.read(RUN)?;
    let mut wide = String::new();
    for (k, line) in text.lines().take(1 + rows).enumerate() {
        let _ = writeln!(wide, "{line},{}", if k == 0 { header } else { row });
    }
    scene.write(RUN, wide.as_bytes())?;
    Ok(wide.len())
}

fn many_names(more: &str) -> (String, String) {
    let names: Vec<String> = (16..COLUMNS).map(|k| format!("c{k}")).collect();
    let row = vec!["1.5"; COLUMNS - 16].join(",");
    (names.join(",") + more, row)
}

fn many_columns(scene: &Scene) -> io::Result<Outcome> {
    let (header, row) = many_names("");
    let bytes = widened(scene, 100, &header, &row)?;
    answered(scene, &bounded(scene.check(), bytes))
}

fn a_column_twice_of_many(scene: &Scene) -> io::Result<Outcome> {
    let (header, row) = many_names(",c77");
    let bytes = widened(scene, 1, &header, &row)?;
    refused(scene, &bounded(scene.check(), bytes), &["run01.csv:1: column `c77`", "twice"])
}

fn mapped(scene: &Scene) -> Asked {
    scene.asked(&["map", RUN, "--robot", "session/robot.toml", "--out", "columns.toml"])
}

fn a_mapping_of_many_columns(scene: &Scene) -> io::Result<Outcome> {
    let (header, row) = many_names("");
    let bytes = widened(scene, 100, &header, &row)?;
    refused(scene, &bounded(mapped(scene), bytes), &["run01.csv: found no rows of numbers in its first lines"])
}

fn long_text(scene: &Scene) -> io::Result<Outcome> {
    let bytes = widened(scene, 10, "note", &"x".repeat(LONG))?;
    answered(scene, &bounded(scene.check(), bytes))
}

fn a_long_number(scene: &Scene) -> io::Result<Outcome> {
    let bytes = widened(scene, 2, "i0_A", &"9".repeat(LONG))?;
    scene.write(RUN, scene.read(RUN)?.replacen("i0_A,", "other,", 1).as_bytes())?;
    refused(scene, &bounded(scene.check(), bytes), &["run01.csv:2: column `i0_A`", "finite number"])
}

fn a_mapping_of_long_rows(scene: &Scene) -> io::Result<Outcome> {
    let bytes = widened(scene, 10, "note", &"x".repeat(LONG))?;
    answered(scene, &bounded(mapped(scene), bytes))
}

fn an_open_quote(scene: &Scene) -> io::Result<Outcome> {
    let text = scene.read(RUN)? + "\"" + &"1,2,3\n".repeat(LONG * 5 / 6);
    scene.write(RUN, text.as_bytes())?;
    refused(scene, &bounded(scene.check(), text.len()), &["run01.csv:202: found 1 fields"])
}

fn an_endless_robot_file(scene: &Scene) -> io::Result<Outcome> {
    let asked = scene.asked(&["check", "--robot", "/dev/zero", RUN]);
    refused(scene, &asked, &["/dev/zero: ", "a robot file"])
}

fn empty_lines(scene: &Scene) -> io::Result<Outcome> {
    let text = scene.read(RUN)?;
    let (header, rows) = text.split_once('\n').unwrap_or_default();
    let text = [header, &"\n".repeat(20_000_000), rows].concat();
    scene.write(RUN, text.as_bytes())?;
    answered(scene, &bounded(scene.check(), text.len()))
}
