//! Recordings that are too long to be weighed whole, or have many runs: what they show rarely is found all the same.

use model_core::effects::EffectKind;
use omni_gap::engine::Knobs;
use omni_gap::simulate::EffectInstance;
use omni_gap::synthesize::{Scenario, synthesize};
use omni_gap::{Options, Report, Session, Verdict, diagnose, known_effects};

/// Rows that answers rest on where an excerpt is asked for, and the pieces into which they are cut.
const ROWS: usize = 6_000;
const PIECES: usize = 12;

/// What shows at hard driving alone.
const SHOWN_BY_HARD_DRIVING: [EffectKind; 2] = [EffectKind::CurrentLimit, EffectKind::SupplySag];

/// Ten gentle runs, and then two hard ones: 14,400 rows.
fn gentle_and_then_hard(kind: EffectKind) -> Session {
    let robot = include_str!("../../examples/feup-4w/robot.toml");
    let hidden = vec![EffectInstance::typical(kind.card(), None)];
    let gentle = Scenario { hidden, uncertain: false, voltage: 3.0, rate: 200.0, runs: 10, ..Scenario::default() };
    let hard = Scenario { runs: 2, voltage: 12.0, seed: 2, ..gentle.clone() };
    let mut session = synthesize(robot, &gentle, &known_effects()).expect("a session");
    session.runs.extend(synthesize(robot, &hard, &known_effects()).expect("a session").runs);
    session
}

fn answered(session: &Session, most_rows: usize) -> Report {
    let mut knobs = Knobs::default();
    (knobs.layout.excerpt.most_rows, knobs.layout.excerpt.pieces) = (most_rows, PIECES);
    diagnose(session, &Options { knobs, ..Options::default() })
}

fn is_excerpt(report: &Report) -> bool {
    report.notices.iter().any(|told| told.contains("rows are more than an answer needs"))
}

#[test]
fn an_excerpt_shows_what_as_many_rows_from_the_start_do_not() {
    for kind in SHOWN_BY_HARD_DRIVING {
        let whole = gentle_and_then_hard(kind);
        let report = answered(&whole, ROWS);
        assert_eq!(report.causes, [kind.card().id]);
        assert!(is_excerpt(&report));

        let start = Session { runs: whole.runs.into_iter().take(5).collect(), ..whole };
        assert_eq!(start.runs.iter().map(|run| run.rows()).sum::<usize>(), ROWS);
        let report = answered(&start, ROWS);
        assert_eq!(report.verdict, Verdict::NoGap);
        assert!(!is_excerpt(&report));
    }
}

#[test]
fn of_many_runs_those_that_show_it_are_looked_at() {
    for kind in SHOWN_BY_HARD_DRIVING {
        let report = answered(&gentle_and_then_hard(kind), 60_000);
        assert_eq!(report.causes, [kind.card().id]);
        assert!(!is_excerpt(&report));
    }
}
