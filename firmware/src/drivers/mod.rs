//! # Drivers: the parts around the chip, over the traits of `embedded-hal`
//!
//! Nothing here knows a pin or a register, so all of it runs on the host too (`firmware/tests/drivers.rs`).
//!
//! | part | is |
//! |---|---|
//! | [`gate`] | a gate driver: three PWM inputs and an enable |
//! | [`halls`] | three hall lines |
//! | [`fault`] | the fault line that all gate drivers share |
//! | [`flash_slots`] | the parameter block in two flash slots |
//! | [`heartbeat`] | who has to be alive before the watchdog is fed |

pub mod fault;
pub mod flash_slots;
pub mod gate;
pub mod halls;
pub mod heartbeat;
