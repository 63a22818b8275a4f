//! The robot's controller: what runs, how urgent it is, and what it holds.
//!
//! | task | priority | when | what |
//! |---|---|---|---|
//! | `current` | 4 | the converters are done, 20 kHz | codes → duties of all motors |
//! | `motion` | 3 | every 20th of these, 1 kHz | command → currents and voltages, one record |
//! | `sense` | 2 | eight periods before a motion turn | gyro and encoders, those that are fitted |
//! | `listen` | 2 | after each motion turn | bytes → commands, parameter blocks |
//! | `record` | 1 | after each motion turn | records → bytes |
//! | `idle` | 0 | otherwise | feeds the watchdog while the others keep their time; stores a new block while nothing is driven |
//!
//! Interrupts that no pin uses stand for the software's own tasks: a hardware task is bound without the executor of
//! `async` ones, which links a panic.
#![no_std]
#![no_main]

mod tasks;

/// A panic, which the control path cannot reach, opens the bridges; the watchdog then restarts the chip.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    firmware::board::fail_safe()
}

#[rtic::app(device = firmware::board::pac, peripherals = true)]
mod app {
    use firmware::board::{Bridges, FlashStore, MotionSensors, SerialLink, Watchdog};
    use firmware::command_receiver::CommandReceiver;
    use firmware::drivers::heartbeat::Heartbeats;
    use firmware::inbox::Inbox;
    use firmware::motion::Motion;
    use firmware::sensing::Sensing;
    use firmware::to_store::BlockToStore;
    use firmware::tx_queue::{TxConsumer, TxProducer, TxStorage};
    use firmware::windings::Windings;

    use crate::tasks::event_log::{EventLog, Report};
    use crate::tasks::load::Load;
    use crate::tasks::{
        current::current, idle::idle, listen::listen, motion::motion, record::record, sense::sense, start::init,
    };

    #[shared]
    pub struct Shared {
        pub windings: Windings,
        pub inbox: Inbox,
        pub load: Load,
        pub serial: SerialLink,
        pub sensing: Sensing,
        pub to_store: BlockToStore,
        pub report: Report,
        pub heartbeats: Heartbeats,
    }

    #[local]
    pub struct Local {
        pub bridges: Bridges,
        pub motion_control: Motion,
        pub event_log: EventLog,
        pub receiver: CommandReceiver,
        pub tx_producer: TxProducer,
        pub tx_consumer: TxConsumer,
        pub watchdog: Watchdog,
        pub flash_store: FlashStore,
        pub sensors: MotionSensors,
    }

    extern "Rust" {
        #[init(local = [tx_storage: TxStorage = TxStorage::new()])]
        fn init(_: init::Context) -> (Shared, Local);

        #[task(binds = ADC, priority = 4, local = [bridges], shared = [windings, load, &heartbeats])]
        fn current(_: current::Context);

        #[task(binds = EXTI0, priority = 3, local = [motion_control, tx_producer], shared = [windings, inbox, load, sensing, report, &heartbeats])]
        fn motion(_: motion::Context);

        #[task(binds = EXTI3, priority = 2, local = [sensors], shared = [sensing])]
        fn sense(_: sense::Context);

        #[task(binds = EXTI1, priority = 2, local = [receiver], shared = [inbox, serial, to_store, &heartbeats])]
        fn listen(_: listen::Context);

        #[task(binds = EXTI2, priority = 1, local = [tx_consumer], shared = [serial, &heartbeats])]
        fn record(_: record::Context);

        #[idle(local = [watchdog, flash_store, event_log], shared = [windings, inbox, to_store, report, &heartbeats])]
        fn idle(_: idle::Context) -> !;
    }
}
