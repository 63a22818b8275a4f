//! # Map: where the registers are
//!
//! Source: RM0090, memory map and the register maps of the peripherals.

/// Where the peripherals begin.
pub const PERIPHERALS: u32 = 0x4000_0000;
/// Bytes of them that are modelled.
pub const PERIPHERALS_LEN: u32 = 0x8_0000;

/// TIM1, TIM8, TIM3, TIM4: motors 0 to 3.
pub const TIMERS: [u32; 4] = [0x4001_0000, 0x4001_0400, 0x4000_0400, 0x4000_0800];
/// ADC1, ADC2, ADC3.
pub const ADCS: [u32; 3] = [0x4001_2000, 0x4001_2100, 0x4001_2200];
/// The converters' common control register.
pub const ADC_CCR: u32 = 0x4001_2304;
/// SPI1.
pub const SPI1: u32 = 0x4001_3000;
/// Independent watchdog.
pub const IWDG: u32 = 0x4000_3000;
/// USART3.
pub const USART3: u32 = 0x4000_4800;
/// Power controller.
pub const PWR: u32 = 0x4000_7000;
/// Port A; the others follow.
pub const GPIO: u32 = 0x4002_0000;
/// From one port to the next.
pub const GPIO_STEP: u32 = 0x400;
/// Ports that are modelled, A to I.
pub const PORTS: usize = 9;
/// Reset and clock control.
pub const RCC: u32 = 0x4002_3800;
/// Flash interface.
pub const FLASH: u32 = 0x4002_3C00;
/// DMA1.
pub const DMA1: u32 = 0x4002_6000;

/// The enable bit of a peripheral's clock: (register of RCC, bit); none where it needs none.
pub fn clock_enable(address: u32) -> Option<(u32, u32)> {
    const AHB1ENR: u32 = RCC + 0x30;
    const APB1ENR: u32 = RCC + 0x40;
    const APB2ENR: u32 = RCC + 0x44;
    Some(match address & !0x3FF {
        0x4000_0400 => (APB1ENR, 1),
        0x4000_0800 => (APB1ENR, 2),
        USART3 => (APB1ENR, 18),
        PWR => (APB1ENR, 28),
        0x4001_0000 => (APB2ENR, 0),
        0x4001_0400 => (APB2ENR, 1),
        0x4001_2000 => (APB2ENR, 8 + (address >> 8 & 3).min(2)),
        SPI1 => (APB2ENR, 12),
        DMA1 => (AHB1ENR, 21),
        base @ GPIO..0x4002_2400 => (AHB1ENR, (base - GPIO) / GPIO_STEP),
        _ => return None,
    })
}
