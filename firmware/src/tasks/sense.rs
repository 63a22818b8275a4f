//! Gyro and encoders, asked in time for the next motion turn.

use rtic::Mutex;

use crate::app;

/// One reading of all that are fitted. No turn waits for it, and it waits for no turn: an interrupt only makes a transfer longer.
pub fn sense(mut cx: app::sense::Context<'_>) {
    let fitted = cx.shared.sensing.lock(|sensing| sensing.fitted());
    let codes = cx.local.sensors.read(fitted);
    cx.shared.sensing.lock(|sensing| sensing.put(codes));
}
