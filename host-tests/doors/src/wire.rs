//! What comes over the wire.

use crc::{CRC_32_ISO_HDLC, Crc};
use model_core::link::block::{MAX_BYTES, Parameters};
use model_core::link::command::Command;
use model_core::link::framing::FrameDecoder;
use model_core::link::message::Message;

use crate::answer::Answer;

/// The checksum of a block.
const CHECK: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Bytes of the link, read by the robot and by the host: never more frames than there can be.
///
/// # Panics
/// Where a frame is counted that was not there.
pub fn frames(bytes: &[u8]) -> Answer {
    let mut decoder = FrameDecoder::new();
    let (mut frames, mut understood) = (0, 0);
    for byte in bytes {
        let Some(frame) = decoder.push(*byte) else { continue };
        frames += 1;
        let said = Message::decode(frame.kind, frame.payload).is_some();
        let told = Command::decode(frame.kind, frame.payload).is_ok();
        assert!(!(said && told), "kind {} is said by robots and told to them", frame.kind);
        understood += u32::from(said || told);
    }
    assert_eq!(decoder.good(), frames);
    // a frame has five bytes at the least: its distance, a kind, two of the checksum, a zero
    assert!(5 * frames as usize <= bytes.len());
    if understood > 0 { Answer::Taken } else { Answer::Refused("no frame of the link is in these bytes".into()) }
}

/// A parameter block, as it is and with its length and checksum made right: what is taken can be written, and is then the
/// same block.
///
/// # Panics
/// Where a block that was read cannot be written, or is another one when it is read again.
pub fn block(bytes: &[u8]) -> Answer {
    let answer = taken_block(bytes);
    let mut mended = bytes.to_vec();
    let length = bytes.len() as u16;
    if let Some(said) = mended.get_mut(6..8) {
        said.copy_from_slice(&length.to_le_bytes());
    }
    if let Some((before, check)) = mended.split_last_chunk_mut::<4>() {
        *check = CHECK.checksum(before).to_le_bytes();
    }
    taken_block(&mended);
    answer
}

fn taken_block(bytes: &[u8]) -> Answer {
    let parameters = match Parameters::decode(bytes) {
        Ok(parameters) => parameters,
        Err(why) => return Answer::Refused(why.to_string()),
    };
    let written = encoded(&parameters);
    let again = Parameters::decode(&written).expect("a block that was written can be read");
    assert_eq!(encoded(&again), written);
    Answer::Taken
}

fn encoded(parameters: &Parameters) -> Vec<u8> {
    let mut out = [0; MAX_BYTES];
    let length = parameters.encode(&mut out).expect("a block that was read is sound");
    out[..length].to_vec()
}
