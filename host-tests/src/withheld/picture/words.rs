//! Words as pictures have them.

use super::super::scored::Scored;

/// What a write to a string never fails with.
pub(super) const FITS: &str = "a string takes any text";

/// Text as it may stand in HTML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// What was answered first, in a word.
pub fn answered(one: &Scored) -> String {
    match &one.answer {
        None => "failed".to_owned(),
        Some(answer) => answer.causes.first().cloned().unwrap_or_else(|| {
            serde_json::to_value(answer.verdict)
                .ok()
                .and_then(|word| word.as_str().map(str::to_owned))
                .unwrap_or_default()
        }),
    }
}
