//! A table in plain text.

use std::fmt::Write;

/// Lines under their heads, the first and the last column to the left, the others to the right.
pub(super) fn table(out: &mut String, heads: &[&str], lines: &[Vec<String>]) {
    let heads: Vec<String> = heads.iter().map(|head| (*head).to_owned()).collect();
    let all = || [&heads].into_iter().chain(lines);
    let wide = |k: usize| all().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..heads.len()).map(wide).collect();
    for line in all() {
        let [first, middle @ .., last] = line.as_slice() else { continue };
        let space = |text: &str, width: usize| " ".repeat(width - text.chars().count());
        let right = |(text, width): (&String, &usize)| format!("  {}{text}", space(text, *width));
        let middle: String = middle.iter().zip(&widths[1..]).map(right).collect();
        let _ = writeln!(out, "{}", format!("  {first}{}{middle}  {last}", space(first, widths[0])).trim_end());
    }
}
