//! The page of a validation.

use super::phrases::{self, fit_cell, fit_text, rms_cell};
use super::{curves, run};
use crate::localise::validation::{HorizonFigures, RunTraces, Signal, SignalFigures, Validation};
use crate::report::html::notes;
use crate::report::html::page::{page, scrolling, section, table};
use crate::report::markup::Markup;
use crate::report::number::num;
use crate::report::phrases::sentence;
use crate::simulate::HORIZON_S;

/// The whole page: `traces` are the runs that are drawn, in their order.
pub fn html(validation: &Validation, traces: &[RunTraces]) -> String {
    page(&format!("{}: validation", subject(validation)), |m| {
        head(m, validation);
        run_by_run(m, validation);
        horizons(m, validation);
        for drawn in traces {
            let Some(figures) = validation.runs.get(drawn.run) else { continue };
            run::run(m, figures, drawn);
        }
        notes::list(m, "Notices", &validation.notices);
        foot(m, validation.runs.len(), traces.len());
    })
}

fn subject(validation: &Validation) -> String {
    let parts: Vec<&str> =
        [Some(&validation.robot), validation.session.as_ref()].into_iter().flatten().map(String::as_str).collect();
    parts.join(", ")
}

fn head(m: &mut Markup, validation: &Validation) {
    m.within("header", &[], |m| {
        m.within("p", &[("class", &"subject")], |m| {
            m.leaf("span", &[("class", &"verdict")], "validation");
            m.text(&subject(validation));
        });
        m.leaf("h1", &[], &format!("{}.", phrases::verdict(validation)));
        let figures = phrases::figures(validation);
        if !figures.is_empty() {
            m.leaf("p", &[("class", &"lede")], &sentence(&figures));
        }
        m.leaf(
            "p",
            &[("class", &"how")],
            "Every run is simulated freely from its start to its end, driven by its recorded input alone, and laid over \
             what was measured.",
        );
        m.within("dl", &[("class", &"figures")], |m| {
            for figures in Signal::AXES.into_iter().filter_map(|axis| validation.over_all(axis)) {
                let fit = figures.fit_percent.map_or("–".into(), fit_text);
                let allowed = figures.noise_allows_percent.map(|x| format!("noise allows {}", fit_text(x)));
                let note = allowed.unwrap_or("it hardly varies beyond its noise".into());
                figure(m, &format!("fit of {}, all runs", phrases::short(figures.signal)), &fit, &note);
            }
            let shown = |h: &&HorizonFigures| h.horizon_s == HORIZON_S;
            if let Some(h) = validation.horizons.iter().find(shown).or(validation.horizons.first()) {
                let name = format!("error, restarted every {}\u{a0}s", h.horizon_s);
                let note = format!("noise floor {}", num(h.total.noise_floor_sigma));
                figure(m, &name, &format!("{}\u{a0}σ", num(h.total.rms_sigma)), &note);
            }
        });
    });
}

fn figure(m: &mut Markup, name: &str, value: &str, note: &str) {
    m.within("div", &[], |m| {
        m.leaf("dt", &[], name);
        m.leaf("dd", &[("class", &"figure")], value);
        m.leaf("dd", &[("class", &"note")], note);
    });
}

fn run_by_run(m: &mut Markup, validation: &Validation) {
    let how = "Fit is 100·(1 − ‖y − ŷ‖/‖y − ȳ‖): 100 is exact, 0 no better than the mean ȳ of what was measured, less \
               than 0 worse than it. A dash stands where a signal hardly varies beyond its noise. Beside it the root \
               mean square of measured minus simulated.";
    section(m, "Run by run", how, |m| {
        scrolling(m, "Run by run", |m| {
            let fits = Signal::AXES.map(|axis| format!("fit {} %", phrases::short(axis)));
            let errors = Signal::AXES.map(|axis| format!("RMS {} {}", phrases::short(axis), axis.unit()));
            table(m, "axes", &[&["Run".to_owned()], &fits[..], &errors[..]].concat(), |m| {
                for run in &validation.runs {
                    row(m, "", &phrases::run_name(run), |axis| run.signal(axis).cloned());
                }
                row(m, "all", "all runs", |axis| validation.over_all(axis).cloned());
                row(m, "", "noise allows", |axis| {
                    let f = validation.over_all(axis)?;
                    Some(SignalFigures { fit_percent: f.noise_allows_percent, rms_si: f.sigma_si, ..f.clone() })
                });
            });
        });
    });
}

fn row(m: &mut Markup, class: &str, name: &str, find: impl Fn(Signal) -> Option<SignalFigures>) {
    m.within("tr", &[("class", &class)], |m| {
        m.leaf("th", &[("scope", &"row")], name);
        let figures = Signal::AXES.map(find);
        figures.iter().for_each(|f| m.leaf("td", &[], &fit_cell(f.as_ref())));
        figures.iter().for_each(|f| m.leaf("td", &[], &rms_cell(f.as_ref())));
    });
}

fn horizons(m: &mut Markup, validation: &Validation) {
    if validation.horizons.is_empty() {
        return;
    }
    let how = "Root mean square of measured minus simulated over all runs, in units of each sensor’s stated sigma, with \
               the model restarted from the measured state every so often. Dotted: what noise alone would give, were the \
               model the truth.";
    section(m, "How errors grow", how, |m| {
        curves::legend(m, &validation.horizons);
        m.within("div", &[("class", &"beside")], |m| {
            m.within("figure", &[], |m| curves::chart(m, &validation.horizons));
        });
    });
}

fn foot(m: &mut Markup, runs: usize, drawn: usize) {
    let some = format!("Of {runs} runs the {drawn} that fit least are drawn. ");
    let text = format!(
        "{}Every number on this page stands in validation.json beside it.",
        if drawn < runs { &some } else { "" }
    );
    m.leaf("footer", &[], &text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::html::page::is_sound;
    use crate::report::validation::sample;

    #[test]
    fn every_tag_closes_and_the_page_needs_no_network() {
        let whole = html(&sample::validation(), &sample::traces());
        let mut little = sample::validation();
        (little.all_runs, little.horizons, little.worst) = (Vec::new(), Vec::new(), None);
        for (name, page) in [("whole", whole), ("little", html(&little, &[]))] {
            is_sound(name, &page);
        }
    }

    #[test]
    fn a_run_shows_its_body_speeds_and_folds_the_rest_away() {
        let page = html(&sample::validation(), &sample::traces());
        let run = page.split("<h2>").find(|part| part.starts_with("run01 (held out)")).unwrap();
        let (open, folded) = run.split_once("<details>").unwrap();
        let pictures = |part: &str| part.matches("<svg").count();
        assert_eq!((pictures(open), pictures(folded)), (3, 2));
        assert_eq!(open.matches("class=\"line measured\"").count(), 3);
        assert_eq!(open.matches("class=\"line simulated\"").count(), 3);
        assert!(open.contains("Driven by its commanded voltages") && open.contains("least-squares twist of the wheel"));
        assert!(folded.contains("Wheel speeds and currents"), "{folded}");
    }

    #[test]
    fn text_of_the_session_is_never_markup() {
        let mut evil = sample::validation();
        let tag = "<b>\"x\"</b>".to_string();
        evil.robot = tag.clone();
        evil.session = Some(tag.clone());
        evil.runs[0].run = tag.clone();
        evil.worst.as_mut().unwrap().run = tag.clone();
        evil.notices = vec![tag];
        let page = html(&evil, &sample::traces());
        assert!(!page.contains("<b>") && page.matches("&lt;b&gt;").count() >= 7);
    }

    #[test]
    fn runs_that_are_not_drawn_are_counted() {
        let some = html(&sample::validation(), &sample::traces()[..1]);
        assert!(some.contains("Of 2 runs the 1 that fit least are drawn."));
    }
}
