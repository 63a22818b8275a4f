//! The link's bytes, made commands and parameters.

use firmware::drivers::roll::Task;
use rtic::Mutex;

use crate::app;

/// Whatever has come since the last motion turn.
pub fn listen(mut cx: app::listen::Context<'_>) {
    let mut bytes = [0; 64];
    loop {
        let count = cx.shared.wire.lock(|wire| wire.receive(&mut bytes));
        for byte in bytes.iter().take(count) {
            if let Some(heard) = cx.local.listener.hear(*byte) {
                cx.shared.inbox.lock(|inbox| inbox.put(heard));
            }
        }
        if count < bytes.len() {
            break;
        }
    }
    cx.shared.roll.here(Task::Listen);
}
