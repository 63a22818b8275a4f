//! How long a part of a recording is believed to be, a chunk or a page, before room is made for it: some bytes may unpack to gigabytes.

/// No part is believed to be longer, packed or unpacked (bytes).
pub(super) const LONGEST: u64 = 1 << 28;

/// That short any part may be (bytes).
pub(super) const SHORT: u64 = 1 << 24;

/// So many times as long as the whole recording a part may be where it is packed.
const UNPACKED: u64 = 64;

/// The longest part that a recording of so many bytes is believed to unpack to (bytes).
pub(super) fn longest_part(recording: u64) -> u64 {
    recording.saturating_mul(UNPACKED).clamp(SHORT, LONGEST)
}
