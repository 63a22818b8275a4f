//! # Pins: what every lead of the LQFP100 does
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
    /// SPI of gyro and encoders, clock
    SensorClock,
    /// SPI of gyro and encoders, to the chip
    SensorIn,
    /// SPI of gyro and encoders, from the chip
    SensorOut,
    /// Chip select of the gyro, low selects
    GyroSelect,
    /// Chip select of a motor's encoder, low selects
    EncoderSelect {
        /// Motor
        motor: usize,
    },
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
    /// Lead of the LQFP100 package (datasheet DS8626, pin definitions)
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

const fn select(motor: usize) -> Job {
    Job::EncoderSelect { motor }
}

/// Every pin that is used.
pub const PINS: [Pin; 54] = [
    pin('A', 8, 67, "TIM1_CH1 (AF1)", phase(0, 0)),
    pin('A', 9, 68, "TIM1_CH2 (AF1)", phase(0, 1)),
    pin('A', 10, 69, "TIM1_CH3 (AF1)", phase(0, 2)),
    pin('C', 6, 63, "TIM8_CH1 (AF3)", phase(1, 0)),
    pin('C', 7, 64, "TIM8_CH2 (AF3)", phase(1, 1)),
    pin('C', 8, 65, "TIM8_CH3 (AF3)", phase(1, 2)),
    pin('A', 6, 31, "TIM3_CH1 (AF2)", phase(2, 0)),
    pin('A', 7, 32, "TIM3_CH2 (AF2)", phase(2, 1)),
    pin('B', 0, 35, "TIM3_CH3 (AF2)", phase(2, 2)),
    pin('B', 6, 92, "TIM4_CH1 (AF2)", phase(3, 0)),
    pin('B', 7, 93, "TIM4_CH2 (AF2)", phase(3, 1)),
    pin('B', 8, 95, "TIM4_CH3 (AF2)", phase(3, 2)),
    pin('A', 4, 29, "ADC1_IN4", current(0, 0)),
    pin('A', 0, 23, "ADC2_IN0", current(0, 1)),
    pin('C', 0, 15, "ADC3_IN10", current(0, 2)),
    pin('A', 5, 30, "ADC1_IN5", current(1, 0)),
    pin('A', 1, 24, "ADC2_IN1", current(1, 1)),
    pin('C', 1, 16, "ADC3_IN11", current(1, 2)),
    pin('C', 4, 33, "ADC1_IN14", current(2, 0)),
    pin('A', 2, 25, "ADC2_IN2", current(2, 1)),
    pin('C', 2, 17, "ADC3_IN12", current(2, 2)),
    pin('C', 5, 34, "ADC1_IN15", current(3, 0)),
    pin('A', 3, 26, "ADC2_IN3", current(3, 1)),
    pin('C', 3, 18, "ADC3_IN13", current(3, 2)),
    pin('B', 1, 36, "ADC1_IN9", Job::Bus),
    pin('D', 0, 81, "GPIO in, pull-up", hall(0, 0)),
    pin('D', 1, 82, "GPIO in, pull-up", hall(0, 1)),
    pin('D', 3, 84, "GPIO in, pull-up", hall(0, 2)),
    pin('B', 9, 96, "GPIO in, pull-up", hall(1, 0)),
    pin('C', 9, 66, "GPIO in, pull-up", hall(1, 1)),
    pin('C', 12, 80, "GPIO in, pull-up", hall(1, 2)),
    pin('B', 12, 51, "GPIO in, pull-up", hall(2, 0)),
    pin('B', 13, 52, "GPIO in, pull-up", hall(2, 1)),
    pin('B', 14, 53, "GPIO in, pull-up", hall(2, 2)),
    pin('B', 15, 54, "GPIO in, pull-up", hall(3, 0)),
    pin('D', 2, 83, "GPIO in, pull-up", hall(3, 1)),
    pin('A', 15, 77, "GPIO in, pull-up", hall(3, 2)),
    pin('B', 10, 47, "GPIO out", enable(0)),
    pin('B', 11, 48, "GPIO out", enable(1)),
    pin('A', 11, 70, "GPIO out", enable(2)),
    pin('A', 12, 71, "GPIO out", enable(3)),
    pin('C', 13, 7, "GPIO in, pull-up", Job::Fault),
    pin('C', 10, 78, "USART3_TX (AF7)", Job::LinkOut),
    pin('C', 11, 79, "USART3_RX (AF7)", Job::LinkIn),
    pin('B', 3, 89, "SPI1_SCK (AF5)", Job::SensorClock),
    pin('B', 4, 90, "SPI1_MISO (AF5)", Job::SensorIn),
    pin('B', 5, 91, "SPI1_MOSI (AF5)", Job::SensorOut),
    pin('D', 8, 55, "GPIO out", Job::GyroSelect),
    pin('D', 4, 85, "GPIO out", select(0)),
    pin('D', 5, 86, "GPIO out", select(1)),
    pin('D', 6, 87, "GPIO out", select(2)),
    pin('D', 7, 88, "GPIO out", select(3)),
    pin('A', 13, 72, "SWDIO", Job::ProbeData),
    pin('A', 14, 76, "SWCLK", Job::ProbeClock),
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
