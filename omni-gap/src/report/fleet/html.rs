//! The page of a fleet.

use super::course::course;
use super::map::map;
use super::model::{FleetReport, KindOfRobot, SessionLine};
use super::phrases;
use crate::report::html::notes;
use crate::report::html::page::{page, section, table};
use crate::report::markup::Markup;
use crate::report::number::{num, percent};
use crate::report::phrases::list;

/// The whole page.
pub fn html(report: &FleetReport) -> String {
    page(&format!("A fleet: {}", phrases::subject(report)), |m| {
        m.within("header", &[], |m| {
            m.leaf("p", &[("class", &"subject")], &phrases::subject(report));
            report.kinds.iter().for_each(|kind| m.leaf("h1", &[], &phrases::headline(kind)));
            m.leaf(
                "p",
                &[("class", &"lede")],
                &format!("Alone, the sessions say: {}.", phrases::verdicts(&report.sessions)),
            );
        });
        for kind in &report.kinds {
            let outliers = kind.pooled.estimates.iter().filter(|e| e.stands_out).map(phrases::outlier);
            let contrasts = kind.pooled.contrasts.iter().map(phrases::contrast);
            common(m, kind);
            notes::list(m, "Robots that stand out", &outliers.collect::<Vec<_>>());
            changes(m, kind);
            notes::list(m, "Firmware and floors", &contrasts.collect::<Vec<_>>());
            map(m, kind);
        }
        sessions(m, &report.sessions);
        m.leaf("footer", &[], "Every number on this page stands in fleet.json beside it.");
    })
}

fn common(m: &mut Markup, kind: &KindOfRobot) {
    let how = "What all robots of the kind have in common, the sessions of all of them together. Probabilities are those of one shared \
               cause against another and against none.";
    section(m, &format!("What robots of the kind {} have in common", kind.kind), how, |m| {
        if kind.pooled.common.is_empty() {
            m.leaf("p", &[], "Nothing that their file does not know.");
        } else {
            table(m, "causes", &["Cause", "Probability", "Size", "Standard errors", "Named alone"], |m| {
                kind.pooled.common.iter().for_each(|cause| {
                    m.within("tr", &[], |m| {
                        m.leaf("th", &[("scope", &"row")], &phrases::named(&cause.title, cause.of.wheel));
                        m.leaf("td", &[], &percent(cause.probability));
                        m.leaf("td", &[], &phrases::size(&cause.of.key, cause.value, cause.std));
                        m.leaf("td", &[], &num(cause.z));
                        m.leaf("td", &[], &cause.named_alone.to_string());
                    });
                });
            });
        }
        phrases::in_common(kind).iter().for_each(|told| m.leaf("p", &[("class", &"how")], told));
    });
}

fn changes(m: &mut Markup, kind: &KindOfRobot) {
    if kind.pooled.changes.is_empty() {
        return;
    }
    section(m, "Changes over time", "Each dot is a session, with one standard error.", |m| {
        m.within("div", &[("class", &"beside")], |m| {
            kind.pooled.changes.iter().for_each(|change| course(m, change, &phrases::change(change)));
        });
    });
}

fn sessions(m: &mut Markup, sessions: &[SessionLine]) {
    section(m, "Sessions", "Each on its own; its report is behind its name where it was kept.", |m| {
        table(m, "numbers wide", &["Session", "Robot", "Day", "Answer", "Causes", "Gap (σ)"], |m| {
            sessions.iter().for_each(|line| session(m, line));
        });
    });
}

fn session(m: &mut Markup, line: &SessionLine) {
    m.within("tr", &[], |m| {
        m.within("th", &[("scope", &"row")], |m| match &line.report {
            Some(report) => m.leaf("a", &[("href", &format!("{report}/report.html"))], &line.session),
            None => m.text(&line.session),
        });
        m.leaf("td", &[], &line.robot);
        m.leaf("td", &[], &line.date);
        m.within("td", &[], |m| {
            m.text(line.verdict.map_or("no answer", crate::report::phrases::verdict));
            line.reason.iter().for_each(|why| m.leaf("small", &[], why));
        });
        m.leaf("td", &[], &list(&line.causes));
        let gap = line.gap.map(|gap| format!("{} → {}", num(gap), line.gap_after.map_or("–".to_owned(), num)));
        m.leaf("td", &[], &gap.unwrap_or_default());
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fleet::sample;
    use crate::report::html::page::is_sound;

    #[test]
    fn the_page_is_sound_and_escapes_what_others_wrote() {
        let page = html(&sample::fleet());
        is_sound("fleet.html", &page);
        for part in
            ["all robots share", "Every cause on every robot", "reports/r012026-11-03/report.html", "&lt;no&gt;"]
        {
            assert!(page.contains(part), "{part}");
        }
    }
}
