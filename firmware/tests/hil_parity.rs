//! The model's bits on a board: `cargo fw-test`, after the board's own test. An image of its own: beside the tests of `hil.rs`
//! the plant would not fit in the sectors that an image may fill.
#![no_std]
#![no_main]

use panic_probe as _;

#[cfg(test)]
#[embedded_test::tests]
mod tests {
    use defmt::{assert_eq, info, unwrap};
    use firmware::board::{self, Parts, pac};
    use firmware::parity;

    /// The bits that host and emulator agree on.
    const PARITY: &str = include_str!("../golden/parity.txt");

    #[init]
    fn init() -> Parts {
        let core = unwrap!(cortex_m::Peripherals::take());
        let device = unwrap!(pac::Peripherals::take());
        board::take(core, device)
    }

    #[test]
    fn the_model_has_the_same_bits_as_on_the_host(_parts: Parts) {
        let golden = unwrap!(u64::from_str_radix(PARITY.trim(), 16).ok());
        let began = board::ticks();
        assert_eq!(parity::hash(), golden);
        info!("{} results in {} cycles", parity::RESULTS, board::ticks().wrapping_sub(began));
    }
}
