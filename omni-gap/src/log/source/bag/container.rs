//! What a recording of topics can tell, whatever its file format.

use super::decoder::Decoder;
use super::rows::Recorded;
use crate::error::Result;

/// A topic that a recording has messages of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Seen {
    pub topic: String,
    /// The type of its messages.
    pub of_type: String,
    pub messages: usize,
}

/// What is done with each message.
pub(super) type Take<'a> = dyn FnMut(&Decoder, Recorded) -> Result<()> + 'a;

/// An opened recording.
pub(super) trait Container {
    /// The topics that it has messages of, by name.
    fn topics(&self) -> Result<Vec<Seen>>;

    /// Hands over the messages of a topic in the order of the file; says what was amiss, if anything was.
    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>>;
}
