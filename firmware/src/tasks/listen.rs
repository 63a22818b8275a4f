//! The link's bytes, made commands and parameters.

use firmware::drivers::heartbeat::Task;
use rtic::Mutex;

use crate::app;

/// Whatever has come since the last motion turn.
pub fn listen(mut cx: app::listen::Context<'_>) {
    let mut bytes = [0; 64];
    loop {
        let count = cx.shared.serial.lock(|serial| serial.receive(&mut bytes));
        for byte in bytes.iter().take(count) {
            if let Some(command) = cx.local.receiver.push(*byte) {
                cx.shared.to_store.lock(|to_store| to_store.hear(&command, cx.local.receiver));
                cx.shared.inbox.lock(|inbox| inbox.put(command));
            }
        }
        if count < bytes.len() {
            break;
        }
    }
    cx.shared.heartbeats.beat(Task::Listen);
}
