//! # Pins: what every lead of the LQFP64 does
//!
//! The one list. The converters' channels are computed from it ([`super::adc`]), the table of `firmware/HARDWARE.md` is
//! compared to it, and the board hands exactly these pins to the chip's peripherals, where the compiler checks that
//! each can do its job.
//!
//! Motors count from 0, phases and hall lines are a, b, c = 0, 1, 2. TIM1, TIM8, TIM3 and TIM4 drive motors 0 to 3.

use crate::codes::MOTORS;

/// What a pin does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Job {
    /// PWM of one phase
    Phase {
        /// Motor
        motor: usize,
        /// Phase
        phase: usize,
    },
    /// Current of one phase
    Current {
        /// Motor
        motor: usize,
        /// Phase
        phase: usize,
    },
    /// One hall line
    Hall {
        /// Motor
        motor: usize,
        /// Line
        line: usize,
    },
    /// Enable of one gate driver; low opens the bridge
    Enable {
        /// Motor
        motor: usize,
    },
    /// Fault line that all gate drivers share; low is a fault
    Fault,
    /// Divided supply voltage
    Bus,
    /// From the robot to the host
    LinkOut,
    /// From the host to the robot
    LinkIn,
    /// Serial wire debug, data
    ProbeData,
    /// Serial wire debug, clock
    ProbeClock,
}

/// One pin of the chip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Port, a letter
    pub port: char,
    /// Number in the port
    pub number: u8,
    /// Lead of the LQFP64 package
    pub lead: u8,
    /// Peripheral that it is connected to inside
    pub inside: &'static str,
    /// What it does
    pub job: Job,
}

const fn pin(port: char, number: u8, lead: u8, inside: &'static str, job: Job) -> Pin {
    Pin { port, number, lead, inside, job }
}

const fn phase(motor: usize, phase: usize) -> Job {
    Job::Phase { motor, phase }
}

const fn current(motor: usize, phase: usize) -> Job {
    Job::Current { motor, phase }
}

const fn hall(motor: usize, line: usize) -> Job {
    Job::Hall { motor, line }
}

const fn enable(motor: usize) -> Job {
    Job::Enable { motor }
}

/// Every pin that is used.
pub const PINS: [Pin; 46] = [
    pin('A', 8, 41, "TIM1_CH1 (AF1)", phase(0, 0)),
    pin('A', 9, 42, "TIM1_CH2 (AF1)", phase(0, 1)),
    pin('A', 10, 43, "TIM1_CH3 (AF1)", phase(0, 2)),
    pin('C', 6, 37, "TIM8_CH1 (AF3)", phase(1, 0)),
    pin('C', 7, 38, "TIM8_CH2 (AF3)", phase(1, 1)),
    pin('C', 8, 39, "TIM8_CH3 (AF3)", phase(1, 2)),
    pin('A', 6, 22, "TIM3_CH1 (AF2)", phase(2, 0)),
    pin('A', 7, 23, "TIM3_CH2 (AF2)", phase(2, 1)),
    pin('B', 0, 26, "TIM3_CH3 (AF2)", phase(2, 2)),
    pin('B', 6, 58, "TIM4_CH1 (AF2)", phase(3, 0)),
    pin('B', 7, 59, "TIM4_CH2 (AF2)", phase(3, 1)),
    pin('B', 8, 61, "TIM4_CH3 (AF2)", phase(3, 2)),
    pin('A', 4, 20, "ADC1_IN4", current(0, 0)),
    pin('A', 0, 14, "ADC2_IN0", current(0, 1)),
    pin('C', 0, 8, "ADC3_IN10", current(0, 2)),
    pin('A', 5, 21, "ADC1_IN5", current(1, 0)),
    pin('A', 1, 15, "ADC2_IN1", current(1, 1)),
    pin('C', 1, 9, "ADC3_IN11", current(1, 2)),
    pin('C', 4, 24, "ADC1_IN14", current(2, 0)),
    pin('A', 2, 16, "ADC2_IN2", current(2, 1)),
    pin('C', 2, 10, "ADC3_IN12", current(2, 2)),
    pin('C', 5, 25, "ADC1_IN15", current(3, 0)),
    pin('A', 3, 17, "ADC2_IN3", current(3, 1)),
    pin('C', 3, 11, "ADC3_IN13", current(3, 2)),
    pin('B', 1, 27, "ADC1_IN9", Job::Bus),
    pin('B', 3, 55, "GPIO in, pull-up", hall(0, 0)),
    pin('B', 4, 56, "GPIO in, pull-up", hall(0, 1)),
    pin('B', 5, 57, "GPIO in, pull-up", hall(0, 2)),
    pin('B', 9, 62, "GPIO in, pull-up", hall(1, 0)),
    pin('C', 9, 40, "GPIO in, pull-up", hall(1, 1)),
    pin('C', 12, 53, "GPIO in, pull-up", hall(1, 2)),
    pin('B', 12, 33, "GPIO in, pull-up", hall(2, 0)),
    pin('B', 13, 34, "GPIO in, pull-up", hall(2, 1)),
    pin('B', 14, 35, "GPIO in, pull-up", hall(2, 2)),
    pin('B', 15, 36, "GPIO in, pull-up", hall(3, 0)),
    pin('D', 2, 54, "GPIO in, pull-up", hall(3, 1)),
    pin('A', 15, 50, "GPIO in, pull-up", hall(3, 2)),
    pin('B', 10, 29, "GPIO out", enable(0)),
    pin('B', 11, 30, "GPIO out", enable(1)),
    pin('A', 11, 44, "GPIO out", enable(2)),
    pin('A', 12, 45, "GPIO out", enable(3)),
    pin('C', 13, 2, "GPIO in, pull-up", Job::Fault),
    pin('C', 10, 51, "USART3_TX (AF7)", Job::LinkOut),
    pin('C', 11, 52, "USART3_RX (AF7)", Job::LinkIn),
    pin('A', 13, 46, "SWDIO", Job::ProbeData),
    pin('A', 14, 49, "SWCLK", Job::ProbeClock),
];

/// The pin that measures the current of a phase.
///
/// # Panics
/// Where the list has none; in a constant that stops the build.
pub const fn current_of(motor: usize, phase: usize) -> Pin {
    let mut at = 0;
    while at < PINS.len() {
        if let Job::Current { motor: m, phase: p } = PINS[at].job
            && m == motor
            && p == phase
        {
            return PINS[at];
        }
        at += 1;
    }
    panic!("every phase of every motor has a pin for its current")
}

/// The pin that measures the supply.
///
/// # Panics
/// Where the list has none; in a constant that stops the build.
pub const fn bus() -> Pin {
    let mut at = 0;
    while at < PINS.len() {
        if let Job::Bus = PINS[at].job {
            return PINS[at];
        }
        at += 1;
    }
    panic!("the supply has a pin")
}

/// BSRR of a port: the enables of all gate drivers on it go low.
///
/// A one in the upper half of the register resets its pin, a zero leaves it (RM0090, GPIO port bit set/reset register).
pub const fn enables_low(port: char) -> u32 {
    let (mut bits, mut at) = (0, 0);
    while at < PINS.len() {
        if let Job::Enable { .. } = PINS[at].job
            && PINS[at].port == port
        {
            bits |= 1 << (16 + PINS[at].number);
        }
        at += 1;
    }
    bits
}

// Ports A and B have all enables: a board that fails opens its bridges with these two.
const _: () = assert!((enables_low('A').count_ones() + enables_low('B').count_ones()) as usize == MOTORS);

impl Pin {
    /// Its channel at the converters, if it has one (datasheet DS8626, pin definitions: ADC123_INx and ADC12_INx).
    pub const fn channel(self) -> Option<u8> {
        match (self.port, self.number) {
            ('A', n @ 0..=7) => Some(n),
            ('B', n @ 0..=1) => Some(8 + n),
            ('C', n @ 0..=5) => Some(10 + n),
            _ => None,
        }
    }

    /// Which of ADC1, ADC2, ADC3 can convert it.
    pub const fn converters(self) -> [bool; 3] {
        match (self.port, self.number) {
            ('A' | 'C', 0..=3) => [true, true, true],
            ('A', 4..=7) | ('B', 0..=1) | ('C', 4..=5) => [true, true, false],
            _ => [false; 3],
        }
    }
}

/// The pins of the phase currents by rank of the injected group and converter: rank k is motor k, phases a, b and c go
/// to ADC1, ADC2 and ADC3.
pub const RANKS: [[Pin; 3]; MOTORS] = {
    let mut ranks = [[bus(); 3]; MOTORS];
    let mut motor = 0;
    while motor < MOTORS {
        let mut phase = 0;
        while phase < 3 {
            ranks[motor][phase] = current_of(motor, phase);
            phase += 1;
        }
        motor += 1;
    }
    ranks
};
