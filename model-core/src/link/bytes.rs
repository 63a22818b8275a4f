//! Little-endian numbers into and out of fixed memory; what does not fit is refused, never a panic.

/// Puts numbers one after the other.
#[derive(Debug)]
pub(crate) struct Writer<'a> {
    into: &'a mut [u8],
    at: usize,
    full: bool,
}

impl<'a> Writer<'a> {
    pub fn new(into: &'a mut [u8]) -> Self {
        Self { into, at: 0, full: false }
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        match self.into.get_mut(self.at..).and_then(|rest| rest.get_mut(..bytes.len())) {
            Some(room) => {
                room.copy_from_slice(bytes);
                self.at += bytes.len();
            }
            None => self.full = true,
        }
    }

    pub fn u8(&mut self, x: u8) {
        self.bytes(&[x]);
    }

    pub fn u16(&mut self, x: u16) {
        self.bytes(&x.to_le_bytes());
    }

    pub fn u32(&mut self, x: u32) {
        self.bytes(&x.to_le_bytes());
    }

    pub fn f32(&mut self, x: f32) {
        self.bytes(&x.to_le_bytes());
    }

    /// What has been written so far.
    pub fn written(&self) -> &[u8] {
        self.into.get(..self.at).unwrap_or_default()
    }

    /// How many bytes were written; none if they did not all fit.
    pub fn len(&self) -> Option<usize> {
        (!self.full).then_some(self.at)
    }
}

/// Takes numbers one after the other; `None` where the bytes end first.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub fn new(rest: &'a [u8]) -> Self {
        Self { rest }
    }

    pub fn array<const K: usize>(&mut self) -> Option<[u8; K]> {
        let (first, rest) = self.rest.split_first_chunk::<K>()?;
        self.rest = rest;
        Some(*first)
    }

    pub fn u8(&mut self) -> Option<u8> {
        self.array::<1>().map(|[x]| x)
    }

    pub fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub fn f32(&mut self) -> Option<f32> {
        self.array().map(f32::from_le_bytes)
    }

    /// All that is left.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// As many numbers as the array holds, each taken by `one`.
    pub fn each<T: Copy + Default, const K: usize>(&mut self, one: impl Fn(&mut Self) -> Option<T>) -> Option<[T; K]> {
        let mut all = [T::default(); K];
        for slot in &mut all {
            *slot = one(self)?;
        }
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read() {
        let mut memory = [0; 16];
        let mut writer = Writer::new(&mut memory);
        writer.u8(7);
        writer.u16(0x1234);
        writer.u32(0xdead_beef);
        writer.f32(-1.5);
        assert_eq!(writer.len(), Some(11));
        let mut reader = Reader::new(writer.written());
        assert_eq!((reader.u8(), reader.u16()), (Some(7), Some(0x1234)));
        assert_eq!((reader.u32(), reader.f32(), reader.u8()), (Some(0xdead_beef), Some(-1.5), None));
    }

    #[test]
    fn what_does_not_fit_is_told() {
        let mut memory = [0; 3];
        let mut writer = Writer::new(&mut memory);
        writer.u16(1);
        writer.u16(2);
        assert_eq!((writer.len(), writer.written()), (None, &[1, 0][..]));
        assert_eq!(Reader::new(&[1, 2]).each::<u16, 2>(Reader::u16), None);
    }
}
