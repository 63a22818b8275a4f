//! # Store: the parameter block in two flash slots, so that a power loss never loses the old one
//!
//! A slot is a flash region that is erased at once. It begins with 16 bytes, the block follows:
//!
//! | bytes | what |
//! |---|---|
//! | 0..4 | `SLOT` |
//! | 4..8 | sequence number: of two good slots the later counts |
//! | 8..12 | length of the block |
//! | 12..16 | CRC-32 (ISO HDLC) of sequence, length and block |
//!
//! Keeping a block erases the slot that is not in force, writes the block, and the head last. Until the head's last
//! byte is written the CRC is wrong and the old slot stays in force; from then on the new one is. Bytes that do not
//! read back as written are refused, and the old slot stays in force then too.

use crc::{CRC_32_ISO_HDLC, Crc, Digest, NoTable};
use embedded_storage::nor_flash::{NorFlash, ReadNorFlash};

/// Bytes before the block.
pub const HEAD: usize = 16;
/// The longest block [bytes].
pub const MAX_BLOCK: usize = model_core::link::block::MAX_BYTES;

const MAGIC: [u8; 4] = *b"SLOT";

/// Without a table: it runs twice a start, not in the loop.
static CHECK: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);

/// A region of the flash that is erased at once, as offsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// First byte
    pub from: u32,
    /// Byte after the last
    pub to: u32,
}

/// A block that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredBlock {
    /// Which of the two slots
    pub slot: usize,
    /// Offset of the block in the flash
    pub at: u32,
    /// Its length [bytes]
    pub len: usize,
    /// Its sequence number
    pub sequence: u32,
}

/// Why a block was not kept; the old one still is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoreError {
    /// Longer than [`LONGEST`] or than the slot
    TooLong,
    /// The flash refused
    Flash,
    /// What was written does not read back
    Unread,
}

/// The block in force, if there is one.
pub fn find<F: ReadNorFlash>(flash: &mut F, slots: &[Slot; 2]) -> Option<StoredBlock> {
    let [first, second] = [read_slot(flash, slots, 0), read_slot(flash, slots, 1)];
    match (first, second) {
        // the sequence wraps: of two neighbours the one ahead
        (Some(a), Some(b)) => Some(if (b.sequence.wrapping_sub(a.sequence) as i32) > 0 { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Keeps a block, which is in force when this returns `Ok`. Takes as long as erasing takes.
pub fn save<F: NorFlash>(flash: &mut F, slots: &[Slot; 2], block: &[u8]) -> Result<StoredBlock, StoreError> {
    const { assert!(HEAD.is_multiple_of(F::WRITE_SIZE), "the head is written in whole words of the flash") }
    let old = find(flash, slots);
    let (index, sequence) = old.map_or((0, 0), |old| (1 - old.slot, old.sequence.wrapping_add(1)));
    let slot = slots.get(index).copied().ok_or(StoreError::Flash)?;
    if block.len() > MAX_BLOCK || (HEAD + MAX_BLOCK) as u32 > slot.to - slot.from {
        return Err(StoreError::TooLong);
    }
    flash.erase(slot.from, slot.to).map_err(|_| StoreError::Flash)?;

    let body = slot.from + HEAD as u32;
    let whole = block.len() - block.len() % F::WRITE_SIZE;
    let (words, rest) = block.split_at(whole);
    flash.write(body, words).map_err(|_| StoreError::Flash)?;
    if !rest.is_empty() {
        // the last word is filled up with what erased flash holds
        let mut word = [0xFF_u8; HEAD];
        word.iter_mut().zip(rest).for_each(|(to, from)| *to = *from);
        let word = word.get(..F::WRITE_SIZE).ok_or(StoreError::Flash)?;
        flash.write(body + whole as u32, word).map_err(|_| StoreError::Flash)?;
    }

    let mut head = [0; HEAD];
    let mut check = begin_check(sequence, block.len());
    add(&mut check, block);
    let check = check.finalize().to_le_bytes();
    let fields = [MAGIC, sequence.to_le_bytes(), (block.len() as u32).to_le_bytes(), check];
    head.iter_mut().zip(fields.as_flattened()).for_each(|(to, from)| *to = *from);
    flash.write(slot.from, &head).map_err(|_| StoreError::Flash)?;

    match read_slot(flash, slots, index) {
        Some(stored) if stored.sequence == sequence && stored.len == block.len() => Ok(stored),
        _ => Err(StoreError::Unread),
    }
}

/// What a slot holds, if it is good.
fn read_slot<F: ReadNorFlash>(flash: &mut F, slots: &[Slot; 2], index: usize) -> Option<StoredBlock> {
    let slot = slots.get(index)?;
    let mut head = [0; HEAD];
    flash.read(slot.from, &mut head).ok()?;
    let [magic, sequence, len, stated] = words(&head);
    let len = len as usize;
    if magic != u32::from_le_bytes(MAGIC) || len > MAX_BLOCK || (HEAD + len) as u32 > slot.to - slot.from {
        return None;
    }
    let at = slot.from + HEAD as u32;
    let mut check = begin_check(sequence, len);
    let mut chunk = [0; HEAD];
    let mut done = 0;
    while done < len {
        let part = chunk.get_mut(..(len - done).min(HEAD))?;
        flash.read(at + done as u32, part).ok()?;
        add(&mut check, part);
        done += part.len();
    }
    (check.finalize() == stated).then_some(StoredBlock { slot: index, at, len, sequence })
}

/// Counts bytes into a check. By itself: the check has no table, and its loop is long when written out.
#[inline(never)]
fn add(check: &mut Digest<'static, u32, NoTable>, bytes: &[u8]) {
    check.update(bytes);
}

/// The check of a slot, before its block.
fn begin_check(sequence: u32, len: usize) -> Digest<'static, u32, NoTable> {
    let mut check = CHECK.digest();
    add(&mut check, &sequence.to_le_bytes());
    add(&mut check, &(len as u32).to_le_bytes());
    check
}

/// The four words of a head.
fn words(head: &[u8; HEAD]) -> [u32; 4] {
    let mut words = [0; 4];
    for (word, bytes) in words.iter_mut().zip(head.as_chunks::<4>().0) {
        *word = u32::from_le_bytes(*bytes);
    }
    words
}
