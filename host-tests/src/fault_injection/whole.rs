//! Whether a file is whole, by its kind, and whether a program left what it only needed on the way.

use std::fs;
use std::path::Path;

/// How the names of files begin that are not finished yet.
const UNFINISHED: &[u8] = b".omni-gap-";

/// Whether it is a file that its writer had not finished.
pub fn is_unfinished(path: &Path) -> bool {
    path.file_name().unwrap_or_default().as_encoded_bytes().starts_with(UNFINISHED)
}

/// What is wrong with a file, if it is half-written; none of a folder, a link and a file that is whole.
pub fn amiss(path: &Path) -> Option<String> {
    if path.is_symlink() || !path.is_file() {
        return None;
    }
    let told = |why: &str| Some(format!("{}: {why}", path.display()));
    if is_unfinished(path) {
        return told("was left behind unfinished");
    }
    let Ok(bytes) = fs::read(path) else { return told("cannot be read") };
    let text = || String::from_utf8(bytes.clone()).ok();
    let is_whole = match path.extension().and_then(|suffix| suffix.to_str()) {
        Some("json") => serde_json::from_slice::<serde_json::Value>(&bytes).is_ok(),
        Some("html") => bytes.trim_ascii_end().ends_with(b"</html>"),
        Some("toml") => text().is_some_and(|text| text.ends_with('\n') && text.parse::<toml::Table>().is_ok()),
        Some("csv") => text().is_some_and(|text| rows_are_equal(&text)),
        Some("parquet") => bytes.len() > 8 && bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"),
        _ => true,
    };
    if is_whole { None } else { told("is half-written") }
}

fn rows_are_equal(text: &str) -> bool {
    let mut fields = text.lines().map(|line| line.split(',').count());
    let first = fields.next();
    text.ends_with('\n') && fields.all(|count| Some(count) == first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_any_file_is_seen_to_be_half() {
        let folder = tempfile::tempdir().unwrap();
        let html = format!("<html>{}</html>\n", "x".repeat(40));
        for (name, sound) in [
            ("a.json", &br#"{"a": [1, 2, 3, 4]}"#[..]),
            ("a.html", html.as_bytes()),
            ("a.toml", b"a = 1\nb = \"two\"\n"),
            ("a.csv", b"a,b\n1,2\n3,4\n"),
            ("a.parquet", b"PAR1 columns PAR1"),
        ] {
            let path = folder.path().join(name);
            fs::write(&path, sound).unwrap();
            assert_eq!(amiss(&path), None);
            fs::write(&path, &sound[..sound.len() / 2]).unwrap();
            assert!(amiss(&path).is_some(), "{name}");
        }
        fs::write(folder.path().join(".omni-gap-x"), "").unwrap();
        assert!(amiss(&folder.path().join(".omni-gap-x")).is_some());
        assert_eq!(amiss(folder.path()), None);
    }
}
