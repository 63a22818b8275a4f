//! A long signal as few points, with every peak kept.

/// Strips in time of a line that fills a page.
pub const STRIPS: usize = 700;

/// A gap of this many usual sample intervals breaks a line.
const BREAK: f64 = 2.5;

/// Unbroken stretches of a signal, thinned, from its samples in time order: of each of so many strips in time, the lowest
/// and the highest sample are kept.
///
/// A line breaks where samples are missing for longer than this signal's own interval (a camera that answers every
/// fourth row is not broken), and at each of the times `cuts`.
pub fn stretches(t_s: &[f64], values: &[Option<f64>], cuts: &[f64], strips: usize) -> Vec<Vec<(f64, f64)>> {
    let samples: Vec<(usize, f64, f64)> = t_s
        .iter()
        .zip(values)
        .enumerate()
        .filter_map(|(k, (&t, &v))| v.filter(|v| v.is_finite() && t.is_finite()).map(|v| (k, t, v)))
        .collect();
    let mut steps: Vec<f64> = samples.windows(2).map(|w| w[1].1 - w[0].1).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let broken = |a: &(usize, f64, f64), b: &(usize, f64, f64)| {
        let missing = b.0 > a.0 + 1 && b.1 - a.1 > BREAK * usual;
        missing || cuts.iter().any(|&cut| a.1 < cut && cut <= b.1)
    };
    let (first, last) = (samples.first().map_or(0.0, |s| s.1), samples.last().map_or(0.0, |s| s.1));
    let strip = |t: f64| (strips as f64 * (t - first) / (last - first).max(f64::MIN_POSITIVE)) as usize;
    samples
        .chunk_by(|a, b| !broken(a, b))
        .map(|stretch| {
            let mut points = Vec::new();
            for strip in stretch.chunk_by(|a, b| strip(a.1) == strip(b.1)) {
                keep_extremes(strip, &mut points);
            }
            points
        })
        .collect()
}

fn keep_extremes(strip: &[(usize, f64, f64)], points: &mut Vec<(f64, f64)>) {
    let mut ends: Vec<_> =
        [strip.iter().min_by(|a, b| a.2.total_cmp(&b.2)), strip.iter().max_by(|a, b| a.2.total_cmp(&b.2))]
            .into_iter()
            .flatten()
            .collect();
    ends.sort_by_key(|s| s.0);
    ends.dedup_by_key(|s| s.0);
    points.extend(ends.iter().map(|s| (s.1, s.2)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(n: usize) -> Vec<f64> {
        (0..n).map(|k| 0.005 * k as f64).collect()
    }

    #[test]
    fn a_long_signal_keeps_its_one_spike() {
        let t = clock(100_000);
        let mut v: Vec<_> = t.iter().map(|t| Some(t.sin())).collect();
        v[54_321] = Some(9.0);
        let lines = stretches(&t, &v, &[], STRIPS);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].len() <= 1500, "{}", lines[0].len());
        assert!(lines[0].contains(&(t[54_321], 9.0)));
        assert!(lines[0].windows(2).all(|w| w[0].0 < w[1].0));
    }

    #[test]
    fn a_short_signal_is_left_alone() {
        let t = clock(5);
        let v = [1.0, 2.0, 3.0, 2.5, 2.0].map(Some);
        assert_eq!(stretches(&t, &v, &[], STRIPS)[0].len(), 5);
    }

    #[test]
    fn a_hole_breaks_the_line_but_a_slow_sensor_does_not() {
        let t = clock(100);
        let hole: Vec<_> = (0..100).map(|k| (!(40..60).contains(&k)).then_some(1.0)).collect();
        assert_eq!(stretches(&t, &hole, &[], STRIPS).len(), 2);
        let camera: Vec<_> = (0..100).map(|k| (k % 4 == 0).then_some(1.0)).collect();
        assert_eq!(stretches(&t, &camera, &[], STRIPS).len(), 1);
    }

    #[test]
    fn a_restart_breaks_the_line_before_its_row() {
        let lines = stretches(&clock(10), &[Some(1.0); 10], &[0.025], STRIPS);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [5, 5]);
    }

    #[test]
    fn nothing_and_not_a_number_draw_nothing() {
        assert!(stretches(&clock(3), &[None, Some(f64::NAN), None], &[], STRIPS).is_empty());
        assert!(stretches(&[], &[], &[], STRIPS).is_empty());
    }
}
