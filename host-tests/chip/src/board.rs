//! # Board: the chip with its image in the place of a program that drives a virtual board
//!
//! ```text
//! up:    TIM1 is UP_BEFORE_TOP before its top: the latch is over, what stands in the compare registers is next
//! down:  codes for the ranks that are sampled from this top on, levels of the pins, bytes on the wire
//! ```
//!
//! So the runs that the emulated board is driven with drive this one, through the registers of its peripherals.

use std::collections::VecDeque;

use firmware::codes::MOTORS;
use firmware::exchange::{DownFrame, LINK_BYTES, LinkBytes, UpFrame};
use firmware::registers::pins::{self, Job, PINS, Pin};
use firmware::registers::timing;
use host_tests::emulator::{BoardProgram, RunError};
use model_core::link::sensor_codes::SensorCodes;

use crate::core::{Chip, ChipError};
use crate::peripherals::map::{GPIO, GPIO_STEP, TIMERS};
use crate::peripherals::timer::at;

/// When a period is handed over [core cycles before TIM1's top]: after the latch, before the trigger.
const UP_BEFORE_TOP: u64 = 250;
/// Longest wait for the timers to run [core cycles]: a reset by the watchdog, and the start.
const LONGEST: u64 = 168_000_000;

/// A chip that drives a board.
#[derive(Debug)]
pub struct ChipBoard {
    /// The chip
    pub chip: Chip,
    /// Gyro and encoders are not plugged in
    pub unplugged: bool,
    period: u32,
    taken: usize,
    outward: VecDeque<u8>,
}

impl ChipBoard {
    /// A chip that has just been switched on.
    pub fn new(chip: Chip) -> Self {
        Self { chip, unplugged: false, period: 0, taken: 0, outward: VecDeque::new() }
    }

    /// Runs to where a period is handed over.
    fn run_to_hand_over(&mut self) -> Result<(), ChipError> {
        let began = self.chip.now();
        while !self.chip.machine().bus.timers[0].runs {
            if self.chip.now() > began + LONGEST {
                return Err(self.chip.late("the first period", LONGEST));
            }
            self.chip.run_to(self.chip.now() + 1_000)?;
        }
        let now = self.chip.now();
        let (count, down) = self.chip.machine().bus.timers[0].count(now);
        let top = u64::from(timing::TOPS[0]);
        let to_top = if down { top + u64::from(count) } else { top - u64::from(count) };
        let period = u64::from(timing::PERIOD);
        self.chip.run_to(now + (to_top + period - UP_BEFORE_TOP - 1) % period + 1)
    }

    /// The gate drivers' enables as the pins have them, a bit a motor.
    pub fn enabled(&self) -> u8 {
        let words = &self.chip.machine().bus.words;
        let high = |pin: &Pin| {
            let base = GPIO + GPIO_STEP * port(*pin);
            words.field(base, 2 * u32::from(pin.number), 2) == 1 && words.bit(base + 0x14, pin.number.into())
        };
        PINS.iter().fold(0, |bits, pin| match pin.job {
            Job::Enable { motor } => bits | u8::from(high(pin)) << motor,
            _ => bits,
        })
    }

    fn level(&mut self, pin: Pin, high: bool) {
        let level = &mut self.chip.machine_mut().bus.levels[port(pin) as usize];
        *level = *level & !(1 << pin.number) | u16::from(high) << pin.number;
    }
}

fn port(pin: Pin) -> u32 {
    u32::from(pin.port) - u32::from('A')
}

fn run_error(why: ChipError) -> RunError {
    RunError::Exchange(std::io::Error::other(why))
}

impl BoardProgram for ChipBoard {
    fn up(&mut self) -> Result<UpFrame, RunError> {
        self.run_to_hand_over().map_err(run_error)?;
        let bus = &self.chip.machine().bus;
        self.outward.extend(&bus.link.outward[self.taken..]);
        self.taken = bus.link.outward.len();
        let count = |motor: usize, phase: u32| bus.words.get(TIMERS[motor] + at::CCR + 4 * phase) as u16;
        let compare = std::array::from_fn(|motor| [0, 1, 2].map(|phase| count(motor, phase)));
        let leaving: Vec<u8> = self.outward.drain(..self.outward.len().min(LINK_BYTES)).collect();
        let up = UpFrame {
            period: self.period,
            compare,
            enabled: self.enabled(),
            link: LinkBytes::of(&leaving),
            ..UpFrame::default()
        };
        self.period = self.period.wrapping_add(1);
        Ok(up)
    }

    fn down(&mut self, down: &DownFrame) -> Result<(), RunError> {
        let channel = |pin: Pin| usize::from(pin.channel().unwrap_or(0));
        for motor in 0..MOTORS {
            for phase in 0..3 {
                let code = down.codes.phases[motor][phase].0;
                self.chip.machine_mut().bus.converters.codes[phase][channel(pins::current_of(motor, phase))] = code;
            }
        }
        self.chip.machine_mut().bus.converters.codes[0][channel(pins::bus())] = down.codes.bus.0;
        for pin in PINS {
            match pin.job {
                Job::Hall { motor, line } => self.level(pin, down.codes.halls[motor].0 >> line & 1 != 0),
                Job::Fault => self.level(pin, !down.codes.driver_fault),
                _ => {}
            }
        }
        let sensors = if self.unplugged { SensorCodes::default() } else { down.sensors };
        self.chip.machine_mut().bus.spi.sensors = sensors;
        self.chip.send(down.link.as_slice());
        Ok(())
    }
}
