//! The turn of the motion: what was told, what to do, one record.

use firmware::board;
use firmware::drivers::heartbeat::Task;
use rtic::Mutex;

use crate::app;
use crate::tasks::event_log::Report;

/// One turn, 1 ms.
pub fn motion(mut cx: app::motion::Context<'_>) {
    let mut feedback = cx.shared.windings.lock(|windings| windings.feedback());
    let fitted = cx.local.motion_control.fitted();
    (feedback.sensors, feedback.silent_sensors) = cx.shared.sensing.lock(|sensing| sensing.take(fitted));
    let output = cx.shared.inbox.lock(|inbox| cx.local.motion_control.tick(&feedback, inbox));
    cx.shared.windings.lock(|windings| windings.apply(&output));
    board::burn_motion();

    let load = cx.shared.load.lock(|load| load.motion());
    cx.local.tx_producer.enqueue_tick(&feedback, &output, load);
    let report = Report {
        state: output.state,
        faults: output.all_faults(&feedback),
        events: output.events,
        silent_sensors: feedback.silent_sensors,
    };
    cx.shared.report.lock(|last| *last = report);
    cx.shared.heartbeats.beat(Task::Motion);
    rtic::pend(board::pac::Interrupt::EXTI1);
    rtic::pend(board::pac::Interrupt::EXTI2);
}
