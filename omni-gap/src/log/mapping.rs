//! # A mapping: how the columns of one file become those of the contract

use super::catalogue::nearest;
use super::from::From;
use super::run::Sampled;
use super::source::Layout;
use super::target::{Quantity, Target};
use super::toml_walk::Section;
use crate::error::{InputKind, Result};
use std::collections::BTreeMap;

/// How one file is read.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Mapping {
    /// When, relative to the row's voltage, its currents were measured; where nothing is said, as the file's format has it.
    pub currents_sampled: Option<Sampled>,
    pub layout: Layout,
    /// Which topic is read, of a recording of several.
    pub topic: Option<String>,
    /// Empty where columns have their names in the contract.
    pub rules: Vec<(Target, Rule)>,
    pub groups: BTreeMap<String, Flags>,
}

/// What is true of a whole group.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Flags {
    pub unsigned: bool,
    pub quantum: Option<f64>,
    /// Of wheel speeds taken from the time between edges: edges in a turn of the wheel.
    pub edges_per_turn: Option<f64>,
}

/// How counts become speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Counts {
    pub per_turn: f64,
    /// A running count, rather than counts since the row above.
    pub position: bool,
}

/// How one column is made.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rule {
    pub from: From,
    /// Sign, scale and unit in one factor.
    pub factor: f64,
    pub offset: f64,
    pub counts: Option<Counts>,
    pub running_sum: bool,
    /// A log without the source is read without the column.
    pub optional: bool,
}

impl Default for Rule {
    fn default() -> Self {
        Rule { from: From::Itself, factor: 1.0, offset: 0.0, counts: None, running_sum: false, optional: false }
    }
}

impl Rule {
    pub fn linear(&self, value: f64) -> f64 {
        value * self.factor + self.offset
    }

    pub fn is_plain(&self) -> bool {
        self.factor == 1.0 && self.offset == 0.0
    }
}

/// Units a source may have, what they measure, and what one of them is in the contract's unit.
const UNITS: [(&str, Quantity, f64); 16] = [
    ("s", Quantity::Time, 1.0),
    ("ms", Quantity::Time, 1e-3),
    ("us", Quantity::Time, 1e-6),
    ("ns", Quantity::Time, 1e-9),
    ("V", Quantity::Voltage, 1.0),
    ("mV", Quantity::Voltage, 1e-3),
    ("A", Quantity::Current, 1.0),
    ("mA", Quantity::Current, 1e-3),
    ("rad/s", Quantity::Rate, 1.0),
    ("deg/s", Quantity::Rate, std::f64::consts::PI / 180.0),
    ("rpm", Quantity::Rate, std::f64::consts::PI / 30.0),
    ("m", Quantity::Length, 1.0),
    ("cm", Quantity::Length, 1e-2),
    ("mm", Quantity::Length, 1e-3),
    ("rad", Quantity::Angle, 1.0),
    ("deg", Quantity::Angle, std::f64::consts::PI / 180.0),
];

/// What one of a unit is in the contract's unit.
pub(crate) fn unit_factor(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(known, ..)| *known == unit).map(|(.., factor)| *factor)
}

const RULE_KEYS: [&str; 10] =
    ["from", "expr", "unit", "scale", "sign", "offset", "counts_per_turn", "counts", "running_sum", "optional"];
/// The keys of a mapping, wherever it stands.
pub(super) const MAPPING_KEYS: [&str; 8] =
    ["separator", "decimal", "skip_lines", "header", "topic", "currents_sampled", "columns", "groups"];

impl Mapping {
    /// What a table says of a file.
    pub fn of(top: &Section) -> Result<Mapping> {
        let header = top.flag("header")?.unwrap_or(true);
        let (separator, decimal) = (separator(top)?, decimal(top)?);
        if separator == decimal {
            return Err(top
                .key_error(
                    "decimal",
                    "columns cannot be separated by what stands within a number",
                    "Correct one of both",
                )
                .of_kind(InputKind::Conflict));
        }
        let layout = Layout { separator, decimal, skip_lines: top.whole("skip_lines")?.unwrap_or(0), header };
        let currents_sampled = match top.text("currents_sampled")? {
            None => None,
            Some("after") => Some(Sampled::After),
            Some("before") => Some(Sampled::Before),
            Some(_) => {
                return Err(top.key_error(
                    "currents_sampled",
                    "expected \"before\" or \"after\"",
                    "Write one of the two",
                ));
            }
        };
        let rules = |item| {
            let columns = Section::new(top.source, "[columns]", item)?;
            columns.table.iter().map(|(name, item)| rule(&columns, name, item, header)).collect()
        };
        let rules = top.table.get("columns").map_or(Ok(Vec::new()), rules)?;
        let of_groups = |item| groups(&Section::new(top.source, "[groups]", item)?);
        let groups = top.table.get("groups").map_or(Ok(BTreeMap::new()), of_groups)?;
        let topic = top.text("topic")?.map(str::to_owned);
        Ok(Mapping { currents_sampled, layout, topic, rules, groups })
    }
}

fn separator(top: &Section) -> Result<u8> {
    match top.text("separator")?.map(str::as_bytes) {
        None => Ok(b','),
        Some([one]) if one.is_ascii() => Ok(*one),
        Some(_) => Err(top.key_error("separator", "expected one ASCII character", "Write \",\", \";\" or \"\\t\"")),
    }
}

fn decimal(top: &Section) -> Result<u8> {
    match top.text("decimal")? {
        None | Some(".") => Ok(b'.'),
        Some(",") => Ok(b','),
        Some(_) => Err(top.key_error("decimal", "expected \".\" or \",\"", "Write one of the two")),
    }
}

fn rule(columns: &Section, name: &str, item: &toml_edit::Item, header: bool) -> Result<(Target, Rule)> {
    let Some(target) = Target::named(name) else {
        let known = [
            "t_s",
            "u0_V",
            "i0_A",
            "w0_rad_s",
            "wset0_rad_s",
            "x_m",
            "y_m",
            "theta_rad",
            "vbat_V",
            "gyro_rad_s",
            "enable",
        ];
        let fix = nearest(name, known)
            .map_or(format!("Known are {}", known.join(", ")), |near| format!("Did you mean `{near}`?"));
        return Err(columns.key_error(name, "this is not a column of the run log", fix).of_kind(InputKind::Unknown));
    };
    let title = format!("[columns] {name}");
    let s = Section::new(columns.source, &title, item)?;
    s.only_keys(&RULE_KEYS)?;
    let from = From::read(&s, name, header)?;
    let sign = s.number("sign")?.unwrap_or(1.0);
    s.checked("sign", sign, sign.abs() == 1.0, "1 or -1")?;
    let scale = s.number("scale")?.unwrap_or(1.0);
    s.checked("scale", scale, scale != 0.0, "a factor other than zero")?;
    let unit = unit(&s, target)?;
    let counts = counts(&s, target)?;
    if counts.is_some() && s.table.contains_key("unit") {
        return Err(s
            .key_error("unit", "counts have no unit", "Remove `unit`, or `counts_per_turn`")
            .of_kind(InputKind::Conflict));
    }
    let optional = s.flag("optional")?.unwrap_or(false);
    let running_sum = s.flag("running_sum")?.unwrap_or(false);
    if running_sum && target != Target::Time {
        return Err(s
            .key_error("running_sum", "only time can be a running sum", "Remove the key")
            .of_kind(InputKind::Conflict));
    }
    let offset = s.number("offset")?.unwrap_or(0.0);
    Ok((target, Rule { from, factor: sign * scale * unit, offset, counts, running_sum, optional }))
}

fn unit(s: &Section, target: Target) -> Result<f64> {
    let Some(name) = s.text("unit")? else { return Ok(1.0) };
    let fitting = |unit: &&(&str, Quantity, f64)| unit.1 == target.quantity();
    match UNITS.iter().filter(fitting).find(|unit| unit.0 == name) {
        Some(unit) => Ok(unit.2),
        None => {
            let known: Vec<&str> = UNITS.iter().filter(fitting).map(|unit| unit.0).collect();
            let fix = format!("Known here: {}; or use `scale`", known.join(", "));
            Err(s.key_error("unit", format!("`{name}` is not a unit for {target}"), fix))
        }
    }
}

fn counts(s: &Section, target: Target) -> Result<Option<Counts>> {
    let kind = s.text("counts")?;
    if !s.table.contains_key("counts_per_turn") {
        return match kind {
            None => Ok(None),
            Some(_) => Err(s
                .key_error("counts", "`counts_per_turn` is missing", "Say how many counts make a turn")
                .of_kind(InputKind::Missing)),
        };
    }
    let per_turn = s.positive("counts_per_turn")?;
    if target.quantity() != Quantity::Rate {
        return Err(s.key_error("counts_per_turn", format!("{target} is not a speed"), "Use `scale` instead"));
    }
    match kind {
        None | Some("per_sample") => Ok(Some(Counts { per_turn, position: false })),
        Some("position") => Ok(Some(Counts { per_turn, position: true })),
        Some(_) => Err(s.key_error("counts", "expected \"per_sample\" or \"position\"", "Write one of the two")),
    }
}

fn groups(all: &Section) -> Result<BTreeMap<String, Flags>> {
    all.only_keys(&["u", "i", "w", "wset", "pose"])?;
    let read = |(name, item): (&str, &toml_edit::Item)| {
        let title = format!("[groups] {name}");
        let s = Section::new(all.source, &title, item)?;
        let keys: &[&str] =
            if name == "w" { &["unsigned", "quantum", "edges_per_turn"] } else { &["unsigned", "quantum"] };
        s.only_keys(keys)?;
        let positive = |key: &str| s.number(key)?.map(|_| s.positive(key)).transpose();
        let (quantum, edges_per_turn) = (positive("quantum")?, positive("edges_per_turn")?);
        Ok((name.to_string(), Flags { unsigned: s.flag("unsigned")?.unwrap_or(false), quantum, edges_per_turn }))
    };
    all.table.iter().map(read).collect()
}
