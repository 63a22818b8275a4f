//! The keys of a robot file's nominal numbers, and what a model's factors make of them.

use model_core::effects::nominal::{IN_THE_FILE, Number, Table};
use model_core::plant::robot::Nominal;

use crate::log::{Change, RobotFile};

/// A nominal number of a robot file, as its card says.
#[derive(Clone, Copy, Debug)]
pub struct NominalKey {
    /// Its key.
    pub key: &'static str,
    /// The table that holds it; `wheel` stands for every wheel.
    pub table: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The factors that multiply it.
    pub factors: &'static [Nominal],
}

/// All of them, in the order of the file. Of the wheels, the first one's number stands for all.
pub const NOMINAL_KEYS: [NominalKey; Nominal::COUNT] = {
    let mut keys = [NominalKey { key: "", table: "", unit: "", factors: &[] }; Nominal::COUNT];
    let mut k = 0;
    while k < keys.len() {
        let Number { key, table, unit, factors, .. } = *IN_THE_FILE[k];
        keys[k] = NominalKey { key, table: table.name(), unit, factors };
        k += 1;
    }
    keys
};

impl NominalKey {
    /// The number of this key.
    pub fn of(key: &str) -> Option<&'static NominalKey> {
        NOMINAL_KEYS.iter().find(|k| k.key == key)
    }

    /// The number that this factor alone multiplies.
    pub fn alone(nominal: Nominal) -> Option<&'static NominalKey> {
        NOMINAL_KEYS.iter().find(|key| key.factors == [nominal])
    }

    /// The file's number (of the first wheel, for a wheel's key) in SI units.
    pub fn value(&self, file: &RobotFile) -> f64 {
        file.nominal(self.key, 0).expect("a card's number stands in every robot file")
    }

    /// The product of this number's factors.
    pub fn factor(&self, factors: &[f64; Nominal::COUNT]) -> f64 {
        self.factors.iter().map(|p| factors[*p as usize]).product()
    }

    /// The changes that multiply this number of a file; for a wheel's key, of all its wheels.
    pub fn scaled(&self, file: &RobotFile, factor: f64) -> Vec<Change> {
        if self.table != Table::Wheel.name() {
            let path = format!("{}.{}", self.table, self.key);
            return vec![Change::Number { path, value: self.value(file) * factor }];
        }
        (0..file.wheel.len())
            .filter_map(|j| {
                let path = format!("{}[{j}].{}", self.table, self.key);
                Some(Change::Number { path, value: file.nominal(self.key, j)? * factor })
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::log::Catalogue;

    const FILE: &str = include_str!("../../robots/feup-4w/robot.toml");

    #[test]
    fn every_number_of_a_card_is_read_and_written_where_the_file_has_it() {
        let path = Path::new("robot.toml");
        let mut file = RobotFile::parse(FILE, path, &Catalogue::default()).expect("the example is sound");
        let document: toml_edit::DocumentMut = FILE.parse().expect("the example is TOML");
        for key in &NOMINAL_KEYS {
            let table = if key.table == "wheel" { &document["wheel"][0] } else { &document[key.table] };
            let written = table[key.key].as_float().unwrap_or_else(|| panic!("{} is not in [{}]", key.key, key.table));
            assert_eq!(key.value(&file), written, "{}", key.key);
            *file.nominal_mut(key.key, 0).expect("a number of the file") *= 1.25;
            assert_eq!(key.value(&file), 1.25 * written, "{}", key.key);
        }
    }

    #[test]
    fn a_scaled_number_is_scaled_on_every_wheel_and_read_back() {
        let path = Path::new("robot.toml");
        let file = RobotFile::parse(FILE, path, &Catalogue::default()).expect("the example is sound");
        for key in &NOMINAL_KEYS {
            let changes = key.scaled(&file, 1.5);
            assert_eq!(changes.len(), if key.table == "wheel" { file.wheel.len() } else { 1 }, "{}", key.key);
            let text = crate::log::corrected(FILE, &changes).expect("the path leads somewhere");
            let after = RobotFile::parse(&text, path, &Catalogue::default()).expect("sound as before");
            assert_eq!(key.value(&after), 1.5 * key.value(&file), "{}", key.key);
        }
    }
}
