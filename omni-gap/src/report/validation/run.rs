//! One run on the page: its pictures and its figures.

use super::phrases;
use crate::localise::validation::{RunFigures, RunTraces, Signal, SignalFigures, Trace};
use crate::report::figure::figure;
use crate::report::html::page::{scrolling, section, table};
use crate::report::markup::Markup;
use crate::report::number::num;
use crate::report::phrases::sentence;
use crate::report::picture::{MEASURED, Panel, SIMULATED, Series};

pub(super) fn run(m: &mut Markup, figures: &RunFigures, traces: &RunTraces) {
    let driven =
        format!("Driven by its {} alone, {} s without a restart.", phrases::driver(figures), num(figures.duration_s));
    let how: Vec<String> = std::iter::once(driven)
        .chain(phrases::source(figures).map(|text| format!("{text}.")))
        .chain(figures.not_compared.iter().map(|why| format!("Not compared: {why}.")))
        .collect();
    section(m, &phrases::run_name(figures), &how.join(" "), |m| {
        legend(m);
        let (body, rest): (Vec<&Trace>, Vec<&Trace>) =
            traces.traces.iter().partition(|t| Signal::AXES.contains(&t.signal));
        m.within("div", &[("class", &"panels")], |m| {
            body.iter().for_each(|trace| panel(m, &traces.t_s, trace));
            m.within("figure", &[], |m| {
                m.leaf("figcaption", &[], "Figures of merit");
                merits(m, figures, |signal| Signal::AXES.contains(&signal));
            });
        });
        if !rest.is_empty() {
            m.within("details", &[], |m| {
                let names = kinds(&rest);
                m.leaf("summary", &[], &sentence(&names));
                m.within("div", &[("class", &"panels")], |m| rest.iter().for_each(|t| panel(m, &traces.t_s, t)));
                merits(m, figures, |signal| !Signal::AXES.contains(&signal));
            });
        }
    });
}

/// "wheel speeds, currents and pose"
fn kinds(traces: &[&Trace]) -> String {
    let has = |of: fn(Signal) -> bool| traces.iter().any(|t| of(t.signal));
    let all = [
        (has(|s| matches!(s, Signal::WheelSpeed(_))), "wheel speeds"),
        (has(|s| matches!(s, Signal::Current(_))), "currents"),
        (has(Signal::is_pose), "pose"),
    ];
    let names: Vec<String> = all.iter().filter(|(there, _)| *there).map(|(_, name)| (*name).to_owned()).collect();
    crate::report::phrases::list(&names)
}

fn legend(m: &mut Markup) {
    m.within("p", &[("class", &"legend")], |m| {
        for name in [MEASURED, SIMULATED] {
            m.leaf("span", &[("class", &format!("key {name}"))], name);
        }
    });
}

fn panel(m: &mut Markup, t_s: &[f64], trace: &Trace) {
    let series = |name: &str, values: &[Option<f64>]| Series { name: name.to_owned(), values: values.to_vec() };
    let panel = Panel {
        title: phrases::name(trace.signal),
        unit: trace.signal.unit().to_owned(),
        t_s: t_s.to_vec(),
        series: vec![series(MEASURED, &trace.measured), series(SIMULATED, &trace.simulated)],
        ..Panel::default()
    };
    figure(m, &panel, &[]);
}

fn merits(m: &mut Markup, run: &RunFigures, pick: fn(Signal) -> bool) {
    scrolling(m, "Figures of merit", |m| {
        table(m, "merits", &["", "fit %", "of at most", "RMS", "RMS/σ", "largest"], |m| {
            run.signals.iter().filter(|f| pick(f.signal)).for_each(|f| merit(m, f));
        });
    });
}

fn merit(m: &mut Markup, f: &SignalFigures) {
    let title = f.no_fit.clone().unwrap_or_default();
    let allowed = f.noise_allows_percent.map_or("–".into(), |x| format!("{x:.1}"));
    m.within("tr", &[("title", &title)], |m| {
        m.leaf("th", &[("scope", &"row")], &phrases::short(f.signal));
        let unit = f.signal.unit();
        let with_unit = |x: f64| format!("{}\u{a0}{unit}", num(x));
        for cell in
            [phrases::fit_cell(Some(f)), allowed, with_unit(f.rms_si), num(f.rms_sigma), num(f.largest_error_si)]
        {
            m.leaf("td", &[], &cell);
        }
    });
}
