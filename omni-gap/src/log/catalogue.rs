//! # The effects a robot file may name
//!
//! This room does not know physics: whoever loads a file passes in the ids, parameter keys and bounds that exist.

use model_core::effects::card::Scope;

/// One parameter of an effect.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownParam {
    /// Its key in the robot file, with the unit as suffix.
    pub key: String,
    /// The smallest value allowed, in the key's unit.
    pub low: f64,
    /// The largest value allowed, in the key's unit.
    pub high: f64,
    /// Whether the file must give it.
    pub required: bool,
}

/// One effect.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownEffect {
    /// Its id in the robot file.
    pub id: String,
    /// Where it sits.
    pub scope: Scope,
    /// Its parameters.
    pub params: Vec<KnownParam>,
}

/// All effects that a robot file may name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Catalogue {
    /// The effects, in any order.
    pub effects: Vec<KnownEffect>,
    /// How many tables of effects one robot file may have: what a model has room for, beside what a diagnosis adds.
    pub most_at_once: usize,
}

impl Catalogue {
    /// The effect of this id.
    pub fn find(&self, id: &str) -> Option<&KnownEffect> {
        self.effects.iter().find(|effect| effect.id == id)
    }
}

/// The one of `known` that is spelled most like `word`, if any is like it at all.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let near = known.into_iter().map(|other| (distance(word, other), other)).min()?;
    let (far, other) = near;
    (far <= 2 + other.len() / 3 || other.starts_with(word)).then_some(other)
}

/// How many letters must be changed, added or left out to turn one word into the other.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..b.len() {
            let change = diagonal + usize::from(letter != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_is_found_and_a_strange_one_has_none() {
        assert_eq!(nearest("weel_slip", ["coriolis", "wheel_slip"]), Some("wheel_slip"));
        assert_eq!(nearest("mass", ["inertia_kg_m2", "mass_kg"]), Some("mass_kg"));
        assert_eq!(nearest("xyzzy_qqq", ["creep", "mass_kg"]), None);
    }

    #[test]
    fn distance_counts_letters() {
        assert_eq!((distance("abc", "abc"), distance("abc", "abd"), distance("abc", "ab")), (0, 1, 1));
    }
}
