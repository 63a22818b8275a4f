//! # Emulated: the same verbs on QEMU's `netduinoplus2`
//!
//! That machine has the core, SysTick and the interrupt controller of an STM32F405, but no converters, timers with PWM
//! or pins that one could use. Here SysTick is the PWM period, its handler raises the converters' interrupt, and
//! [`Bridges::read`] exchanges one frame with the host ([`crate::exchange`]), which has the motors.
//!
//! An instruction takes one nanosecond there (`-icount shift=0`), six times as fast as the chip; [`cycles`] counts
//! instructions, in steps of six. What the chip's converters and DMA do takes no time of a period here: SysTick stands
//! still while a frame is exchanged.

use core::hint::black_box;

use cortex_m::peripheral::{NVIC, SYST, syst::SystClkSource};
use cortex_m_rt::exception;
use cortex_m_semihosting::debug;
use defmt_semihosting as _;
use heapless::spsc::Queue;
use model_core::link::sensor_codes::SensorCodes;
use stm32f4xx_hal::pac;

use crate::codes::{Codes, MOTORS};
use crate::drivers::sensors::FittedSensors;
use crate::exchange::{LINK_BYTES, LinkBytes, TOPS, UpFrame, compare};

mod host;
mod line;

pub use host::fail_safe;
use line::Line;

/// Processor cycles in one period of a chip that runs at 168 MHz.
pub const CYCLES_PER_PERIOD: u32 = 8_400;

/// What SysTick counts in one period.
const SYSTICK_PER_PERIOD: u32 = 8_400;

/// Bytes on their way out and in; the task of the link is the one end, the exchange the other.
static SERIAL: Line<Buffers> = Line::new(Buffers { out: Queue::new(), inward: Queue::new() });
static BURN: Line<u16> = Line::new(0);
/// What gyro and encoders say in this period.
static SENSORS: Line<Option<SensorCodes>> = Line::new(None);

struct Buffers {
    out: Queue<u8, 1024>,
    inward: Queue<u8, 1024>,
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
    /// Gyro and encoders
    pub sensors: MotionSensors,
}

/// The bridges of all motors, with what is measured there.
pub struct Bridges {
    syst: SYST,
    next: UpFrame,
    began: u32,
}

/// The link to the host.
pub struct SerialLink(());

/// The watchdog: when it fires, the machine starts anew.
pub struct Watchdog {
    restarted: bool,
}

/// Gyro and encoders.
pub struct MotionSensors(());

/// Where the parameter block is stored: memory, which a reset of the emulator forgets.
pub struct FlashStore(());

/// Takes the board, everything asleep.
pub fn take(core: cortex_m::Peripherals, _device: pac::Peripherals) -> Parts {
    let watchdog = Watchdog { restarted: host::connect() };
    let bridges = Bridges { syst: core.SYST, next: UpFrame::default(), began: 0 };
    Parts { bridges, serial: SerialLink(()), watchdog, flash_store: FlashStore(()), sensors: MotionSensors(()) }
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
        self.syst.disable_counter();
        if host::is_unfed() {
            (self.next.watchdog_fired, self.next.enabled) = (true, 0);
        }
        let mut out = [0; LINK_BYTES];
        let count = SERIAL.with(|serial| fill(&mut out, || serial.out.dequeue()));
        self.next.link = LinkBytes::of(&out[..count]);

        let down = host::exchange(&self.next);
        SERIAL.with(|serial| {
            for byte in down.link.as_slice() {
                let _full = serial.inward.enqueue(*byte);
            }
        });
        SENSORS.with(|sensors| *sensors = Some(down.sensors));
        self.syst.enable_counter();
        self.began = cycles();
        BURN.with(|burn| *burn = (*burn).max(down.burn_motion));
        idle(down.burn_current);
        if let Some(crash) = down.crash {
            host::fail_by(crash);
        }
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
    /// Hands bytes to the link; how many it had room for. Byte by byte: no period waits for all of them.
    pub fn send(&mut self, bytes: &[u8]) -> usize {
        bytes.iter().take_while(|byte| SERIAL.with(|serial| serial.out.enqueue(**byte).is_ok())).count()
    }

    /// Takes the bytes that have come; how many.
    pub fn receive(&mut self, into: &mut [u8]) -> usize {
        fill(into, || SERIAL.with(|serial| serial.inward.dequeue()))
    }
}

/// Takes as many bytes as come and have room; how many.
fn fill(into: &mut [u8], mut next: impl FnMut() -> Option<u8>) -> usize {
    let mut count = 0;
    for slot in into {
        let Some(byte) = next() else { break };
        *slot = byte;
        count += 1;
    }
    count
}

impl Watchdog {
    /// Feeds the watchdog.
    pub fn feed(&mut self) {
        host::feed();
    }

    /// True if it was the watchdog that restarted the machine.
    pub fn restarted(&self) -> bool {
        self.restarted
    }
}

impl MotionSensors {
    /// What those that are fitted say now.
    pub fn read(&mut self, fitted: FittedSensors) -> SensorCodes {
        fitted.only(&SENSORS.with(|sensors| *sensors).unwrap_or_default())
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

/// Lets the turns come, at first or after the core stood still. Here they come by themselves.
pub fn resume_turns() {}

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
    /// Calls of what is counted: the counter's 24 bits are enough for 90,000 instructions each.
    const CALLS: u32 = 1_000;

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
