//! One recording that stands in the session twice, under two names, whole or in part.
//!
//! Noise never repeats itself: rows that are equal to the last bit are the same rows. If a stretch of one run stands in
//! another, the first row of one of the two stands in the other.

use super::Fault;
use crate::log::Run;

/// Rows that must agree one after the other, and how many different ones there must be among them.
const FEWEST: usize = 20;
const DIFFERENT: usize = 10;
/// A smaller share of the shorter run is describe, but forbids nothing.
const SHARE: f64 = 0.2;

/// A number for each row's measured samples; none for a row without any.
type Marks = Vec<Option<u64>>;

pub(super) fn check(runs: &[&Run]) -> Vec<Fault> {
    if runs.len() < 2 {
        return Vec::new();
    }
    let marks: Vec<Marks> = runs.iter().map(|run| marks(run)).collect();
    let mut faults = Vec::new();
    for later in 1..runs.len() {
        let same = (0..later).find_map(|earlier| Some((earlier, overlap(&marks[earlier], &marks[later])?)));
        if let Some((earlier, (rows, first, other_first))) = same {
            faults.push(describe(runs[later], runs[earlier], rows, (first, other_first)));
        }
    }
    faults
}

fn describe(run: &Run, other: &Run, rows: usize, (first, other_first): (usize, usize)) -> Fault {
    let fatal = rows as f64 > SHARE * run.rows().min(other.rows()) as f64;
    let count = if rows == run.rows() { format!("All {rows}") } else { format!("{rows} of {}", run.rows()) };
    let sentence = format!(
        "{count} rows are, to the last bit, those of {} from its line {} on: it is one recording, and what was fitted would be judged by itself.",
        other.place().display(),
        other.line_of(other_first)
    );
    let fix = "Keep one of the two, or record another run.";
    Fault::of(run, "same_run_twice", "all", fatal).at(first, first + rows - 1).says(sentence, fix)
}

fn marks(run: &Run) -> Marks {
    let measured: Vec<_> = run
        .signals()
        .into_iter()
        .filter(|(name, _)| !name.starts_with('u') && !name.starts_with("wset") && name != "enable")
        .map(|(_, channel)| channel)
        .collect();
    let mark = |row: usize| {
        let mut there = false;
        let mut mark = 0xcbf2_9ce4_8422_2325_u64;
        for channel in &measured {
            let bits = channel.get(row).map_or(u64::MAX, |value| {
                there = true;
                value.to_bits()
            });
            mark = (mark ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        }
        there.then_some(mark)
    };
    (0..run.rows()).map(mark).collect()
}

/// Places at which the first change of one run is looked for in another.
const MOST_STARTS: usize = 1000;

/// The longest stretch of equal rows around the first change of either: rows, first row here, first row there.
fn overlap(other: &Marks, this: &Marks) -> Option<(usize, usize, usize)> {
    let here = found(other, this).map(|(rows, there, here)| (rows, here, there));
    here.max(found(this, other))
}

/// Rows, first row in the whole, first row in the part.
fn found(whole: &Marks, part: &Marks) -> Option<(usize, usize, usize)> {
    // a run may begin with many equal rows: its first change is what can be found again
    let begin = (0..part.len().saturating_sub(1)).find(|&k| part[k].is_some() && part[k] != part[k + 1])?;
    let starts = (0..whole.len() - 1).filter(|&k| whole[k] == part[begin] && whole[k + 1] == part[begin + 1]);
    let longest = starts.take(MOST_STARTS).map(|start| {
        let after = whole[start..].iter().zip(&part[begin..]).take_while(|(a, b)| a == b).count();
        let before = whole[..start].iter().rev().zip(part[..begin].iter().rev()).take_while(|(a, b)| a == b).count();
        (before + after, start - before, begin - before)
    });
    let (rows, start, begin) = longest.max()?;
    let mut kinds: Vec<u64> = whole[start..start + rows].iter().flatten().copied().collect();
    kinds.sort_unstable();
    kinds.dedup();
    (rows >= FEWEST && kinds.len() >= DIFFERENT).then_some((rows, start, begin))
}
