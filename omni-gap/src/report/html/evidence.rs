//! Evidence: the shapes of the residual that show the causes, each under a sentence that says what to see.

use super::page::{scrolling, section, table};
use crate::engine::findings::{Form, Shape, ShapeBin};
use crate::report::evidence::{feature, heading, sentence};
use crate::report::figure::figure;
use crate::report::floor_picture::floor_picture;
use crate::report::markup::Markup;
use crate::report::number::num;
use crate::report::picture::{FALSE_ALARM, MEASURED, Over, Panel, Series, ink};

/// Every shape.
pub(super) fn evidence(m: &mut Markup, shapes: &[Shape]) {
    if shapes.is_empty() {
        return;
    }
    let how = "What was measured less what the nominal model says, over what shows it best, of free runs so short that an \
               error has not yet changed the speed. Uprights are 95 % intervals.";
    section(m, "What shows it?", how, |m| shapes.iter().for_each(|shape| one(m, shape)));
}

fn one(m: &mut Markup, shape: &Shape) {
    m.within("div", &[("class", &"evidence")], |m| {
        m.leaf("p", &[("class", &"says")], &sentence(shape));
        match shape.form {
            Form::Map => m.within("figure", &[], |m| {
                m.leaf("figcaption", &[], &heading(shape));
                floor_picture(m, shape);
            }),
            Form::Curve | Form::Spectrum => charted(m, &panel(shape)),
        }
        numbers(m, shape);
    });
}

/// A chart under a legend of its own: what it is over is not what others are over.
fn charted(m: &mut Markup, panel: &Panel) {
    m.within("p", &[("class", &"legend")], |m| {
        for (at, series) in panel.series.iter().enumerate() {
            m.leaf("span", &[("class", &format!("key {}", ink(&series.name, at)))], &series.name);
        }
    });
    figure(m, panel, &[]);
}

fn panel(shape: &Shape) -> Panel {
    let line = |name: &str, of: &dyn Fn(&ShapeBin) -> f64| Series {
        name: name.to_owned(),
        values: shape.bins.iter().map(|bin| Some(of(bin))).collect(),
    };
    let curve = shape.form == Form::Curve;
    let level = shape.alarm_level.unwrap_or_default();
    let series = if curve {
        let [nominal, corrected] =
            [&|_: &ShapeBin| 0.0, &|bin: &ShapeBin| bin.nominal - bin.corrected] as [&dyn Fn(&ShapeBin) -> f64; 2];
        vec![line(MEASURED, &|bin| bin.nominal), line("nominal", nominal), line("corrected", corrected)]
    } else {
        let left = [line("nominal", &|bin| bin.nominal), line("corrected", &|bin| bin.corrected)];
        left.into_iter().chain([line(FALSE_ALARM, &|_| level)]).collect()
    };
    Panel {
        title: heading(shape),
        unit: shape.quantity_unit.clone(),
        over: Over { name: feature(shape.feature).to_owned(), unit: shape.unit.clone() },
        t_s: shape.bins.iter().map(|bin| bin.at).collect(),
        series,
        intervals: if curve { shape.bins.iter().map(|bin| bin.nominal_ci95).collect() } else { Vec::new() },
    }
}

/// The numbers behind the picture, for whoever cannot see it.
fn numbers(m: &mut Markup, shape: &Shape) {
    let strongest = |bin: &&ShapeBin| shape.lines.iter().any(|line| line.order == bin.at as usize);
    let told: Vec<&ShapeBin> = match shape.form {
        Form::Spectrum => shape.bins.iter().filter(strongest).collect(),
        Form::Curve | Form::Map => shape.bins.iter().collect(),
    };
    m.within("details", &[], |m| {
        m.leaf("summary", &[], "The numbers");
        scrolling(m, &heading(shape), |m| {
            let over = format!("{}, {}", feature(shape.feature), shape.unit);
            let left = |model: &str| format!("left by the {model} model, {}", shape.quantity_unit);
            table(m, "merits", &[over, "samples".to_owned(), left("nominal"), left("corrected")], |m| {
                told.iter().for_each(|bin| row(m, bin));
            });
        });
    });
}

fn row(m: &mut Markup, bin: &ShapeBin) {
    let ends = |low: f64, high: f64| if low == high { num(low) } else { format!("{} to {}", num(low), num(high)) };
    let y = bin.y.map(|[low, high]| format!("; y {}", ends(low, high)));
    let left = |x: f64, [low, high]: [f64; 2]| format!("{} ({})", num(x), ends(low, high));
    m.within("tr", &[], |m| {
        m.leaf("th", &[("scope", &"row")], &format!("{}{}", ends(bin.low, bin.high), y.unwrap_or_default()));
        m.leaf("td", &[], &bin.n.to_string());
        m.leaf("td", &[], &left(bin.nominal, bin.nominal_ci95));
        m.leaf("td", &[], &left(bin.corrected, bin.corrected_ci95));
    });
}
