//! The robot's controller: what runs, how urgent it is, and what it holds.
//!
//! | task | priority | when | what |
//! |---|---|---|---|
//! | `current` | 4 | the converters are done, 20 kHz | codes → duties of all motors |
//! | `motion` | 3 | every 20th of these, 1 kHz | command → currents and voltages, one record |
//! | `listen` | 2 | after each motion turn | bytes → commands, parameter blocks |
//! | `record` | 1 | after each motion turn | records → bytes |
//! | `idle` | 0 | otherwise | feeds the watchdog while the others keep their time |
//!
//! Interrupts that no pin uses stand for the software's own tasks: a hardware task is bound without the executor of
//! `async` ones, which links a panic.
#![no_std]
#![no_main]

mod tasks;

// a panic, which the control path cannot reach, ends in the watchdog's bite: the bridges open at the reset
use panic_halt as _;

#[rtic::app(device = firmware::board::pac, peripherals = true)]
mod app {
    use firmware::board::{Bridges, Dog, Wire};
    use firmware::drivers::roll::RollCall;
    use firmware::inbox::Inbox;
    use firmware::listener::Listener;
    use firmware::motion::Motion;
    use firmware::post::{Post, Room, Sender};
    use firmware::windings::Windings;

    use crate::tasks::load::Load;
    use crate::tasks::{current::current, idle::idle, listen::listen, motion::motion, record::record, start::init};

    #[shared]
    pub struct Shared {
        pub windings: Windings,
        pub inbox: Inbox,
        pub load: Load,
        pub wire: Wire,
        pub roll: RollCall,
    }

    #[local]
    pub struct Local {
        pub bridges: Bridges,
        pub motion_turn: Motion,
        pub listener: Listener,
        pub sender: Sender,
        pub post: Post,
        pub dog: Dog,
    }

    extern "Rust" {
        #[init(local = [room: Room = Room::new()])]
        fn init(_: init::Context) -> (Shared, Local);

        #[task(binds = ADC, priority = 4, local = [bridges], shared = [windings, load, &roll])]
        fn current(_: current::Context);

        #[task(binds = EXTI0, priority = 3, local = [motion_turn, sender], shared = [windings, inbox, load, &roll])]
        fn motion(_: motion::Context);

        #[task(binds = EXTI1, priority = 2, local = [listener], shared = [inbox, wire, &roll])]
        fn listen(_: listen::Context);

        #[task(binds = EXTI2, priority = 1, local = [post], shared = [wire, &roll])]
        fn record(_: record::Context);

        #[idle(local = [dog], shared = [&roll])]
        fn idle(_: idle::Context) -> !;
    }
}
