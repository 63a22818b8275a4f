//! What a fitted model changes in a robot file.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::log::{Change, EffectEntry, RobotFile};

/// Changes to a robot file.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct FileChanges {
    /// Numbers that are set, in the order of the file's keys.
    pub numbers: Vec<NumberChange>,
    /// Effects that are written in.
    pub effects: Vec<EffectChange>,
}

/// A number that is set.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct NumberChange {
    /// Its path, such as `body.mass_kg` or `wheel[2].radius_m`.
    pub path: String,
    /// The number, in the key's unit.
    pub value: f64,
}

/// An effect that is written in.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct EffectChange {
    /// Its id in the catalogue.
    pub id: String,
    /// The wheel that it sits on alone.
    pub wheel: Option<usize>,
    /// Its parameters by key, in the unit that the key ends with.
    pub params: BTreeMap<String, f64>,
}

impl FileChanges {
    /// The same as changes that [`corrected`](crate::log::corrected) writes.
    pub fn changes(&self) -> Vec<Change> {
        let number = |n: &NumberChange| Change::Number { path: n.path.clone(), value: n.value };
        let effect = |e: &EffectChange| {
            Change::Effect(EffectEntry { id: e.id.clone(), wheel: e.wheel, params: e.params.clone() })
        };
        self.numbers.iter().map(number).chain(self.effects.iter().map(effect)).collect()
    }

    /// A robot file with these numbers, and with these effects alone.
    pub fn applied_to(&self, file: &RobotFile) -> RobotFile {
        let mut changed = file.clone();
        for NumberChange { path, value } in &self.numbers {
            let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
            let wheel = table.split_once('[').and_then(|(_, at)| at.trim_end_matches(']').parse().ok()).unwrap_or(0);
            if let Some(number) = changed.nominal_mut(key, wheel) {
                *number = *value;
            }
        }
        changed.effects = self
            .effects
            .iter()
            .map(|e| EffectEntry { id: e.id.clone(), wheel: e.wheel, params: e.params.clone() })
            .collect();
        changed
    }
}

impl From<Vec<Change>> for FileChanges {
    fn from(changes: Vec<Change>) -> Self {
        let mut all = Self::default();
        for change in changes {
            match change {
                Change::Number { path, value } => all.numbers.push(NumberChange { path, value }),
                Change::Effect(EffectEntry { id, wheel, params }) => {
                    all.effects.push(EffectChange { id, wheel, params });
                }
            }
        }
        all
    }
}
