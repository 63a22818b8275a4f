//! # Browser: the pages that the program writes, opened in a real one
//!
//! Every kind of page is made from the demonstration's session, and looked at by `host-tests/browser/check.mjs`: at three
//! widths, light and dark, on paper. The pictures that it leaves are for people; `BLESS=1` keeps the first screen of the
//! demonstration's report as the README's.

use crate::install::Install;
use crate::line::Line;
use crate::tool::{Probe, Tool, ensure};

/// The browser, and what drives it.
const TOOLS: &[Tool] = &[
    Tool { name: "Chromium", probe: Probe("chromium --version", "Chromium"), installs: Install::Apt("chromium") },
    Tool { name: "Node.js with npm", probe: Probe("npm --version", ""), installs: Install::Apt("nodejs npm") },
];

/// What makes a page, and the page; `DIR` is where all of it goes, and before each stands the program.
const PAGES: [(&str, &str); 6] = [
    ("demo --out DIR/demo", "DIR/demo/report/report.html"),
    ("compare DIR/demo/session --sim DIR/simulated.csv --out DIR/compare", "DIR/compare/compare.html"),
    ("validate DIR/demo/session --out DIR/validate", "DIR/validate/validation.html"),
    ("next DIR/demo/session --out DIR/next", "DIR/next/next.html"),
    ("selftest DIR/demo/session/robot.toml --out DIR/selftest", "DIR/selftest/selftest.html"),
    ("sensitivity DIR/demo/session/robot.toml --out DIR/sensitivity", "DIR/sensitivity/sensitivity.html"),
];

/// What a simulator without the effect says of the session's first run.
const SIMULATED: &str = "simulate DIR/demo/session/robot.toml --input DIR/demo/session/runs/run00.csv --noise false --out DIR/simulated.csv";

/// Where all of it goes.
const FOLDER: &str = "target/browser";

/// The picture of the demonstration's first screen, and where the README shows it.
const FIRST_SCREEN: &str = "report-report-light-800-first.png";
const SHOWN: &str = "host-tests/golden/report.png";

/// The commands, in order; further pages are looked at too.
pub fn lines(further: &[std::ffi::OsString]) -> Vec<Line> {
    let program = |words: &str| Line::of(&format!("cargo omni-gap --quiet {}", words.replace("DIR", FOLDER)));
    let install = format!("npm install --no-audit --no-fund --silent --prefix {FOLDER}/check");
    let mut lines = vec![program(PAGES[0].0), program(SIMULATED)];
    lines.extend(PAGES[1..].iter().map(|(words, _)| program(words)));
    lines.push(Line::of(&format!("mkdir -p {FOLDER}/check")));
    for file in ["package.json", "package-lock.json", "check.mjs"] {
        lines.push(Line::of(&format!("cp host-tests/browser/{file} {FOLDER}/check")));
    }
    lines.push(Line::of(&install));
    let check = Line::of(&format!("node {FOLDER}/check/check.mjs chromium {FOLDER}/pictures"));
    let pages = PAGES.iter().map(|(_, page)| page.replace("DIR", FOLDER).into());
    lines.push(pages.chain(further.iter().cloned()).fold(check, Line::word));
    lines
}

/// Does it.
///
/// # Errors
/// What to tell the person.
pub fn perform(further: &[std::ffi::OsString]) -> Result<(), String> {
    ensure(TOOLS)?;
    lines(further).iter().try_for_each(Line::announced)?;
    let pictures = format!("{FOLDER}/pictures");
    println!("pictures: {pictures}");
    if std::env::var_os("BLESS").is_some() {
        let first = format!("{pictures}/{FIRST_SCREEN}");
        std::fs::copy(&first, SHOWN).map_err(|why| format!("{first} → {SHOWN}: {why}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_that_is_looked_at_is_made_before() {
        let lines = lines(&["more.html".into()]);
        let (check, before) = lines.split_last().unwrap();
        let before: String = before.iter().map(|line| line.shown() + "\n").collect();
        for page in check.shown().split(' ').filter(|word| word.starts_with(FOLDER) && word.ends_with(".html")) {
            let folder = page.rsplit_once('/').unwrap().0.trim_end_matches("/report");
            assert!(before.contains(&format!("--out {folder}\n")), "{page}: {before}");
        }
        assert!(check.shown().ends_with(" more.html"));
    }
}
