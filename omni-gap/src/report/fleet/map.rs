//! Every cause on every robot, as a map: the colour says how many standard errors it is from absent.

use super::model::KindOfRobot;
use super::phrases::spotted;
use crate::pooling::RobotEstimate;
use crate::report::html::page::{scrolling, section};
use crate::report::markup::Markup;
use crate::report::number::estimate;

/// Causes that the map has room for: those farthest from absent on any robot.
const MOST_CAUSES: usize = 40;

/// Standard errors at which a cell has its full colour.
const FULL: f64 = 6.0;

/// The map of a kind; nothing where it has no estimates.
pub(super) fn map(m: &mut Markup, kind: &KindOfRobot) {
    let rows = rows(&kind.pooled.estimates);
    if rows.is_empty() {
        return;
    }
    let robots = robots(&kind.pooled.estimates);
    let how = "How far each cause is from absent on each robot, in standard errors: the darker, the surer; blue is more, red is less than \
               absent. A frame marks a robot that stands out from its kind. The causes farthest from absent come first.";
    section(m, &format!("Every cause on every robot: {}", kind.kind), how, |m| {
        scrolling(m, "causes and robots", |m| {
            m.within("table", &[("class", &"fleetmap")], |m| {
                m.within("thead", &[], |m| {
                    m.within("tr", &[], |m| {
                        m.leaf("td", &[], "");
                        robots.iter().for_each(|robot| m.leaf("th", &[("scope", &"col")], robot));
                    });
                });
                m.within("tbody", &[], |m| rows.iter().for_each(|row| cause(m, row, &robots)));
            });
        });
    });
}

fn cause(m: &mut Markup, row: &[&RobotEstimate], robots: &[&str]) {
    m.within("tr", &[], |m| {
        m.within("th", &[("scope", &"row")], |m| {
            m.text(&spotted(&row[0].of));
            m.leaf("small", &[], &row[0].of.key);
        });
        for robot in robots {
            match row.iter().find(|estimate| estimate.robot == *robot) {
                None => m.leaf("td", &[], ""),
                Some(found) => cell(m, found),
            }
        }
    });
}

fn cell(m: &mut Markup, of: &RobotEstimate) {
    let z = from_absent(of);
    let class = match (z > 0.0, of.stands_out) {
        (true, false) => "more",
        (false, false) => "less",
        (true, true) => "more out",
        (false, true) => "less out",
    };
    let strength = format!("--s:{:.0}%", (100.0 * z.abs() / FULL).min(100.0));
    let told = estimate(of.value, Some(of.std), &of.of.unit);
    // a cell has room for a tenth
    let text = if z.abs() < 10.0 { format!("{z:.1}") } else { format!("{z:.0}") };
    m.leaf("td", &[("class", &class), ("style", &strength), ("title", &told)], &text.replace('-', "−"));
}

fn from_absent(of: &RobotEstimate) -> f64 {
    (of.value - of.absent) / of.std
}

/// The estimates of each cause, the causes farthest from absent first.
fn rows(estimates: &[RobotEstimate]) -> Vec<Vec<&RobotEstimate>> {
    let mut rows: Vec<Vec<&RobotEstimate>> = Vec::new();
    for estimate in estimates {
        let same = |row: &&mut Vec<&RobotEstimate>| row[0].of == estimate.of;
        match rows.iter_mut().find(same) {
            Some(row) => row.push(estimate),
            None => rows.push(vec![estimate]),
        }
    }
    let farthest = |row: &Vec<&RobotEstimate>| row.iter().map(|of| from_absent(of).abs()).fold(0.0, f64::max);
    rows.sort_by(|a, b| farthest(b).total_cmp(&farthest(a)));
    rows.truncate(MOST_CAUSES);
    rows
}

fn robots(estimates: &[RobotEstimate]) -> Vec<&str> {
    let mut robots: Vec<&str> = estimates.iter().map(|estimate| estimate.robot.as_str()).collect();
    robots.sort_unstable();
    robots.dedup();
    robots
}
