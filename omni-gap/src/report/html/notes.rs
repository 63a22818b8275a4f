//! Parameters, noise, what could not be seen, what is wrong with the log.

use super::page::{section, table};
use crate::engine::findings::{ChannelNoise, Corrected};
use crate::report::markup::Markup;
use crate::report::model::{Fault, Report};
use crate::report::number::{estimate, figures, num};
use crate::report::phrases;
use crate::report::terminal::place_in_log;

/// What is wrong with the log.
pub(in crate::report) fn faults(m: &mut Markup, faults: &[Fault]) {
    if faults.is_empty() {
        return;
    }
    section(m, "What is wrong with the log, and how to mend it", "", |m| {
        m.within("ol", &[("class", &"faults")], |m| {
            for fault in faults {
                m.within("li", &[], |m| {
                    m.leaf("strong", &[], &phrases::sentence(&fault.what));
                    let place = place_in_log(fault);
                    if !place.is_empty() {
                        m.leaf("code", &[], place.trim_end_matches(": "));
                    }
                    m.leaf("p", &[], &format!("To mend it: {}.", phrases::open_ended(&fault.fix)));
                });
            }
        });
    });
}

pub(super) fn parameters(m: &mut Markup, report: &Report) {
    if report.parameters.is_empty() {
        return;
    }
    let how = "One standard deviation on both sides; the last column is the change in stated uncertainties.";
    section(m, "Parameters, nominal and corrected", how, |m| {
        table(m, "numbers", &["Parameter", "Nominal", "Corrected", "Change"], |m| {
            report.parameters.iter().for_each(|p| parameter(m, p));
        });
    });
}

fn parameter(m: &mut Markup, p: &Corrected) {
    m.within("tr", &[], |m| {
        m.within("th", &[("scope", &"row")], |m| m.leaf("code", &[], &p.key));
        let nominal = p.nominal.map(|x| estimate(x, p.nominal_std, &p.unit)).unwrap_or("none".into());
        m.leaf("td", &[("data-name", &"nominal")], &nominal);
        m.leaf("td", &[("data-name", &"corrected")], &estimate(p.corrected, p.std, &p.unit));
        m.within("td", &[("data-name", &"change")], |m| {
            let Some(nominal) = p.nominal else { return m.text("new") };
            if nominal != 0.0 {
                let change = 100.0 * (p.corrected - nominal) / nominal.abs();
                let sign = if change > 0.0 { "+" } else { "" };
                m.text(&format!("{sign}{}\u{a0}%", figures(change, 2)));
            }
            if let Some(std) = p.nominal_std.filter(|s| *s > 0.0) {
                m.leaf("small", &[], &format!("{}\u{a0}σ", figures((p.corrected - nominal).abs() / std, 2)));
            }
        });
    });
}

/// The noise of each sensor, as stated and as found.
pub(super) fn noise(m: &mut Markup, report: &Report) {
    if report.noise.is_empty() {
        return;
    }
    let how =
        "One sigma of each sensor: as the robot file states it, and by what the best model leaves of the recordings.";
    section(m, "Noise, stated and found", how, |m| {
        table(m, "numbers", &["Sensor", "Stated", "Found", "Correlated over"], |m| {
            report.noise.iter().for_each(|n| noise_of(m, n));
        });
    });
}

fn noise_of(m: &mut Markup, n: &ChannelNoise) {
    m.within("tr", &[], |m| {
        m.leaf("th", &[("scope", &"row")], &n.sensor.replace('_', " "));
        for (name, sigma) in [("stated", n.stated), ("found", n.found)] {
            m.leaf("td", &[("data-name", &name)], &format!("{}\u{a0}{}", num(sigma), n.unit));
        }
        let memory = n.correlation_time_s;
        let alike = if memory > 0.0 { format!("{}\u{a0}ms", num(1e3 * memory)) } else { "–".to_owned() };
        m.leaf("td", &[("data-name", &"correlated over")], &alike);
    });
}

pub(super) fn not_seen(m: &mut Markup, report: &Report) {
    list(m, "What this log could not have shown", &report.not_seen);
}

pub(super) fn notices(m: &mut Markup, report: &Report) {
    list(m, "Notices", &report.notices);
}

/// What gives the same page again.
pub(super) fn reproduce(m: &mut Markup, report: &Report) {
    if report.inputs.is_empty() {
        return;
    }
    let engine = report.engine.as_ref().map(|engine| format!(", engine {} {}", engine.name, engine.version));
    let how = format!(
        "Made by omni-gap {}{}, of these files; the same files give the same numbers, to the last bit.",
        env!("CARGO_PKG_VERSION"),
        engine.unwrap_or_default()
    );
    section(m, "How to reproduce it", &how, |m| {
        m.within("details", &[], |m| {
            m.leaf("summary", &[], &format!("{} files and their SHA-256", report.inputs.len()));
            m.within("ul", &[("class", &"plain")], |m| {
                for input in &report.inputs {
                    m.within("li", &[], |m| {
                        m.leaf("code", &[], &input.file);
                        m.leaf("small", &[], &input.sha256);
                    });
                }
            });
        });
    });
}

/// Items under a heading; nothing where there are none.
pub(in crate::report) fn list(m: &mut Markup, title: &str, items: &[String]) {
    if items.is_empty() {
        return;
    }
    section(m, title, "", |m| {
        m.within("ul", &[("class", &"plain columns")], |m| {
            for item in items {
                m.within("li", &[], |m| match item.split_once(": ") {
                    Some((name, why)) => {
                        m.leaf("code", &[], name);
                        m.text(&format!(" {why}"));
                    }
                    None => m.text(item),
                });
            }
        });
    });
}
