//! The door with the name of the program, opened with whatever a fuzzer makes up.
#![no_main]

use doors::Door;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    Door::named(env!("CARGO_BIN_NAME")).check(bytes);
});
