use super::super::capture::Capture;
use super::super::run::tests::{record, sent};
use super::*;

const PLACE: &str = "frames.rec";

/// What comes of records, a hundred bytes at a time, of which only the last tenth of a second is kept.
fn tail(bytes: &[u8]) -> Tail {
    let mut tail = Tail::default();
    for piece in bytes.chunks(100) {
        tail.take(piece);
        if let Some(reaches_s) = tail.reaches_s() {
            tail.forget_before(reaches_s - 0.1);
        }
    }
    tail
}

#[test]
fn the_last_rows_are_those_of_the_whole_recording() {
    let bytes = sent(4, &(7..2000).map(record).collect::<Vec<_>>());
    let tail = tail(&bytes);
    let lately = tail.run(Path::new(PLACE), 4).unwrap();
    let mut capture = Capture::new(None);
    capture.take(&bytes);
    let whole = run(&capture, Path::new(PLACE), "", Some(4)).unwrap();
    assert!((100..=102).contains(&lately.rows()), "{} rows are kept", lately.rows());
    assert!((tail.reaches_s().unwrap() - 1.992).abs() < 1e-9);
    let first = whole.rows() - lately.rows();
    for row in 0..lately.rows() {
        assert!((lately.t_s[row] - whole.t_s[first + row]).abs() < 1e-9);
        for (one, other) in [(&lately.u, &whole.u), (&lately.i, &whole.i)] {
            let of = |group: &Option<crate::log::Group>, row: usize| group.as_ref().unwrap().channels[2].get(row);
            assert_eq!(of(one, row), of(other, first + row));
        }
    }
}

#[test]
fn what_got_lost_is_counted_whether_it_is_forgotten_or_not() {
    let gone = [10, 11, 300, 1995];
    let bytes = sent(4, &(0..2000).filter(|k| !gone.contains(k)).map(record).collect::<Vec<_>>());
    let heard = tail(&bytes).heard();
    assert_eq!(heard, Heard { records: 1996, lost: 4, broken: 0, restarts: 0 });
}

#[test]
fn a_broken_frame_is_known_by_its_row_after_what_came_before_is_forgotten() {
    let mut bytes = sent(4, &(0..2000).map(record).collect::<Vec<_>>());
    let (hello, one) = (sent(4, &[]).len(), sent(4, &[record(0)]).len() - sent(4, &[]).len());
    bytes[hello + 1950 * one + 30] ^= 0x10;
    let tail = tail(&bytes);
    assert_eq!(tail.heard().broken, 1);
    let lately = tail.run(Path::new(PLACE), 4).unwrap();
    let row = lately.t_s.iter().position(|t| (t - 1.950).abs() < 1e-9).unwrap();
    assert_eq!(lately.vbat.unwrap().get(row), Err(crate::log::Missing::BadCrc));
}

#[test]
fn time_goes_on_when_the_robot_starts_again() {
    let first = sent(4, &(500..1000).map(record).collect::<Vec<_>>());
    let tail = tail(&[first, sent(4, &(0..300).map(record).collect::<Vec<_>>())].concat());
    assert_eq!(tail.heard().restarts, 1);
    // the first record of the new start tells of it and is not kept
    assert!((tail.reaches_s().unwrap() - (0.499 + 0.298)).abs() < 2e-3, "{:?}", tail.reaches_s());
}

#[test]
fn a_robot_that_does_not_say_how_to_read_it_fills_no_memory() {
    let without = &sent(4, &(0..30_000).map(record).collect::<Vec<_>>())[sent(4, &[]).len()..];
    let tail = tail(without);
    assert_eq!((tail.reaches_s(), tail.capture.records.len()), (None, MOST_UNEXPLAINED));
    assert_eq!(tail.heard().records, 30_000);
}
