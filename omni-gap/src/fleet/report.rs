//! What a store tells: its sessions, and what the robots of each kind tell together.

use std::collections::BTreeMap;

use model_core::plant::robot::Nominal;

use super::partition::of_table;
use super::rows::{EquationRow, SessionRow};
use super::storage::Storage;
use crate::engine::findings::{Direction, SessionEquations};
use crate::error::{Error, InputKind, Result};
use crate::pooling::{PoolingKnobs, SessionEvidence, pooled};
use crate::report::fleet::{FleetReport, KindOfRobot, SCHEMA, SessionLine};

/// Pools what a store holds.
///
/// # Errors
/// Where it cannot be read, or holds no session.
pub fn fleet_report(store: &dyn Storage, knobs: &PoolingKnobs) -> Result<FleetReport> {
    let mut sessions = of_table::<SessionRow>(store)?;
    if sessions.is_empty() {
        let problem = "there are no sessions of a fleet in it";
        let fix = "Make it first with `omni-gap fleet FOLDER --out STORE`";
        return Err(Error::input(&store.place(""), problem, fix).of_kind(InputKind::Missing));
    }
    sessions.sort_by(|a, b| a.session.cmp(&b.session));
    let mut equations: BTreeMap<(String, String), Vec<EquationRow>> = BTreeMap::new();
    for row in of_table::<EquationRow>(store)? {
        equations.entry((row.session.clone(), row.key.clone())).or_default().push(row);
    }
    let mut of_kind: BTreeMap<&str, Vec<SessionEvidence>> = BTreeMap::new();
    for session in &sessions {
        let Some(kind) = &session.kind else { continue };
        // rows of an answer that was never finished have another key, or no session
        let own = equations.remove(&(session.session.clone(), session.key.clone())).unwrap_or_default();
        of_kind.entry(kind).or_default().push(evidence(session, own));
    }
    let kind = |(kind, evidence): (&str, Vec<SessionEvidence>)| KindOfRobot {
        kind: kind.to_owned(),
        pooled: pooled(&evidence.iter().collect::<Vec<_>>(), knobs),
    };
    let kinds = of_kind.into_iter().map(kind).collect();
    Ok(FleetReport { schema: SCHEMA, kinds, sessions: sessions.iter().map(line).collect(), knobs: knobs.clone() })
}

fn causes(session: &SessionRow) -> Vec<String> {
    session.causes.split(',').filter(|cause| !cause.is_empty()).map(str::to_owned).collect()
}

fn line(session: &SessionRow) -> SessionLine {
    let row = session.clone();
    SessionLine {
        causes: causes(session),
        session: row.session,
        robot: row.robot,
        kind: row.kind,
        date: row.date,
        verdict: row.verdict,
        reason: row.reason,
        gap: row.gap,
        gap_after: row.gap_after,
        report: row.report,
    }
}

fn evidence(session: &SessionRow, rows: Vec<EquationRow>) -> SessionEvidence {
    SessionEvidence {
        session: session.session.clone(),
        robot: session.robot.clone(),
        date: session.date.clone(),
        firmware: session.firmware.clone(),
        floor: session.floor.clone(),
        named: causes(session),
        equations: (!rows.is_empty()).then(|| equations(rows)),
    }
}

fn equations(rows: Vec<EquationRow>) -> SessionEquations {
    let nothing = || vec![vec![0.0; Nominal::COUNT]; Nominal::COUNT];
    let (numbers, stated, toward) = (nothing(), nothing(), vec![0.0; Nominal::COUNT]);
    let mut all = SessionEquations { numbers, toward, stated, directions: Vec::new() };
    for row in rows {
        let number = Nominal::ALL.iter().position(|number| number.number().key == row.number);
        match (row.effect, number) {
            (Some(id), _) => all.directions.push(Direction {
                id,
                wheel: row.wheel.map(|wheel| wheel as usize),
                key: row.number,
                unit: row.unit,
                absent: row.absent,
                typical: row.typical,
                either_way: row.either_way,
                carried: row.carried,
                size: row.size,
                toward: row.toward,
                with_numbers: row.with.to_vec(),
            }),
            (None, Some(k)) => {
                all.numbers[k] = row.with.to_vec();
                all.toward[k] = row.toward;
                all.stated[k] = row.stated_with.to_vec();
            }
            (None, None) => {}
        }
    }
    all
}
