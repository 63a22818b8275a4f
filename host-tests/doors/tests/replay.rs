//! # Bytes that nobody meant
//!
//! Every door takes its sound bytes, what once broke it, and some thousand spoiled ones: with bytes changed, left out, put
//! in or repeated, ends cut off, numbers at the ends of their ranges. None may panic, refuse without a word, or take more
//! than ten times the memory of what it was given, and what any file costs.

use cap::Cap;
use doors::{Answer, DOORS, Door, seeds};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::alloc::System;

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

/// Spoiled inputs of a door in a run of the tests; `SPOILED_INPUTS` in the environment asks for more.
const SPOILED: u32 = 3000;

/// Memory of a door beyond ten times its input [bytes]: databases and decoders reserve some whatever they are given.
const RESERVED: usize = 64 << 20;

/// One thing done to bytes; places are shares of their number, in 1/65536.
#[derive(Clone, Debug)]
enum Spoil {
    Byte(u16, u8),
    Bit(u16, u8),
    Number(u16, &'static [u8]),
    Remove(u16, u8),
    Repeat(u16, u8),
    Insert(u16, Vec<u8>),
    Cut(u16),
}

/// Numbers at the ends of their ranges, as bytes and as text.
const NUMBERS: [&[u8]; 12] = [
    &[0; 8],
    &[0xff; 8],
    &[0xff, 0xff, 0xff, 0x7f],
    &[0, 0, 0, 0x80],
    &[0, 0, 0xc0, 0x7f],
    &[0, 0, 0, 0, 0, 0, 0xf8, 0x7f],
    b"nan",
    b"-1e309",
    b"9223372036854775807",
    b"\n\n",
    b"\"",
    b"[[",
];

fn spoil() -> impl Strategy<Value = Spoil> {
    let place = any::<u16>();
    prop_oneof![
        (place, any::<u8>()).prop_map(|(at, to)| Spoil::Byte(at, to)),
        (place, 0_u8..8).prop_map(|(at, bit)| Spoil::Bit(at, bit)),
        (place, select(&NUMBERS[..])).prop_map(|(at, number)| Spoil::Number(at, number)),
        (place, 1_u8..).prop_map(|(at, length)| Spoil::Remove(at, length)),
        (place, 1_u8..).prop_map(|(at, length)| Spoil::Repeat(at, length)),
        (place, vec(any::<u8>(), 1..16)).prop_map(|(at, bytes)| Spoil::Insert(at, bytes)),
        place.prop_map(Spoil::Cut),
    ]
}

impl Spoil {
    fn apply(&self, bytes: &mut Vec<u8>) {
        let index = |at: u16| bytes.len() * usize::from(at) / 65_536;
        let piece = |at: u16, length: usize| index(at)..(index(at) + length).min(bytes.len());
        match self {
            Spoil::Byte(at, to) => {
                let at = index(*at);
                bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = *to);
            }
            Spoil::Bit(at, bit) => {
                let at = index(*at);
                bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << bit);
            }
            Spoil::Number(at, number) => drop(bytes.splice(piece(*at, number.len()), number.iter().copied())),
            Spoil::Remove(at, length) => drop(bytes.drain(piece(*at, usize::from(*length)))),
            Spoil::Repeat(at, length) => {
                let again = bytes[piece(*at, usize::from(*length))].to_vec();
                let at = index(*at);
                bytes.splice(at..at, again);
            }
            Spoil::Insert(at, more) => {
                let at = index(*at);
                bytes.splice(at..at, more.iter().copied());
            }
            Spoil::Cut(at) => bytes.truncate(index(*at)),
        }
    }
}

/// What a door tells, and whether it took too much memory for it.
fn opened(door: &Door, bytes: &[u8]) -> Result<Answer, String> {
    let before = MEMORY.allocated();
    MEMORY.set_limit(before + RESERVED + 10 * bytes.len()).expect("more than is in use");
    let answer = door.check(bytes);
    MEMORY.set_limit(usize::MAX).expect("more than is in use");
    Ok(answer)
}

/// Sound bytes that a door does not take, or spoiled ones that break it.
fn broken(door: &Door) -> Result<(), String> {
    let sound = seeds(door.name);
    for (k, bytes) in sound.iter().enumerate() {
        if let Answer::Refused(why) = opened(door, bytes)? {
            return Err(format!("sound bytes {k} are refused: {why}"));
        }
    }
    for bytes in regressions(door.name) {
        opened(door, &bytes)?;
    }
    let cases = std::env::var("SPOILED_INPUTS").ok().and_then(|text| text.parse().ok()).unwrap_or(SPOILED);
    let config = Config { cases, max_shrink_iters: 64, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let spoiled = (select(sound), vec(spoil(), 1..6)).prop_map(|(mut bytes, spoils)| {
        spoils.iter().for_each(|spoil| spoil.apply(&mut bytes));
        bytes
    });
    runner
        .run(&spoiled, |bytes| opened(door, &bytes).map(drop).map_err(TestCaseError::fail))
        .map_err(|why| why.to_string())
}

/// What once broke a door: the files of `regressions/NAME`.
fn regressions(name: &str) -> Vec<Vec<u8>> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("regressions").join(name);
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    entries.map(|entry| std::fs::read(entry.expect("an entry").path()).expect("a file")).collect()
}

// one test for all, so that the memory of one door is not counted as another's
#[test]
fn every_door_answers_or_refuses_whatever_it_is_given() {
    let broken: Vec<String> =
        DOORS.iter().filter_map(|door| broken(door).err().map(|why| format!("{}: {why}", door.name))).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
