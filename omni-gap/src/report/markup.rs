//! A writer of tags that cannot leave one open and cannot forget to escape.

use std::fmt::{Display, Write};

use serde::Serialize;

/// Attributes of a tag; values are escaped.
pub type Attrs<'a> = &'a [(&'a str, &'a dyn Display)];

/// A piece of a page, HTML or SVG.
#[derive(Debug, Default)]
pub struct Markup {
    text: String,
    has_data: bool,
}

impl Markup {
    /// A tag around whatever `fill` writes.
    pub fn within(&mut self, tag: &str, attrs: Attrs, fill: impl FnOnce(&mut Self)) {
        self.text.push('<');
        self.text.push_str(tag);
        for (name, value) in attrs {
            let _ = write!(self.text, " {name}=\"{}\"", escape(&value.to_string()));
        }
        self.text.push('>');
        fill(self);
        let _ = write!(self.text, "</{tag}>");
    }

    /// A tag around text.
    pub fn leaf(&mut self, tag: &str, attrs: Attrs, text: &str) {
        self.within(tag, attrs, |m| m.text(text));
    }

    /// Text, escaped.
    pub fn text(&mut self, text: &str) {
        self.text.push_str(&escape(text));
    }

    /// Markup of this program's own, as it stands.
    pub fn own(&mut self, markup: &'static str) {
        self.text.push_str(markup);
    }

    /// Numbers for the page's own scripts, as JSON.
    pub fn data(&mut self, value: &impl Serialize) {
        let json = serde_json::to_string(value).unwrap_or_else(|_| "null".to_owned());
        // in a script only a `<` could end the numbers before their end
        let _ = write!(self.text, "<script type=\"application/json\">{}</script>", json.replace('<', "\\u003c"));
        self.has_data = true;
    }

    /// True where scripts find something to work on.
    pub fn has_data(&self) -> bool {
        self.has_data
    }

    /// The text of the page.
    pub fn finish(self) -> String {
        self.text
    }
}

/// A coordinate in a picture: a tenth of a pixel is fine enough.
#[derive(Clone, Copy, Debug)]
pub struct Px(pub f64);

impl Display for Px {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let tenths = (10.0 * self.0).round() as i64;
        match tenths % 10 {
            0 => write!(f, "{}", tenths / 10),
            _ => write!(f, "{:.1}", tenths as f64 / 10.0),
        }
    }
}

fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            // No page may hold other control characters.
            c if c.is_control() && !matches!(c, '\n' | '\t') => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_attributes_are_escaped() {
        let mut m = Markup::default();
        m.leaf("p", &[("title", &"a\"b")], "<b> & 'c'\u{0}");
        assert_eq!(m.finish(), "<p title=\"a&quot;b\">&lt;b&gt; &amp; &#39;c&#39;\u{fffd}</p>");
    }

    #[test]
    fn numbers_for_scripts_never_end_before_their_end() {
        let mut m = Markup::default();
        m.data(&["</script><b>", "µ"]);
        assert_eq!(m.finish(), "<script type=\"application/json\">[\"\\u003c/script>\\u003cb>\",\"µ\"]</script>");
    }

    #[test]
    fn a_coordinate_has_one_place_at_most() {
        assert_eq!([1.0, 1.04, -2.25, 0.1].map(|x| Px(x).to_string()), ["1", "1", "-2.3", "0.1"]);
    }
}
