//! # Payload: what a frame carries, of a length that what is told decides

use core::ops::Deref;

use crate::link::bytes::Writer;

/// Some bytes, `MOST` of them at the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Payload<const MOST: usize> {
    bytes: [u8; MOST],
    len: usize,
}

impl<const MOST: usize> Payload<MOST> {
    /// What is written; what goes beyond `MOST` is left out.
    #[inline]
    pub(crate) fn of(write: impl FnOnce(&mut Writer)) -> Self {
        let mut bytes = [0; MOST];
        let mut writer = Writer::new(&mut bytes);
        write(&mut writer);
        let len = writer.written().len();
        Self { bytes, len }
    }
}

impl<const MOST: usize> Deref for Payload<MOST> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        self.bytes.get(..self.len).unwrap_or(&self.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_as_long_as_what_was_written() {
        let payload = Payload::<8>::of(|writer| writer.u16(0x0102));
        assert_eq!(*payload, [2, 1]);
        assert!(Payload::<8>::of(|_| ()).is_empty());
        assert_eq!(*Payload::<3>::of(|writer| (0..9).for_each(|x| writer.u8(x))), [0, 1, 2]);
    }
}
