//! # Emulated: the same verbs on QEMU's `netduinoplus2`
//!
//! That machine has the core, SysTick and the interrupt controller of an STM32F405, but no converters, timers with PWM
//! or pins that one could use. Here SysTick is the PWM period, its handler raises the converters' interrupt, and
//! [`Bridges::read`] exchanges one frame with the host ([`crate::exchange`]), which has the motors.
//!
//! An instruction takes one nanosecond there (`-icount shift=0`), six times as fast as the chip; [`cycles`] counts
//! instructions, in steps of six. Semihosting calls cost one instruction each.

use core::cell::UnsafeCell;
use core::hint::black_box;

use cortex_m::peripheral::{NVIC, SYST, syst::SystClkSource};
use cortex_m_rt::exception;
use cortex_m_semihosting::{debug, nr::open, syscall};
use defmt_semihosting as _;
use heapless::spsc::Queue;
use stm32f4xx_hal::pac;

use crate::codes::{Codes, MOTORS};
use crate::exchange::{DOWN_FILE, DownFrame, LINK_BYTES, LinkBytes, TOPS, UP_FILE, UpFrame, compare};

/// Processor cycles in one period of a chip that runs at 168 MHz.
pub const CYCLES_PER_PERIOD: u32 = 8_400;

/// What SysTick counts in one period.
const SYSTICK_PER_PERIOD: u32 = 8_400;

/// Periods after which an unfed watchdog fires: 20 ms.
const WATCHDOG_PERIODS: u32 = 400;

/// Bytes on their way out and in; the task of the link is the one end, the exchange the other.
static SERIAL: Line = Line(UnsafeCell::new(Buffers { out: Queue::new(), inward: Queue::new() }));
static PERIODS_UNFED: Line<u32> = Line(UnsafeCell::new(0));
static BURN: Line<u16> = Line(UnsafeCell::new(0));

struct Buffers {
    out: Queue<u8, 1024>,
    inward: Queue<u8, 1024>,
}

struct Line<T = Buffers>(UnsafeCell<T>);

// SAFETY: one core, and every use goes through `with`, which masks all interrupts.
unsafe impl<T> Sync for Line<T> {}

impl<T> Line<T> {
    fn with<R>(&self, f: impl FnOnce(&mut T) -> R) -> R {
        // SAFETY: interrupts are masked, so no other task runs, and `f` cannot come here again with the same line.
        cortex_m::interrupt::free(|_| f(unsafe { &mut *self.0.get() }))
    }
}

/// Everything on the board, asleep.
pub struct Parts {
    /// Bridges, converters and halls
    pub bridges: Bridges,
    /// The link
    pub serial: SerialLink,
    /// The watchdog
    pub watchdog: Watchdog,
    /// Where the parameter block is stored
    pub flash_store: FlashStore,
}

/// The bridges of all motors, with what is measured there.
pub struct Bridges {
    syst: SYST,
    up: usize,
    down: usize,
    next: UpFrame,
    began: u32,
}

/// The link to the host.
pub struct SerialLink(());

/// The watchdog: when it fires, all bridges open for good.
pub struct Watchdog(());

/// Where the parameter block is stored: memory, which a reset of the emulator forgets.
pub struct FlashStore(());

/// Takes the board, everything asleep.
pub fn take(core: cortex_m::Peripherals, _device: pac::Peripherals) -> Parts {
    let bridges = Bridges {
        syst: core.SYST,
        up: open(UP_FILE, open::W_TRUNC_BINARY),
        down: open(DOWN_FILE, open::R_BINARY),
        next: UpFrame::default(),
        began: 0,
    };
    Parts { bridges, serial: SerialLink(()), watchdog: Watchdog(()), flash_store: FlashStore(()) }
}

/// Opens a file of the host; ends the emulator where there is none.
fn open(name: &str, mode: usize) -> usize {
    let mut path = [0_u8; 16];
    path[..name.len()].copy_from_slice(name.as_bytes());
    // SAFETY: semihosting reads `len` bytes of `path`, which ends with a zero and lives over the call.
    let handle = unsafe { syscall!(OPEN, path.as_ptr(), mode, name.len()) };
    if handle == usize::MAX {
        debug::exit(debug::EXIT_FAILURE);
    }
    handle
}

impl Bridges {
    /// Lets the periods begin; the bridges stay open until they are driven.
    pub fn start(&mut self) {
        self.syst.set_clock_source(SystClkSource::Core);
        self.syst.set_reload(SYSTICK_PER_PERIOD - 1);
        self.syst.clear_current();
        self.syst.enable_counter();
        self.syst.enable_interrupt();
    }

    /// What was measured in this period. Called once a period, first of all.
    pub fn read(&mut self) -> Codes {
        let unfed = PERIODS_UNFED.with(|unfed| {
            *unfed = unfed.saturating_add(1);
            *unfed
        });
        if unfed > WATCHDOG_PERIODS {
            self.next.watchdog_fired = true;
        }
        if self.next.watchdog_fired {
            self.next.enabled = 0;
        }
        let mut out = [0; LINK_BYTES];
        let count = SERIAL.with(|serial| take_from(&mut serial.out, &mut out));
        self.next.link = LinkBytes::of(&out[..count]);

        let sent = self.next.to_bytes();
        let mut got = [0_u8; DownFrame::LEN];
        // SAFETY: semihosting reads and writes the lengths given, of buffers that live over the calls.
        let left = unsafe {
            syscall!(WRITE, self.up, sent.as_ptr(), sent.len()) + syscall!(READ, self.down, got.as_mut_ptr(), got.len())
        };
        let down = DownFrame::from_bytes(&got);
        if left != 0 || down.end {
            debug::exit(if left == 0 { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
        }
        self.began = cycles();
        self.next.period = self.next.period.wrapping_add(1);
        SERIAL.with(|serial| {
            for byte in down.link.as_slice() {
                let _full = serial.inward.enqueue(*byte);
            }
        });
        BURN.with(|burn| *burn = (*burn).max(down.burn_motion));
        idle(down.burn_current);
        down.codes
    }

    /// Drives the next period: duties of the three phases of every motor [1], and a bit for each motor that is enabled.
    pub fn drive(&mut self, duties: &[[f32; 3]; MOTORS], enabled: u8) {
        for ((counts, duties), top) in self.next.compare.iter_mut().zip(duties).zip(TOPS) {
            for (count, duty) in counts.iter_mut().zip(duties) {
                *count = compare(*duty, top);
            }
        }
        self.next.enabled = enabled;
        self.next.cycles = self.spent() as u16;
    }

    /// Processor cycles since the codes of this period were there.
    pub fn spent(&self) -> u32 {
        cycles().saturating_sub(self.began)
    }

    /// True if the next period has begun before this turn was over.
    pub fn is_late(&self) -> bool {
        NVIC::is_pending(pac::Interrupt::ADC)
    }
}

impl SerialLink {
    /// Hands bytes to the link; how many it had room for.
    pub fn send(&mut self, bytes: &[u8]) -> usize {
        SERIAL.with(|serial| bytes.iter().take_while(|byte| serial.out.enqueue(**byte).is_ok()).count())
    }

    /// Takes the bytes that have come; how many.
    pub fn receive(&mut self, into: &mut [u8]) -> usize {
        SERIAL.with(|serial| take_from(&mut serial.inward, into))
    }
}

/// Moves as many bytes as wait and have room; how many.
fn take_from(queue: &mut Queue<u8, 1024>, into: &mut [u8]) -> usize {
    let mut count = 0;
    for slot in into {
        let Some(byte) = queue.dequeue() else { break };
        *slot = byte;
        count += 1;
    }
    count
}

impl Watchdog {
    /// Feeds the watchdog.
    pub fn feed(&mut self) {
        PERIODS_UNFED.with(|unfed| *unfed = 0);
    }
}

impl FlashStore {
    /// The stored block; empty here, because the emulator starts from nothing.
    pub fn load(&self) -> &'static [u8] {
        &[]
    }

    /// Stores a block; true if it is stored.
    pub fn save(&mut self, _block: &[u8]) -> bool {
        true
    }
}

/// Processor cycles since the beginning of the period, an instruction counted as one.
#[inline]
pub fn cycles() -> u32 {
    // SysTick counts down
    instructions(SYSTICK_PER_PERIOD - 1 - SYST::get_current())
}

/// An instruction takes a nanosecond here, in which SysTick counts 0.168.
#[inline]
fn instructions(counts: u32) -> u32 {
    counts * 1000 / 168
}

/// Writes text on the host's standard output.
pub fn say(text: core::fmt::Arguments<'_>) {
    cortex_m_semihosting::hprint!("{}", text);
}

/// Ends the emulator, all well.
pub fn end() -> ! {
    loop {
        debug::exit(debug::EXIT_SUCCESS);
    }
}

/// Says why and ends the emulator as a failure.
pub fn fail(why: core::fmt::Arguments<'_>) -> ! {
    say(why);
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}

/// Counts instructions by SysTick, 0.168 of whose counts are one: many calls are counted and divided.
pub struct Stopwatch(());

impl Stopwatch {
    /// Calls of what is counted: the counter's 24 bits are enough for 9,000 instructions each.
    const CALLS: u32 = 10_000;

    /// Takes SysTick for it; the periods do not begin then.
    pub fn take() -> Self {
        if let Some(core) = cortex_m::Peripherals::take() {
            let mut syst = core.SYST;
            syst.set_clock_source(SystClkSource::Core);
            syst.set_reload(0x00ff_ffff);
            syst.clear_current();
            syst.enable_counter();
        }
        Self(())
    }

    /// Instructions of one call, those of making what it works on and of the loop taken off.
    pub fn cost<A, R>(&mut self, mut make: impl FnMut() -> A, mut call: impl FnMut(&mut A) -> R) -> u32 {
        let made = Self::counts(|| {
            let mut given = make();
            black_box(&mut given);
        });
        let called = Self::counts(|| {
            let mut given = make();
            black_box(&mut given);
            let result = call(&mut given);
            black_box(&result);
        });
        let counts = u64::from(called.saturating_sub(made));
        // rounded to the nearest instruction
        ((counts * 1000 / 168 + u64::from(Self::CALLS) / 2) / u64::from(Self::CALLS)) as u32
    }

    fn counts(mut call: impl FnMut()) -> u32 {
        let began = SYST::get_current();
        for k in 0..Self::CALLS {
            black_box(k);
            call();
        }
        began.wrapping_sub(SYST::get_current()) & 0x00ff_ffff
    }
}

/// Idle instructions that the host asked for, to make the motion turn late; none on a board.
pub fn burn_motion() {
    idle(BURN.with(core::mem::take));
}

fn idle(turns: u16) {
    for _ in 0..u32::from(turns) * 64 {
        cortex_m::asm::nop();
    }
}

#[exception]
fn SysTick() {
    NVIC::pend(pac::Interrupt::ADC);
}
