//! # SPI: SPI1 as a master, with one gyro and four encoders behind it
//!
//! A byte is on the wire for eight of the bus's clocks by its divider, and comes back with what the selected device says. What
//! the devices' data sheets forbid is told: two of them selected, another mode than theirs, a clock above 10 MHz, an encoder that
//! has less than 350 ns between its selection and a byte, or between two frames.
//!
//! Sources: RM0090, SPI (baud rate, RXNE, master by software); Bosch BST-BMI088-DS001 revision 1.4 (registers of the gyro, address
//! auto-increment, bit 7 reads); ams AS5047P datasheet v1-01 (frames, parity, DIAAGC, ANGLECOM, timing).

use firmware::codes::MOTORS;
use firmware::registers::pins::{Job, PINS};
use model_core::link::sensor_codes::SensorCodes;

use super::map::{RCC, SPI1};
use super::words::Words;
use crate::events::Log;

/// RXNE in SR.
const RXNE: u32 = 1;
const SR: u32 = SPI1 + 8;
/// The data register.
pub const DR: u32 = SPI1 + 0xC;

/// tL and tCSn of the encoder [core cycles]: 350 ns of 168 MHz, less a cycle for where within its instruction a write takes place.
const ENCODER_WAITS: u64 = 58;

/// Longest period that is too short for either device's clock [core cycles]: 10 MHz are 16.8.
const TOO_FAST: u64 = 16;

/// One of the devices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Device {
    Gyro,
    Encoder(usize),
}

/// A byte on the wire.
#[derive(Clone, Copy, Debug)]
struct OnWire {
    out: u8,
    ends: u64,
}

/// The master and its devices.
#[derive(Debug)]
pub struct Spi {
    /// What the sensors measure; one that has no reading does not answer
    pub sensors: SensorCodes,
    /// Transfers that came to their end: of the gyro, of all encoders
    pub transfers: [u64; 2],
    on_wire: Option<OnWire>,
    selected: Option<Device>,
    /// When the last selection began or ended
    changed: u64,
    /// Bytes of this selection, to the device
    taken: Vec<u8>,
    /// GYRO_RANGE, GYRO_BANDWIDTH
    gyro: [u8; 2],
    /// What each encoder answers with its next frame
    answers: [u16; MOTORS],
}

impl Default for Spi {
    fn default() -> Self {
        Self {
            sensors: SensorCodes::default(),
            transfers: [0; 2],
            on_wire: None,
            selected: None,
            changed: 0,
            taken: Vec::new(),
            gyro: [0x07, 0x80],
            answers: [0; MOTORS],
        }
    }
}

/// A frame with its parity.
fn even(frame: u16) -> u16 {
    frame | (frame.count_ones() as u16 & 1) << 15
}

impl Spi {
    /// Core cycles of a bit: the second bus by its divider and by that of the SPI.
    fn bit(words: &Words) -> u64 {
        let bus = match words.field(RCC + 8, 13, 3) {
            code @ 4..=7 => 2 << (code - 4),
            _ => 1,
        };
        bus * (2 << words.field(SPI1, 3, 3))
    }

    /// The core cycle of what comes next.
    pub fn next(&self) -> Option<u64> {
        self.on_wire.map(|byte| byte.ends)
    }

    /// The data register is written.
    pub fn send(&mut self, now: u64, words: &Words, log: &mut Log, byte: u8) {
        let master = words.bit(SPI1, 6) && words.bit(SPI1, 2) && words.bit(SPI1, 8) && words.bit(SPI1, 9);
        if !master || self.on_wire.is_some() {
            return log.forbid("SPI1 is written while it is off, no master, or at work".into());
        }
        if Self::bit(words) <= TOO_FAST {
            log.forbid("SPI1 is faster than 10 MHz".into());
        }
        let mode = words.field(SPI1, 0, 2);
        match self.selected {
            None => log.forbid("SPI1 sends while no device is selected".into()),
            Some(Device::Gyro) if mode != 0 && mode != 3 => log.forbid("the gyro is in mode 0 or 3".into()),
            Some(Device::Encoder(_)) if mode != 1 => log.forbid("an encoder is in mode 1".into()),
            Some(Device::Encoder(_)) if self.taken.is_empty() && now < self.changed + ENCODER_WAITS => {
                log.forbid("an encoder has less than 350 ns before its first byte".into());
            }
            _ => {}
        }
        self.on_wire = Some(OnWire { out: byte, ends: now + 8 * Self::bit(words) });
    }

    /// Does what is due at `now`.
    pub fn advance(&mut self, now: u64, words: &mut Words) {
        if let Some(byte) = self.on_wire.filter(|byte| byte.ends <= now) {
            self.on_wire = None;
            let answer = self.answer();
            self.taken.push(byte.out);
            words.set(DR, answer.into());
            words.raise(SR, RXNE);
        }
    }

    /// The data register is read.
    pub fn data_read(words: &mut Words) {
        words.clear(SR, RXNE);
    }

    /// What the selected device says with the next byte.
    fn answer(&self) -> u8 {
        match self.selected {
            Some(Device::Gyro) if self.sensors.yaw().is_some() => self.gyro_byte(),
            Some(Device::Encoder(j)) if self.sensors.angle(j).is_some() => {
                let [high, low] = self.answers[j].to_be_bytes();
                if self.taken.is_empty() { high } else { low }
            }
            // the pull-up
            _ => 0xFF,
        }
    }

    fn gyro_byte(&self) -> u8 {
        let Some(first) = self.taken.first().filter(|first| *first & 0x80 != 0) else { return 0xFF };
        let [low, high] = self.sensors.yaw().unwrap_or(0).to_le_bytes();
        match usize::from(first & 0x7F) + self.taken.len() - 1 {
            0x00 => 0x0F,
            0x06 => low,
            0x07 => high,
            0x0F => self.gyro[0],
            0x10 => self.gyro[1] | 0x80,
            _ => 0,
        }
    }

    /// The outputs of the ports changed: `level` tells that of a pin.
    pub fn select(&mut self, now: u64, log: &mut Log, level: impl Fn(char, u8) -> bool) {
        let mut selected = None;
        for pin in PINS {
            let device = match pin.job {
                Job::GyroSelect => Device::Gyro,
                Job::EncoderSelect { motor } => Device::Encoder(motor),
                _ => continue,
            };
            if !level(pin.port, pin.number) && selected.replace(device).is_some() {
                log.forbid("two devices are selected at SPI1".into());
            }
        }
        if selected == self.selected {
            return;
        }
        if self.on_wire.is_some() {
            log.forbid("a device is selected or released while a byte is on its way".into());
        }
        if selected.is_some() && now < self.changed + ENCODER_WAITS {
            log.forbid("less than 350 ns between two frames".into());
        }
        self.released();
        self.taken.clear();
        self.changed = now;
        self.selected = selected;
    }

    /// A device has its transfer.
    fn released(&mut self) {
        match (self.selected, self.taken.as_slice()) {
            (Some(Device::Gyro), bytes) if !bytes.is_empty() => {
                self.transfers[0] += 1;
                match bytes {
                    [0x0F, range] => self.gyro[0] = *range,
                    [0x10, bandwidth] => self.gyro[1] = *bandwidth,
                    _ => {}
                }
            }
            (Some(Device::Encoder(j)), [high, low]) => {
                self.transfers[1] += 1;
                let command = u16::from_be_bytes([*high, *low]);
                self.answers[j] = match (even(command & 0x7FFF) == command, command & 0x7FFF) {
                    // ANGLECOM; DIAAGC with LF; anything else reads zero
                    (true, 0x7FFF) => even(self.sensors.angle(j).unwrap_or(0) & 0x3FFF),
                    (true, 0x7FFC) => even(0x0180),
                    (true, _) => 0,
                    // the error flag: a parity that was wrong
                    (false, _) => even(0x4000),
                };
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peripherals::bus::Bus;
    use crate::peripherals::map::{GPIO, GPIO_STEP};

    const PORT_D: u32 = GPIO + 3 * GPIO_STEP;

    /// A bus with all that a transfer needs, port D's pins 4 to 8 outputs and high.
    fn ready(mode: u32) -> Bus {
        let mut bus = Bus::new();
        bus.write(RCC + 0x30, 1 << 3);
        bus.write(RCC + 0x44, 1 << 12);
        bus.write(RCC + 8, 4 << 13);
        bus.write(PORT_D + 0x18, 0x01F0);
        bus.write(PORT_D, 0x0001_5500);
        bus.write(SPI1, 0x0344 | 3 << 3 | mode);
        bus.spi.sensors = SensorCodes::of(Some(-2), [Some(5), None, None, None]);
        bus
    }

    /// Bytes to the device at a pin of port D, and what it says.
    fn transfer(bus: &mut Bus, pin: u32, out: &[u8]) -> Vec<u8> {
        bus.advance(bus.now + 60);
        bus.write(PORT_D + 0x18, 1 << (pin + 16));
        bus.advance(bus.now + 60);
        let mut back = Vec::new();
        for byte in out {
            bus.write(DR, u32::from(*byte));
            bus.advance(bus.now + 255);
            assert_eq!(bus.read(SR) & RXNE, 0, "256 core cycles a byte");
            bus.advance(bus.now + 1);
            assert_eq!(bus.read(SR) & RXNE, RXNE);
            back.push(bus.read(DR) as u8);
            assert_eq!(bus.read(SR) & RXNE, 0);
        }
        bus.write(PORT_D + 0x18, 1 << pin);
        back
    }

    #[test]
    fn the_gyro_and_an_encoder_answer_as_their_data_sheets_say() {
        let mut bus = ready(0);
        assert_eq!(transfer(&mut bus, 8, &[0x80, 0])[1], 0x0F);
        transfer(&mut bus, 8, &[0x10, 0x02]);
        assert_eq!(transfer(&mut bus, 8, &[0x90, 0])[1], 0x82);
        assert_eq!(transfer(&mut bus, 8, &[0x86, 0, 0])[1..], [0xFE, 0xFF]);
        let mut bus = ready(1);
        transfer(&mut bus, 4, &[0xFF, 0xFF]);
        assert_eq!(transfer(&mut bus, 4, &[0xFF, 0xFC]), [0x00, 0x05]);
        assert_eq!(transfer(&mut bus, 4, &[0x7F, 0xFF]), [0x01, 0x80]);
        assert_eq!(transfer(&mut bus, 4, &[0xFF, 0xFF]), [0xC0, 0x00], "parity was wrong");
        assert_eq!(transfer(&mut bus, 5, &[0xFF, 0xFF]), [0xFF, 0xFF], "nobody is there");
        assert!(bus.log.forbidden.is_empty(), "{:?}", bus.log.forbidden);
    }

    #[test]
    fn what_the_data_sheets_forbid_is_told() {
        let told = |mode: u32, done: fn(&mut Bus)| {
            let mut bus = ready(mode);
            bus.advance(1000);
            done(&mut bus);
            bus.log.forbidden
        };
        assert!(told(1, |bus| drop(transfer(bus, 8, &[0]))).iter().any(|what| what.contains("mode 0")));
        assert!(told(0, |bus| drop(transfer(bus, 4, &[0]))).iter().any(|what| what.contains("mode 1")));
        let hasty = told(1, |bus| {
            bus.write(PORT_D + 0x18, 1 << 20);
            bus.write(DR, 0);
        });
        assert!(hasty.iter().any(|what| what.contains("before its first byte")), "{hasty:?}");
        let two = told(1, |bus| bus.write(PORT_D + 0x18, 3 << 20));
        assert!(two.iter().any(|what| what.contains("two devices")), "{two:?}");
        assert!(told(1, |bus| bus.write(DR, 0)).iter().any(|what| what.contains("no device")));
        let fast = told(1, |bus| {
            bus.write(SPI1, 0x0345 | 2 << 3);
            bus.write(DR, 0);
        });
        assert!(fast.iter().any(|what| what.contains("10 MHz")), "{fast:?}");
    }
}
