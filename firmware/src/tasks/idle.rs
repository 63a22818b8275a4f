//! Nothing to do: feed the watchdog, if the others have been at work since the last time.

use rtic::Mutex;

use crate::app;

/// The current task has had a turn.
pub const CURRENT: u8 = 1;
/// The motion task has had a turn.
pub const MOTION: u8 = 2;

/// Waits for the next interrupt, for ever.
pub fn idle(mut cx: app::idle::Context<'_>) -> ! {
    loop {
        let all = cx.shared.alive.lock(|alive| {
            let all = *alive == CURRENT | MOTION;
            if all {
                *alive = 0;
            }
            all
        });
        if all {
            cx.local.dog.feed();
        }
        cortex_m::asm::wfi();
    }
}
