//! # Bridges: PWM, currents, supply, halls and the fault line of all motors

use core::convert::Infallible;
use core::sync::atomic::{AtomicBool, AtomicU8, AtomicU16, Ordering, compiler_fence};

use cortex_m::peripheral::NVIC;
use embedded_hal::pwm::{ErrorType, SetDutyCycle};
use model_core::control::calibration::AdcCode;
use stm32f4xx_hal::gpio::{Input, Output, PA11, PA12, PA15, PB9, PB10, PB11, PB12, PB13, PB14, PB15};
use stm32f4xx_hal::gpio::{PC9, PC12, PC13, PD0, PD1, PD2, PD3};
use stm32f4xx_hal::pac::{self, Interrupt, adc1, interrupt};

use super::typed::{Get, Put};
use crate::codes::{Codes, MOTORS};
use crate::drivers::fault::FaultLine;
use crate::drivers::gate::GateDriver;
use crate::drivers::halls::HallLines;
use crate::registers::words::Word;
use crate::registers::{adc, timers, timing};

/// Compare counts that wait for the latch.
static PENDING: [[AtomicU16; 3]; MOTORS] = [const { [const { AtomicU16::new(0) }; 3] }; MOTORS];
/// They are those of one turn, all of them.
static WHOLE: AtomicBool = AtomicBool::new(false);
/// The motors whose bridges are not open, a bit each.
static CLOSED: AtomicU8 = AtomicU8::new(0);

/// True while any bridge is not open.
pub fn any_closed() -> bool {
    CLOSED.load(Ordering::Relaxed) != 0
}

/// Lets the turns come, at first or after the core stood still: what the converters ended until now is nobody's, the next turn
/// comes with the next group, at its time.
pub fn resume_turns() {
    // SAFETY: one store to a flag register, which clears those of the injected group.
    unsafe { (*pac::ADC1::PTR).sr().put(adc::SR_SEEN) };
    NVIC::unpend(Interrupt::ADC);
    // SAFETY: the program has bound its turn to this interrupt, and calls this outside of all critical sections but one that
    // masks every interrupt.
    unsafe { NVIC::unmask(Interrupt::ADC) };
}

/// The compare counts that the last turn asked for.
pub fn requested_counts() -> [[u16; 3]; MOTORS] {
    PENDING.each_ref().map(|motor| motor.each_ref().map(|count| count.load(Ordering::Relaxed)))
}

/// One phase's PWM, as the latch will set it.
#[derive(Debug)]
pub struct Phase {
    count: &'static AtomicU16,
    top: u16,
}

impl Phase {
    /// The phases of a motor.
    pub fn all<const MOTOR: usize>() -> [Self; 3] {
        PENDING[MOTOR].each_ref().map(|count| Self { count, top: timing::TOPS[MOTOR] })
    }
}

impl ErrorType for Phase {
    type Error = Infallible;
}

impl SetDutyCycle for Phase {
    #[inline]
    fn max_duty_cycle(&self) -> u16 {
        self.top
    }

    #[inline]
    fn set_duty_cycle(&mut self, count: u16) -> Result<(), Infallible> {
        self.count.store(count, Ordering::Relaxed);
        Ok(())
    }
}

type Gate<E> = GateDriver<Phase, Phase, Phase, E>;

/// The gate drivers, each with its own enable.
pub struct Gates {
    pub(super) first: Gate<PB10<Output>>,
    pub(super) second: Gate<PB11<Output>>,
    pub(super) third: Gate<PA11<Output>>,
    pub(super) fourth: Gate<PA12<Output>>,
}

/// The hall lines.
pub struct AllHalls {
    pub(super) first: HallLines<PD0<Input>, PD1<Input>, PD3<Input>>,
    pub(super) second: HallLines<PB9<Input>, PC9<Input>, PC12<Input>>,
    pub(super) third: HallLines<PB12<Input>, PB13<Input>, PB14<Input>>,
    pub(super) fourth: HallLines<PB15<Input>, PD2<Input>, PA15<Input>>,
}

/// The bridges of all motors, with what is measured there.
pub struct Bridges {
    pub(super) gates: Gates,
    pub(super) halls: AllHalls,
    pub(super) fault: FaultLine<PC13<Input>>,
    pub(super) converters: (pac::ADC1, pac::ADC2, pac::ADC3),
    pub(super) timers: (pac::TIM1, pac::TIM8, pac::TIM3, pac::TIM4),
    pub(super) bus: AdcCode,
}

impl Bridges {
    /// Lets the periods begin; the bridges stay open until they are driven, and no turn comes before [`resume_turns`].
    pub fn start(&mut self) {
        NVIC::mask(Interrupt::ADC);
        let (first, ..) = &self.converters;
        // the supply is known before the first period; 4.6 µs, and the loop ends without a converter too
        convert(first, adc::CR2_ASLEEP);
        for _ in 0..1_000 {
            if first.sr().get().has(adc::EOC) {
                break;
            }
        }
        self.bus = result(first);

        let (tim1, tim8, tim3, tim4) = &self.timers;
        first.sr().put(adc::SR_SEEN);
        first.cr2().put(adc::CR2_TRIGGERED);
        // counts are written while the counters stand, as centre-aligned timers ask for
        tim1.cnt().write(|w| w.cnt().set(timing::START[0]));
        tim8.cnt().write(|w| w.cnt().set(timing::START[1]));
        tim3.cnt().write(|w| w.cnt().set(timing::START[2]));
        tim4.cnt().write(|w| w.cnt().set(timing::START[3]));
        tim8.sr().put(timers::SR_LATCHED);
        tim8.dier().put(timers::DIER_TIM8);
        // all compare counts are zero: the outputs go from low to low
        tim1.bdtr().put(timers::BDTR_STARTED);
        tim8.bdtr().put(timers::BDTR_STARTED);
        // SAFETY: the handler of this interrupt is below, shares nothing but atomics, and masks no critical
        // section.
        unsafe { NVIC::unmask(Interrupt::TIM8_CC) };
        // TIM1 begins, and its first trigger begins the others
        tim1.cr1().put(timers::CR1_RUNS);
    }

    /// What was measured in this period. Called once a period, first of all.
    #[inline]
    pub fn read(&mut self) -> Codes {
        let (first, second, third) = &self.converters;
        let status = first.sr().get();
        first.sr().put(adc::SR_SEEN);
        if status.has(adc::EOC) {
            self.bus = result(first);
        }
        let [a, b, c] = [group(first), group(second), group(third)];
        let ([a0, a1, a2, a3], [b0, b1, b2, b3], [c0, c1, c2, c3]) = (a, b, c);
        convert(first, adc::CR2_TRIGGERED);
        let halls = &mut self.halls;
        Codes {
            phases: [[a0, b0, c0], [a1, b1, c1], [a2, b2, c2], [a3, b3, c3]],
            bus: self.bus,
            halls: [halls.first.code(), halls.second.code(), halls.third.code(), halls.fourth.code()],
            driver_fault: self.fault.is_pulled(),
        }
    }

    /// Drives the next period: duties of the three phases of every motor [1], and a bit for each motor that is enabled.
    /// Bridges open at once; duties are in force from the next top.
    #[inline]
    pub fn drive(&mut self, duties: &[[f32; 3]; MOTORS], enabled: u8) {
        CLOSED.store(enabled, Ordering::Relaxed);
        WHOLE.store(false, Ordering::Relaxed);
        // the latch runs on this core: what it must not see out of order, the compiler must not reorder
        compiler_fence(Ordering::SeqCst);
        let [first, second, third, fourth] = duties;
        apply(&mut self.gates.first, first, enabled & 1 != 0);
        apply(&mut self.gates.second, second, enabled & 2 != 0);
        apply(&mut self.gates.third, third, enabled & 4 != 0);
        apply(&mut self.gates.fourth, fourth, enabled & 8 != 0);
        compiler_fence(Ordering::SeqCst);
        WHOLE.store(true, Ordering::Relaxed);
    }

    /// Processor cycles since the codes of this period were there.
    #[inline]
    pub fn spent(&self) -> u32 {
        (super::cycles() + timing::PERIOD - timing::TOP_TO_END) % timing::PERIOD
    }

    /// True if this turn was not over when the latch came: its duties are a period late.
    #[inline]
    pub fn is_late(&self) -> bool {
        self.spent() > timing::TURN || NVIC::is_pending(Interrupt::ADC)
    }
}

/// Drives a gate driver, or opens it and prepares its counts. The pins and channels of this chip cannot fail.
#[inline]
fn apply<E: embedded_hal::digital::OutputPin>(gate: &mut Gate<E>, duties: &[f32; 3], enabled: bool) {
    let _never = if enabled { gate.drive(*duties) } else { gate.open().and_then(|()| gate.set(*duties)) };
}

/// The four ranks of a converter.
#[inline]
fn group(converter: &adc1::RegisterBlock) -> [AdcCode; MOTORS] {
    [converter.jdr1(), converter.jdr2(), converter.jdr3(), converter.jdr4()]
        .map(|rank| AdcCode(rank.read().bits() as u16))
}

/// The result of the regular conversion.
#[inline]
fn result(converter: &adc1::RegisterBlock) -> AdcCode {
    AdcCode(converter.dr().read().bits() as u16)
}

/// Starts the regular conversion of a converter that is otherwise set to `cr2`.
#[inline]
fn convert(converter: &adc1::RegisterBlock, cr2: Word<adc::Cr2>) {
    // hardware clears what is added
    converter.cr2().put(cr2 | adc::CR2_CONVERT);
}

/// Copies the counts of a motor into its timer's compare registers; the timers are of two types.
macro_rules! latch {
    ($timer:ident, $counts:ident) => {
        let [a, b, c] = $counts;
        $timer.ccr1().write(|w| w.ccr().set(a.load(Ordering::Relaxed)));
        $timer.ccr2().write(|w| w.ccr().set(b.load(Ordering::Relaxed)));
        $timer.ccr3().write(|w| w.ccr().set(c.load(Ordering::Relaxed)));
    };
}

/// The latch: shortly before the tops, the counts of the last whole turn go into the compare registers.
#[interrupt]
fn TIM8_CC() {
    // SAFETY: `take` has handed the timers to `Bridges`, which after `start` never writes a compare or status register,
    // so that this handler is the only one to do so.
    let (tim1, tim8, tim3, tim4) = unsafe { (&*pac::TIM1::PTR, &*pac::TIM8::PTR, &*pac::TIM3::PTR, &*pac::TIM4::PTR) };
    tim8.sr().put(timers::SR_LATCHED);
    if !WHOLE.load(Ordering::Relaxed) {
        return;
    }
    // `compare` holds them to the timers' tops
    let [first, second, third, fourth] = &PENDING;
    latch!(tim1, first);
    latch!(tim8, second);
    latch!(tim3, third);
    latch!(tim4, fourth);
}
