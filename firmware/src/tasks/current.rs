//! The turn of the windings: read, decide, drive.

use firmware::board::{self, pac::Interrupt};
use firmware::drivers::roll::Task;
use model_core::link::faults::Fault;
use rtic::Mutex;

use crate::app;

/// One period, 50 µs.
pub fn current(mut cx: app::current::Context<'_>) {
    let entered = board::cycles();
    let bridges = cx.local.bridges;
    let codes = bridges.read();
    let (drive, begins_motion) = cx.shared.windings.lock(|windings| {
        let drive = windings.turn(&codes);
        (drive, windings.begins_motion())
    });
    bridges.drive(&drive.duties, drive.enabled);

    let spent = bridges.spent();
    let late = bridges.is_late();
    let overrun = cx.shared.load.lock(|load| load.current(entered, spent, begins_motion)) || late;
    if overrun {
        cx.shared.windings.lock(|windings| windings.latch(Fault::TurnOverrun));
        bridges.drive(&drive.duties, 0);
    }
    if begins_motion {
        rtic::pend(Interrupt::EXTI0);
    }
    cx.shared.roll.here(Task::Current);
}
