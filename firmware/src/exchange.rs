//! # Exchange: what the emulated board and its host tell each other, once a period
//!
//! In place of timers, converters and pins the emulated board has two files. It writes an [`UpFrame`] and then waits
//! for a [`DownFrame`]; the host, which has the motors and the robot, does the opposite. So the host is the clock:
//! nothing here depends on how fast either side runs.
//!
//! What an [`UpFrame`] asks for holds over the period that follows; the codes of a [`DownFrame`] are those of that
//! period, sampled when [`crate::registers::timing`] says.

use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::link::sensor_codes::SensorCodes;

use crate::codes::{Codes, MOTORS};
pub use crate::registers::timing::{TOPS, compare};

/// The name of the file from the image to the host, in QEMU's working folder.
pub const UP_FILE: &str = "omni-up";
/// The name of the file from the host to the image.
pub const DOWN_FILE: &str = "omni-down";

/// Bytes that the link carries in a period: 2 Mbaud.
pub const LINK_BYTES: usize = 10;

/// From the image to the host.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UpFrame {
    /// Periods since the start
    pub period: u32,
    /// Compare counts of every motor's three phases, of [`TOPS`]
    pub compare: [[u16; 3]; MOTORS],
    /// One bit a motor: its gate driver is enabled
    pub enabled: u8,
    /// The watchdog has fired: the program starts anew after this period
    pub watchdog_fired: bool,
    /// The program has failed, and its board waits for the watchdog with the bridges open
    pub fail_safe: bool,
    /// Processor cycles that the last current turn took, as the emulator counts
    pub cycles: u16,
    /// Bytes for the link
    pub link: LinkBytes,
}

/// From the host to the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DownFrame {
    /// What the converters, the hall lines and the fault line say
    pub codes: Codes,
    /// True: the image is to end
    pub end: bool,
    /// Injected: what the program is to fail by
    pub crash: Option<Crash>,
    /// Injected overrun: so many times 64 idle instructions in the current turn
    pub burn_current: u16,
    /// The same in the next motion turn
    pub burn_motion: u16,
    /// Bytes from the link
    pub link: LinkBytes,
    /// What gyro and encoders say where they are asked in this period
    pub sensors: SensorCodes,
}

/// What a program may fail by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Crash {
    /// It panics
    Panic = 1,
    /// It executes what is no instruction
    HardFault,
    /// The same, after its stack pointer has come to lead nowhere
    Stack,
    /// An interrupt comes that nothing is bound to
    UnknownInterrupt,
    /// The non-maskable interrupt comes, as from a crystal that stops
    NonMaskable,
}

impl Crash {
    /// All of them, in the order of their codes.
    pub const ALL: [Crash; 5] =
        [Crash::Panic, Crash::HardFault, Crash::Stack, Crash::UnknownInterrupt, Crash::NonMaskable];
}

/// What the link carries in one period, [`LINK_BYTES`] at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LinkBytes {
    held: [u8; LINK_BYTES],
    len: u8,
}

impl LinkBytes {
    /// As many of these bytes as a period has room for.
    pub fn of(bytes: &[u8]) -> Self {
        let mut held = [0; LINK_BYTES];
        let mut len = 0;
        for (to, from) in held.iter_mut().zip(bytes) {
            *to = *from;
            len += 1;
        }
        Self { held, len }
    }

    /// The bytes.
    pub fn as_slice(&self) -> &[u8] {
        self.held.get(..usize::from(self.len)).unwrap_or(&self.held)
    }
}

impl UpFrame {
    /// Bytes of this frame.
    pub const LEN: usize = 44;

    /// The frame's bytes, little endian.
    pub fn to_bytes(&self) -> [u8; Self::LEN] {
        let mut bytes = [0; Self::LEN];
        let mut put = Cursor { bytes: &mut bytes, at: 0 };
        put.put(self.period.to_le_bytes());
        self.compare.as_flattened().iter().for_each(|count| put.put(count.to_le_bytes()));
        put.put([self.enabled, u8::from(self.watchdog_fired) | u8::from(self.fail_safe) << 1]);
        put.put(self.cycles.to_le_bytes());
        put.put([self.link.len]);
        put.put(self.link.held);
        bytes
    }

    /// The frame of these bytes.
    pub fn from_bytes(bytes: &[u8; Self::LEN]) -> Self {
        let mut get = Reader { bytes, at: 0 };
        let period = u32::from_le_bytes(get.take());
        let compare = [(); MOTORS].map(|()| [(); 3].map(|()| u16::from_le_bytes(get.take())));
        let [enabled, flags] = get.take();
        let cycles = u16::from_le_bytes(get.take());
        let (watchdog_fired, fail_safe) = (flags & 1 != 0, flags & 2 != 0);
        Self { period, compare, enabled, watchdog_fired, fail_safe, cycles, link: get.link() }
    }
}

impl DownFrame {
    /// Bytes of this frame.
    pub const LEN: usize = 58;

    /// The frame's bytes, little endian.
    pub fn to_bytes(&self) -> [u8; Self::LEN] {
        let mut bytes = [0; Self::LEN];
        let mut put = Cursor { bytes: &mut bytes, at: 0 };
        self.codes.phases.as_flattened().iter().for_each(|code| put.put(code.0.to_le_bytes()));
        put.put(self.codes.bus.0.to_le_bytes());
        put.put(self.codes.halls.map(|code| code.0));
        put.put([u8::from(self.codes.driver_fault), u8::from(self.end), self.crash.map_or(0, |crash| crash as u8)]);
        put.put(self.burn_current.to_le_bytes());
        put.put(self.burn_motion.to_le_bytes());
        put.put([self.link.len]);
        put.put(self.link.held);
        put.put(self.sensors.to_bytes());
        bytes
    }

    /// The frame of these bytes.
    pub fn from_bytes(bytes: &[u8; Self::LEN]) -> Self {
        let mut get = Reader { bytes, at: 0 };
        let phases = [(); MOTORS].map(|()| [(); 3].map(|()| AdcCode(u16::from_le_bytes(get.take()))));
        let bus = AdcCode(u16::from_le_bytes(get.take()));
        let halls = get.take().map(HallCode);
        let [line, end, crash] = get.take();
        let crash = Crash::ALL.into_iter().find(|known| *known as u8 == crash);
        let codes = Codes { phases, bus, halls, driver_fault: line != 0 };
        let burn_current = u16::from_le_bytes(get.take());
        let burn_motion = u16::from_le_bytes(get.take());
        let link = get.link();
        let sensors = SensorCodes::from_bytes(&get.take());
        Self { codes, end: end != 0, crash, burn_current, burn_motion, link, sensors }
    }
}

/// Writes numbers one behind the other; what does not fit is left out, which a test of the lengths excludes.
struct Cursor<'a> {
    bytes: &'a mut [u8],
    at: usize,
}

impl Cursor<'_> {
    fn put<const K: usize>(&mut self, number: [u8; K]) {
        if let Some(to) = self.bytes.get_mut(self.at..self.at + K) {
            to.copy_from_slice(&number);
        }
        self.at += K;
    }
}

/// Reads numbers one behind the other; zeros past the end, which a test of the lengths excludes.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn take<const K: usize>(&mut self) -> [u8; K] {
        let from = self.bytes.get(self.at..self.at + K).and_then(|from| from.try_into().ok());
        self.at += K;
        from.unwrap_or([0; K])
    }

    fn link(&mut self) -> LinkBytes {
        let [len] = self.take();
        LinkBytes { held: self.take(), len: len.min(LINK_BYTES as u8) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_up_frame_comes_back_as_it_was() {
        let up = UpFrame {
            period: 0x8123_4567,
            compare: [[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 4200]],
            enabled: 0b1010,
            watchdog_fired: true,
            fail_safe: true,
            cycles: 65_000,
            link: LinkBytes::of(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 255]),
        };
        assert_eq!(UpFrame::from_bytes(&up.to_bytes()), up);
        // the last byte but one is the link's last: nothing was left out
        assert_eq!(up.to_bytes()[UpFrame::LEN - 2], 255);
    }

    #[test]
    fn a_down_frame_comes_back_as_it_was() {
        let code = |k: u16| AdcCode(4000 + k);
        let down = DownFrame {
            codes: Codes {
                phases: [
                    [code(1), code(2), code(3)],
                    [code(4), code(5), code(6)],
                    [code(7), code(8), code(9)],
                    [code(10), code(11), code(12)],
                ],
                bus: AdcCode(1354),
                halls: [1, 3, 2, 6].map(HallCode),
                driver_fault: true,
            },
            end: true,
            crash: Some(Crash::UnknownInterrupt),
            burn_current: 513,
            burn_motion: 1027,
            link: LinkBytes::of(&[9; LINK_BYTES]),
            sensors: SensorCodes::of(Some(-5), [Some(1), None, Some(3), Some(0x0809)]),
        };
        assert_eq!(DownFrame::from_bytes(&down.to_bytes()), down);
        assert_eq!(down.to_bytes()[DownFrame::LEN - 2..], [9, 8]);
    }

    #[test]
    fn the_link_takes_what_a_period_has_room_for() {
        assert_eq!(LinkBytes::of(&[7; 40]).as_slice(), &[7; LINK_BYTES]);
        assert_eq!(LinkBytes::of(&[]).as_slice(), &[] as &[u8]);
        // a length that cannot be is cut
        let mut bytes = UpFrame::default().to_bytes();
        bytes[32] = 200;
        assert_eq!(UpFrame::from_bytes(&bytes).link.as_slice().len(), LINK_BYTES);
    }
}
