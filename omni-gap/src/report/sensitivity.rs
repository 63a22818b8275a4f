//! The sensitivity of a robot's motion to the numbers of its file: in the terminal, on a page, in files.

mod bars;
mod phrases;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::figure::figure;
use super::html::page::{page, section, table};
use super::markup::Markup;
use super::number::num;
use super::picture::{Panel, Series, ink};
use super::write::{put, unwritable};
use crate::error::Result;
use crate::simulate::{AxisSensitivity, Influence, NOMINAL_KEYS, NominalKey, Sensitivity};
use phrases::{short, signed, split};

/// Numbers that the picture shows.
const MOST_CURVES: usize = 4;
/// Names of what an axis has.
struct Names {
    axis: &'static str,
    symbol: &'static str,
    speed: &'static str,
    distance: &'static str,
    acceleration: &'static str,
}

fn names(axis: &AxisSensitivity) -> Names {
    let along = |axis, symbol| Names { axis, symbol, speed: "m/s", distance: "m", acceleration: "m/s²" };
    match axis.axis {
        "v" => along("v axis (ahead)", "v"),
        "vn" => along("vn axis (sideways)", "vn"),
        _ => {
            Names { axis: "ω axis (turning)", symbol: "ω", speed: "rad/s", distance: "rad", acceleration: "rad/s²" }
        }
    }
}

fn key(influence: &Influence) -> &'static NominalKey {
    NominalKey::of(influence.key).expect("an influence is that of a key")
}

/// The step in a phrase.
fn step_in_words(s: &Sensitivity) -> String {
    let effects = match s.effects.as_slice() {
        [] => "no effect beside the plain model".to_owned(),
        some => format!("with {}", some.join(", ")),
    };
    format!("a step from rest, {} V on the motor that gets most; {effects}", short(s.voltage))
}

/// The motors of an axis.
fn motors(axis: &AxisSensitivity) -> String {
    axis.motors.iter().map(|u| short(*u)).collect::<Vec<_>>().join(", ")
}

/// The terms are those of the plain model: said where it has effects.
fn plain(s: &Sensitivity) -> &'static str {
    if s.effects.is_empty() { "" } else { "; without the effects" }
}

/// Where the robot gets to.
fn reached(axis: &AxisSensitivity, time_s: f64) -> String {
    let n = names(axis);
    if axis.speed == 0.0 {
        let [drive, coulomb] = [axis.terms.drive, axis.terms.coulomb].map(num);
        return format!("it does not move: the drive gives {drive} {0}, friction holds {coulomb} {0}", n.acceleration);
    }
    let end = match axis.final_speed {
        Some(speed) => format!("{} {} in the end", num(speed), n.speed),
        None => "the speed does not settle".into(),
    };
    let [speed, distance] = [axis.speed, axis.distance].map(num);
    format!("{speed} {} and {distance} {} after {} s; {end}", n.speed, n.distance, short(time_s))
}

/// Equation of an axis with its numbers.
fn equation(axis: &AxisSensitivity) -> String {
    let Names { symbol: v, acceleration, .. } = names(axis);
    let t = axis.terms;
    let [drive, brake, viscous, coulomb] = [t.drive, t.back_emf_per_s, t.viscous_per_s, t.coulomb].map(num);
    format!("d{v}/dt = {drive} − {brake}·{v} − {viscous}·{v} − {coulomb} {acceleration}")
}

/// What the command says.
pub fn sensitivity_terminal(s: &Sensitivity) -> String {
    let mut text = format!("{}: {}\n", s.robot, step_in_words(s));
    for axis in &s.axes {
        let _ = writeln!(text, "\n{}, motors at {} V", names(axis).axis, motors(axis));
        let _ = writeln!(text, "  {}   (drive, back-EMF, viscous, Coulomb{})", equation(axis), plain(s));
        let _ = writeln!(text, "  {}", reached(axis, s.time_s));
        let (some, none) = split(axis);
        if some.is_empty() {
            continue;
        }
        let after = format!("speed after {} s", short(s.time_s));
        let _ = writeln!(
            text,
            "  {:26}{:>14}{:>22}{:>13}{:>10}",
            "% for 1 % more of", "number", after, "final speed", "distance"
        );
        for i in some {
            let number = format!("{} {}", num(i.value), key(i).unit);
            let last = i.final_speed.map_or("–".into(), signed);
            let [speed, distance] = [i.speed, i.distance].map(signed);
            let _ = writeln!(text, "  {:26}{number:>14}{speed:>22}{last:>13}{distance:>10}", i.key);
        }
        if !none.is_empty() {
            let _ = writeln!(text, "  no influence: {}", none.join(", "));
        }
    }
    text
}

/// The page.
pub fn sensitivity_html(s: &Sensitivity) -> String {
    page(&format!("{}: sensitivity", s.robot), |m| {
        m.within("header", &[], |m| {
            m.leaf("p", &[("class", &"subject")], &s.robot);
            m.leaf("h1", &[], "Which numbers of the robot file the motion depends on");
            let how = "Each axis for itself. A sensitivity of +0.5 says: one per cent more of the number, half a per cent \
                       more speed.";
            m.leaf("p", &[("class", &"lede")], &format!("For {}. {how}", step_in_words(s)));
        });
        for axis in &s.axes {
            section(m, names(axis).axis, &format!("Motors at {} V: {}.", motors(axis), reached(axis, s.time_s)), |m| {
                figures(m, axis);
                if !s.effects.is_empty() {
                    m.leaf(
                        "p",
                        &[("class", &"how")],
                        "These four are of the plain model; all else is with the effects.",
                    );
                }
                if !axis.influences.is_empty() {
                    m.within("div", &[("class", &"beside")], |m| {
                        bars::chart(m, axis, s.time_s);
                        curves(m, axis);
                    });
                    influences(m, axis, s.time_s);
                }
            });
        }
        m.leaf("footer", &[], "Every number on this page stands in sensitivity.json beside it.");
    })
}

/// The terms of the equation.
fn figures(m: &mut Markup, axis: &AxisSensitivity) {
    let n = names(axis);
    let t = axis.terms;
    let cells = [
        ("drive", t.drive, n.acceleration, "acceleration by the voltage".to_owned()),
        ("back-EMF", t.back_emf_per_s, "1/s", format!("braking by the motors, times {}", n.symbol)),
        ("viscous", t.viscous_per_s, "1/s", format!("friction, times {}", n.symbol)),
        ("Coulomb", t.coulomb, n.acceleration, "friction, at any speed".to_owned()),
    ];
    m.within("dl", &[("class", &"figures even")], |m| {
        for (name, value, unit, note) in cells {
            m.within("div", &[], |m| {
                m.leaf("dt", &[], name);
                m.leaf("dd", &[("class", &"figure")], &format!("{}\u{a0}{unit}", num(value)));
                m.leaf("dd", &[("class", &"note")], &note);
            });
        }
    });
}

/// The sensitivities of the speed on the way.
fn curves(m: &mut Markup, axis: &AxisSensitivity) {
    let place = |i: &Influence| NOMINAL_KEYS.iter().position(|k| k.key == i.key);
    let lines: Vec<_> = axis.influences.iter().take(MOST_CURVES).filter_map(|i| Some((i.key, place(i)?))).collect();
    let panel = Panel {
        title: "Sensitivity of the speed, from the step on".into(),
        unit: "%/%".into(),
        t_s: axis.curve.iter().map(|p| p.time).collect(),
        series: lines
            .iter()
            .map(|(key, k)| Series {
                name: (*key).into(),
                values: axis.curve.iter().map(|p| (p.speed != 0.0).then_some(p.slopes[*k])).collect(),
            })
            .collect(),
        ..Panel::default()
    };
    m.within("div", &[], |m| {
        m.within("p", &[("class", &"legend")], |m| {
            for (at, (key, _)) in lines.iter().enumerate() {
                m.leaf("span", &[("class", &format!("key {}", ink(key, at)))], key);
            }
        });
        figure(m, &panel, &[]);
    });
}

fn influences(m: &mut Markup, axis: &AxisSensitivity, time_s: f64) {
    let (some, none) = split(axis);
    let speed = format!("Speed after {} s", short(time_s));
    table(m, "numbers", &["Per cent for one per cent of", "In the file", &speed, "Final speed", "Distance"], |m| {
        for i in some {
            m.within("tr", &[], |m| {
                m.within("th", &[("scope", &"row")], |m| m.leaf("code", &[], i.key));
                m.leaf("td", &[], &format!("{}\u{a0}{}", num(i.value), key(i).unit));
                m.leaf("td", &[("data-name", &"Speed")], &signed(i.speed));
                m.leaf("td", &[("data-name", &"Final speed")], &i.final_speed.map_or("–".into(), signed));
                m.leaf("td", &[("data-name", &"Distance")], &signed(i.distance));
            });
        }
    });
    if !none.is_empty() {
        m.leaf("p", &[("class", &"how")], &format!("Without influence on this axis: {}.", none.join(", ")));
    }
}

/// Puts `sensitivity.json` and `sensitivity.html` into the folder, which is made where it is not there.
pub fn write_sensitivity(dir: &Path, s: &Sensitivity) -> Result<[PathBuf; 2]> {
    let json = serde_json::to_string_pretty(s).map_err(|why| unwritable(&why.into(), &dir.join("sensitivity.json")))?;
    put(dir, [("sensitivity.json", &(json + "\n")), ("sensitivity.html", &sensitivity_html(s))])
}

#[cfg(test)]
mod tests;
