//! Nothing to do: feed the watchdog, if all others have been at work since the last time.

use crate::app;

/// Waits for the next interrupt, for ever.
pub fn idle(cx: app::idle::Context<'_>) -> ! {
    loop {
        if cx.shared.heartbeats.all_alive() {
            cx.local.watchdog.feed();
        }
        cortex_m::asm::wfi();
    }
}
