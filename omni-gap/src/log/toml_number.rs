//! A number as a person would write it into a TOML file.

/// A number in so many figures, at least one behind the point, as TOML has a float.
pub fn toml_number(value: f64, figures: i32) -> String {
    // of zero the logarithm is less than any number
    let digits = (figures - 1).saturating_sub(value.abs().log10().floor() as i32).clamp(1, 12) as usize;
    let text = format!("{value:.digits$}");
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::toml_number;

    #[test]
    fn figures_are_kept_and_zeros_are_not() {
        for (value, text) in
            [(0.0625, "0.0625"), (1.0 / 3.0, "0.33333"), (-1234.5678, "-1234.6"), (12.0, "12.0"), (0.0, "0.0")]
        {
            assert_eq!(toml_number(value, 5), text);
        }
    }
}
