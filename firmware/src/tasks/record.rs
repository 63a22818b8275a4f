//! The records' way out.

use firmware::drivers::roll::Task;
use rtic::Mutex;

use crate::app;

/// Hands to the link as much as it takes.
pub fn record(mut cx: app::record::Context<'_>) {
    while let Some(bytes) = cx.local.post.waiting() {
        let taken = cx.shared.wire.lock(|wire| wire.send(bytes));
        cx.local.post.sent(taken);
        if taken == 0 {
            break;
        }
    }
    cx.shared.roll.here(Task::Record);
}
