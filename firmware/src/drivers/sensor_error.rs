//! # Sensor error: what came in place of an answer

/// Why a sensor on the SPI was not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorError {
    /// The bus did not carry the transfer to its end
    Bus,
    /// A field holds what it cannot or must not
    Field {
        /// Its name in the data sheet
        field: &'static str,
        /// What it holds
        is: u16,
    },
}
