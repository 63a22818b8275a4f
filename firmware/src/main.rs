//! stand-in
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use firmware::board;

#[entry]
fn main() -> ! {
    let _ = board::cycles();
    loop {}
}
