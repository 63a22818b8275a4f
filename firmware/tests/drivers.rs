//! The drivers around the chip, against parts that only do what the traits promise.

use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::digital::{Mock as PinMock, State, Transaction as PinDo};
use embedded_hal_mock::eh1::pwm::{Mock as PwmMock, Transaction as PwmDo};
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use firmware::drivers::fault::FaultLine;
use firmware::drivers::flash_slots::{HEAD, MAX_BLOCK, Slot, StoreError, find, save};
use firmware::drivers::gate::{GateDriver, GateFault};
use firmware::drivers::halls::HallLines;
use firmware::drivers::heartbeat::{Heartbeats, Task};
use model_core::control::halls::HallCode;

fn broken() -> MockError {
    MockError::Io(std::io::ErrorKind::BrokenPipe)
}

/// A PWM channel of 4200 counts that is told these.
fn pwm(counts: &[u16]) -> PwmMock {
    let feedback: Vec<_> =
        counts.iter().flat_map(|count| [PwmDo::max_duty_cycle(4200), PwmDo::set_duty_cycle(*count)]).collect();
    PwmMock::new(&feedback)
}

/// A pin that reads a level, or fails.
fn line(level: Option<bool>) -> PinMock {
    let read = |high| PinDo::get(if high { State::High } else { State::Low });
    PinMock::new(&[level.map_or_else(|| read(false).with_error(broken()), read)])
}

/// Runs a gate driver on channels and an enable that expect these, and sees that all of it has been done.
fn gate(
    channels: [PwmMock; 3],
    enable: &[PinDo],
    run: impl FnOnce(&mut GateDriver<PwmMock, PwmMock, PwmMock, PinMock>),
) {
    let enable = PinMock::new(enable);
    let [a, b, c] = channels.clone();
    run(&mut GateDriver::new(a, b, c, enable.clone()).unwrap());
    channels.into_iter().for_each(|mut channel| channel.done());
    { enable }.done();
}

#[test]
fn a_gate_driver_comes_up_open() {
    gate([pwm(&[]), pwm(&[]), pwm(&[])], &[PinDo::set(State::Low)], |_| ());
}

#[test]
fn a_duty_of_zero_brakes_and_only_the_enable_opens() {
    let enable = [PinDo::set(State::Low), PinDo::set(State::High), PinDo::set(State::Low)];
    gate([pwm(&[0]), pwm(&[0]), pwm(&[0])], &enable, |driver| {
        driver.drive([0.0; 3]).unwrap();
        driver.open().unwrap();
    });
}

#[test]
fn duties_become_counts_and_only_driving_closes_the_bridge() {
    let counts = [pwm(&[1050, 0]), pwm(&[2100, 0]), pwm(&[3840, 0])];
    gate(counts, &[PinDo::set(State::Low), PinDo::set(State::High)], |driver| {
        driver.drive([0.25, 0.5, firmware::registers::timing::MAX_DUTY]).unwrap();
        driver.set([0.0; 3]).unwrap();
    });
}

#[test]
fn a_channel_that_fails_opens_the_bridge() {
    let fails = PwmMock::new(&[PwmDo::max_duty_cycle(4200), PwmDo::set_duty_cycle(2100).with_error(broken())]);
    gate([fails, pwm(&[]), pwm(&[])], &[PinDo::set(State::Low), PinDo::set(State::Low)], |driver| {
        assert_eq!(driver.drive([0.5; 3]), Err(GateFault::Channel));
    });
}

#[test]
fn hall_lines_are_bits_one_two_and_four() {
    for code in 0..8_u8 {
        let [mut a, mut b, mut c] = [0, 1, 2].map(|bit| line(Some(code >> bit & 1 == 1)));
        assert_eq!(HallLines::new(a.clone(), b.clone(), c.clone()).code(), HallCode(code));
        for mock in [&mut a, &mut b, &mut c] {
            mock.done();
        }
    }
}

#[test]
fn a_hall_line_that_cannot_be_read_makes_the_illegal_code() {
    let [mut a, mut b, mut c] = [line(Some(true)), line(None), line(Some(true))];
    assert_eq!(HallLines::new(a.clone(), b.clone(), c.clone()).code(), HallCode(0));
    for mock in [&mut a, &mut b, &mut c] {
        mock.done();
    }
}

#[test]
fn the_fault_line_is_pulled_when_low_and_when_it_cannot_be_read() {
    for (level, pulled) in [(Some(false), true), (Some(true), false), (None, true)] {
        let mut pin = line(level);
        assert_eq!(FaultLine::new(pin.clone()).is_pulled(), pulled);
        pin.done();
    }
}

#[test]
fn the_dog_is_fed_only_if_every_task_has_been_seen_since() {
    let all = [Task::Current, Task::Motion, Task::Listen, Task::Record];
    for missing in all {
        let heartbeats = Heartbeats::new();
        for task in all.into_iter().filter(|task| *task != missing) {
            heartbeats.beat(task);
            heartbeats.beat(task);
        }
        assert!(!heartbeats.all_alive(), "{missing:?} is missing");
        heartbeats.beat(missing);
        assert!(heartbeats.all_alive());
        assert!(!heartbeats.all_alive(), "the roll begins anew");
    }
}

/// Flash whose supply fails after so many steps: a byte written, or an eighth of an erase.
#[derive(Clone)]
struct Flash<const WRITE: usize = 1> {
    bytes: Vec<u8>,
    steps: usize,
}

#[derive(Debug)]
struct Dead;

impl NorFlashError for Dead {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

const SECTOR: usize = 2048;
const SLOTS: [Slot; 2] = [Slot { from: 2048, to: 4096 }, Slot { from: 4096, to: 6144 }];

impl<const WRITE: usize> Flash<WRITE> {
    fn new() -> Self {
        Self { bytes: vec![0xFF; 3 * SECTOR], steps: usize::MAX }
    }

    fn step(&mut self) -> Result<(), Dead> {
        self.steps = self.steps.checked_sub(1).ok_or(Dead)?;
        Ok(())
    }

    fn block(&mut self) -> Option<Vec<u8>> {
        let stored = find(self, &SLOTS)?;
        Some(self.bytes[stored.at as usize..][..stored.len].to_vec())
    }
}

impl<const WRITE: usize> ErrorType for Flash<WRITE> {
    type Error = Dead;
}

impl<const WRITE: usize> ReadNorFlash for Flash<WRITE> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Dead> {
        let from = self.bytes.get(offset as usize..offset as usize + bytes.len()).ok_or(Dead)?;
        bytes.copy_from_slice(from);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const WRITE: usize> NorFlash for Flash<WRITE> {
    const WRITE_SIZE: usize = WRITE;
    const ERASE_SIZE: usize = SECTOR;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Dead> {
        // an erase that is cut short leaves some bytes erased and some not
        for eighth in 0..8 {
            self.step()?;
            for at in from as usize..to as usize {
                if at % 8 == eighth {
                    self.bytes[at] = 0xFF;
                }
            }
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Dead> {
        assert!(
            (offset as usize).is_multiple_of(WRITE) && bytes.len().is_multiple_of(WRITE),
            "only whole words are written"
        );
        for (at, byte) in bytes.iter().enumerate() {
            self.step()?;
            // flash only clears bits
            self.bytes[offset as usize + at] &= byte;
        }
        Ok(())
    }
}

#[test]
fn an_empty_store_has_no_block() {
    assert_eq!(Flash::<1>::new().block(), None);
}

#[test]
fn the_block_kept_last_is_in_force() {
    let mut flash = Flash::<1>::new();
    for round in 0..6_u8 {
        let block = vec![round; 100 + usize::from(round)];
        let stored = save(&mut flash, &SLOTS, &block).unwrap();
        assert_eq!(stored.slot, usize::from(round % 2), "the slots take turns");
        assert_eq!(flash.block(), Some(block));
    }
}

#[test]
fn blocks_of_any_length_fit_words_of_any_size() {
    let mut flash = Flash::<8>::new();
    for len in [0, 1, 7, 8, 9, 511, 512, MAX_BLOCK] {
        let block: Vec<u8> = (0..len).map(|at| at as u8).collect();
        save(&mut flash, &SLOTS, &block).unwrap();
        assert_eq!(flash.block(), Some(block));
    }
}

#[test]
fn a_power_loss_at_any_step_leaves_the_old_block_or_the_new_one() {
    let (old, new) = (vec![0x5A; 300], vec![0xA5; 200]);
    let mut before = Flash::<1>::new();
    // both slots have been used, so that the one to erase holds an older block
    for block in [vec![1; 50], vec![2; 60], old.clone()] {
        save(&mut before, &SLOTS, &block).unwrap();
    }
    let whole = 8 + new.len() + HEAD;
    let mut lasted = 0;
    for steps in 0..=whole {
        let mut flash = Flash { steps, ..before.clone() };
        let stored = save(&mut flash, &SLOTS, &new);
        flash.steps = usize::MAX;
        let found = flash.block().expect("a block is in force");
        assert!(found == old || found == new, "after {steps} steps");
        if stored.is_ok() {
            assert_eq!(found, new, "what was said to be kept is");
        }
        lasted += usize::from(found == new);
        // and the store still works
        save(&mut flash, &SLOTS, &[7; 9]).unwrap();
        assert_eq!(flash.block(), Some(vec![7; 9]));
    }
    assert_eq!(lasted, 1, "the last byte of the head puts the new block in force");
}

#[test]
fn a_block_that_is_too_long_is_refused_before_anything_is_erased() {
    let mut flash = Flash::<1>::new();
    save(&mut flash, &SLOTS, &[3; 3]).unwrap();
    assert_eq!(save(&mut flash, &SLOTS, &vec![0; MAX_BLOCK + 1]), Err(StoreError::TooLong));
    assert_eq!(flash.block(), Some(vec![3; 3]));
}

#[test]
fn a_flipped_bit_anywhere_in_the_newer_slot_brings_the_older_block_back() {
    let mut flash = Flash::<1>::new();
    save(&mut flash, &SLOTS, &[1; 20]).unwrap();
    let newer = save(&mut flash, &SLOTS, &[2; 20]).unwrap();
    for at in newer.at as usize - HEAD..newer.at as usize + newer.len {
        let mut worn = flash.clone();
        worn.bytes[at] ^= 0x10;
        assert_eq!(worn.block(), Some(vec![1; 20]), "byte {at}");
    }
}
