//! Dates and times in text (ISO 8601, RFC 3339) as seconds since 1970.

use jiff::Timestamp;

/// Letters of the shortest that is read: a day and its hours and minutes.
const SHORTEST: usize = "2026-03-01T12:00".len();

/// The seconds since 1970 of a date and time; one that names no zone is taken for UTC. None of other texts.
///
/// A double holds times of this century to some quarter of a microsecond.
pub(super) fn seconds(text: &str) -> Option<f64> {
    if text.len() < SHORTEST || !text.as_bytes()[..4].iter().all(u8::is_ascii_digit) {
        return None;
    }
    let instant: Timestamp = text.parse().or_else(|_| format!("{text}Z").parse()).ok()?;
    Some(instant.as_second() as f64 + 1e-9 * f64::from(instant.subsec_nanosecond()))
}

#[cfg(test)]
mod tests {
    use super::seconds;

    #[test]
    fn a_time_with_a_zone_without_one_and_with_a_blank_between_is_read() {
        // `date -u -d @1772366400.25`: 1 March 2026, noon and a quarter of a second
        for text in [
            "2026-03-01T12:00:00.250Z",
            "2026-03-01 12:00:00.25",
            "2026-03-01T13:00:00.250+01:00",
            "2026-03-01T12:00:00,250",
        ] {
            assert_eq!(seconds(text), Some(1_772_366_400.25), "{text}");
        }
        assert_eq!(seconds("1969-12-31T23:59:59.500Z"), Some(-0.5));
    }

    #[test]
    fn other_texts_are_none() {
        for text in ["", "ok", "2026-03-01", "12:00:00", "2026-13-01T12:00:00", "20260301", "ääääääääääääääääää"]
        {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
