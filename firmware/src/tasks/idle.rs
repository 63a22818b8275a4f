//! Nothing to do: feed the watchdog, if all others have been at work since the last time, store what is to be stored, and tell a
//! debugger what changed.

use firmware::board;
use rtic::Mutex;

use crate::app;

/// Waits for the next interrupt, for ever.
pub fn idle(mut cx: app::idle::Context<'_>) -> ! {
    board::resume_turns();
    loop {
        if cx.shared.heartbeats.all_alive() {
            cx.local.watchdog.feed();
        }
        store(&mut cx);
        let report = cx.shared.report.lock(|report| *report);
        cx.local.event_log.tell(report);
        cortex_m::asm::wfi();
    }
}

/// Stores a block that waits for it, once it is driven with and all bridges are open. With all interrupts masked: no turn may
/// close a bridge and then stand still with the core.
fn store(cx: &mut app::idle::Context<'_>) {
    let app::idle::SharedResources { windings, inbox, to_store, .. } = &mut cx.shared;
    let flash_store = &mut *cx.local.flash_store;
    to_store.lock(|to_store| {
        if to_store.is_empty() {
            return;
        }
        let tried = cortex_m::interrupt::free(|_| {
            let block = windings.lock(|windings| inbox.lock(|inbox| to_store.due(windings, inbox)))?;
            let stored = flash_store.save(block);
            board::resume_turns();
            Some(stored)
        });
        let Some(stored) = tried else { return };
        to_store.clear();
        inbox.lock(|inbox| inbox.unsaved = !stored);
        if stored {
            defmt::info!("parameters stored");
        } else {
            defmt::error!("the flash does not take the parameters");
        }
    });
}
