//! The pictures of a table: one page that carries all it needs, for light and dark, for a screen of any width.

mod curves;
mod matrix;
mod recall;
mod words;

use std::fmt::Write;

use super::honest::Contestants;
use super::scored::Scored;
use super::set::About;
use words::{FITS, escaped};

pub(super) use words::answered;

/// How many lines can be told apart in one picture.
const LINES: usize = 6;

/// The whole page, as HTML: whose pictures the first contestant's answers make, with the others as further lines.
pub fn page(about: &About, contestants: &Contestants) -> String {
    let Some((first, all)) = contestants.first() else { return String::new() };
    let css = include_str!("page.css");
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>The effect withheld</title>\n\
         <style>\n{css}</style>\n</head>\n<body>\n<main>\n<h1>The effect withheld</h1>\n\
         <p>What a diagnosis answers where the cause was sealed before it was asked: pictures of the answers of {}, split {}, \
         seed {:016x}, recorded at commit {}. The figures stand in <code>{}.md</code>.</p>\n",
        escaped(first),
        escaped(&about.split),
        about.seed,
        escaped(&about.commit),
        about.page()
    );
    let shown = &contestants[..contestants.len().min(LINES)];
    html += "<section>\n<h2>How sure, how often right</h2>\n";
    legend(&mut html, shown);
    html += "<div class=\"two\">\n<div>\n";
    html += &curves::reliability(shown);
    html += "</div>\n<div>\n";
    html += &curves::risk(shown);
    html += "</div>\n</div>\n</section>\n";
    html += "<section>\n<h2>Each cause</h2>\n<p>How often a hidden cause that can be seen was answered first, on its wheel, \
             and how often it was at least named with the first.</p>\n";
    html += &recall::recall(first, all);
    html += "</section>\n<section>\n<h2>What was taken for what</h2>\n<p>Rows: what was hidden. Columns: what was answered \
             first. A cell is the fuller the more of its row it holds; its number is of sessions.</p>\n";
    html += &matrix::matrix(first, all);
    html + "</section>\n</main>\n</body>\n</html>\n"
}

fn legend(html: &mut String, contestants: &[(String, Vec<Scored>)]) {
    *html += "<ul>\n";
    for (k, (name, _)) in contestants.iter().enumerate() {
        let line =
            format!("<svg viewBox=\"0 0 30 10\" aria-hidden=\"true\"><path class=\"line l{k}\" d=\"M0 5h30\"/></svg>");
        writeln!(html, "<li>{line}{}</li>", escaped(name)).expect(FITS);
    }
    *html += "</ul>\n";
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::answer::Answer;
    use super::super::contestant::Ended;
    use super::super::label::{Hidden, Label, Suite};
    use super::*;

    fn scored(hidden: &str, said: &str, probability: f64) -> Scored {
        let label = Label {
            session: format!("{hidden}-{said}"),
            suite: Suite::Laboratory,
            seed: 0,
            hidden: vec![Hidden { cause: hidden.to_owned(), wheel: None, times: 1.0, gap: 5.0 }],
            foreign: None,
            far_off: Vec::new(),
            about: BTreeMap::new(),
            truth: None,
            class: Vec::new(),
        };
        let rest = 1.0 - probability;
        let text = format!(
            r#"{{"verdict": "effect", "causes": ["{said}"], "which": [{{"cause": "{said}", "probability": {probability}}},
            {{"cause": "unknown", "probability": {rest}}}]}}"#
        );
        let answer = Some(Answer::parse(&text).expect("a good answer"));
        Scored { label, ended: Ended { failed: None, seconds: 1.0, megabytes: 1.0 }, answer, closed: None }
    }

    /// Three of `creep`, of which two are right; one of `stribeck` that is taken for `creep`.
    fn answers() -> Vec<Scored> {
        [("creep", "creep", 0.9), ("creep", "creep", 0.8), ("creep", "backlash", 0.7), ("stribeck", "creep", 0.6)]
            .map(|(hidden, said, probability)| scored(hidden, said, probability))
            .to_vec()
    }

    #[test]
    fn a_page_carries_all_it_needs_and_names_who_answered() {
        let about = About { split: "tuning".to_owned(), seed: 1, commit: "abc".to_owned() };
        let html = page(&about, &[("us & <them>".to_owned(), answers()), ("other".to_owned(), answers())]);
        assert!(html.contains("us &amp; &lt;them&gt;") && !html.contains("<them>"));
        assert!(
            !html.contains("http") && !html.contains("<script") && !html.contains("url("),
            "nothing from elsewhere"
        );
        for tag in ["svg", "section", "div", "ul", "g"] {
            let count = |what: String| html.matches(&what).count();
            assert_eq!(count(format!("<{tag}")) - count(format!("<{tag}=")), count(format!("</{tag}>")), "{tag}");
        }
    }

    #[test]
    fn cells_count_what_was_taken_for_what() {
        let svg = matrix::matrix("us", &answers());
        for told in
            ["creep, answered creep: 2 of 3", "creep, answered backlash: 1 of 3", "stribeck, answered creep: 1 of 1"]
        {
            assert!(svg.contains(told), "{told} in {svg}");
        }
        let svg = recall::recall("us", &answers());
        assert!(svg.contains("creep: 2 of 3 first") && svg.contains("stribeck: 0 of 1 first"), "{svg}");
    }

    #[test]
    fn a_curve_of_risk_ends_where_all_are_answered() {
        let svg = curves::risk(&[("us".to_owned(), answers())]);
        // right, right, wrong, wrong: half of all are wrong
        assert!(svg.contains("of all answers 50 % are wrong"), "{svg}");
        let svg = curves::reliability(&[("us".to_owned(), answers())]);
        assert!(svg.contains("held for 90 % likely, 100 % came true, of 1"), "{svg}");
    }
}
