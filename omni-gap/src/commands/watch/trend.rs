//! Bars: how a number went, the newest at the right.

use ratatui::style::{Color, Style};
use ratatui::text::Span;

const BARS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The last `width` of some shares, a bar each, over so many lines of the screen, the top one first: half height is one, full
/// height two and more. What is above one is red; none is a blank.
pub fn trend(
    shares: impl DoubleEndedIterator<Item = Option<f64>>,
    width: usize,
    lines: usize,
) -> Vec<Vec<Span<'static>>> {
    let mut newest: Vec<Option<f64>> = shares.rev().take(width).collect();
    newest.resize(width, None);
    newest.reverse();
    (0..lines).rev().map(|line| newest.iter().map(|share| part(*share, line, lines)).collect()).collect()
}

/// What is seen of a bar on a line, counted from the lowest.
fn part(share: Option<f64>, line: usize, lines: usize) -> Span<'static> {
    let Some(share) = share else { return Span::raw(" ") };
    let (whole, half, above) = (8 * lines, 4 * lines, share > 1.0);
    let height = (share * half as f64).ceil() as usize;
    // one that is just above the limit is higher than one just below it
    let height = if above { height.clamp(half + 1, whole) } else { height.clamp(1, half) };
    let bar = BARS[height.saturating_sub(8 * line).min(8)];
    Span::styled(bar.to_string(), Style::new().fg(if above { Color::Red } else { Color::Green }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(shares: &[Option<f64>], width: usize, lines: usize) -> Vec<String> {
        let text = |line: &Vec<Span>| line.iter().map(|span| span.content.to_string()).collect();
        trend(shares.iter().copied(), width, lines).iter().map(text).collect()
    }

    #[test]
    fn the_newest_bars_stand_at_the_right_and_half_height_is_the_limit() {
        assert_eq!(drawn(&[Some(0.2), Some(1.0), None, Some(1.01), Some(9.0)], 6, 1), [" ▁▄ ▅█"]);
        assert_eq!(drawn(&[Some(0.2), Some(1.0), Some(0.5)], 2, 1), ["▄▂"]);
        assert_eq!(drawn(&[Some(0.2)], 0, 1), [""]);
        assert_eq!(drawn(&[Some(1.0), Some(1.1), Some(1.6), Some(0.1)], 4, 2), [" ▁▅ ", "███▁"]);
        assert_eq!(trend([Some(1.01)].into_iter(), 1, 1)[0][0].style.fg, Some(Color::Red));
    }
}
