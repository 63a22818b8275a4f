//! What a reader makes of bytes.

/// What a door tells of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// They could be read.
    Taken,
    /// They could not, and why.
    Refused(String),
}
