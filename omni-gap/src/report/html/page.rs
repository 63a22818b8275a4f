//! What every page has: title, style, sections.

use crate::report::markup::Markup;

/// A page with its title and style, around what `fill` writes.
pub(in crate::report) fn page(title: &str, fill: impl FnOnce(&mut Markup)) -> String {
    let mut m = Markup::default();
    m.own("<!doctype html>\n");
    m.within("html", &[("lang", &"en")], |m| {
        m.within("head", &[], |m| {
            m.own("<meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">");
            m.own("<meta name=\"color-scheme\" content=\"light dark\">");
            m.leaf("title", &[], title);
            m.within("style", &[], |m| m.own(include_str!("style.css")));
        });
        m.within("body", &[], |m| {
            m.within("main", &[], fill);
        });
    });
    m.finish() + "\n"
}

/// A section under a heading, with a line that says how to read it.
pub(in crate::report) fn section(m: &mut Markup, title: &str, explained: &str, fill: impl FnOnce(&mut Markup)) {
    m.within("section", &[], |m| {
        m.leaf("h2", &[], title);
        if !explained.is_empty() {
            m.leaf("p", &[("class", &"how")], explained);
        }
        fill(m);
    });
}
