//! Evidence: the shapes of the residual that show the causes, each under a sentence that says what to see.

use super::page::{scrolling, section, table};
use crate::engine::findings::{Form, Shape, ShapeBin};
use crate::report::evidence::{feature, heading, is_explained, is_refitted, sentence};
use crate::report::figure::figure;
use crate::report::floor_picture::floor_picture;
use crate::report::markup::Markup;
use crate::report::number::num;
use crate::report::picture::{FALSE_ALARM, MEASURED, Over, Panel, REFITTED, Series, ink};

/// Every shape.
pub(super) fn evidence(m: &mut Markup, shapes: &[Shape]) {
    if shapes.is_empty() {
        return;
    }
    let how = "What was measured, and what other models say, beyond the nominal model, over what shows it best: of free runs so \
               short that an error has not yet changed the speed. Uprights are 95 % intervals of the measurement.";
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
    // what a model says beyond the nominal one is what it leaves less of; a spectrum has what it leaves
    let said = |left: f64, bin: &ShapeBin| if curve { bin.nominal - left } else { left };
    let nominal = line("nominal", &|bin| said(bin.nominal, bin));
    let refitted = line(REFITTED, &|bin| said(bin.before, bin));
    let corrected = line("corrected", &|bin| said(bin.corrected, bin));
    let series = [
        curve.then(|| line(MEASURED, &|bin| bin.nominal)),
        Some(nominal),
        is_refitted(shape).then_some(refitted),
        is_explained(shape).then_some(corrected),
        (!curve).then(|| line(FALSE_ALARM, &|_| level)),
    ];
    let series = series.into_iter().flatten().collect();
    Panel {
        title: heading(shape),
        unit: shape.quantity_unit.clone(),
        over: Over {
            name: feature(shape.feature).to_owned(),
            unit: if curve { shape.unit.clone() } else { "a turn".to_owned() },
        },
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
            let names = [over, "samples".to_owned(), left("nominal"), left("re-fitted"), left("corrected")];
            table(m, "merits", &names, |m| {
                told.iter().for_each(|bin| row(m, bin));
            });
        });
    });
}

fn row(m: &mut Markup, bin: &ShapeBin) {
    let ends =
        |low: f64, high: f64| if low == high { low.to_string() } else { format!("{} to {}", num(low), num(high)) };
    let y = bin.y.map(|[low, high]| format!("; y {}", ends(low, high)));
    let left = |x: f64, [low, high]: [f64; 2]| format!("{} ({})", num(x), ends(low, high));
    m.within("tr", &[], |m| {
        m.leaf("th", &[("scope", &"row")], &format!("{}{}", ends(bin.low, bin.high), y.unwrap_or_default()));
        m.leaf("td", &[], &bin.n.to_string());
        m.leaf("td", &[], &left(bin.nominal, bin.nominal_ci95));
        m.leaf("td", &[], &left(bin.before, bin.before_ci95));
        m.leaf("td", &[], &left(bin.corrected, bin.corrected_ci95));
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample_evidence::{carpet, rollers, shapes, stribeck};

    fn written(shapes: &[Shape]) -> String {
        let mut m = Markup::default();
        evidence(&mut m, shapes);
        m.finish()
    }

    #[test]
    fn a_curve_has_a_dot_a_bin_and_a_line_a_model() {
        let page = written(&[stribeck()]);
        let lines = ["nominal", "corrected"].map(|ink| page.matches(&format!("class=\"line {ink}\"")).count());
        assert_eq!((page.matches("<circle").count(), lines), (stribeck().bins.len(), [1, 1]), "{page}");
        assert!(page.contains("\"over\":{\"name\":\"wheel speed\",\"unit\":\"rad/s\"}"), "{page}");
        assert!(!page.contains(REFITTED), "no number was re-fitted: {page}");
    }

    #[test]
    fn a_spectrum_has_the_level_of_chance_and_no_dots() {
        let page = written(&[rollers()]);
        assert!(page.contains(FALSE_ALARM) && !page.contains("<circle") && !page.contains("key measured"), "{page}");
    }

    #[test]
    fn a_map_has_a_cell_a_place_beside_its_legend() {
        let page = written(&[carpet()]);
        let legend =
            written(&[Shape { bins: carpet().bins[..1].to_vec(), ..carpet() }]).matches("class=\"cell").count() - 1;
        assert_eq!(page.matches("class=\"cell").count(), carpet().bins.len() + legend, "{page}");
    }

    #[test]
    fn each_shape_stands_under_its_sentence_and_nothing_has_no_heading() {
        let page = written(&shapes());
        for shape in shapes() {
            let mut m = Markup::default();
            m.text(&sentence(&shape));
            assert!(page.contains(&m.finish()), "{page}");
        }
        assert_eq!(written(&[]), "");
    }
}
