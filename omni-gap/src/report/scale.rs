//! From data to pixels, and the round numbers on an axis.

/// A straight map from a range of data to a range of pixels.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    data: (f64, f64),
    px: (f64, f64),
}

impl Scale {
    /// Maps `data` onto `px`; a range without width is widened.
    pub fn new(data: (f64, f64), px: (f64, f64)) -> Scale {
        let (lo, hi) = data;
        let data = match hi - lo {
            width if width > 1e-9 * lo.abs().max(hi.abs()) => (lo, hi),
            _ => {
                let half = if lo == 0.0 { 1.0 } else { 0.1 * lo.abs() };
                (lo - half, hi + half)
            }
        };
        Scale { data, px }
    }

    /// Maps the range of `values`, with a little air on both sides.
    pub fn around(values: impl Iterator<Item = f64>, px: (f64, f64)) -> Scale {
        let range = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
        if range.0 > range.1 {
            return Scale::new((0.0, 1.0), px);
        }
        let (lo, hi) = Scale::new(range, px).data;
        Scale::new((lo - 0.05 * (hi - lo), hi + 0.05 * (hi - lo)), px)
    }

    /// Where a value lies.
    pub fn at(&self, x: f64) -> f64 {
        let (lo, hi) = self.data;
        self.px.0 + (x - lo) / (hi - lo) * (self.px.1 - self.px.0)
    }

    /// Round numbers inside the range, about `wanted` of them, with their labels.
    pub fn ticks(&self, wanted: usize) -> Vec<(f64, String)> {
        let (lo, hi) = self.data;
        let step = round_step((hi - lo) / wanted.max(1) as f64);
        let places = (-step.log10().floor()).max(0.0) as usize;
        let (first, last) = ((lo / step - 1e-9).ceil() as i64, (hi / step + 1e-9).floor() as i64);
        (first..=last).map(|k| (k as f64 * step, format!("{:.places$}", k as f64 * step).replace('-', "−"))).collect()
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `raw`.
fn round_step(raw: f64) -> f64 {
    let decade = 10f64.powf(raw.log10().floor());
    [1.0, 2.0, 5.0].map(|m| m * decade).into_iter().find(|s| *s >= 0.999 * raw).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(lo: f64, hi: f64) -> Vec<String> {
        Scale::new((lo, hi), (0.0, 100.0)).ticks(4).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(0.0, 2.0), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(labels(-13.0, 17.0), ["−10", "0", "10"]);
        assert_eq!(labels(0.0213, 0.0267), ["0.022", "0.024", "0.026"]);
        assert_eq!(labels(1000.0, 5000.0), ["1000", "2000", "3000", "4000", "5000"]);
    }

    #[test]
    fn a_constant_signal_has_an_axis() {
        for value in [0.0, 3.0, -1e-7, 1e9] {
            let scale = Scale::around([value, value].into_iter(), (100.0, 0.0));
            assert!((scale.at(value) - 50.0).abs() < 1e-3, "{value}: {}", scale.at(value));
            assert!(!scale.ticks(4).is_empty());
        }
    }

    #[test]
    fn no_data_still_has_an_axis() {
        assert!(!Scale::around(std::iter::empty(), (0.0, 1.0)).ticks(4).is_empty());
    }
}
