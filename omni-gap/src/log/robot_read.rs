//! # From the text of a robot file to a sound [`RobotFile`]

use super::catalogue::{Catalogue, nearest};
use super::controller::controller;
use super::robot_file::*;
use super::toml_walk::{Section, Source};
use crate::error::{Error, Result};
use model_core::effects::nominal::{IN_THE_FILE, Table};
use std::collections::BTreeMap;
use std::path::Path;
use toml_edit::{Item, TableLike};

/// The newest form of the robot file that this program knows.
const NEWEST_SCHEMA: usize = 1;

const TOP: [&str; 12] = [
    "schema",
    "name",
    "wheel",
    "motor",
    "body",
    "friction",
    "sensors",
    "uncertainty",
    "supply",
    "limits",
    "controller",
    "effects",
];

pub(super) fn robot(text: &str, path: &Path, catalogue: &Catalogue) -> Result<RobotFile> {
    let source = Source { path, text };
    let document = source.parse()?;
    let top = Section::of(source, "the robot file", document.as_table(), None);
    let schema = top.whole("schema")?;
    if let Some(newer) = schema.filter(|schema| *schema > NEWEST_SCHEMA) {
        let problem = format!("the robot file has form {newer}, this program knows forms up to {NEWEST_SCHEMA}");
        return Err(top.key_error("schema", problem, "Use a newer program, or write the file in the older form"));
    }
    top.only_keys(&TOP)?;
    let section = |key, title| top.table.get(key).map(|item| Section::new(source, title, item)).transpose();
    let needed = |key, title: &'static str| {
        section(key, title)?.ok_or_else(|| Error::input(path, format!("{title} is missing"), format!("Add {title}")))
    };
    let wheel = wheels(source, top.table)?;
    let count = wheel.len();
    Ok(RobotFile {
        schema: schema.map(|schema| schema as u32),
        name: top.text("name")?.unwrap_or("robot").to_string(),
        wheel,
        motor: motor(&needed("motor", "[motor]")?)?,
        body: body(&needed("body", "[body]")?)?,
        friction: section("friction", "[friction]")?.map_or(Ok(FrictionFile::default()), |s| friction(&s))?,
        sensors: section("sensors", "[sensors]")?.map_or(Ok(SensorsFile::default()), |s| sensors(&s))?,
        uncertainty: section("uncertainty", "[uncertainty]")?.map_or(Ok(BTreeMap::new()), |s| uncertainty(&s))?,
        supply: section("supply", "[supply]")?.map(|s| supply(&s)).transpose()?,
        limits: section("limits", "[limits]")?.map(|s| limits(&s)).transpose()?,
        controller: section("controller", "[controller]")?.map(|s| controller(&s)).transpose()?,
        effects: section("effects", "[effects]")?.map_or(Ok(Vec::new()), |s| effects(&s, catalogue, count))?,
    })
}

/// The tables of an array of tables, whether written with `[[…]]` or as an inline list.
fn tables(item: &Item) -> Option<Vec<&dyn TableLike>> {
    match item {
        Item::ArrayOfTables(list) => Some(list.iter().map(|table| table as &dyn TableLike).collect()),
        Item::Value(value) => {
            value.as_array()?.iter().map(|v| v.as_inline_table().map(|table| table as &dyn TableLike)).collect()
        }
        _ => None,
    }
}

fn span_of(table: &dyn TableLike) -> Option<std::ops::Range<usize>> {
    table.iter().next().and_then(|(key, _)| table.get_key_value(key)?.0.span())
}

fn wheels(source: Source, top: &dyn TableLike) -> Result<Vec<WheelFile>> {
    let Some(item) = top.get("wheel") else {
        return Err(Error::input(
            source.path,
            "no [[wheel]] found, expected three or four",
            "Add one [[wheel]] per wheel",
        ));
    };
    let expected = || source.error(item.span(), "`wheel` is not a list of tables", "Write [[wheel]] once per wheel");
    let list = tables(item).ok_or_else(expected)?;
    let mut wheels = Vec::new();
    for (number, table) in list.iter().enumerate() {
        let title = format!("[[wheel]] {number}");
        let span = item.as_array_of_tables().and_then(|list| list.get(number)?.span()).or_else(|| span_of(*table));
        let section = Section::of(source, &title, *table, span);
        section.only_keys(&[&["drive_angle_deg"], keys_of(Table::Wheel).as_slice()].concat())?;
        wheels.push(WheelFile {
            drive_angle_deg: section.needed("drive_angle_deg")?,
            distance_m: section.positive("distance_m")?,
            radius_m: section.positive("radius_m")?,
        });
    }
    let first = item.as_array_of_tables().and_then(|list| list.get(0)?.span()).or_else(|| item.span());
    if !(3..=4).contains(&wheels.len()) {
        let found = ["no wheels", "one wheel", "two wheels"].get(wheels.len()).map(|s| s.to_string());
        let found = found.unwrap_or_else(|| format!("{} wheels", wheels.len()));
        let problem = format!("{found} in the robot file, expected three or four");
        return Err(source.error(first, problem, "Describe each wheel in its own [[wheel]] table"));
    }
    if !tells_the_motion(&wheels) {
        let problem = "the drive angles cannot tell the body's motion: a direction moves no wheel";
        return Err(source.error(first, problem, "Correct drive_angle_deg; wheels must not all roll along one line"));
    }
    Ok(wheels)
}

/// Whether the kinematic rows have rank three: det(AᵀA) of rows scaled to lever 1 is not tiny.
fn tells_the_motion(wheels: &[WheelFile]) -> bool {
    let lever = wheels.iter().map(|w| w.distance_m).fold(0.0, f64::max);
    let mut m = nalgebra::Matrix3::<f64>::zeros();
    for wheel in wheels {
        let [c, s, d] = wheel.row();
        let row = nalgebra::RowVector3::new(c, s, d / lever);
        m += row.transpose() * row;
    }
    m.determinant() > 1e-6
}

/// The keys of a table's nominal numbers, in the order of the file.
fn keys_of(table: Table) -> Vec<&'static str> {
    IN_THE_FILE.iter().filter(|number| number.table == table).map(|number| number.key).collect()
}

fn motor(s: &Section) -> Result<MotorFile> {
    s.only_keys(&[&["gear_ratio"], keys_of(Table::Motor).as_slice()].concat())?;
    Ok(MotorFile {
        gear_ratio: s.positive("gear_ratio")?,
        resistance_ohm: s.positive("resistance_ohm")?,
        emf_constant_v_s: s.positive("emf_constant_V_s")?,
        torque_constant_nm_per_a: s.positive("torque_constant_Nm_per_A")?,
    })
}

fn body(s: &Section) -> Result<BodyFile> {
    s.only_keys(&keys_of(Table::Body))?;
    Ok(BodyFile { mass_kg: s.positive("mass_kg")?, inertia_kg_m2: s.positive("inertia_kg_m2")? })
}

fn friction(s: &Section) -> Result<FrictionFile> {
    s.only_keys(&keys_of(Table::Friction))?;
    Ok(FrictionFile {
        viscous_v_n_s_per_m: s.not_negative("viscous_v_N_s_per_m", 0.0)?,
        viscous_vn_n_s_per_m: s.not_negative("viscous_vn_N_s_per_m", 0.0)?,
        viscous_w_nm_s: s.not_negative("viscous_w_Nm_s", 0.0)?,
        coulomb_v_n: s.not_negative("coulomb_v_N", 0.0)?,
        coulomb_vn_n: s.not_negative("coulomb_vn_N", 0.0)?,
        coulomb_w_nm: s.not_negative("coulomb_w_Nm", 0.0)?,
    })
}

fn sensors(s: &Section) -> Result<SensorsFile> {
    s.only_keys(&["current_noise_A", "wheel_speed_noise_rad_s", "position_noise_m", "heading_noise_rad"])?;
    let default = SensorsFile::default();
    let noise = |key, default| {
        let sigma = s.number(key)?.unwrap_or(default);
        s.checked(key, sigma, sigma > 0.0, "a noise above zero (gaps are measured in units of it)")
    };
    Ok(SensorsFile {
        current_noise_a: noise("current_noise_A", default.current_noise_a)?,
        wheel_speed_noise_rad_s: noise("wheel_speed_noise_rad_s", default.wheel_speed_noise_rad_s)?,
        position_noise_m: noise("position_noise_m", default.position_noise_m)?,
        heading_noise_rad: noise("heading_noise_rad", default.heading_noise_rad)?,
    })
}

fn uncertainty(s: &Section) -> Result<BTreeMap<String, f64>> {
    s.only_keys(&IN_THE_FILE.map(|number| number.key))?;
    s.table.iter().map(|(key, _)| Ok((key.to_string(), s.not_negative(key, 0.0)?))).collect()
}

fn supply(s: &Section) -> Result<SupplyFile> {
    s.only_keys(&["voltage_V"])?;
    Ok(SupplyFile { voltage_v: s.positive("voltage_V")? })
}

fn limits(s: &Section) -> Result<LimitsFile> {
    s.only_keys(&["current_A", "speed_m_s", "field_m"])?;
    let limit = |key| s.number(key)?.map(|_| s.positive(key)).transpose();
    Ok(LimitsFile { current_a: limit("current_A")?, speed_m_s: limit("speed_m_s")?, field_m: limit("field_m")? })
}

fn effects(s: &Section, catalogue: &Catalogue, wheels: usize) -> Result<Vec<EffectEntry>> {
    let mut all: Vec<EffectEntry> = Vec::new();
    for (id, item) in s.table.iter() {
        if catalogue.find(id).is_none() {
            let known = catalogue.effects.iter().map(|effect| effect.id.as_str());
            let mend = match nearest(id, known) {
                Some(near) => format!("Did you mean `{near}`?"),
                None => "See the catalogue of effects for the ids there are".to_string(),
            };
            return Err(s.key_error(id, format!("unknown effect `{id}`"), mend));
        }
        let listed = tables(item);
        let one = || item.as_table_like().map(|table| vec![table]);
        let Some(list) = listed.or_else(one) else {
            let problem = format!("found {}, expected a table of parameters", item.type_name());
            return Err(s.key_error(id, problem, format!("Write [effects.{id}] and its parameters below it")));
        };
        for (number, table) in list.into_iter().enumerate() {
            let span = item.as_array_of_tables().and_then(|list| list.get(number)?.span()).or_else(|| item.span());
            let title = format!("[effects.{id}]");
            let entry = effect(&Section::of(s.source, &title, table, span), id, catalogue, wheels)?;
            if all.iter().any(|other| other.id == entry.id && other.wheel == entry.wheel) {
                let place = entry.wheel.map_or(String::new(), |wheel| format!(" on wheel {wheel}"));
                let error = Section::of(s.source, &title, table, item.span());
                return Err(error.error(format!("`{id}`{place} stands twice"), "Keep one of the two tables"));
            }
            all.push(entry);
        }
    }
    Ok(all)
}

fn effect(s: &Section, id: &str, catalogue: &Catalogue, wheels: usize) -> Result<EffectEntry> {
    let params = catalogue.find(id).map(|known| known.params.as_slice()).unwrap_or_default();
    let mut keys: Vec<&str> = params.iter().map(|param| param.key.as_str()).collect();
    keys.push("wheel");
    s.only_keys(&keys)?;
    let wheel = s.whole("wheel")?;
    if let Some(wheel) = wheel.filter(|wheel| *wheel >= wheels) {
        let problem = format!("found wheel {wheel}, the robot has wheels 0 to {}", wheels - 1);
        return Err(s.key_error("wheel", problem, "Wheels are counted from 0"));
    }
    let mut given = BTreeMap::new();
    for param in params {
        let value = if param.required { Some(s.needed(&param.key)?) } else { s.number(&param.key)? };
        let Some(value) = value else { continue };
        let expected = format!("a value from {} to {}", param.low, param.high);
        s.checked(&param.key, value, (param.low..=param.high).contains(&value), &expected)?;
        given.insert(param.key.clone(), value);
    }
    Ok(EffectEntry { id: id.to_string(), wheel, params: given })
}

#[cfg(test)]
#[path = "robot_read_tests.rs"]
pub(super) mod tests;
