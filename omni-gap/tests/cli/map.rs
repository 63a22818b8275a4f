//! A mapping for foreign logs, proposed.

use std::f64::consts::PI;

use crate::bench::{Bench, table};
use crate::foreign::{Foreign, foreign};

/// The bench's own run in another layout: milliseconds, rpm, degrees, semicolons, decimal commas.
fn log(bench: &Bench) -> String {
    let text = bench.read("session/runs/run01.csv");
    let (names, _) = table(&text);
    let renamed = |name: &&str| match *name {
        "t_s" => "time_ms".to_owned(),
        "theta_rad" => "heading_deg".to_owned(),
        name if name.starts_with('w') => format!("wheel{}_rpm", &name[1..2]),
        name => name.to_owned(),
    };
    let change = |name: &str| -> fn(f64) -> String {
        match name {
            "t_s" => |t_s| comma(t_s * 1000.0),
            "theta_rad" => |theta_rad| comma(theta_rad * (180.0 / PI)),
            name if name.starts_with('w') => |w_rad_s| comma(w_rad_s * (30.0 / PI)),
            _ => comma,
        }
    };
    let theirs: Vec<String> = names.iter().map(renamed).collect();
    let columns: Vec<Foreign<'_>> =
        names.iter().zip(&theirs).map(|(own, theirs)| (*own, theirs.as_str(), change(own))).collect();
    foreign(bench, &columns, ";")
}

/// A number with a decimal comma.
fn comma(number: f64) -> String {
    number.to_string().replace('.', ",")
}

#[test]
fn a_foreign_log_is_mapped_checked_and_read() {
    let bench = Bench::with_session();
    bench.write("log.txt", &log(&bench));
    let said = bench.done(&["map", "log.txt", "--robot", "session/robot.toml", "--out", "columns.toml"]);
    for part in ["sure", "w0_rad_s", "unit = \"rpm\"", "unit = \"ms\"", "unit = \"deg\"", "written to columns.toml"] {
        assert!(said.out.contains(part), "{part}: {}", said.out);
    }
    assert!(bench.read("columns.toml").contains("decimal = \",\""), "{}", bench.read("columns.toml"));
    bench.done(&["convert", "session/robot.toml", "log.txt", "--columns", "columns.toml", "--out", "back.csv"]);
    let (back, own) = (bench.read("back.csv"), bench.read("session/runs/run01.csv"));
    assert_eq!(back.lines().next(), own.lines().next());
    for (back, own) in back.lines().zip(own.lines()).skip(1) {
        for (back, own) in back.split(',').zip(own.split(',')) {
            let (back, own) = (back.parse::<f64>().ok(), own.parse::<f64>().ok());
            // a heading may be a whole turn further
            let turn = std::f64::consts::TAU;
            let apart = back
                .zip(own)
                .map_or(0.0, |(back, own)| ((back - own + 0.5 * turn).rem_euclid(turn) - 0.5 * turn).abs());
            assert!(back.is_some() == own.is_some() && apart < 1e-9, "{back:?} {own:?}");
        }
    }
}

#[test]
fn without_out_the_mapping_is_printed_and_nothing_is_written() {
    let bench = Bench::with_session();
    let before = bench.all();
    let said = bench.done(&["map", "session/runs/run01.csv", "--robot", "session/robot.toml"]);
    assert!(said.out.contains("[columns]") && said.out.contains("w0_rad_s"), "{}", said.out);
    assert_eq!(bench.all(), before);
}

#[test]
fn what_cannot_be_mapped_is_one_message() {
    let bench = Bench::with_session();
    bench.write("diary.txt", "it rained\n");
    for (args, told) in [
        (&["map", "diary.txt", "--robot", "session/robot.toml"][..], "no rows of numbers"),
        (&["map", "none.csv", "--robot", "session/robot.toml"], "none.csv"),
        (&["map", "session/runs/run01.csv", "--robot", "none.toml"], "none.toml"),
        (
            &["map", "session/runs/run01.csv", "--robot", "session/robot.toml", "--out", "session/robot.toml"],
            "it is an input",
        ),
    ] {
        let said = bench.run(args);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{args:?}");
        assert!(said.err.contains(told) && said.err.lines().count() <= 4, "{args:?}: {}", said.err);
    }
}
