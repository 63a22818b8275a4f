//! # Which columns make the signals of a run

use super::names::Role;
use super::tables::{Column, Table};

/// A place in the logs: table and column.
pub(super) type Place = (usize, usize);

/// What was found of the signals, by names alone.
#[derive(Debug, Clone, Default)]
pub(super) struct Groups {
    pub drive: Option<Vec<Place>>,
    pub set_speed: Option<Vec<Place>>,
    /// Commands of which no name says what they are.
    pub command: Option<Vec<Place>>,
    pub current: Option<Vec<Place>>,
    pub speed: Option<Vec<Place>>,
    /// x, y, heading.
    pub pose: Option<[Place; 3]>,
    pub battery: Option<Place>,
    pub gyro: Option<Place>,
    /// What was seen and not taken, one sentence each.
    pub notes: Vec<String>,
}

/// Sorts the columns of all tables.
pub(super) fn find(tables: &[Table], wheels: usize) -> Groups {
    let mut groups = Groups::default();
    groups.speed = of_wheels(tables, Role::Speed, wheels, &mut groups.notes);
    groups.drive = of_wheels(tables, Role::Drive, wheels, &mut groups.notes);
    groups.set_speed = of_wheels(tables, Role::SetSpeed, wheels, &mut groups.notes);
    if groups.drive.is_none() && groups.set_speed.is_none() {
        groups.command = of_wheels(tables, Role::Command, wheels, &mut groups.notes);
    }
    groups.current = of_wheels(tables, Role::Current, wheels, &mut groups.notes);
    groups.pose = pose(tables, &mut groups.notes);
    groups.battery = single(tables, Role::Battery);
    groups.gyro = single(tables, Role::Gyro);
    groups
}

/// The columns of one role, one of each wheel, sorted by what their names call the wheels.
fn of_wheels(tables: &[Table], role: Role, wheels: usize, notes: &mut Vec<String>) -> Option<Vec<Place>> {
    let mut found: Vec<Vec<Place>> = Vec::new();
    for (t, table) in tables.iter().enumerate() {
        let mut stems: Vec<&str> = Vec::new();
        let of_role = |column: &&Column| column.name.role == Some(role) && column.name.wheel.is_some();
        for column in table.columns.iter().filter(of_role) {
            if !stems.contains(&column.name.stem.as_str()) {
                stems.push(&column.name.stem);
            }
        }
        for stem in stems {
            let same = |(_, column): &(usize, &Column)| of_role(column) && column.name.stem == stem;
            let mut places: Vec<Place> =
                table.columns.iter().enumerate().filter(same).map(|(place, _)| (t, place)).collect();
            places.sort_by_key(|(_, place)| wheel_key(table.columns[*place].name.wheel.as_deref().unwrap_or_default()));
            found.push(places);
        }
    }
    let title = |(t, c): &Place| tables[*t].columns[*c].title.clone();
    let titles = |places: &[Place]| places.iter().map(title).collect::<Vec<_>>().join(", ");
    let (whole, other): (Vec<_>, Vec<_>) = found.into_iter().partition(|places| places.len() == wheels);
    for places in &other {
        notes.push(format!(
            "{}: {} columns, and the robot has {wheels} wheels; left out",
            titles(places),
            places.len()
        ));
    }
    // a speed that is told beats one that has to be counted
    let counts = |places: &Vec<Place>| tables[places[0].0].columns[places[0].1].name.unit == Some("counts");
    let mut whole = whole;
    whole.sort_by_key(counts);
    for places in whole.iter().skip(1) {
        notes.push(format!("{}: the same signal a second time; left out", titles(places)));
    }
    whole.into_iter().next()
}

/// Numbers by their size, words by their letters.
fn wheel_key(wheel: &str) -> (u64, String) {
    (wheel.parse().unwrap_or(u64::MAX), wheel.to_owned())
}

/// What is said of a table that has a place and no heading.
fn place_alone(table: &Table) -> Option<String> {
    let title =
        |role: Role| table.columns.iter().find(|column| column.name.role == Some(role)).map(|column| &column.title);
    let (x, y) = title(Role::X).zip(title(Role::Y))?;
    Some(format!(
        "{x} and {y} look like a place, and no column like its heading: map theta_rad by hand, a pose is all three"
    ))
}

/// x, y and heading of one table; of several, of that which is measured from outside.
fn pose(tables: &[Table], notes: &mut Vec<String>) -> Option<[Place; 3]> {
    const OUTSIDE: [&str; 7] = ["vision", "camera", "mocap", "optitrack", "vicon", "pose", "video"];
    let of_table = |t: usize| -> Option<[Place; 3]> {
        let first = |role: Role| tables[t].columns.iter().position(|column| column.name.role == Some(role));
        Some([(t, first(Role::X)?), (t, first(Role::Y)?), (t, first(Role::Heading)?)])
    };
    let mut all: Vec<[Place; 3]> = (0..tables.len()).filter_map(of_table).collect();
    if all.is_empty() {
        notes.extend(tables.iter().filter_map(place_alone));
    }
    let title = |pose: &[Place; 3]| tables[pose[0].0].title().to_lowercase();
    all.sort_by_key(|pose| !OUTSIDE.iter().any(|word| title(pose).contains(word)));
    for other in all.iter().skip(1) {
        notes.push(format!("{} has a pose too; left out", title(other)));
    }
    all.into_iter().next()
}

fn single(tables: &[Table], role: Role) -> Option<Place> {
    let of_table = |(t, table): (usize, &Table)| {
        let is = |column: &Column| column.name.role == Some(role) && column.name.wheel.is_none();
        Some((t, table.columns.iter().position(is)?))
    };
    tables.iter().enumerate().find_map(of_table)
}

impl Groups {
    /// Whether no signal was found.
    pub fn is_empty(&self) -> bool {
        let of_wheels = [&self.drive, &self.set_speed, &self.command, &self.current, &self.speed];
        of_wheels.iter().all(|group| group.is_none()) && self.pose.is_none()
    }

    /// Takes out what stands in tables that are no use, and says so.
    pub fn drop_tables(&mut self, is_no_use: impl Fn(usize) -> bool, tables: &[Table]) -> Vec<String> {
        let mut dropped = Vec::new();
        let mut told = |place: Place| {
            let bad = is_no_use(place.0);
            if bad && !dropped.contains(&place.0) {
                dropped.push(place.0);
            }
            bad
        };
        for group in [&mut self.drive, &mut self.set_speed, &mut self.command, &mut self.current, &mut self.speed] {
            if group.as_ref().is_some_and(|places| told(places[0])) {
                *group = None;
            }
        }
        if self.pose.is_some_and(|pose| told(pose[0])) {
            self.pose = None;
        }
        for single in [&mut self.battery, &mut self.gyro] {
            if single.is_some_and(&mut told) {
                *single = None;
            }
        }
        let say =
            |table: usize| format!("{}: no column in it increases as a clock does; left out", tables[table].title());
        dropped.into_iter().map(say).collect()
    }
}
