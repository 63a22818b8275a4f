//! Functions with so many parameters that a call reads like a row of numbers.

use crate::code::code_of;
use crate::finding::Finding;
use crate::tree::Source;

/// The most parameters of a function, `self` aside; more of them are a struct that has no name yet.
pub const MOST_PARAMETERS: usize = 6;

/// Every function outside tests with more.
pub fn too_many(source: &Source) -> Vec<Finding> {
    if source.path.contains("tests") || source.path.contains("benches") {
        return Vec::new();
    }
    let code = code_of(&source.text);
    let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let found = code.match_indices("fn ").filter_map(|(at, _)| {
        let rest = &code[at + 3..];
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let count = parameters(&rest[name.len()..])?;
        (count > MOST_PARAMETERS && !name.is_empty()).then(|| Finding {
            file: source.path.clone(),
            line: 1 + code[..at].matches('\n').count(),
            what: format!("`{name}` takes {count} parameters, at most {MOST_PARAMETERS}: group those that go together"),
        })
    });
    found.collect()
}

/// How many parameters follow a function's name, `self` aside; `None` where no list follows.
fn parameters(after_name: &str) -> Option<usize> {
    let (mut depth, mut list, mut items) = (0_i32, false, vec![String::new()]);
    let mut before = ' ';
    for c in after_name.chars() {
        match c {
            '(' if depth == 0 && !list => list = true,
            '(' | '[' | '{' | '<' => depth += 1,
            ')' if list && depth == 0 => {
                let counts = |item: &&String| !item.trim_matches(['(', ' ', '\n']).is_empty() && !is_self(item.trim());
                return Some(items.iter().filter(counts).count());
            }
            '>' if before == '-' || before == '=' => {}
            ')' | ']' | '}' | '>' => depth -= 1,
            ',' if list && depth == 0 => items.push(String::new()),
            ';' if depth == 0 => return None,
            _ => {}
        }
        if list && c != ',' {
            items.last_mut()?.push(c);
        }
        before = c;
    }
    None
}

fn is_self(item: &str) -> bool {
    let name = item.trim_start_matches('(').split(':').next().unwrap_or_default();
    name.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == "self")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> usize {
        too_many(&Source { path: "a/src/b.rs".to_owned(), text: text.to_owned() }).len()
    }

    #[test]
    fn seven_are_too_many_and_self_is_none_of_them() {
        assert_eq!(found("fn f(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8,) {}"), 0);
        assert_eq!(found("fn f(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8, g: u8) {}"), 1);
        assert_eq!(
            found("fn f<T: Fn(u8, u8) -> u8>(&mut self, a: T, b: [u8; 2], c: (u8, u8), d: u8, e: u8, f: u8) {}"),
            0
        );
    }

    #[test]
    fn commas_within_a_type_do_not_count() {
        assert_eq!(found("fn f(a: impl Fn(u8, u8, u8) -> Vec<(u8, u8)>, b: Map<u8, u8>, c: [u8; 3]) {}"), 0);
    }
}
