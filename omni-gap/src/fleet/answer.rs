//! One session, diagnosed: its rows.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use model_core::plant::robot::Nominal;
use rayon::ThreadPoolBuilder;
use sha2::{Digest, Sha256};

use super::cells::{Row, read, written};
use super::find::FoundSession;
use super::key::key_of;
use super::rows::{CauseRow, EquationRow, SessionRow};
use crate::api::inputs;
use crate::diagnosis::{Diagnosis, Options};
use crate::engine::Knobs;
use crate::engine::findings::{ConsideredCause, Direction, Findings, SessionEquations};
use crate::error::{Error, Result};
use crate::known::known_effects;
use crate::log::{Run, Session};
use crate::report::{self, Beside};

/// The rows of a session.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionAnswer {
    pub(super) session: SessionRow,
    pub(super) causes: Vec<CauseRow>,
    pub(super) equations: Vec<EquationRow>,
}

/// Diagnoses a session on one thread, unless it is as it was when the answer of the key `held` was made. Its report is put below
/// `reports`, the folder of the store, where that is named.
///
/// Nothing that a session has wrong is an error: it is a row with its reason.
///
/// # Errors
/// Where its report cannot be written, which says nothing of the session: it is done again once there is room.
pub fn answer_session(
    found: &FoundSession,
    held: Option<&str>,
    knobs: &Knobs,
    reports: Option<&Path>,
) -> Result<Option<SessionAnswer>> {
    let key = match key_of(found, knobs) {
        Ok(key) if held == Some(&key) => return Ok(None),
        Ok(key) => key,
        Err(why) => return Ok(Some(SessionAnswer::unreadable(found, &why.to_string()))),
    };
    if let Some(why) = &found.refused {
        return Ok(Some(SessionAnswer::failed(found, key, why)));
    }
    let name = report_folder(&found.name, &key);
    let keep = reports.map(|store| (store.join(&name), name));
    let one = match ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(one) => one,
        Err(why) => return Ok(Some(SessionAnswer::unreadable(found, &why.to_string()))),
    };
    // nothing of it is used after a panic, and one session's must not end a night's work on the others
    let failed = match catch_unwind(AssertUnwindSafe(|| one.install(|| diagnosed(found, &key, knobs, keep)))) {
        Ok(Ok(answer)) => return Ok(Some(answer)),
        Ok(Err(why @ Error::Output { .. })) => return Err(why),
        Ok(Err(why)) => why.to_string(),
        Err(_) => "the program itself failed on it: `omni-gap diagnose` of this session tells where".to_owned(),
    };
    Ok(Some(SessionAnswer::failed(found, key, &failed)))
}

/// Where a session's report is kept: two copies of a session have a report each.
fn report_folder(session: &str, key: &str) -> String {
    let mut hash = Sha256::new();
    hash.update(session);
    hash.update(key);
    format!("reports/{}", &format!("{:x}", hash.finalize())[..16])
}

impl SessionAnswer {
    /// The session's own row.
    pub fn session(&self) -> &SessionRow {
        &self.session
    }

    /// The rows as Parquet files, to send them elsewhere: of `sessions`, `causes` and `equations`.
    ///
    /// # Errors
    /// Where Parquet refuses them.
    pub fn to_parquet(&self) -> Result<[Vec<u8>; 3]> {
        Ok([file(std::slice::from_ref(&self.session))?, file(&self.causes)?, file(&self.equations)?])
    }

    /// The other way round.
    ///
    /// # Errors
    /// Where these are not the files of one session.
    pub fn of_parquet([sessions, causes, equations]: [Vec<u8>; 3]) -> Result<Self> {
        let [session] = <[SessionRow; 1]>::try_from(rows(sessions)?)
            .map_err(|found| unfit::<SessionRow>(format!("found {} rows, expected one", found.len())))?;
        Ok(Self { session, causes: rows(causes)?, equations: rows(equations)? })
    }

    /// A session that could not be read, and why; asked again, it is read again.
    pub fn unreadable(found: &FoundSession, why: &str) -> Self {
        Self::failed(found, String::new(), why)
    }

    /// A session without an answer.
    fn failed(found: &FoundSession, key: String, why: &str) -> Self {
        let session = SessionRow { reason: Some(why.to_owned()), ..blank(found, &key) };
        Self { session, causes: Vec::new(), equations: Vec::new() }
    }
}

fn file<R: Row>(rows: &[R]) -> Result<Vec<u8>> {
    written(rows, &[]).map_err(|why| unfit::<R>(why.to_string()))
}

fn rows<R: Row>(bytes: Vec<u8>) -> Result<Vec<R>> {
    read(bytes, &[]).map_err(|why| unfit::<R>(why.to_string()))
}

fn unfit<R: Row>(why: String) -> Error {
    Error::input(Path::new(R::TABLE), why, "Send the three files of one answer, by the same version of omni-gap")
}

fn diagnosed(found: &FoundSession, key: &str, knobs: &Knobs, keep: Option<(PathBuf, String)>) -> Result<SessionAnswer> {
    let session = Session::load(&found.path, None, &known_effects())?;
    let name = found.path.file_name().map(|name| name.to_string_lossy().into_owned());
    let mut diagnosis = Diagnosis::of(&session, &Options { session: name, knobs: knobs.clone(), ..Options::default() });
    let mut row = SessionRow { kind: Some(session.robot.name.clone()), ..blank(found, key) };
    if found.robot.is_none() {
        row.robot.clone_from(&session.robot.name);
    }
    if let Some((folder, name)) = keep {
        diagnosis.report.inputs = inputs([&session])?;
        let page = report::html(&diagnosis.report, &diagnosis.pictures);
        let (refitted, corrected) = (diagnosis.refitted_robot.as_deref(), diagnosis.corrected_robot.as_deref());
        report::write(&folder, &diagnosis.report, &page, Beside { refitted, corrected, script: None })?;
        row.report = Some(name);
    }
    let report = &diagnosis.report;
    let runs = || session.runs.iter().chain(&session.heldout);
    let length = |run: &Run| run.t_s.last().zip(run.t_s.first()).map_or(0.0, |(last, first)| last - first);
    row.verdict = Some(report.verdict);
    row.reason = report.faults.first().map(|fault| fault.what.clone());
    row.causes = report.causes.join(",");
    row.runs = runs().count() as u32;
    row.rows = runs().map(|run| run.rows() as u64).sum();
    row.duration_s = runs().map(length).sum();
    (row.gap, row.gap_after, row.floor_of_gap) = (report.shrink.before, report.shrink.after, report.shrink.noise_floor);
    let causes = cause_rows(&row, &diagnosis.findings);
    let equations = diagnosis.findings.equations.iter().flat_map(|equations| equation_rows(&row, equations)).collect();
    Ok(SessionAnswer { session: row, causes, equations })
}

fn blank(found: &FoundSession, key: &str) -> SessionRow {
    SessionRow {
        key: key.to_owned(),
        session: found.name.clone(),
        robot: found.robot.clone().unwrap_or_else(|| "unnamed".to_owned()),
        kind: None,
        date: found.date.to_string(),
        firmware: found.firmware.clone(),
        floor: found.floor.clone(),
        verdict: None,
        reason: None,
        causes: String::new(),
        runs: 0,
        rows: 0,
        duration_s: 0.0,
        gap: None,
        gap_after: None,
        floor_of_gap: None,
        report: None,
    }
}

fn cause_rows(session: &SessionRow, findings: &Findings) -> Vec<CauseRow> {
    let rows = |cause: &ConsideredCause| {
        let probability = findings.which.iter().find(|which| which.cause == cause.id).map(|which| which.probability);
        let row = |number: &crate::engine::findings::EstimatedNumber| CauseRow {
            key: session.key.clone(),
            session: session.session.clone(),
            robot: session.robot.clone(),
            date: session.date.clone(),
            cause: cause.id.clone(),
            cause_kind: cause.kind,
            wheel: cause.wheel.map(|wheel| wheel as u32),
            axis: cause.axis,
            round: cause.round as u32,
            taken_up: cause.taken_up,
            number: number.key.clone(),
            unit: number.unit.clone(),
            absent: number.absent,
            value: number.value,
            std: number.std,
            promise: cause.promise,
            gain: cause.gain,
            probability,
        };
        cause.numbers.iter().map(row).collect::<Vec<_>>()
    };
    findings.considered.iter().flat_map(rows).collect()
}

fn equation_rows(session: &SessionRow, equations: &SessionEquations) -> Vec<EquationRow> {
    let list = |values: &[f64]| std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0));
    let own = |number: Nominal| {
        let k = number as usize;
        EquationRow {
            key: session.key.clone(),
            session: session.session.clone(),
            effect: None,
            wheel: None,
            number: number.number().key.to_owned(),
            unit: "1".to_owned(),
            absent: 1.0,
            typical: 1.0,
            either_way: true,
            carried: false,
            size: equations.numbers[k][k],
            toward: equations.toward[k],
            with: list(&equations.numbers[k]),
            stated_with: list(&equations.stated[k]),
        }
    };
    let of = |direction: &Direction| EquationRow {
        effect: Some(direction.id.clone()),
        wheel: direction.wheel.map(|wheel| wheel as u32),
        number: direction.key.clone(),
        unit: direction.unit.clone(),
        absent: direction.absent,
        typical: direction.typical,
        either_way: direction.either_way,
        carried: direction.carried,
        size: direction.size,
        toward: direction.toward,
        with: list(&direction.with_numbers),
        stated_with: [0.0; Nominal::COUNT],
        ..own(Nominal::Mass)
    };
    Nominal::ALL.map(own).into_iter().chain(equations.directions.iter().map(of)).collect()
}
