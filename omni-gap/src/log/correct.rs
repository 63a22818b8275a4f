//! # Writing a robot file back with changes
//!
//! The user's comments, order and spelling stay; only the numbers that change are rewritten, and effects are added.

use super::robot_file::EffectEntry;
use super::toml_walk::Source;
use crate::error::{Error, InputKind, Result};
use std::path::Path;
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, value};

/// One change to a robot file.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// Sets a number by its path, such as `body.mass_kg` or `wheel[2].radius_m`. What lies on the way is made.
    Number {
        /// The path.
        path: String,
        /// The number, in the key's unit.
        value: f64,
    },
    /// Writes an effect: into its own table where the file has one for the same wheel, or in a new one.
    Effect(EffectEntry),
}

/// The text of a robot file with the changes written in.
pub fn corrected(text: &str, changes: &[Change]) -> Result<String> {
    let path = Path::new("robot.toml");
    Source { path, text }.parse()?;
    let unreadable = |broken: toml_edit::TomlError| {
        Error::input(path, broken.message(), "Correct the robot file").of_kind(InputKind::Malformed)
    };
    let mut document: DocumentMut = text.parse().map_err(unreadable)?;
    for change in changes {
        match change {
            Change::Number { path: at, value } => set_number(document.as_table_mut(), at, *value).ok_or_else(|| {
                Error::input(path, format!("there is no place `{at}`"), "Correct the path").of_kind(InputKind::Missing)
            })?,
            Change::Effect(entry) => set_effect(document.as_table_mut(), entry)
                .ok_or_else(|| Error::input(path, "`effects` is not a table", "Write [effects.<id>] tables"))?,
        }
    }
    Ok(document.to_string())
}

fn set_number(root: &mut Table, path: &str, number: f64) -> Option<()> {
    let (way, key) = path.rsplit_once('.').unwrap_or(("", path));
    let mut here: &mut dyn toml_edit::TableLike = root;
    for step in way.split('.').filter(|step| !step.is_empty()) {
        let (name, index) = match step.split_once('[') {
            Some((name, index)) => (name, Some(index.strip_suffix(']')?.parse::<usize>().ok()?)),
            None => (step, None),
        };
        let item = here.entry(name).or_insert_with(|| Item::Table(Table::new()));
        here = match (index, item) {
            (None, item) => item.as_table_like_mut()?,
            (Some(index), Item::ArrayOfTables(list)) => list.get_mut(index)?,
            (Some(index), item) => item.as_array_mut()?.get_mut(index)?.as_inline_table_mut()?,
        };
    }
    set(here, key, number);
    Some(())
}

/// Sets one key, keeping the comment behind the old value.
fn set(table: &mut dyn toml_edit::TableLike, key: &str, number: f64) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            let decor = old.decor().clone();
            *old = toml_edit::Value::from(number);
            *old.decor_mut() = decor;
        }
        None => {
            table.insert(key, value(number));
        }
    }
}

fn set_effect(root: &mut Table, entry: &EffectEntry) -> Option<()> {
    let effects = root.entry("effects").or_insert_with(|| {
        let mut table = Table::new();
        table.set_implicit(true);
        Item::Table(table)
    });
    let effects = effects.as_table_like_mut()?;
    if let Some(inline) = effects.get_mut(&entry.id).and_then(Item::as_inline_table_mut) {
        let table = std::mem::take(inline).into_table();
        effects.insert(&entry.id, Item::Table(table));
    }
    match effects.get_mut(&entry.id) {
        None => {
            let item = match entry.wheel {
                None => Item::Table(table_of(entry)),
                Some(_) => Item::ArrayOfTables(ArrayOfTables::from_iter([table_of(entry)])),
            };
            effects.insert(&entry.id, item);
        }
        Some(Item::Table(table)) if wheel_of(table) == entry.wheel => fill(table, entry),
        Some(item @ Item::Table(_)) => {
            let first = std::mem::take(item).into_table().ok()?;
            *item = Item::ArrayOfTables(ArrayOfTables::from_iter([first, table_of(entry)]));
        }
        Some(Item::ArrayOfTables(list)) => {
            let place = list.iter().position(|table| wheel_of(table) == entry.wheel);
            match place.and_then(|place| list.get_mut(place)) {
                Some(table) => fill(table, entry),
                None => list.push(table_of(entry)),
            }
        }
        Some(_) => return None,
    }
    Some(())
}

fn wheel_of(table: &Table) -> Option<usize> {
    table.get("wheel")?.as_integer()?.try_into().ok()
}

fn table_of(entry: &EffectEntry) -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    if let Some(wheel) = entry.wheel {
        table.insert("wheel", value(wheel as i64));
    }
    fill(&mut table, entry);
    table
}

fn fill(table: &mut Table, entry: &EffectEntry) {
    for (key, number) in &entry.params {
        set(table, key, *number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn effect(id: &str, wheel: Option<usize>, key: &str, number: f64) -> Change {
        Change::Effect(EffectEntry { id: id.into(), wheel, params: [(key.to_string(), number)].into() })
    }

    fn number(path: &str, value: f64) -> Change {
        Change::Number { path: path.into(), value }
    }

    const TEXT: &str = "# my robot\nname = \"r\"\n\n[[wheel]]\nradius_m = 0.03 # measured\n[[wheel]]\nradius_m = 0.04\n\n[body] # heavy\nmass_kg = 2 # on a kitchen scale\n";

    #[test]
    fn numbers_change_and_comments_stay() {
        let after = corrected(TEXT, &[number("body.mass_kg", 2.5), number("wheel[1].radius_m", 0.05)]).unwrap();
        assert_eq!(after, TEXT.replace("= 2 #", "= 2.5 #").replace("0.04", "0.05"));
    }

    #[test]
    fn a_number_in_a_table_that_was_not_there_makes_the_table() {
        let after = corrected(TEXT, &[number("friction.coulomb_v_N", 1.0)]).unwrap();
        assert!(after.starts_with(TEXT) && after.ends_with("[friction]\ncoulomb_v_N = 1.0\n"), "{after}");
    }

    #[test]
    fn effects_are_added_as_tables_and_one_per_wheel_as_a_list() {
        let changes = [
            effect("coriolis", None, "factor", 1.0),
            effect("motor_mismatch", Some(2), "torque_constant_ratio", 0.88),
            effect("motor_mismatch", Some(0), "torque_constant_ratio", 0.9),
        ];
        let after = corrected(TEXT, &changes).unwrap();
        let added = "\n[effects.coriolis]\nfactor = 1.0\n\n[[effects.motor_mismatch]]\nwheel = 2\n\
                     torque_constant_ratio = 0.88\n\n[[effects.motor_mismatch]]\nwheel = 0\ntorque_constant_ratio = 0.9\n";
        assert_eq!(after, format!("{TEXT}{added}"));
        assert_eq!(corrected(&after, &changes).unwrap(), after, "writing the same again changes nothing");
    }

    #[test]
    fn an_effect_for_another_wheel_turns_a_table_into_a_list() {
        let text = "[effects.motor_mismatch] # known\nwheel = 1\ntorque_constant_ratio = 0.9\n";
        let after = corrected(text, &[effect("motor_mismatch", Some(2), "torque_constant_ratio", 0.8)]).unwrap();
        assert_eq!(after.matches("[[effects.motor_mismatch]]").count(), 2, "{after}");
        assert!(after.parse::<DocumentMut>().is_ok());
    }

    #[test]
    fn a_path_that_leads_nowhere_is_refused() {
        assert!(corrected(TEXT, &[number("wheel[7].radius_m", 1.0)]).is_err());
        assert!(corrected("name = [", &[]).is_err());
    }
}
