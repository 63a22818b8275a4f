//! What recordings could show of a robot: as a table in the terminal, on a page, in files.

mod phrases;
mod picture;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::columns::table;
use super::html::page::{self, page, section};
use super::write::put;
use crate::engine::findings::{SelfTest, WithSensor};
use crate::error::Result;
use crate::vocabulary::Kind;
use phrases::{heads, hidden, is_hidden, line};

/// True if simulated recordings were asked too.
fn is_verified(said: &SelfTest) -> bool {
    said.causes.iter().any(|cause| cause.verified.is_some())
}

fn with_sensor(with: &WithSensor) -> String {
    let list = |what: &str, ids: &[&str]| match ids {
        [] => String::new(),
        ids => format!(" {what} {};", ids.join(", ")),
    };
    let brings = list("would be seen:", &with.seen) + &list("would be named:", &with.named);
    let brings = if brings.is_empty() { " nothing new at typical sizes".to_owned() } else { brings };
    format!("  {}:{}", with.sensor, brings.trim_end_matches(';'))
}

/// The head of what numbers imitate.
const HIDDEN: &str = "Hidden behind the robot's own numbers";

fn hidden_causes(said: &SelfTest) -> impl Iterator<Item = String> {
    said.causes.iter().filter(|cause| is_hidden(cause)).map(hidden)
}

/// The answer in plain text.
pub fn selftest_terminal(said: &SelfTest) -> String {
    let verified = is_verified(said);
    let mut out = format!(
        "{}: what such recordings could show ({} numbers of {})\n\n",
        said.robot,
        said.numbers,
        said.logged.join(", ")
    );
    for (kind, title) in [(Kind::Effect, "Effects"), (Kind::Parameter, "Numbers of the robot file that are wrong by")] {
        let lines: Vec<_> =
            said.causes.iter().filter(|cause| cause.kind == kind).map(|cause| line(cause, verified)).collect();
        if !lines.is_empty() {
            let _ = writeln!(out, "{title}");
            table(&mut out, &heads(verified), &lines);
            out.push('\n');
        }
    }
    let hidden: Vec<String> = hidden_causes(said).collect();
    if !hidden.is_empty() {
        let _ = writeln!(out, "{HIDDEN}");
        hidden.iter().for_each(|line| {
            let _ = writeln!(out, "  {line}");
        });
        out.push('\n');
    }
    out.push_str("What one sensor more would bring\n");
    for with in &said.with_sensor {
        let _ = writeln!(out, "{}", with_sensor(with));
    }
    out
}

/// The answer on a page.
pub fn selftest_html(said: &SelfTest) -> String {
    let (title, verified) = (format!("What recordings of {} could show", said.robot), is_verified(said));
    page(&title, |m| {
        m.leaf("h1", &[], &title);
        let logged = format!("{} numbers of {}.", said.numbers, said.logged.join(", "));
        m.leaf("p", &[], &logged);
        let explained = "A bar begins where a diagnosis finds the cause and turns dark where it also tells it from every \
            other; the line is its typical size. Sizes are multiples of the typical one.";
        section(m, "From what size on", explained, |m| picture::bars(m, &said.causes));
        let explained = "How far the typical size moves the recordings beyond what starts and nominal numbers can \
            imitate, and the angle to the causes that it could be taken for.";
        section(m, "Sizes", explained, |m| {
            page::table(m, "", &heads(verified), |m| {
                for cause in &said.causes {
                    m.within("tr", &[], |m| line(cause, verified).iter().for_each(|cell| m.leaf("td", &[], cell)));
                }
            });
        });
        section(m, HIDDEN, "Within what the robot file states of them.", |m| {
            m.within("ul", &[], |m| hidden_causes(said).for_each(|line| m.leaf("li", &[], &line)));
        });
        section(m, "One sensor more", "At typical sizes.", |m| {
            m.within("ul", &[], |m| {
                said.with_sensor.iter().for_each(|with| m.leaf("li", &[], with_sensor(with).trim()));
            });
        });
    })
}

/// The answer as JSON, in the form of its types.
pub fn selftest_json(said: &SelfTest) -> String {
    serde_json::to_string_pretty(said).expect("numbers and names have a form in JSON") + "\n"
}

/// Writes `selftest.json` and `selftest.html` into a folder.
///
/// # Errors
/// Where they cannot be written.
pub fn write_selftest(dir: &Path, said: &SelfTest) -> Result<[PathBuf; 2]> {
    put(dir, [("selftest.json", &selftest_json(said)), ("selftest.html", &selftest_html(said))])
}
