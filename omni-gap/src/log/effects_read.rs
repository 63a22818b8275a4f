//! # `[effects]`: what the nominal model already includes
//!
//! Each effect says where it sits ([`Scope`]), which keys it has and from where to where they go; a table that says
//! anything else is refused with its line. One effect acts at most once on a wheel.

use model_core::effects::card::Scope;

use super::catalogue::{Catalogue, KnownEffect, nearest};
use super::robot_file::EffectEntry;
use super::toml_walk::{Section, tables};
use crate::error::{Error, InputKind, Result};
use std::collections::BTreeMap;

pub(super) fn effects(s: &Section, catalogue: &Catalogue, wheels: usize) -> Result<Vec<EffectEntry>> {
    let mut all: Vec<EffectEntry> = Vec::new();
    for (id, item) in s.table.iter() {
        let known = catalogue.find(id).ok_or_else(|| unknown(s, id, catalogue))?;
        let listed = tables(item);
        let one = || item.as_table_like().map(|table| vec![table]);
        let Some(list) = listed.or_else(one) else {
            let problem = format!("found {}, expected a table of parameters", item.type_name());
            return Err(s.key_error(id, problem, format!("Write [effects.{id}] and its parameters below it")));
        };
        for (number, table) in list.into_iter().enumerate() {
            let span = item.as_array_of_tables().and_then(|list| list.get(number)?.span()).or_else(|| item.span());
            let title = format!("[effects.{id}]");
            let section = Section::of(s.source, &title, table, span);
            let entry = effect(&section, known, wheels)?;
            if let Some(other) = all.iter().find(|other| other.id == entry.id && overlap(other, &entry)) {
                return Err(twice(&section, other, &entry));
            }
            if all.len() == catalogue.most_at_once {
                let problem = format!("a model has room for {} effects, this is one more", catalogue.most_at_once);
                return Err(section.error(problem, "Leave out the effects that matter least").in_column(id));
            }
            all.push(entry);
        }
    }
    Ok(all)
}

fn unknown(s: &Section, id: &str, catalogue: &Catalogue) -> Error {
    let fix = match nearest(id, catalogue.effects.iter().map(|effect| effect.id.as_str())) {
        Some(near) => format!("Did you mean `{near}`?"),
        None => "`omni-gap explain` lists the effects there are".to_string(),
    };
    s.key_error(id, format!("unknown effect `{id}`"), fix).of_kind(InputKind::Unknown)
}

/// Whether two tables of one effect act on the same wheel.
fn overlap(one: &EffectEntry, other: &EffectEntry) -> bool {
    one.wheel.is_none() || other.wheel.is_none() || one.wheel == other.wheel
}

fn twice(s: &Section, before: &EffectEntry, now: &EffectEntry) -> Error {
    let id = &now.id;
    let (problem, fix) = match (before.wheel, now.wheel) {
        (None, None) => (format!("`{id}` stands twice"), "Keep one of the two tables".to_string()),
        (Some(a), Some(b)) if a == b => {
            (format!("`{id}` on wheel {a} stands twice"), "Keep one of the two tables".to_string())
        }
        (a, b) => {
            let wheel = a.or(b).unwrap_or(0);
            let problem = format!("`{id}` stands on all wheels and on wheel {wheel} too, so that it acts there twice");
            (problem, "Remove the table without `wheel`, or give every wheel a table of its own".to_string())
        }
    };
    s.error(problem, fix).in_column(id).of_kind(InputKind::Conflict)
}

fn effect(s: &Section, known: &KnownEffect, wheels: usize) -> Result<EffectEntry> {
    let mut keys: Vec<&str> = known.params.iter().map(|param| param.key.as_str()).collect();
    keys.push("wheel");
    s.only_keys(&keys)?;
    let wheel = s.whole("wheel")?;
    match (known.scope, wheel) {
        (Scope::Robot, Some(_)) => {
            let problem = format!("`{}` acts on the whole robot, expected no wheel", known.id);
            return Err(s.key_error("wheel", problem, "Remove the key `wheel`"));
        }
        (Scope::OneWheel, None) => {
            let problem = format!("`{}` sits on one wheel, expected `wheel` to say which", known.id);
            let fix = format!("Add `wheel = …`, from 0 to {}; for several wheels write a table for each", wheels - 1);
            return Err(s.error(problem, fix).in_column("wheel").of_kind(InputKind::Missing));
        }
        _ => {}
    }
    if let Some(wheel) = wheel.filter(|wheel| *wheel >= wheels) {
        let problem = format!("found wheel {wheel}, the robot has wheels 0 to {}", wheels - 1);
        return Err(s.key_error("wheel", problem, "Wheels are counted from 0").of_kind(InputKind::Unknown));
    }
    let mut given = BTreeMap::new();
    for param in &known.params {
        let value = if param.required { Some(s.needed(&param.key)?) } else { s.number(&param.key)? };
        let Some(value) = value else { continue };
        let expected = format!("a value from {} to {}", param.low, param.high);
        s.checked(&param.key, value, (param.low..=param.high).contains(&value), &expected)?;
        given.insert(param.key.clone(), value);
    }
    Ok(EffectEntry { id: known.id.clone(), wheel, params: given })
}

#[cfg(test)]
#[path = "effects_read_tests.rs"]
mod tests;
