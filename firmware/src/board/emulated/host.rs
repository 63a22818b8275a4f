//! # Host: the frames of every period, the watchdog, and what a program comes to that has failed
//!
//! The watchdog counts exchanges and restarts the machine, as the chip's restarts the chip; what has to live over that
//! lies where the start does not clear it. A program that fails opens its bridges and goes on exchanging frames until then
//! ([`fail_safe`]).

use core::mem::MaybeUninit;

use cortex_m::peripheral::{NVIC, SCB};
use cortex_m_semihosting::{debug, nr::open, syscall};
use stm32f4xx_hal::pac;

use super::line::Line;
use crate::exchange::{Crash, DOWN_FILE, DownFrame, UP_FILE, UpFrame};

/// Periods after which an unfed watchdog fires: 20 ms.
const WATCHDOG_PERIODS: u32 = 400;

static PERIODS_UNFED: Line<u32> = Line::new(0);
/// The host, once its files are open.
static HOST: Line<Option<Host>> = Line::new(None);
/// What lives over a restart.
#[unsafe(link_section = ".uninit.KEPT")]
static KEPT: Line<MaybeUninit<Kept>> = Line::new(MaybeUninit::uninit());

/// What [`Kept`] is marked with.
const MARK: u32 = 0x00D0_6B17;

/// What lives over a restart: nothing, unless it is marked.
#[derive(Clone, Copy)]
#[repr(C)]
struct Kept {
    mark: u32,
    /// The next period
    period: u32,
}

/// The files of the host, and the periods that it has been told of.
#[derive(Clone, Copy)]
struct Host {
    up: usize,
    down: usize,
    period: u32,
}

/// Opens the files of the host; true if it was the watchdog that restarted the machine.
pub fn connect() -> bool {
    let kept = take_kept();
    let (up, down) = (open(UP_FILE, open::W_TRUNC_BINARY), open(DOWN_FILE, open::R_BINARY));
    HOST.with(|host| *host = Some(Host { up, down, period: kept.unwrap_or(0) }));
    kept.is_some()
}

/// The next period that the program before a restart has left, once.
fn take_kept() -> Option<u32> {
    KEPT.with(|kept| {
        // SAFETY: any bits are two numbers, and the memory is this static's; a read that the compiler must not leave out
        // finds what was written before the restart, or whatever the memory began with.
        let was = unsafe { kept.as_ptr().read_volatile() };
        kept.write(Kept { mark: 0, period: 0 });
        (was.mark == MARK).then_some(was.period)
    })
}

/// The watchdog fires: the machine starts anew.
fn restart(period: u32) -> ! {
    KEPT.with(|kept| {
        // SAFETY: the memory is this static's; a write that the compiler must not leave out.
        unsafe { kept.as_mut_ptr().write_volatile(Kept { mark: MARK, period }) }
    });
    SCB::sys_reset()
}

/// Opens all bridges and waits for the watchdog's restart, telling the host of every period.
pub extern "C" fn fail_safe() -> ! {
    cortex_m::interrupt::disable();
    loop {
        let watchdog_fired = is_unfed();
        exchange(&UpFrame { fail_safe: true, watchdog_fired, ..UpFrame::default() });
    }
}

/// The watchdog is fed.
pub fn feed() {
    PERIODS_UNFED.with(|unfed| *unfed = 0);
}

/// One more period without food; true if the watchdog fires.
pub fn is_unfed() -> bool {
    PERIODS_UNFED.with(|unfed| {
        *unfed = unfed.saturating_add(1);
        *unfed > WATCHDOG_PERIODS
    })
}

/// Tells the host what is asked of the period that begins, and hears what is measured in it; ends the emulator where the
/// host wants it or is not there, and starts it anew where the watchdog has fired.
pub fn exchange(frame: &UpFrame) -> DownFrame {
    let told = HOST.with(|host| host.as_mut().and_then(|host| Some((host.exchange(frame)?, host.period))));
    let Some((down, period)) = told else { end(debug::EXIT_FAILURE) };
    if down.end {
        end(debug::EXIT_SUCCESS);
    }
    if frame.watchdog_fired {
        restart(period);
    }
    down
}

/// Ends the emulator.
fn end(how: debug::ExitStatus) -> ! {
    loop {
        debug::exit(how);
    }
}

impl Host {
    /// One period; nothing where a file is not what it should be.
    fn exchange(&mut self, frame: &UpFrame) -> Option<DownFrame> {
        let sent = UpFrame { period: self.period, ..*frame }.to_bytes();
        let mut got = [0_u8; DownFrame::LEN];
        // SAFETY: semihosting reads and writes the lengths given, of buffers that live over the calls.
        let left = unsafe {
            syscall!(WRITE, self.up, sent.as_ptr(), sent.len()) + syscall!(READ, self.down, got.as_mut_ptr(), got.len())
        };
        self.period = self.period.wrapping_add(1);
        (left == 0).then(|| DownFrame::from_bytes(&got))
    }
}

/// Fails as the host wants it.
#[inline(never)]
pub fn fail_by(crash: Crash) {
    match crash {
        Crash::Panic => panic!("the host wants it"),
        Crash::HardFault => cortex_m::asm::udf(),
        // SAFETY: a stack pointer that leads nowhere, and then what is no instruction: that is wanted.
        Crash::Stack => unsafe { core::arch::asm!("mov sp, {}", "udf #0", in(reg) 0, options(noreturn)) },
        Crash::UnknownInterrupt => {
            // SAFETY: nothing is bound to this interrupt, and that is wanted.
            unsafe { NVIC::unmask(pac::Interrupt::SPI1) };
            NVIC::pend(pac::Interrupt::SPI1);
        }
        // SAFETY: NMIPENDSET, which does what the clock security system does (ARMv7-M, ICSR).
        Crash::NonMaskable => unsafe { (*SCB::PTR).icsr.write(1 << 31) },
    }
}

/// Opens a file of the host; ends the emulator where there is none.
fn open(name: &str, mode: usize) -> usize {
    let mut path = [0_u8; 16];
    path[..name.len()].copy_from_slice(name.as_bytes());
    // SAFETY: semihosting reads `len` bytes of `path`, which ends with a zero and lives over the call.
    let handle = unsafe { syscall!(OPEN, path.as_ptr(), mode, name.len()) };
    if handle == usize::MAX {
        end(debug::EXIT_FAILURE);
    }
    handle
}
