//! The turn of the motion: what was told, what to do, one record.

use firmware::board;
use firmware::drivers::roll::Task;
use rtic::Mutex;

use crate::app;

/// One turn, 1 ms.
pub fn motion(mut cx: app::motion::Context<'_>) {
    let told = cx.shared.windings.lock(|windings| windings.told());
    let turn = cx.shared.inbox.lock(|inbox| cx.local.motion_turn.turn(&told, inbox));
    cx.shared.windings.lock(|windings| windings.take(&turn));
    board::burn_motion();

    let load = cx.shared.load.lock(|load| load.motion());
    cx.local.sender.turn(&told, &turn, load);
    cx.shared.roll.here(Task::Motion);
    rtic::pend(board::pac::Interrupt::EXTI1);
    rtic::pend(board::pac::Interrupt::EXTI2);
}
