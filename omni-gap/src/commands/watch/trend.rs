//! A row of bars: how a number went, the newest at the right.

use ratatui::style::{Color, Style};
use ratatui::text::Span;

const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The last `width` of some shares, a bar each: half height is one, full height two and more. What is above one is red; none is a
/// blank.
pub fn trend(shares: impl DoubleEndedIterator<Item = Option<f64>>, width: usize) -> Vec<Span<'static>> {
    let mut newest: Vec<Option<f64>> = shares.rev().take(width).collect();
    newest.resize(width, None);
    newest.into_iter().rev().map(bar).collect()
}

fn bar(share: Option<f64>) -> Span<'static> {
    let Some(share) = share else { return Span::raw(" ") };
    let above = share > 1.0;
    let height = ((share * 4.0).ceil() as usize).clamp(1, BARS.len());
    // a share just above one is higher than one just below it
    let height = if above { height.max(5) } else { height.min(4) };
    Span::styled(BARS[height - 1].to_string(), Style::new().fg(if above { Color::Red } else { Color::Green }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(shares: &[Option<f64>], width: usize) -> String {
        trend(shares.iter().copied(), width).iter().map(|span| span.content.to_string()).collect()
    }

    #[test]
    fn the_newest_bars_stand_at_the_right_and_half_height_is_the_limit() {
        assert_eq!(drawn(&[Some(0.2), Some(1.0), None, Some(1.01), Some(9.0)], 6), " ▁▄ ▅█");
        assert_eq!(drawn(&[Some(0.2), Some(1.0), Some(0.5)], 2), "▄▂");
        assert_eq!(drawn(&[Some(0.2)], 0), "");
        assert_eq!(trend([Some(1.01)].into_iter(), 1)[0].style.fg, Some(Color::Red));
    }
}
