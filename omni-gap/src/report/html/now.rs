//! What to do now: the lines to change in the simulator, and the next measurement.

use super::page::section;
use crate::engine::findings::{Corrected, NextExperiment};
use crate::report::markup::Markup;
use crate::report::model::Report;
use crate::report::number::{estimate, num};
use crate::report::phrases;
use crate::vocabulary::Kind;

pub(super) fn now(m: &mut Markup, report: &Report) {
    let lines: Vec<&Corrected> = report.parameters.iter().filter(|p| belongs_to_a_cause(report, p)).collect();
    if lines.is_empty() && report.next_experiment.is_none() {
        return;
    }
    section(m, "What to do now", "", |m| {
        if !lines.is_empty() {
            m.within("p", &[], |m| {
                m.text("In the simulator’s robot file (");
                m.leaf("code", &[], "corrected_robot.toml");
                m.text(" has it written in):");
            });
            m.within("ul", &[("class", &"plain changes")], |m| lines.iter().for_each(|p| line(m, p)));
        }
        if let Some(next) = &report.next_experiment {
            measure(m, report, next);
        }
    });
}

/// True for the numbers of the causes that were named.
fn belongs_to_a_cause(report: &Report, p: &Corrected) -> bool {
    let last = p.key.rsplit('.').next().unwrap_or(&p.key);
    report.named().into_iter().any(|w| {
        let table = p.key.strip_prefix("effects.").and_then(|key| key.split(['.', '[']).next());
        let own = if w.kind == Some(Kind::Effect) { table == Some(w.cause.as_str()) } else { table.is_none() };
        own && w.parameters.contains_key(last)
    })
}

fn line(m: &mut Markup, p: &Corrected) {
    m.within("li", &[], |m| {
        m.leaf("code", &[], &p.key);
        m.text(" = ");
        m.leaf("strong", &[], &estimate(p.corrected, p.std, &p.unit));
        m.text(&p.nominal.map_or_else(|| ", new in the file".to_owned(), |nominal| format!(", was {}", num(nominal))));
    });
}

fn measure(m: &mut Markup, report: &Report, next: &NextExperiment) {
    m.within("div", &[("class", &"next")], |m| {
        m.leaf("p", &[], &format!("Next: {}", phrases::open_ended(&next.why)));
        let names: Vec<_> = next.tells_apart.iter().map(|id| phrases::title(report, id).into_owned()).collect();
        if !names.is_empty() {
            m.leaf("p", &[("class", &"how")], &format!("Tells apart: {}.", phrases::list(&names)));
        }
        if let Some(file) = &next.file {
            m.within("p", &[("class", &"how")], |m| {
                m.text("Input to play: ");
                m.leaf("code", &[], file);
            });
        }
    });
}
