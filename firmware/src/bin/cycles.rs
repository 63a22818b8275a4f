//! Prints what one call of each part of the control path costs, in instructions of the emulated core.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware::board;

#[entry]
fn main() -> ! {
    board::end()
}
