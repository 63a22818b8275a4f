//! # Parts: clocks, pins and peripherals, all asleep
//!
//! The enables go low first of all. Then the timers are set up standing and their outputs are held low, and only then
//! do their pins belong to them. Every pin passes through a function that the compiler lets it pass only if the chip
//! can do that.

use cortex_m::asm;
use model_core::control::calibration::AdcCode;
use stm32f4xx_hal::gpio::alt::{SerialAsync, SpiCommon, TimCPin};
use stm32f4xx_hal::gpio::gpiod::PDn;
use stm32f4xx_hal::gpio::{Output, Pin, PinPull, PinSpeed, PinState, Pull, PushPull, Speed};
use stm32f4xx_hal::hal_02::adc::Channel;
use stm32f4xx_hal::pac::{self, Interrupt};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Enable};

use super::bridges::{AllHalls, Bridges, Gates, Phase};
use super::flash_store::FlashStore;
use super::sensor_bus::{MotionSensors, SensorDevice};
use super::serial::SerialLink;
use super::typed::{Get, Put};
use super::watchdog::Watchdog;
use crate::drivers::fault::FaultLine;
use crate::drivers::gate::GateDriver;
use crate::drivers::halls::HallLines;
use crate::registers::words::Word;
use crate::registers::{adc, spi, timers, timing, watchdog};

/// The board's crystal [Hz]; 4 to 26 MHz.
pub const HSE_HZ: u32 = 8_000_000;

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

/// Takes the board, everything asleep: bridges open, timers standing, converters on but not triggered, no watchdog.
pub fn take(mut core: cortex_m::Peripherals, device: pac::Peripherals) -> Parts {
    let clocks = Config::hse(HSE_HZ.Hz())
        .sysclk(timing::CORE_HZ.Hz())
        .hclk(timing::CORE_HZ.Hz())
        .pclk1(timing::APB1_HZ.Hz())
        .pclk2(timing::APB2_HZ.Hz());
    let mut rcc = device.RCC.freeze(clocks);
    // the crystal runs by now
    rcc.cr().put(rcc.cr().get() | watchdog::CLOCK_SECURITY);
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();

    let gpioa = device.GPIOA.split(&mut rcc);
    let gpiob = device.GPIOB.split(&mut rcc);
    let gpioc = device.GPIOC.split(&mut rcc);
    let gpiod = device.GPIOD.split(&mut rcc);

    let enables = (
        gpiob.pb10.into_push_pull_output_in_state(PinState::Low),
        gpiob.pb11.into_push_pull_output_in_state(PinState::Low),
        gpioa.pa11.into_push_pull_output_in_state(PinState::Low),
        gpioa.pa12.into_push_pull_output_in_state(PinState::Low),
    );

    pac::TIM1::enable(&mut rcc);
    pac::TIM8::enable(&mut rcc);
    pac::TIM3::enable(&mut rcc);
    pac::TIM4::enable(&mut rcc);
    let timers = (device.TIM1, device.TIM8, device.TIM3, device.TIM4);
    set_up_timers(&timers);
    // SAFETY: the latch goes before everything else, so that it never comes after the tops; it takes nothing from other
    // tasks.
    unsafe { core.NVIC.set_priority(Interrupt::TIM8_CC, 0) };

    pwm::<pac::TIM1, 0>(gpioa.pa8);
    pwm::<pac::TIM1, 1>(gpioa.pa9);
    pwm::<pac::TIM1, 2>(gpioa.pa10);
    pwm::<pac::TIM8, 0>(gpioc.pc6);
    pwm::<pac::TIM8, 1>(gpioc.pc7);
    pwm::<pac::TIM8, 2>(gpioc.pc8);
    pwm::<pac::TIM3, 0>(gpioa.pa6);
    pwm::<pac::TIM3, 1>(gpioa.pa7);
    pwm::<pac::TIM3, 2>(gpiob.pb0);
    pwm::<pac::TIM4, 0>(gpiob.pb6);
    pwm::<pac::TIM4, 1>(gpiob.pb7);
    pwm::<pac::TIM4, 2>(gpiob.pb8);

    // a phase for each converter, a motor for each rank
    let ranks = [
        adc::jsqr([
            reaches::<pac::ADC1, _>(gpioa.pa4.into_analog()),
            reaches::<pac::ADC1, _>(gpioa.pa5.into_analog()),
            reaches::<pac::ADC1, _>(gpioc.pc4.into_analog()),
            reaches::<pac::ADC1, _>(gpioc.pc5.into_analog()),
        ]),
        adc::jsqr([
            reaches::<pac::ADC2, _>(gpioa.pa0.into_analog()),
            reaches::<pac::ADC2, _>(gpioa.pa1.into_analog()),
            reaches::<pac::ADC2, _>(gpioa.pa2.into_analog()),
            reaches::<pac::ADC2, _>(gpioa.pa3.into_analog()),
        ]),
        adc::jsqr([
            reaches::<pac::ADC3, _>(gpioc.pc0.into_analog()),
            reaches::<pac::ADC3, _>(gpioc.pc1.into_analog()),
            reaches::<pac::ADC3, _>(gpioc.pc2.into_analog()),
            reaches::<pac::ADC3, _>(gpioc.pc3.into_analog()),
        ]),
    ];
    let bus = adc::sqr3(reaches::<pac::ADC1, _>(gpiob.pb1.into_analog()));
    pac::ADC1::enable(&mut rcc);
    pac::ADC2::enable(&mut rcc);
    pac::ADC3::enable(&mut rcc);
    let converters = (device.ADC1, device.ADC2, device.ADC3);
    set_up_converters(&converters, &device.ADC_COMMON, ranks, bus);

    let [a, b, c] = Phase::all::<0>();
    let Ok(first) = GateDriver::new(a, b, c, enables.0);
    let [a, b, c] = Phase::all::<1>();
    let Ok(second) = GateDriver::new(a, b, c, enables.1);
    let [a, b, c] = Phase::all::<2>();
    let Ok(third) = GateDriver::new(a, b, c, enables.2);
    let [a, b, c] = Phase::all::<3>();
    let Ok(fourth) = GateDriver::new(a, b, c, enables.3);
    let halls = AllHalls {
        first: HallLines::new(
            gpiod.pd0.into_pull_up_input(),
            gpiod.pd1.into_pull_up_input(),
            gpiod.pd3.into_pull_up_input(),
        ),
        second: HallLines::new(
            gpiob.pb9.into_pull_up_input(),
            gpioc.pc9.into_pull_up_input(),
            gpioc.pc12.into_pull_up_input(),
        ),
        third: HallLines::new(
            gpiob.pb12.into_pull_up_input(),
            gpiob.pb13.into_pull_up_input(),
            gpiob.pb14.into_pull_up_input(),
        ),
        fourth: HallLines::new(
            gpiob.pb15.into_pull_up_input(),
            gpiod.pd2.into_pull_up_input(),
            gpioa.pa15.into_pull_up_input(),
        ),
    };
    let fault = FaultLine::new(gpioc.pc13.into_pull_up_input());

    sends::<pac::USART3>(gpioc.pc10);
    receives::<pac::USART3>(gpioc.pc11);
    pac::USART3::enable(&mut rcc);
    pac::DMA1::enable(&mut rcc);

    // no device is selected while the bus comes up
    let gyro = SensorDevice::new(select(gpiod.pd8), spi::CR1_GYRO);
    let encoders = [select(gpiod.pd4), select(gpiod.pd5), select(gpiod.pd6), select(gpiod.pd7)]
        .map(|pin| SensorDevice::new(pin, spi::CR1_ENCODER));
    // the reset leaves two of these pins to a probe of more lines than two
    beats::<pac::SPI1>(gpiob.pb3.into_floating_input());
    hears::<pac::SPI1>(gpiob.pb4.into_floating_input());
    speaks::<pac::SPI1>(gpiob.pb5);
    pac::SPI1::enable(&mut rcc);
    Parts {
        bridges: Bridges {
            gates: Gates { first, second, third, fourth },
            halls,
            fault,
            converters,
            timers,
            bus: AdcCode(0),
        },
        serial: SerialLink::new(device.USART3, device.DMA1),
        watchdog: Watchdog::new(device.IWDG, &rcc),
        flash_store: FlashStore::new(device.FLASH),
        sensors: MotionSensors::new(gyro, encoders),
    }
}

/// Gives a pin to a channel of a timer; compiles only for a pin that the channel comes out at.
fn pwm<TIM: TimCPin<C>, const C: u8>(pin: impl Into<TIM::Ch<PushPull>>) {
    let _pin: TIM::Ch<PushPull> = pin.into();
}

/// The channel at which a converter reaches a pin; compiles only where it does.
fn reaches<ADC, PIN: Channel<ADC, ID = u8>>(_pin: PIN) -> u8 {
    PIN::channel()
}

/// Gives a pin to a serial port's transmitter, its edges fast enough for 2 Mbaud; compiles only where it comes out.
fn sends<USART: SerialAsync>(pin: impl Into<USART::Tx<PushPull>>)
where
    USART::Tx<PushPull>: PinSpeed,
{
    let mut pin: USART::Tx<PushPull> = pin.into();
    pin.set_speed(Speed::Medium);
}

/// Gives a pin to a serial port's receiver, idle while nothing is plugged in; compiles only where it comes in.
fn receives<USART: SerialAsync>(pin: impl Into<USART::Rx<PushPull>>)
where
    USART::Rx<PushPull>: PinPull,
{
    let mut pin: USART::Rx<PushPull> = pin.into();
    pin.set_internal_resistor(Pull::Up);
}

/// Gives a pin to the clock of an SPI, held low while the bus is off; compiles only where it comes out.
fn beats<SPI: SpiCommon>(pin: impl Into<SPI::Sck>)
where
    SPI::Sck: PinSpeed + PinPull,
{
    let mut pin: SPI::Sck = pin.into();
    pin.set_speed(Speed::Medium);
    pin.set_internal_resistor(Pull::Down);
}

/// Gives a pin to the input of an SPI, high while nothing answers; compiles only where it comes in.
fn hears<SPI: SpiCommon>(pin: impl Into<SPI::Miso>)
where
    SPI::Miso: PinPull,
{
    let mut pin: SPI::Miso = pin.into();
    pin.set_internal_resistor(Pull::Up);
}

/// Gives a pin to the output of an SPI; compiles only where it comes out.
fn speaks<SPI: SpiCommon>(pin: impl Into<SPI::Mosi>)
where
    SPI::Mosi: PinSpeed,
{
    let mut pin: SPI::Mosi = pin.into();
    pin.set_speed(Speed::Medium);
}

/// A chip select, high.
fn select<const N: u8>(pin: Pin<'D', N>) -> PDn<Output> {
    pin.into_push_pull_output_in_state(PinState::High).erase_number()
}

/// What all four timers have in common; they are of two types.
macro_rules! set_up {
    ($timer:expr, $top:expr) => {
        $timer.cr1().put(timers::CR1);
        $timer.arr().write(|w| w.arr().set($top));
        $timer.ccmr1_output().put(timers::CCMR1);
        $timer.ccer().put(timers::CCER);
    };
}

fn set_up_timers((tim1, tim8, tim3, tim4): &(pac::TIM1, pac::TIM8, pac::TIM3, pac::TIM4)) {
    let [top1, top8, top3, top4] = timing::TOPS;
    // no counter runs yet; registers that are not named here stay as the reset leaves them: zero
    tim1.bdtr().put(timers::BDTR_ASLEEP);
    tim8.bdtr().put(timers::BDTR_ASLEEP);
    set_up!(tim1, top1);
    set_up!(tim8, top8);
    set_up!(tim3, top3);
    set_up!(tim4, top4);
    tim1.ccr4().write(|w| w.ccr().set(timers::CCR4_TIM1));
    tim8.ccr4().write(|w| w.ccr().set(timers::CCR4_TIM8));
    tim1.ccmr2_output().put(timers::CCMR2_TIM1);
    tim8.ccmr2_output().put(timers::CCMR2);
    tim3.ccmr2_output().put(timers::CCMR2);
    tim4.ccmr2_output().put(timers::CCMR2);
    // the preloaded registers are loaded before TIM1's signal leads anywhere
    tim1.egr().write(|w| w.ug().set_bit());
    tim8.egr().write(|w| w.ug().set_bit());
    tim3.egr().write(|w| w.ug().set_bit());
    tim4.egr().write(|w| w.ug().set_bit());
    tim1.cr2().put(timers::CR2_TIM1);
    tim8.smcr().put(timers::SMCR_WAITS);
    tim3.smcr().put(timers::SMCR_WAITS);
    tim4.smcr().put(timers::SMCR_WAITS);
}

fn set_up_converters(
    (first, second, third): &(pac::ADC1, pac::ADC2, pac::ADC3),
    common: &pac::ADC_COMMON,
    ranks: [Word<adc::Jsqr>; 3],
    bus: Word<adc::Sqr3>,
) {
    // no converter is triggered yet
    common.ccr().put(adc::CCR);
    for (converter, (cr1, jsqr)) in [&**first, &**second, &**third].into_iter().zip(adc::CR1.into_iter().zip(ranks)) {
        converter.cr1().put(cr1);
        converter.smpr1().put(adc::SMPR1);
        converter.smpr2().put(adc::SMPR2);
        converter.jsqr().put(jsqr);
        converter.cr2().put(adc::CR2_ASLEEP);
    }
    first.sqr1().put(adc::SQR1);
    first.sqr3().put(bus);
    // converters need 3 µs after they are switched on (DS8626, ADC characteristics, power-up time); this is 10 µs
    asm::delay(timing::CORE_HZ / 100_000);
}
