//! Numbers for people: three significant figures, and no more digits than the uncertainty allows.

/// A space that does not break a line.
pub const NBSP: &str = "\u{a0}";

/// A number with three significant figures.
pub fn num(x: f64) -> String {
    figures(x, 3)
}

/// A number with `n` significant figures; powers of ten only where the number is tiny or huge.
pub fn figures(x: f64, n: usize) -> String {
    if !x.is_finite() {
        return "not a number".into();
    }
    if x == 0.0 {
        return "0".into();
    }
    match exponent(x, n) {
        e if (-4..=6).contains(&e) => minus(format!("{x:.*}", decimals(e, n))),
        _ => minus(format!("{x:.*e}", n - 1)),
    }
}

/// A value and its standard deviation, cut at the second figure of the latter, with the unit.
pub fn estimate(value: f64, std: Option<f64>, unit: &str) -> String {
    let unit = if unit == "1" || unit.is_empty() { String::new() } else { format!("{NBSP}{unit}") };
    let Some(std) = std.filter(|s| s.is_finite() && *s > 0.0) else { return num(value) + &unit };
    if !value.is_finite() {
        return num(value);
    }
    let places = decimals(exponent(std, 2), 2);
    if places > 6 {
        return format!("{}{NBSP}±{NBSP}{}{unit}", num(value), figures(std, 2));
    }
    minus(format!("{value:.places$}{NBSP}±{NBSP}{std:.places$}{unit}"))
}

/// A fraction as per cent: whole ones in the middle, a tenth at both ends.
pub fn percent(fraction: f64) -> String {
    let p = 100.0 * fraction;
    let text = match p {
        p if !p.is_finite() => return "not a number".into(),
        p if p > 0.0 && p < 0.1 => "<0.1".into(),
        p if p > 99.9 && p < 100.0 => ">99.9".into(),
        p if (10.0..90.0).contains(&p.abs()) || p.abs() >= 100.0 => format!("{p:.0}"),
        p => format!("{p:.1}").trim_end_matches(".0").to_string(),
    };
    format!("{}{NBSP}%", if text == "-0" { "0".into() } else { minus(text) })
}

/// A range of fractions: "94 to 98 %".
pub fn percents([lo, hi]: [f64; 2]) -> String {
    format!("{} to {}", percent(lo).trim_end_matches('%').trim_end_matches(NBSP), percent(hi))
}

/// Decimal exponent of the leading figure once rounded to `n` figures.
fn exponent(x: f64, n: usize) -> i32 {
    let text = format!("{:.*e}", n - 1, x.abs());
    text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// Places after the point that show `n` figures of a number with this exponent.
fn decimals(exponent: i32, n: usize) -> usize {
    usize::try_from(n as i32 - 1 - exponent).unwrap_or(0)
}

/// A typographer's minus sign.
fn minus(text: String) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_shows_three_figures() {
        let shown: Vec<_> = [3.4, 1.08234, 0.02281, 12.345, 9.999, 4321.6, 0.0, -0.5].map(num).into();
        assert_eq!(shown, ["3.40", "1.08", "0.0228", "12.3", "10.0", "4322", "0", "−0.500"]);
        assert_eq!(num(0.0000123), "1.23e−5");
    }

    #[test]
    fn an_estimate_shows_no_more_digits_than_its_uncertainty_allows() {
        let plain = |v, s, u| estimate(v, s, u).replace(NBSP, " ");
        assert_eq!(plain(0.41234, Some(0.0199), "1"), "0.412 ± 0.020");
        assert_eq!(plain(4.3111, Some(0.13), "ohm"), "4.31 ± 0.13 ohm");
        assert_eq!(plain(1234.5, Some(56.7), "N"), "1234 ± 57 N");
        assert_eq!(plain(0.012, None, "s"), "0.0120 s");
        assert_eq!(plain(5.2e-7, Some(4e-8), "H"), "5.20e−7 ± 4.0e−8 H");
    }

    #[test]
    fn per_cent_is_fine_at_both_ends_and_coarse_between() {
        let shown = [0.0, 0.0002, 0.0123, 0.21, 0.93, 0.967, 0.99987, 1.0, 1.034, -0.03];
        let expected = ["0", "<0.1", "1.2", "21", "93", "96.7", ">99.9", "100", "103", "−3"];
        assert_eq!(shown.map(|x| percent(x).replace("\u{a0}%", "")), expected);
    }
}
