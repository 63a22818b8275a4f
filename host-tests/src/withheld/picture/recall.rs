//! Bars: how often each cause was answered first, or named with the first.

use std::fmt::Write;

use super::super::scored::{Scored, stage_of};
use super::words::{FITS, escaped};
use model_core::effects::card::Stage;

/// A row, the room for names to the left of bars and for counts to the right, and the longest bar [px].
const ROW: usize = 16;
const LEFT: usize = 168;
const BAR: usize = 172;
const RIGHT: usize = 48;
const TOP: usize = 24;

/// All causes that somebody hid, stage by stage.
pub fn recall(name: &str, all: &[Scored]) -> String {
    let mut rows = String::new();
    let mut y = TOP;
    for stage in Stage::ALL {
        let mut causes: Vec<&str> =
            all.iter().filter_map(Scored::cause).filter(|id| stage_of(id) == Some(stage.name())).collect();
        causes.sort_unstable();
        causes.dedup();
        if causes.is_empty() {
            continue;
        }
        writeln!(rows, "<text class=\"soft\" x=\"0\" y=\"{}\" font-weight=\"600\">{}</text>", y + 14, stage.name())
            .expect(FITS);
        y += ROW + 4;
        for cause in causes {
            let of: Vec<&Scored> = all.iter().filter(|one| one.cause() == Some(cause)).collect();
            let first = of.iter().filter(|one| one.right()).count();
            let named = of.iter().filter(|one| one.right() || one.in_set() == Some(true)).count();
            let long = |count: usize| BAR * count / of.len();
            let told = format!("{cause}: {first} of {} first, {named} named with the first", of.len());
            let (middle, bar) = (y + 11, y + 3);
            writeln!(rows, "<g><title>{told}</title>").expect(FITS);
            writeln!(rows, "<text x=\"{}\" y=\"{middle}\" text-anchor=\"end\">{cause}</text>", LEFT - 6).expect(FITS);
            for (class, length) in [("rest", BAR), ("other", long(named)), ("own", long(first))] {
                writeln!(rows, "<rect class=\"{class}\" x=\"{LEFT}\" y=\"{bar}\" width=\"{length}\" height=\"10\"/>")
                    .expect(FITS);
            }
            let beside = LEFT + BAR + 6;
            writeln!(rows, "<text class=\"soft\" x=\"{beside}\" y=\"{middle}\">{first} of {}</text></g>", of.len())
                .expect(FITS);
            y += ROW;
        }
    }
    let key = |x: usize, class: &str, what: &str| {
        format!(
            "<rect class=\"{class}\" x=\"{x}\" y=\"4\" width=\"10\" height=\"10\"/><text x=\"{}\" y=\"13\">{what}</text>\n",
            x + 14
        )
    };
    format!(
        "<svg class=\"recall\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Recall of each cause\">\n\
         <title>Recall of each cause, {}</title>\n{}{}{}{rows}</svg>\n",
        LEFT + BAR + RIGHT,
        y + 4,
        escaped(name),
        key(LEFT, "own", "first"),
        key(LEFT + 52, "other", "with the first"),
        key(LEFT + 148, "rest", "not"),
    )
}
