//! What every page has: title, style, sections.

use crate::report::markup::Markup;

/// The style of every page, and that of charts.
const STYLES: [&str; 3] = [include_str!("uplot/uPlot.min.css"), include_str!("style.css"), include_str!("charts.css")];

/// What makes the charts of a page ones to zoom: uPlot, whose licence lies beside it, and how this program uses it.
const SCRIPTS: [&str; 2] = [include_str!("uplot/uPlot.iife.min.js"), include_str!("charts.js")];

/// A page with its title and style, around what `fill` writes.
pub(in crate::report) fn page(title: &str, fill: impl FnOnce(&mut Markup)) -> String {
    let mut m = Markup::default();
    m.own("<!doctype html>\n");
    m.within("html", &[("lang", &"en")], |m| {
        m.within("head", &[], |m| {
            m.own("<meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">");
            m.own("<meta name=\"color-scheme\" content=\"light dark\">");
            m.leaf("title", &[], title);
            m.within("style", &[], |m| STYLES.into_iter().for_each(|style| m.own(style)));
        });
        m.within("body", &[], |m| {
            m.within("main", &[], fill);
            if m.has_data() {
                SCRIPTS.into_iter().for_each(|script| m.within("script", &[], |m| m.own(script)));
            }
        });
    });
    m.finish() + "\n"
}

/// A table of a class under the names of its columns, around the rows that `fill` writes.
pub(in crate::report) fn table<T: AsRef<str>>(
    m: &mut Markup,
    class: &str,
    names: &[T],
    fill: impl FnOnce(&mut Markup),
) {
    m.within("table", &[("class", &class)], |m| {
        heads(m, names);
        m.within("tbody", &[], fill);
    });
}

/// The names of a table's columns; a column without one has no heading cell.
fn heads<T: AsRef<str>>(m: &mut Markup, names: &[T]) {
    m.within("thead", &[], |m| {
        m.within("tr", &[], |m| {
            for name in names.iter().map(AsRef::as_ref) {
                if name.is_empty() {
                    m.leaf("td", &[], "");
                } else {
                    m.leaf("th", &[("scope", &"col")], name);
                }
            }
        });
    });
}

/// A table that scrolls sideways where the window is too narrow, by keyboard too.
pub(in crate::report) fn scrolling(m: &mut Markup, name: &str, fill: impl FnOnce(&mut Markup)) {
    m.within("div", &[("class", &"scroll"), ("tabindex", &0), ("role", &"group"), ("aria-label", &name)], fill);
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

/// Fails where a page would need a network, shows a number that is none, or leaves a tag open or closes another.
#[cfg(test)]
pub(in crate::report) fn is_sound(name: &str, page: &str) {
    let own = SCRIPTS.iter().fold(page.to_owned(), |page, script| page.replace(script, ""));
    let (numbers, markup): (Vec<_>, Vec<_>) =
        own.split("<script").enumerate().map(|(k, part)| split_script(k, part)).unzip();
    let markup = markup.concat();
    for banned in ["<script", "http", "url(", "@import", "NaN", "javascript"] {
        assert!(!markup.contains(banned), "{name} contains {banned}");
    }
    for numbers in numbers.iter().filter(|numbers| !numbers.is_empty()) {
        serde_json::from_str::<serde_json::Value>(numbers).unwrap_or_else(|why| panic!("{name}: {why}: {numbers}"));
    }
    every_tag_closes(name, &markup);
}

/// The numbers of a script and the markup behind it; the first part of a page has markup alone.
#[cfg(test)]
fn split_script(k: usize, part: &str) -> (&str, &str) {
    if k == 0 {
        return ("", part);
    }
    let (script, markup) = part.split_once("</script>").expect("a script ends");
    (script.split_once('>').expect("a script begins").1, markup)
}

#[cfg(test)]
fn every_tag_closes(name: &str, page: &str) {
    let mut open = Vec::new();
    for tag in page.split('<').skip(1).map(|rest| rest.split('>').next().unwrap()) {
        match tag.split_whitespace().next().unwrap() {
            "!doctype" | "meta" => {}
            closing if closing.starts_with('/') => assert_eq!(open.pop(), Some(&closing[1..]), "{name}: <{tag}>"),
            opening => open.push(opening),
        }
    }
    assert!(open.is_empty(), "{name}: {open:?} stay open");
}
