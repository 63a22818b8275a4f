//! Numbers of the tables: two significant figures.

/// A number with two significant figures, without powers of ten.
pub fn two_figures(x: f64) -> String {
    if !x.is_finite() {
        return "–".to_owned();
    }
    let places = places(x);
    format!("{x:.places$}").replace('-', "−")
}

/// The places after the point that show two figures.
fn places(x: f64) -> usize {
    // the exponent once rounded, so that 0.0996 is 0.10 and not 0.100
    let exponent = format!("{:.1e}", x.abs()).split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    usize::try_from(1 - exponent).unwrap_or(0)
}

/// A fraction as a number of per cent.
pub fn percent(x: f64) -> String {
    two_figures(100.0 * x)
}

/// The same with its sign, to as many places as `beside` is shown with.
pub fn signed(x: f64, beside: f64) -> String {
    let places = places(100.0 * beside);
    format!("{:+.places$}", 100.0 * x).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_shows_two_figures_and_its_sign_where_asked() {
        assert_eq!(
            [0.0, 0.0996, 1.0, 12.34, 127.7, f64::INFINITY].map(two_figures),
            ["0.0", "0.10", "1.0", "12", "128", "–"]
        );
        assert_eq!([(0.01234, 0.002), (-0.456, 0.5)].map(|(x, beside)| signed(x, beside)), ["+1.23", "−46"]);
    }
}
