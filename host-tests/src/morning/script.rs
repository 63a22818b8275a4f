//! The commands of a page, and what it says that they print.
//!
//! Between `BEGIN` and `END` a block of `sh` is typed as it stands, and the block of `text` behind it is what it prints: a
//! line `...` stands for any lines, `…` within a line for any text. A block below `ON_A_BOARD` is for a person alone.

const BEGIN: &str = "<!-- morning -->";
const END: &str = "<!-- end of morning -->";
const ON_A_BOARD: &str = "<!-- on a board -->";
const PLUG: &str = "<!-- the plug is pulled -->";

/// Stands for any lines.
const LINES: &str = "...";
/// Stands for any text within a line.
const TEXT: char = '…';

/// Something to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Type this.
    Shell {
        /// The line of the page, counted from 1
        line: usize,
        /// The commands
        commands: String,
        /// What they print, where the page says it
        prints: Vec<String>,
    },
    /// What only a person at a board types.
    OnABoard {
        /// The commands, a line each
        commands: Vec<String>,
    },
    /// Pull the plug of the motors' supply, and put it in again.
    Plug,
}

/// The steps of a page.
pub fn steps(page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut block: Option<(usize, &str, Vec<&str>)> = None;
    let (mut within, mut above) = (false, "");
    for (line, text) in page.lines().enumerate().map(|(k, text)| (k + 1, text)) {
        within = text == BEGIN || (within && text != END);
        match (&mut block, text.strip_prefix("```")) {
            _ if !within => {}
            (None, Some(language)) => block = Some((line, language, vec![above])),
            (Some((begins, language, lines)), Some(_)) => {
                add(&mut steps, *begins, language, lines);
                block = None;
            }
            (Some((_, _, lines)), None) => lines.push(text),
            (None, None) if text == PLUG => steps.push(Step::Plug),
            (None, None) => {}
        }
        above = text;
    }
    steps
}

/// Adds a block, whose first line is the one above it.
fn add(steps: &mut Vec<Step>, line: usize, language: &str, lines: &[&str]) {
    let Some((above, lines)) = lines.split_first() else { return };
    let owned = || lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
    match (language, steps.last_mut()) {
        ("sh", _) if *above == ON_A_BOARD => steps.push(Step::OnABoard { commands: owned() }),
        ("sh", _) => steps.push(Step::Shell { line, commands: lines.join("\n"), prints: Vec::new() }),
        ("text", Some(Step::Shell { prints, .. })) => *prints = owned(),
        _ => {}
    }
}

/// The first line of the page that was not printed where it should be; none where all were.
pub fn missing<'a>(page: &'a [String], printed: &[&str]) -> Option<&'a str> {
    let mut at = 0;
    let mut anywhere = false;
    for line in page {
        if line == LINES {
            anywhere = true;
            continue;
        }
        let reach = if anywhere { printed.len() } else { (at + 1).min(printed.len()) };
        let Some(found) = (at..reach).find(|k| is_like(line, printed[*k])) else { return Some(line) };
        (at, anywhere) = (found + 1, false);
    }
    None
}

/// Whether a printed line is as the page has it.
fn is_like(page: &str, printed: &str) -> bool {
    let mut parts = page.trim_end().split(TEXT);
    let Some(mut rest) = parts.next().and_then(|first| printed.trim_end().strip_prefix(first)) else { return false };
    let mut parts: Vec<&str> = parts.collect();
    let Some(last) = parts.pop() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "\
before
```sh
not typed
```
<!-- morning -->
<!-- on a board -->
```sh
cargo fw
```
Then:
```sh
a --long \\
    line
```
```text
said 1.2 of …
...
end
```
<!-- the plug is pulled -->
```sh
b
```
<!-- end of morning -->
```sh
not typed either
```
";

    #[test]
    fn what_stands_between_the_marks_is_typed_in_order() {
        let strings = |lines: &[&str]| lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
        let shell = |line, commands: &str, prints: &[&str]| Step::Shell {
            line,
            commands: commands.to_owned(),
            prints: strings(prints),
        };
        let expected = [
            Step::OnABoard { commands: strings(&["cargo fw"]) },
            shell(11, "a --long \\\n    line", &["said 1.2 of …", "...", "end"]),
            Step::Plug,
            shell(21, "b", &[]),
        ];
        assert_eq!(steps(PAGE), expected);
    }

    #[test]
    fn printed_lines_may_differ_where_the_page_leaves_something_out() {
        let page: Vec<String> = ["said … of …", "...", "end"].map(str::to_owned).to_vec();
        assert_eq!(missing(&page, &["said 1.2 of 3", "x", "y", "end", "z"]), None);
        assert_eq!(missing(&page, &["said 1.2 of 3", "end"]), None);
        assert_eq!(missing(&page, &["told 1.2 of 3", "end"]), Some("said … of …"));
        assert_eq!(missing(&page, &["said 1.2 of 3", "the end"]), Some("end"));
        assert_eq!(missing(&page[2..], &["x", "end"]), Some("end"), "only `...` may leave a line out");
        assert_eq!(missing(&page[2..], &[]), Some("end"));
        assert!(is_like("a … b", "a x b") && !is_like("a … b", "a x c") && !is_like("a", "ab"));
    }
}
