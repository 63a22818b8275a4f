//! What a recording of topics can tell, whatever its file format.

use super::decoder::Decoder;
use super::rows::Recorded;
use crate::error::Result;
pub(super) use crate::log::source::topic::Seen;

/// What is done with each message.
pub(super) type Take<'a> = dyn FnMut(&Decoder, Recorded) -> Result<()> + 'a;

/// An opened recording.
pub(super) trait Container {
    /// The topics that it has messages of, by name.
    fn topics(&self) -> Result<Vec<Seen>>;

    /// Hands over the messages of a topic in the order of the file; says what was amiss, if anything was.
    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>>;
}
