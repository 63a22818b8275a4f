//! A sound session, spoiled in a few places.

use std::sync::LazyLock;

use model_core::effects::EffectKind;
use omni_gap::known_effects;
use omni_gap::synthesize::{Scenario, synthesize};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

/// A robot file and two logs, as text.
#[derive(Clone, Debug)]
pub struct Texts {
    pub robot: String,
    pub runs: [String; 2],
}

/// What a field or a number may become.
const ODD: [&str; 18] = [
    "0", "-0", "-1", "1", "1e-300", "1e200", "-1e200", "65535", "nan", "inf", "-inf", "", "x", "3,5", "1e400", "0.5",
    "1000", "\"a\"",
];

/// One change to a robot file; indices count on beyond the end.
#[derive(Clone, Debug)]
enum RobotChange {
    Value(usize, &'static str),
    Scale(usize, f64),
    Remove(usize),
    Repeat(usize),
    Effect { id: &'static str, wheel: Option<usize>, values: Vec<&'static str>, typical: bool },
}

/// One change to both logs.
#[derive(Clone, Debug)]
enum LogChange {
    Field(usize, usize, &'static str),
    ScaleColumn(usize, f64),
    HoldColumn(usize),
    CopyColumn(usize, usize),
    RemoveColumn(usize),
    MagnitudeOf(usize),
    Truncate(usize),
    RepeatRow(usize),
    SwapRows(usize, usize),
    BlankColumn(usize),
    SameRunTwice,
}

fn factor() -> impl Strategy<Value = f64> {
    select(vec![-1.0, 0.0, 1e-9, 1e-3, 57.29577951308232, 0.1, 10.0, 1e3, 1e6, 1e9])
}

fn robot_change() -> impl Strategy<Value = RobotChange> {
    let ids: Vec<&'static str> =
        EffectKind::ALL.iter().map(|effect| effect.card().id).chain(["no_such_effect"]).collect();
    let effect = (select(ids), proptest::option::of(0_usize..6), vec(select(&ODD[..]), 4), any::<bool>());
    prop_oneof![
        (0_usize..64, select(&ODD[..])).prop_map(|(line, to)| RobotChange::Value(line, to)),
        (0_usize..64, factor()).prop_map(|(line, by)| RobotChange::Scale(line, by)),
        (0_usize..64).prop_map(RobotChange::Remove),
        (0_usize..64).prop_map(RobotChange::Repeat),
        effect.prop_map(|(id, wheel, values, typical)| RobotChange::Effect { id, wheel, values, typical }),
    ]
}

fn log_change() -> impl Strategy<Value = LogChange> {
    let (row, column) = (0_usize..200, 0_usize..20);
    prop_oneof![
        (row.clone(), column.clone(), select(&ODD[..])).prop_map(|(r, c, to)| LogChange::Field(r, c, to)),
        (column.clone(), factor()).prop_map(|(c, by)| LogChange::ScaleColumn(c, by)),
        column.clone().prop_map(LogChange::HoldColumn),
        (column.clone(), column.clone()).prop_map(|(a, b)| LogChange::CopyColumn(a, b)),
        column.clone().prop_map(LogChange::RemoveColumn),
        column.clone().prop_map(LogChange::MagnitudeOf),
        (0_usize..12).prop_map(LogChange::Truncate),
        row.clone().prop_map(LogChange::RepeatRow),
        (row.clone(), row).prop_map(|(a, b)| LogChange::SwapRows(a, b)),
        column.prop_map(LogChange::BlankColumn),
        Just(LogChange::SameRunTwice),
    ]
}

/// What was done to a sound session.
#[derive(Clone, Debug)]
pub struct Spoiled {
    three_wheels: bool,
    robot: Vec<RobotChange>,
    logs: Vec<LogChange>,
}

impl Spoiled {
    /// The session, spoiled.
    pub fn texts(&self) -> Texts {
        let mut texts = SOUND[usize::from(self.three_wheels)].clone();
        self.robot.iter().for_each(|change| change.apply(&mut texts.robot));
        self.logs.iter().for_each(|change| change.apply(&mut texts.runs));
        texts
    }
}

/// Sessions of three wheels or four with up to two changes to the robot file and to the logs.
pub fn spoiled() -> impl Strategy<Value = Spoiled> {
    (any::<bool>(), vec(robot_change(), 0..3), vec(log_change(), 0..3))
        .prop_map(|(three_wheels, robot, logs)| Spoiled { three_wheels, robot, logs })
}

static SOUND: LazyLock<[Texts; 2]> = LazyLock::new(|| {
    [include_str!("../../robots/feup-4w/robot.toml"), include_str!("../../robots/feup-3w/robot.toml")].map(|robot| {
        let plan = Scenario { runs: 2, duration: 1.5, rate: 100.0, ..Scenario::default() };
        let staged = synthesize(robot, &plan, &known_effects()).expect("the examples are sound");
        let text = |k: usize| {
            let mut text = Vec::new();
            staged.runs[k].write_csv(&mut text).expect("memory takes all");
            String::from_utf8(text).expect("numbers are text")
        };
        Texts { robot: staged.robot_text.clone(), runs: [text(0), text(1)] }
    })
});

impl RobotChange {
    fn apply(&self, text: &mut String) {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let count = lines.len();
        let with_value = |line: &str, to: &dyn Fn(&str) -> String| match line.split_once('=') {
            Some((key, value)) => format!("{key}= {}", to(value.split('#').next().unwrap_or("").trim())),
            None => line.to_owned(),
        };
        match self {
            Self::Value(line, to) => lines[line % count] = with_value(&lines[line % count], &|_| (*to).to_owned()),
            Self::Scale(line, by) => {
                let scaled = |value: &str| value.parse::<f64>().map_or(value.to_owned(), |x| format!("{:?}", x * by));
                lines[line % count] = with_value(&lines[line % count], &scaled);
            }
            Self::Remove(line) => drop(lines.remove(line % count)),
            Self::Repeat(line) => lines.insert(line % count, lines[line % count].clone()),
            Self::Effect { id, wheel, values, typical } => {
                lines.push(format!("[[effects.{id}]]"));
                lines.extend(wheel.map(|wheel| format!("wheel = {wheel}")));
                let params = EffectKind::find(id).map_or(&[][..], |effect| effect.card().params);
                for (param, value) in params.iter().zip(values) {
                    let value = if *typical { format!("{:?}", param.typical) } else { (*value).to_owned() };
                    lines.push(format!("{} = {value}", param.key));
                }
            }
        }
        *text = lines.join("\n") + "\n";
    }
}

impl LogChange {
    fn apply(&self, runs: &mut [String; 2]) {
        if let Self::SameRunTwice = self {
            runs[1] = runs[0].clone();
            return;
        }
        for text in runs {
            let mut rows: Vec<Vec<String>> =
                text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
            self.change(&mut rows);
            *text = rows.iter().map(|row| row.join(",") + "\n").collect();
        }
    }

    fn change(&self, rows: &mut Vec<Vec<String>>) {
        let (height, width) = (rows.len(), rows[0].len());
        // the header is row 0, and stays but where a column goes
        let body = |row: &usize| (1 + row % (height - 1).max(1)).min(height - 1);
        let each = |rows: &mut Vec<Vec<String>>, column: &usize, to: &dyn Fn(&str) -> String| {
            for row in rows.iter_mut().skip(1) {
                if let Some(field) = row.get_mut(column % width) {
                    *field = to(field);
                }
            }
        };
        let number = |text: &str, f: &dyn Fn(f64) -> f64| text.parse().map_or(text.to_owned(), |x| f(x).to_string());
        match self {
            Self::Field(row, column, to) => rows[body(row)][column % width] = (*to).to_owned(),
            Self::ScaleColumn(column, by) => each(rows, column, &|text| number(text, &|x| x * by)),
            Self::HoldColumn(column) => each(rows, column, &|text| number(text, &|_| 0.25)),
            Self::MagnitudeOf(column) => each(rows, column, &|text| number(text, &f64::abs)),
            Self::BlankColumn(column) => each(rows, column, &|_| String::new()),
            Self::CopyColumn(from, to) => {
                for row in rows.iter_mut().skip(1) {
                    row[to % width] = row[from % width].clone();
                }
            }
            Self::RemoveColumn(column) => rows.iter_mut().for_each(|row| drop(row.remove(column % width))),
            Self::Truncate(left) => rows.truncate(1 + left),
            Self::RepeatRow(row) => rows.insert(body(row), rows[body(row)].clone()),
            Self::SwapRows(a, b) => rows.swap(body(a), body(b)),
            Self::SameRunTwice => {}
        }
    }
}
