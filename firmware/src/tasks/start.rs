//! Everything asleep, then the first period.

use firmware::board;
use firmware::command_receiver::CommandReceiver;
use firmware::drivers::heartbeat::Heartbeats;
use firmware::inbox::Inbox;
use firmware::motion::Motion;
use firmware::sensing::Sensing;
use firmware::to_store::BlockToStore;
use firmware::tx_queue;
use firmware::windings::Windings;
use model_core::link::faults::Fault;

use crate::app;
use crate::tasks::event_log::{EventLog, Report};
use crate::tasks::load::Load;

/// Takes the board, reads the parameters that were kept, and lets the periods begin.
pub fn init(cx: app::init::Context<'_>) -> (app::Shared, app::Local) {
    let board::Parts { mut bridges, serial, watchdog, flash_store, sensors } = board::take(cx.core, cx.device);
    let (tx_producer, tx_consumer) = tx_queue::split(cx.local.tx_storage);
    let mut receiver = CommandReceiver::default();
    let mut inbox = Inbox::default();
    let stored = flash_store.load();
    if let Some(command) = receiver.restore(stored) {
        inbox.put(command);
    }
    defmt::info!("asleep; bridges open, {} bytes of parameters kept", stored.len());
    let mut windings = Windings::default();
    if watchdog.restarted() {
        windings.latch(Fault::Watchdog);
    }
    bridges.start();
    (
        app::Shared {
            windings,
            inbox,
            load: Load::default(),
            serial,
            sensing: Sensing::default(),
            to_store: BlockToStore::default(),
            report: Report::default(),
            heartbeats: Heartbeats::new(),
        },
        app::Local {
            bridges,
            motion_control: Motion::default(),
            event_log: EventLog::default(),
            receiver,
            tx_producer,
            tx_consumer,
            watchdog,
            flash_store,
            sensors,
        },
    )
}
