//! # Handlers: where a program that has failed ends
//!
//! | what | comes here when |
//! |---|---|
//! | hard fault | an instruction or an access is not possible; all other faults of the core escalate to it |
//! | non-maskable interrupt | the clock security system has seen the crystal stop |
//! | any other | an exception or interrupt comes that nothing is bound to |
//!
//! All of them, and a panic (`main.rs`), go to the board's `fail_safe`, which opens the bridges and waits for the
//! watchdog. Nothing of the program is needed on the way: the stack begins anew at its top, because a stack pointer that
//! leads nowhere may be what has failed. A test walks through the linked image from each entry to the last enable that
//! goes low.

use core::arch::naked_asm;

use super::fail_safe;

macro_rules! fails {
    ($($handler:ident),*) => {$(
        // SAFETY: the vector table's name for it; entered by the core alone, and it never returns.
        #[unsafe(naked)]
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $handler() -> ! {
            naked_asm!(
                "cpsid i",
                "movw r0, #:lower16:_stack_start",
                "movt r0, #:upper16:_stack_start",
                "mov sp, r0",
                "b {fail_safe}",
                fail_safe = sym fail_safe,
            )
        }
    )*};
}

fails!(HardFault, NonMaskableInt, DefaultHandler);
