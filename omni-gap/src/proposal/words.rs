//! # The words that a name is made of

/// Words for units, in the spelling of mappings.
pub(super) const UNITS: [(&str, &str); 29] = [
    ("s", "s"),
    ("sec", "s"),
    ("secs", "s"),
    ("seconds", "s"),
    ("ms", "ms"),
    ("msec", "ms"),
    ("millis", "ms"),
    ("us", "us"),
    ("usec", "us"),
    ("micros", "us"),
    ("ns", "ns"),
    ("nsec", "ns"),
    ("nanos", "ns"),
    ("v", "V"),
    ("mv", "mV"),
    ("a", "A"),
    ("ma", "mA"),
    ("rpm", "rpm"),
    ("m", "m"),
    ("cm", "cm"),
    ("mm", "mm"),
    ("rad", "rad"),
    ("deg", "deg"),
    ("degrees", "deg"),
    ("grad", "deg"),
    ("ticks", "counts"),
    ("tick", "counts"),
    ("counts", "counts"),
    ("count", "counts"),
];

/// The words of a name, and what may be asked of them.
pub(super) struct Words<'a>(pub &'a [String]);

impl Words<'_> {
    pub fn any(&self, known: &[&str]) -> bool {
        self.0.iter().any(|word| known.contains(&word.as_str()))
    }

    /// Also where words are run together: `setvel`, `motorcurrent`.
    pub fn hold(&self, known: &[&str]) -> bool {
        let within = |word: &String| known.iter().any(|known| known.len() > 2 && word.contains(known));
        self.any(known) || self.0.iter().any(within)
    }

    pub fn last(&self) -> &str {
        self.0.last().map(String::as_str).unwrap_or_default()
    }
}

/// The words of a name in small letters, and what stands in its first brackets where that is no unit.
pub(super) fn words_of(name: &str) -> (Vec<String>, Option<String>) {
    let mut words: Vec<String> = Vec::new();
    let mut last = ' ';
    let kind = |letter: char| (letter.is_ascii_digit(), letter.is_alphabetic());
    let inside = name.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(inside, _)| inside);
    let is_unit = |inside: &str| {
        let small = inside.to_lowercase();
        UNITS.iter().any(|(word, _)| *word == small) || small.contains('/') || small.contains('°')
    };
    let bracketed = inside.filter(|inside| !inside.is_empty() && !is_unit(inside)).map(str::to_owned);
    let outside = match &bracketed {
        Some(inside) => name.replacen(&format!("[{inside}]"), "", 1),
        None => name.to_owned(),
    };
    // units with a capital in them are one word
    let outside =
        [("mA", "ma"), ("mV", "mv"), ("°", "deg")].iter().fold(outside, |name, (unit, word)| name.replace(unit, word));
    for letter in outside.chars() {
        let begins = kind(letter) != kind(last) || letter.is_uppercase() && last.is_lowercase();
        if letter.is_alphanumeric() {
            if begins {
                words.push(String::new());
            }
            words.last_mut().into_iter().for_each(|word| word.extend(letter.to_lowercase()));
        }
        last = letter;
    }
    (words, bracketed)
}
