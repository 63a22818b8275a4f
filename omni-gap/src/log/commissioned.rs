//! # `[[commissioned]]`: which lead of a motor is soldered where
//!
//! Left in a robot file by `omni-gap robot commission`, read by `omni-gap export`; no diagnosis looks at it.
//!
//! ```toml
//! [[commissioned]]
//! wheel = 0
//! outputs = [0, 2, 1]                    # outputs of the gate driver that phases a, b, c hang on
//! converters = [1, 2, 0]                 # converters that measure their currents
//! inverted = [false, true, false]        # whose codes fall with the current into the motor
//! hall_codes = [1, 3, 2, 6, 4, 5]        # of the six sectors, forward: line a is 1, b is 2, c is 4
//! hall_edges_deg = [-31.2, 29.0, 92.7, 150.3, 208.9, 271.1]   # where each sector begins, electrical
//! ```

use model_core::control::halls::HallCode;
use model_core::control::wiring::MotorWiring;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, TableLike, Value, value};

use super::toml_walk::{Section, Source, tables};
use crate::error::{Error, InputKind, Result};

/// How one motor is wired.
#[derive(Debug, Clone, Copy, PartialEq, JsonSchema, Serialize)]
pub struct CommissionedFile {
    /// Its wheel, counted from 0.
    pub wheel: usize,
    /// Outputs of the gate driver that phases a, b, c hang on.
    pub outputs: [u8; 3],
    /// Converters that measure their currents.
    pub converters: [u8; 3],
    /// Whether their codes fall with the current into the motor.
    pub inverted: [bool; 3],
    /// Hall codes of the six sectors, forward: line a is 1, b is 2, c is 4.
    pub hall_codes: [u8; 6],
    /// Where each sector begins, electrical (degrees).
    pub hall_edges_deg: [f64; 6],
}

const KEYS: [&str; 6] = ["wheel", "outputs", "converters", "inverted", "hall_codes", "hall_edges_deg"];

impl CommissionedFile {
    /// A wheel's motor that is wired like that.
    pub fn of(wheel: usize, wiring: &MotorWiring) -> Self {
        // around zero, to a thousandth: a robot has them to 0.005°
        let degrees = |edge: u16| (f64::from(edge.cast_signed()) * 360_000.0 / 65_536.0).round() / 1000.0;
        Self {
            wheel,
            outputs: wiring.outputs,
            converters: wiring.converters,
            inverted: wiring.inverted,
            hall_codes: wiring.codes.map(|code| code.0),
            hall_edges_deg: wiring.edges.map(degrees),
        }
    }

    /// The wiring, as a robot gets it.
    pub fn wiring(&self) -> MotorWiring {
        MotorWiring {
            outputs: self.outputs,
            converters: self.converters,
            inverted: self.inverted,
            codes: self.hall_codes.map(HallCode),
            edges: self.hall_edges_deg.map(|edge| (edge.rem_euclid(360.0) * 65_536.0 / 360.0).round() as u32 as u16),
        }
    }
}

/// The entries of a robot file with so many wheels.
pub(super) fn commissioned(source: Source, item: &Item, wheels: usize) -> Result<Vec<CommissionedFile>> {
    let list = tables(item)
        .ok_or_else(|| source.error(item.span(), "`commissioned` is not a list of tables", "Write [[commissioned]]"))?;
    let mut found: Vec<CommissionedFile> = Vec::new();
    for table in list {
        let entry = entry(&Section::of(source, "[[commissioned]]", table, item.span()), wheels)?;
        if found.iter().any(|other| other.wheel == entry.wheel) {
            let problem = format!("wheel {} is commissioned twice", entry.wheel);
            return Err(source.error(item.span(), problem, "Leave one of the two").of_kind(InputKind::Conflict));
        }
        found.push(entry);
    }
    Ok(found)
}

fn entry(s: &Section, wheels: usize) -> Result<CommissionedFile> {
    s.only_keys(&KEYS)?;
    let wheel = s.needed("wheel")?;
    let wheel = s.checked("wheel", wheel, (0..wheels).any(|k| k as f64 == wheel), "a wheel of this robot, from 0")?;
    let small = |value: &Value| value.as_integer().and_then(|number| u8::try_from(number).ok());
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    let entry = CommissionedFile {
        wheel: wheel as usize,
        outputs: list(s, "outputs", small)?,
        converters: list(s, "converters", small)?,
        inverted: list(s, "inverted", Value::as_bool)?,
        hall_codes: list(s, "hall_codes", small)?,
        hall_edges_deg: list(s, "hall_edges_deg", |value| number(value).filter(|x| x.is_finite()))?,
    };
    if !entry.wiring().is_possible() {
        let problem = "no motor is wired like that: each lead once, six codes, edges within 45° of -30, 30, 90, ...";
        return Err(s.error(problem, "Commission the motor anew: `omni-gap robot commission`"));
    }
    Ok(entry)
}

fn list<T, const K: usize>(s: &Section, key: &str, of: impl Fn(&Value) -> Option<T>) -> Result<[T; K]> {
    let values = s.table.get(key).and_then(Item::as_array);
    let values: Option<Vec<T>> = values.and_then(|values| values.iter().map(of).collect());
    values.and_then(|values| values.try_into().ok()).ok_or_else(|| {
        let problem = format!("`{key}` is no list of {K}, as a commissioning leaves it");
        s.key_error(key, problem, "Commission the motor anew: `omni-gap robot commission`")
    })
}

/// The text of a robot file with these motors' wirings written in; those of other motors stay.
pub fn with_commissioned(text: &str, motors: &[CommissionedFile]) -> Result<String> {
    let broken = |broken: toml_edit::TomlError| {
        Error::input(Path::new("robot.toml"), broken.message(), "Correct the robot file").of_kind(InputKind::Malformed)
    };
    let mut document: DocumentMut = text.parse().map_err(broken)?;
    let before = document.remove("commissioned").and_then(|item| item.into_array_of_tables().ok()).unwrap_or_default();
    let written = |table: &Table| motors.iter().any(|motor| wheel_of(table) == i64::try_from(motor.wheel).ok());
    let mut all: Vec<Table> = before.into_iter().filter(|table| !written(table)).collect();
    all.extend(motors.iter().map(table_of));
    all.sort_by_key(|table| wheel_of(table));
    document.insert("commissioned", Item::ArrayOfTables(ArrayOfTables::from_iter(all)));
    Ok(document.to_string())
}

fn wheel_of(table: &dyn TableLike) -> Option<i64> {
    table.get("wheel")?.as_integer()
}

fn table_of(motor: &CommissionedFile) -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    let whole = |numbers: &[u8]| value(numbers.iter().map(|x| i64::from(*x)).collect::<Array>());
    table.insert("wheel", value(motor.wheel as i64));
    table.insert("outputs", whole(&motor.outputs));
    table.insert("converters", whole(&motor.converters));
    table.insert("inverted", value(motor.inverted.iter().copied().collect::<Array>()));
    table.insert("hall_codes", whole(&motor.hall_codes));
    table.insert("hall_edges_deg", value(motor.hall_edges_deg.iter().copied().collect::<Array>()));
    table
}

#[cfg(test)]
mod tests {
    use super::super::{Catalogue, RobotFile};
    use super::*;

    const FILE: &str = include_str!("../../robots/feup-4w/robot.toml");

    fn crossed() -> MotorWiring {
        let inverted = [true, false, false];
        MotorWiring {
            outputs: [0, 2, 1],
            inverted,
            edges: [59_900, 5_500, 16_000, 27_000, 38_500, 49_000],
            ..MotorWiring::default()
        }
    }

    fn read(text: &str) -> Result<RobotFile> {
        RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default())
    }

    #[test]
    fn what_was_found_is_written_behind_the_file_and_read_as_it_was() {
        let motors = [2, 0].map(|wheel| CommissionedFile::of(wheel, &crossed()));
        let text = with_commissioned(FILE, &motors).unwrap();
        assert!(text.starts_with(FILE) && text.contains("outputs = [0, 2, 1]\n"), "{text}");
        let file = read(&text).unwrap();
        assert_eq!(file.commissioned.iter().map(|entry| entry.wheel).collect::<Vec<_>>(), [0, 2]);
        assert_eq!(file.commissioned[1].wiring(), crossed(), "to the last bit of an edge");
        // anew for one of them: the other stays
        let anew = with_commissioned(&text, &[CommissionedFile::of(0, &MotorWiring::default())]).unwrap();
        let file = read(&anew).unwrap();
        assert_eq!(
            file.commissioned.iter().map(CommissionedFile::wiring).collect::<Vec<_>>(),
            [MotorWiring::default(), crossed()]
        );
        assert!(anew.starts_with(FILE));
    }

    #[test]
    fn what_no_motor_is_wired_like_is_refused_with_its_place() {
        let text = with_commissioned(FILE, &[CommissionedFile::of(1, &crossed())]).unwrap();
        for (from, to, says) in [
            ("[0, 2, 1]", "[0, 2, 2]", "no motor is wired like that"),
            ("[0, 2, 1]", "[0, 2]", "`outputs` is no list of 3"),
            ("wheel = 1\n", "wheel = 4\n", "found 4, expected a wheel of this robot"),
            ("inverted", "invreted", "Did you mean `inverted`?"),
        ] {
            let told = read(&text.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(told.contains(says), "{told}");
        }
        let twice = format!("{text}{}", text.strip_prefix(FILE).unwrap());
        assert!(read(&twice).unwrap_err().to_string().contains("wheel 1 is commissioned twice"));
    }
}
