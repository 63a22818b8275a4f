//! The records' way out.

use firmware::drivers::heartbeat::Task;
use rtic::Mutex;

use crate::app;

/// Hands to the link as much as it takes.
pub fn record(mut cx: app::record::Context<'_>) {
    while let Some(bytes) = cx.local.tx_consumer.pending() {
        let taken = cx.shared.serial.lock(|serial| serial.send(bytes));
        cx.local.tx_consumer.consume(taken);
        if taken == 0 {
            break;
        }
    }
    cx.shared.heartbeats.beat(Task::Record);
}
