//! A fleet's report for tests.

use super::model::{FleetReport, KindOfRobot, SCHEMA, SessionLine};
use crate::pooling::{
    ChangePoint, CommonCause, Contrast, CourseDay, Pooled, PooledNumber, PoolingKnobs, RobotEstimate,
};
use crate::vocabulary::Verdict;

/// Three robots of a kind.
pub(super) fn fleet() -> FleetReport {
    let lines = [
        ("r01", "2026-11-03", Some(Verdict::NoGap), ""),
        ("r01", "2026-11-05", Some(Verdict::NoGap), ""),
        ("r02", "2026-11-03", Some(Verdict::Effect), "coriolis"),
        ("r03", "2026-11-03", None, ""),
    ];
    let session = |(robot, date, verdict, causes): &(&str, &str, Option<Verdict>, &str)| SessionLine {
        session: format!("logs/{robot}/{date}"),
        robot: (*robot).to_owned(),
        kind: Some("tester".to_owned()),
        date: (*date).to_owned(),
        verdict: *verdict,
        causes: causes.split(',').filter(|cause| !cause.is_empty()).map(str::to_owned).collect(),
        reason: verdict.is_none().then(|| "robot.toml:3: <no> number".to_owned()),
        gap: verdict.map(|_| 2.5),
        gap_after: verdict.map(|_| 1.1),
        report: verdict.map(|_| format!("reports/{robot}{date}")),
    };
    FleetReport {
        schema: SCHEMA,
        kinds: vec![KindOfRobot { kind: "tester".to_owned(), pooled: pooled() }],
        sessions: lines.iter().map(session).collect(),
        knobs: PoolingKnobs::default(),
    }
}

fn pooled() -> Pooled {
    let common = CommonCause {
        of: number("dead_time", None, "voltage_loss_V", "V"),
        title: "Dead time of the bridge".to_owned(),
        value: 0.21,
        std: 0.03,
        spread: 0.0,
        z: 7.0,
        probability: 0.97,
        named_alone: 0,
    };
    let estimate = |robot: &str, value: f64| RobotEstimate {
        robot: robot.to_owned(),
        of: number("gear_efficiency", Some(2), "efficiency", "1"),
        absent: 1.0,
        value,
        std: 0.02,
        from_kind: Some((value - 1.0) / 0.02),
        stands_out: value < 0.9,
    };
    let course = [("2026-11-03", 0.001), ("2026-11-05", 0.004)];
    let change = ChangePoint {
        robot: "r01".to_owned(),
        of: number("creep", None, "creep_m_s_per_N", "m/s/N"),
        last_before: "2026-11-03".to_owned(),
        since: "2026-11-05".to_owned(),
        by: 0.003,
        std: 0.0004,
        z: 7.5,
        course: course.map(|(date, value)| CourseDay { date: date.to_owned(), value, std: 0.0003 }).to_vec(),
    };
    let contrast = Contrast {
        label: "firmware".to_owned(),
        from: "1.3".to_owned(),
        to: "1.4".to_owned(),
        of: number("actuation_delay", None, "delay_s", "s"),
        by: 0.004,
        std: 0.0005,
        z: 8.0,
        robots: 2,
    };
    Pooled {
        robots: 3,
        in_common: Some(0.5),
        common: vec![common],
        estimates: vec![estimate("r01", 0.99), estimate("r02", 1.01), estimate("r03", 0.7)],
        changes: vec![change],
        contrasts: vec![contrast],
    }
}

fn number(id: &str, wheel: Option<usize>, key: &str, unit: &str) -> PooledNumber {
    PooledNumber { id: id.to_owned(), wheel, key: key.to_owned(), unit: unit.to_owned() }
}
