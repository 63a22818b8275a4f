//! # From the text of a robot file to a sound [`RobotFile`]

use super::catalogue::Catalogue;
use super::commissioned::commissioned;
use super::controller::controller;
use super::effects_read::effects;
use super::plausible;
use super::robot_file::*;
use super::toml_walk::{Section, Source, read_text, tables};
use crate::error::{Error, InputKind, Result};
use model_core::effects::nominal::{IN_THE_FILE, Table};
use model_core::geometry::kinematics::Wheels;
use std::collections::BTreeMap;
use std::path::Path;
use toml_edit::TableLike;

/// The newest form of the robot file that this program knows.
const NEWEST_SCHEMA: usize = 1;

const TOP: [&str; 14] = [
    "schema",
    "name",
    "wheel",
    "motor",
    "body",
    "friction",
    "sensors",
    "uncertainty",
    "identified",
    "supply",
    "limits",
    "controller",
    "commissioned",
    "effects",
];

impl RobotFile {
    /// Reads and checks a robot file.
    pub fn load(path: &Path, catalogue: &Catalogue) -> Result<RobotFile> {
        RobotFile::parse(&read_text(path, "a robot file")?, path, catalogue)
    }

    /// Checks the text of a robot file; `path` is named in messages.
    pub fn parse(text: &str, path: &Path, catalogue: &Catalogue) -> Result<RobotFile> {
        robot(text, path, catalogue)
    }
}

fn robot(text: &str, path: &Path, catalogue: &Catalogue) -> Result<RobotFile> {
    let source = Source { path, text };
    let document = source.parse()?;
    let top = Section::of(source, "the robot file", document.as_table(), None);
    let schema = top.whole("schema")?;
    if let Some(newer) = schema.filter(|schema| *schema > NEWEST_SCHEMA) {
        let problem = format!("the robot file has form {newer}, this program knows forms up to {NEWEST_SCHEMA}");
        return Err(top
            .key_error("schema", problem, "Use a newer program, or write the file in the older form")
            .of_kind(InputKind::Newer));
    }
    top.only_keys(&TOP)?;
    let section = |key, title| top.table.get(key).map(|item| Section::new(source, title, item)).transpose();
    let needed = |key, title: &'static str| {
        section(key, title)?.ok_or_else(|| {
            Error::input(path, format!("{title} is missing"), format!("Add {title}")).of_kind(InputKind::Missing)
        })
    };
    let wheel = wheels(source, top.table)?;
    let count = wheel.len();
    let robot = RobotFile {
        schema: schema.map(|schema| schema as u32),
        name: top.text("name")?.unwrap_or("robot").to_string(),
        wheel,
        motor: motor(&needed("motor", "[motor]")?)?,
        body: body(&needed("body", "[body]")?)?,
        friction: section("friction", "[friction]")?.map_or(Ok(FrictionFile::default()), |s| friction(&s))?,
        sensors: section("sensors", "[sensors]")?.map_or(Ok(SensorsFile::default()), |s| sensors(&s))?,
        uncertainty: section("uncertainty", "[uncertainty]")?.map_or(Ok(BTreeMap::new()), |s| uncertainty(&s))?,
        identified: section("identified", "[identified]")?.map(|s| identified(&s)).transpose()?,
        supply: section("supply", "[supply]")?.map(|s| supply(&s)).transpose()?,
        limits: section("limits", "[limits]")?.map(|s| limits(&s)).transpose()?,
        controller: section("controller", "[controller]")?.map(|s| controller(&s)).transpose()?,
        commissioned: top.table.get("commissioned").map_or(Ok(Vec::new()), |item| commissioned(source, item, count))?,
        effects: section("effects", "[effects]")?.map_or(Ok(Vec::new()), |s| effects(&s, catalogue, count))?,
    };
    plausible::together(&robot, &needed)?;
    Ok(robot)
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
        )
        .of_kind(InputKind::Missing));
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
            drive_angle_deg: plausible::number(&section, "drive_angle_deg")?,
            distance_m: plausible::number(&section, "distance_m")?,
            radius_m: plausible::number(&section, "radius_m")?,
        });
    }
    let first = item.as_array_of_tables().and_then(|list| list.get(0)?.span()).or_else(|| item.span());
    if !(3..=4).contains(&wheels.len()) {
        let found = ["no wheels", "one wheel", "two wheels"].get(wheels.len()).map(|s| s.to_string());
        let found = found.unwrap_or_else(|| format!("{} wheels", wheels.len()));
        let problem = format!("{found} in the robot file, expected three or four");
        return Err(source.error(first, problem, "Describe each wheel in its own [[wheel]] table"));
    }
    if plausible::in_radians(&wheels) {
        let problem = "the drive angles look like radians, expected degrees";
        return Err(source.error(first, problem, "Multiply each drive_angle_deg by 57.29578 (180/π)"));
    }
    if !tells_the_motion(&wheels) {
        let problem = "the drive angles cannot tell the body's motion: a direction moves no wheel";
        return Err(source
            .error(first, problem, "Correct drive_angle_deg; wheels must not all roll along one line")
            .of_kind(InputKind::Conflict));
    }
    Ok(wheels)
}

/// Whether the wheels fix all three directions.
fn tells_the_motion(wheels: &[WheelFile]) -> bool {
    let regular = |wheels: &[WheelFile; 3]| Wheels::new(wheels.map(|wheel| wheel.wheel())).is_regular();
    match wheels {
        [a, b, c, d] => Wheels::new([a, b, c, d].map(WheelFile::wheel)).is_regular(),
        wheels => wheels.try_into().is_ok_and(regular),
    }
}

/// The keys of a table's nominal numbers, in the order of the file.
fn keys_of(table: Table) -> Vec<&'static str> {
    IN_THE_FILE.iter().filter(|number| number.table == table).map(|number| number.key).collect()
}

fn motor(s: &Section) -> Result<MotorFile> {
    s.only_keys(&[&["gear_ratio"], keys_of(Table::Motor).as_slice()].concat())?;
    Ok(MotorFile {
        gear_ratio: plausible::number(s, "gear_ratio")?,
        resistance_ohm: plausible::number(s, "resistance_ohm")?,
        emf_constant_v_s: plausible::number(s, "emf_constant_V_s")?,
        torque_constant_nm_per_a: plausible::number(s, "torque_constant_Nm_per_A")?,
    })
}

fn body(s: &Section) -> Result<BodyFile> {
    s.only_keys(&keys_of(Table::Body))?;
    Ok(BodyFile { mass_kg: plausible::number(s, "mass_kg")?, inertia_kg_m2: plausible::number(s, "inertia_kg_m2")? })
}

fn friction(s: &Section) -> Result<FrictionFile> {
    s.only_keys(&keys_of(Table::Friction))?;
    let size = |key| plausible::bounded(s, key, key, s.not_negative(key, 0.0)?);
    Ok(FrictionFile {
        viscous_v_n_s_per_m: size("viscous_v_N_s_per_m")?,
        viscous_vn_n_s_per_m: size("viscous_vn_N_s_per_m")?,
        viscous_w_nm_s: size("viscous_w_Nm_s")?,
        coulomb_v_n: size("coulomb_v_N")?,
        coulomb_vn_n: size("coulomb_vn_N")?,
        coulomb_w_nm: size("coulomb_w_Nm")?,
    })
}

fn sensors(s: &Section) -> Result<SensorsFile> {
    s.only_keys(&[
        "current_noise_A",
        "wheel_speed_noise_rad_s",
        "position_noise_m",
        "heading_noise_rad",
        "gyro_noise_rad_s",
        "battery_noise_V",
    ])?;
    let default = SensorsFile::default();
    let checked = |key, sigma| {
        s.checked(key, sigma, sigma > 0.0, "a noise above zero (gaps are measured in units of it)")?;
        plausible::bounded(s, key, key, sigma)
    };
    let noise = |key, default| checked(key, s.number(key)?.unwrap_or(default));
    let stated = |key| s.number(key)?.map(|sigma| checked(key, sigma)).transpose();
    Ok(SensorsFile {
        current_noise_a: noise("current_noise_A", default.current_noise_a)?,
        wheel_speed_noise_rad_s: noise("wheel_speed_noise_rad_s", default.wheel_speed_noise_rad_s)?,
        position_noise_m: noise("position_noise_m", default.position_noise_m)?,
        heading_noise_rad: noise("heading_noise_rad", default.heading_noise_rad)?,
        gyro_noise_rad_s: stated("gyro_noise_rad_s")?,
        battery_noise_v: stated("battery_noise_V")?,
    })
}

fn uncertainty(s: &Section) -> Result<BTreeMap<String, f64>> {
    s.only_keys(&IN_THE_FILE.map(|number| number.key))?;
    let relative = |key: &str| plausible::bounded(s, key, plausible::RELATIVE, s.not_negative(key, 0.0)?);
    s.table.iter().map(|(key, _)| Ok((key.to_string(), relative(key)?))).collect()
}

fn identified(s: &Section) -> Result<IdentifiedFile> {
    s.only_keys(&["rate_hz"])?;
    Ok(IdentifiedFile { rate_hz: s.number("rate_hz")?.map(|_| s.positive("rate_hz")).transpose()? })
}

fn supply(s: &Section) -> Result<SupplyFile> {
    s.only_keys(&["voltage_V"])?;
    Ok(SupplyFile { voltage_v: plausible::number(s, "voltage_V")? })
}

fn limits(s: &Section) -> Result<LimitsFile> {
    s.only_keys(&["current_A", "speed_m_s", "field_m"])?;
    let limit = |key| s.number(key)?.map(|_| s.positive(key)).transpose();
    Ok(LimitsFile { current_a: limit("current_A")?, speed_m_s: limit("speed_m_s")?, field_m: limit("field_m")? })
}

#[cfg(test)]
#[path = "robot_read_tests.rs"]
pub(super) mod tests;
