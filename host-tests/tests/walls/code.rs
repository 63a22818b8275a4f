//! A Rust source without its prose: comments and the insides of strings are blanked, lines stay where they are.
//!
//! A page may say why the core has no fused multiply-add; only code is held to it.

/// The source with a space for every character of a comment, a string or a character literal.
pub fn code_of(source: &str) -> String {
    let text: Vec<char> = source.chars().collect();
    let mut code = String::with_capacity(source.len());
    let mut at = 0;
    while at < text.len() {
        let after_name = at > 0 && named(text[at - 1]) && text[at - 1] != 'b'; // br"…" is raw too
        let prose = prose_at(&text[at..], after_name).min(text.len() - at);
        code.extend(text[at..at + prose].iter().map(|c| if *c == '\n' { '\n' } else { ' ' }));
        at += prose;
        if prose == 0 {
            code.push(text[at]);
            at += 1;
        }
    }
    code
}

/// A character that a name may hold.
pub fn named(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The lines (from 1) on which `needle` stands; where it begins or ends as a name does, it must be the whole name.
pub fn lines_with(text: &str, needle: &str) -> Vec<usize> {
    let stands = |line: &str| {
        line.match_indices(needle).any(|(at, _)| {
            let joined =
                |inner: Option<char>, outer: Option<char>| inner.is_some_and(named) && outer.is_some_and(named);
            !joined(needle.chars().next(), line[..at].chars().next_back())
                && !joined(needle.chars().next_back(), line[at + needle.len()..].chars().next())
        })
    };
    text.lines().enumerate().filter(|(_, line)| stands(line)).map(|(k, _)| k + 1).collect()
}

/// How many characters of prose begin here; 0 where code goes on.
fn prose_at(rest: &[char], after_name: bool) -> usize {
    match rest {
        ['/', '/', ..] => rest.iter().take_while(|c| **c != '\n').count(),
        ['/', '*', ..] => block_comment(rest),
        ['"', ..] => 1 + until_closed(&rest[1..], '"'),
        ['r', '"' | '#', ..] if !after_name => raw_string(rest),
        // A quote opens a character literal if one closes it; otherwise it begins a lifetime.
        ['\'', '\\', ..] => 1 + until_closed(&rest[1..], '\''),
        ['\'', _, '\'', ..] => 3,
        _ => 0,
    }
}

/// The characters up to and with the closing quote, escapes heeded.
fn until_closed(rest: &[char], quote: char) -> usize {
    let mut at = 0;
    while at < rest.len() && rest[at] != quote {
        at += if rest[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

fn raw_string(rest: &[char]) -> usize {
    let hashes = rest[1..].iter().take_while(|c| **c == '#').count();
    if rest.get(1 + hashes) != Some(&'"') {
        return 0; // r#name
    }
    let body = 2 + hashes;
    let close: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
    let inside = rest[body..].windows(close.len()).position(|end| *end == close[..]);
    inside.map_or(rest.len(), |inside| body + inside + close.len())
}

fn block_comment(rest: &[char]) -> usize {
    let (mut at, mut depth) = (0, 0);
    while at < rest.len() {
        match rest[at..] {
            ['/', '*', ..] => (at, depth) = (at + 2, depth + 1),
            ['*', '/', ..] => (at, depth) = (at + 2, depth - 1),
            _ => at += 1,
        }
        if depth == 0 {
            break;
        }
    }
    at
}

#[test]
fn comments_and_strings_are_blanked_and_code_stays() {
    for (source, code) in [
        ("a // b\nc", "a \nc"),
        ("a /* b /* c */\n d */ e", "a \n e"),
        (r#"f("x \" // y") + g"#, "f( ) + g"),
        ("r#\"a \" b\"# c", " c"),
        ("r#type = 'x'; c", "r#type = ; c"),
        (r"'\'' '\u{7f}' c", " c"),
        ("fn f<'a, 'b>(x: &'a str) {}", "fn f<'a, 'b>(x: &'a str) {}"),
        (r#"br"\" c"#, "b c"),
        ("\"never closed", " "),
        ("\"never closed \\", " "),
    ] {
        let blanked = code_of(source);
        assert_eq!(blanked.chars().count(), source.chars().count(), "{source}: nothing may move");
        assert_eq!(with_single_spaces(&blanked), code, "{source}");
    }
}

#[cfg(test)]
fn with_single_spaces(text: &str) -> String {
    let mut text = text.to_string();
    while text.contains("  ") {
        text = text.replace("  ", " ");
    }
    text
}

#[test]
fn a_needle_is_found_as_a_whole_name_only() {
    assert_eq!(lines_with("x\nunsafe {}\nunsafe_code\n(unsafe)", "unsafe"), [2, 4]);
    assert_eq!(lines_with("std::mem\nnot_std::mem\n{std::mem}", "std::"), [1, 3]);
    assert_eq!(lines_with("unsafe_code unsafe", "unsafe"), [1], "a near miss must not hide a hit behind it");
}
