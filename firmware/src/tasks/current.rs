//! The turn of the windings: read, decide, drive.

use firmware::board::{self, pac::Interrupt};
use firmware::drivers::heartbeat::Task;
use model_core::link::faults::Fault;
use rtic::Mutex;

use crate::app;

/// One period, 50 µs.
pub fn current(mut cx: app::current::Context<'_>) {
    let entered = board::cycles();
    let bridges = cx.local.bridges;
    let codes = bridges.read();
    let (command, motion_due, sensors_due) = cx.shared.windings.lock(|windings| {
        let command = windings.tick(&codes);
        (command, windings.motion_is_due(), windings.sensors_are_due())
    });
    bridges.drive(&command.duties, command.enabled);

    let spent = bridges.spent();
    let late = bridges.is_late();
    let overrun = cx.shared.load.lock(|load| load.current(entered, spent, motion_due)) || late;
    if overrun {
        cx.shared.windings.lock(|windings| windings.latch(Fault::TurnOverrun));
        bridges.drive(&command.duties, 0);
    }
    if motion_due {
        rtic::pend(Interrupt::EXTI0);
    }
    if sensors_due {
        rtic::pend(Interrupt::EXTI3);
    }
    cx.shared.heartbeats.beat(Task::Current);
}
