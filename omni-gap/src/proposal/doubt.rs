//! # How sure a guess is, and of what

/// How sure a guess is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Certainty {
    /// A person has to confirm it.
    Guess,
    /// Its name says so, or its numbers, and nothing speaks against it.
    Likely,
    /// Names and numbers agree, or the numbers leave nothing else.
    Sure,
}

impl Certainty {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Certainty::Guess => "guess",
            Certainty::Likely => "likely",
            Certainty::Sure => "sure",
        }
    }
}

/// How something was found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub certainty: Certainty,
    pub reason: String,
}

impl Found {
    pub fn new(certainty: Certainty, reason: impl Into<String>) -> Found {
        Found { certainty, reason: reason.into() }
    }

    /// Both together, as sure as the less sure of them.
    pub fn and(self, other: Found) -> Found {
        let reason = [self.reason, other.reason].into_iter().filter(|reason| !reason.is_empty());
        Found::new(self.certainty.min(other.certainty), reason.collect::<Vec<_>>().join("; "))
    }
}
