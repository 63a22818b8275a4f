//! Prints the folded bits of the model's results, as the emulated core computes them.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware::{board, parity};
use panic_halt as _;

#[entry]
fn main() -> ! {
    board::say(format_args!("{:016x}\n", parity::hash()));
    board::end()
}
