//! Golden pages: files that a person can judge, held to by a test and rewritten with `BLESS=1`.

use std::fs;
use std::path::Path;

/// Holds a page to what stands in `golden/`; with `BLESS=1` in the environment it is written there instead.
///
/// # Panics
/// If the page differs, with its first line that does.
pub fn holds(name: &str, page: &str) {
    holds_at(&Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(name), page);
}

/// The same for a file that stands anywhere.
///
/// # Panics
/// If the text differs, with its first line that does.
pub fn holds_at(path: &Path, page: &str) {
    let name = path.file_name().unwrap_or_default().display();
    if std::env::var_os("BLESS").is_some_and(|bless| bless == "1") {
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder that can be written");
        fs::write(path, page).unwrap_or_else(|why| panic!("{name}: {why}"));
        return;
    }
    let stored = fs::read_to_string(path).unwrap_or_default();
    let advice = "judge the difference; if it is right, rewrite the page with BLESS=1";
    for (k, (new, old)) in page.lines().zip(stored.lines()).enumerate() {
        assert!(new == old, "{name}, line {}: {advice}\n  stands: {old}\n  is now: {new}", k + 1);
    }
    let (new, old) = (page.lines().count(), stored.lines().count());
    assert!(new == old, "{name} has {old} lines and is now {new} long: {advice}");
}

/// A number with two significant digits, so that a page stays as it is while nothing that matters changes.
pub fn two_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor();
    let scale = 10f64.powf(exponent - 1.0);
    let rounded = (x / scale).round() * scale;
    // what rounds up to a power of ten has one digit before it more
    let exponent = rounded.abs().log10().floor();
    if (-4.0..2.0).contains(&exponent) {
        format!("{rounded:.*}", (1.0 - exponent).max(0.0) as usize)
    } else {
        format!("{rounded:.1e}")
    }
}

#[test]
fn two_digits_are_two_digits() {
    for (x, text) in
        [(0.0, "0"), (1.234, "1.2"), (0.000_567_8, "0.00057"), (99.6, "1.0e2"), (12.3, "12"), (3.21e-7, "3.2e-7")]
    {
        assert_eq!(two_digits(x), text);
    }
}
