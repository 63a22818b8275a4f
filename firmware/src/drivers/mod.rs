//! # Drivers: the parts around the chip, over the traits of `embedded-hal`
//!
//! Nothing here knows a pin or a register, so all of it runs on the host too (`firmware/tests/drivers.rs`,
//! `sensors.rs`).
//!
//! | part | is |
//! |---|---|
//! | [`gate`] | a gate driver: three PWM inputs and an enable |
//! | [`halls`] | three hall lines |
//! | [`fault`] | the fault line that all gate drivers share |
//! | [`bmi088`] | a gyro on the SPI |
//! | [`as5047p`] | a magnetic encoder on the SPI |
//! | [`sensor_error`] | why neither was believed |
//! | [`sensors`] | one gyro and an encoder a wheel, kept at work |
//! | [`flash_slots`] | the parameter block in two flash slots |
//! | [`heartbeat`] | who has to be alive before the watchdog is fed |

pub mod as5047p;
pub mod bmi088;
pub mod fault;
pub mod flash_slots;
pub mod gate;
pub mod halls;
pub mod heartbeat;
pub mod sensor_error;
pub mod sensors;
