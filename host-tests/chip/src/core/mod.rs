//! # Core: a Cortex-M4F that executes the image
//!
//! Instructions are Unicorn's, which is the translator of QEMU. Exceptions are taken here: the frame with the registers of
//! the floating-point unit goes onto the stack every time (as without lazy stacking), and the address in the link register
//! leads to where nothing can be fetched, by which the return is seen.
//!
//! Sources: ARMv7-M architecture reference manual, exception entry and return; Cortex-M4 technical reference manual,
//! interrupt latency of 12 cycles.

pub mod cycles;
mod error;
mod exceptions;
pub mod flash_reads;
mod machine;
mod memory;
pub mod nvic;
pub mod pace;
pub mod profile;
mod semihosting;

use unicorn_engine::unicorn_const::{Arch, HookType, Mode, Permission};
use unicorn_engine::{ArmCpuModel, RegisterARM as Reg, Unicorn};

use crate::peripherals::bus::Bus;
use crate::peripherals::flash;
use exceptions::masks;
use machine::{FLASH_AT, Stop};
use memory::{map_registers, move_bytes, word};

pub use error::ChipError;
pub use machine::Machine;
pub use pace::Pace;

const RAM_AT: u64 = 0x2000_0000;
const RAM_LEN: usize = 0x2_0000;
/// Words that the factory has written (RM0090, device electronic signature).
const SYSTEM_MEMORY: u64 = 0x1FFF_7000;
/// The flash's size among them [KiB].
const FLASH_SIZE: u64 = 0x1FFF_7A22;

/// A chip with an image in its flash.
#[derive(Debug)]
pub struct Chip {
    unicorn: Unicorn<'static, Machine>,
}

impl Chip {
    /// A chip that has just been switched on, with these bytes from the beginning of its flash on.
    ///
    /// # Errors
    /// [`ChipError`] where the emulator refuses or the image is too long.
    pub fn new(image: &[u8], pace: Pace) -> Result<Self, ChipError> {
        // whole sectors: what is behind them can be erased
        let reserved = image.len().next_multiple_of(flash::SECTOR);
        if reserved >= flash::LEN {
            return Err(ChipError::Image(format!("{} bytes", image.len())));
        }
        let mut bytes = vec![0xFF; reserved];
        bytes[..image.len()].copy_from_slice(image);
        let machine = Machine::new(bytes.clone(), pace);
        let mut unicorn = Unicorn::new_with_data(Arch::ARM, Mode::THUMB | Mode::MCLASS, machine)?;
        unicorn.ctl_set_cpu_model(ArmCpuModel::UC_CPU_ARM_CORTEX_M4 as i32)?;
        unicorn.mem_map(FLASH_AT, reserved, Permission::READ | Permission::EXEC)?;
        unicorn.mem_write(FLASH_AT, &bytes)?;
        unicorn.mem_map(RAM_AT, RAM_LEN, Permission::ALL)?;
        unicorn.mem_map(SYSTEM_MEMORY, 0x1000, Permission::READ)?;
        unicorn.mem_write(FLASH_SIZE, &((flash::LEN / 1024) as u16).to_le_bytes())?;
        unicorn.get_data_mut().bus.flash.image = reserved;
        map_registers(&mut unicorn, reserved)?;
        unicorn.add_code_hook(1, 0, |unicorn, address, size| {
            let address = address as u32;
            // masks are asked for where it matters: after what is due has been done, and something waits
            let machine = unicorn.get_data_mut();
            machine.due();
            let masks = if machine.nvic.waits() { masks(unicorn) } else { (0, true) };
            let machine = unicorn.get_data_mut();
            if !machine.before(address, masks) {
                let _stopped = unicorn.emu_stop();
                return;
            }
            let at = address.wrapping_sub(FLASH_AT as u32) as usize / 2;
            let executed = machine.executed.iter_mut().skip(at).take(size as usize / 2);
            executed.for_each(|halfword| *halfword = true);
            if !machine.bus.moves.is_empty() {
                move_bytes(unicorn);
            }
        })?;
        let last = FLASH_AT + reserved as u64 - 1;
        unicorn.add_mem_hook(HookType::MEM_READ, FLASH_AT, last, |unicorn, _, address, _, _| {
            let machine = unicorn.get_data_mut();
            machine.time += machine.pace.load(address as u32);
            true
        })?;
        let mut chip = Self { unicorn };
        chip.start()?;
        Ok(chip)
    }

    /// Peripherals, interrupts, time.
    pub fn machine(&self) -> &Machine {
        self.unicorn.get_data()
    }

    /// The same, to be changed.
    pub fn machine_mut(&mut self) -> &mut Machine {
        self.unicorn.get_data_mut()
    }

    /// The core begins where the vector table says.
    fn start(&mut self) -> Result<(), ChipError> {
        let [stack, reset] = [0, 4].map(|at| word(&self.unicorn, FLASH_AT as u32 + at));
        self.unicorn.reg_write(Reg::MSP, u64::from(stack))?;
        self.unicorn.reg_write(Reg::SP, u64::from(stack))?;
        self.unicorn.reg_write(Reg::PRIMASK, 0)?;
        self.unicorn.reg_write(Reg::BASEPRI, 0)?;
        self.unicorn.reg_write(Reg::PC, u64::from(reset))?;
        Ok(())
    }

    /// Where the core is.
    pub fn pc(&self) -> u32 {
        self.unicorn.reg_read(Reg::PC).unwrap_or(0) as u32
    }

    /// Lets the core go on at an address, as a program that has gone astray.
    ///
    /// # Errors
    /// Where the emulator refuses.
    pub fn go_astray(&mut self, address: u32) -> Result<(), ChipError> {
        Ok(self.unicorn.reg_write(Reg::PC, u64::from(address | 1))?)
    }

    /// The stack pointer comes to lead nowhere.
    ///
    /// # Errors
    /// Where the emulator refuses.
    pub fn lose_stack(&mut self) -> Result<(), ChipError> {
        Ok(self.unicorn.reg_write(Reg::SP, 0x6000_0000)?)
    }

    /// Runs up to a core cycle, through resets of the watchdog.
    ///
    /// # Errors
    /// [`ChipError`] where the emulator refuses.
    pub fn run_to(&mut self, cycle: u64) -> Result<(), ChipError> {
        self.machine_mut().until = cycle;
        self.machine_mut().settle();
        while self.machine().time / 4 < cycle && self.machine().ended.is_none() {
            let pc = self.pc();
            let went = self.unicorn.emu_start(u64::from(pc | 1), 0, 0, 0);
            match (went, self.machine_mut().stop.take()) {
                (Ok(()), Some(stop)) => self.stopped(stop)?,
                // nothing can be fetched there: the return of an exception
                _ if self.pc() >= exceptions::RETURNS => exceptions::leave(&mut self.unicorn)?,
                // what a program on a board asks its probe
                _ if word(&self.unicorn, self.pc()) as u16 == semihosting::BREAKPOINT => {
                    semihosting::answer(&mut self.unicorn)?
                }
                // an access or a fetch that leads nowhere, an instruction that is none
                _ => exceptions::enter(&mut self.unicorn, 3)?,
            }
        }
        Ok(())
    }

    fn stopped(&mut self, stop: Stop) -> Result<(), ChipError> {
        match stop {
            Stop::Until => Ok(()),
            Stop::Reset => {
                self.machine_mut().reset();
                self.start()
            }
            Stop::Exception => {
                let (basepri, primask) = masks(&self.unicorn);
                match self.machine().nvic.next(basepri, primask) {
                    Some(exception) => exceptions::enter(&mut self.unicorn, exception),
                    None => Ok(()),
                }
            }
            Stop::Sleep => self.sleep(),
        }
    }

    /// Nothing is executed until something waits.
    fn sleep(&mut self) -> Result<(), ChipError> {
        while !self.machine().nvic.waits() {
            let machine = self.machine_mut();
            let to = machine.next.min(machine.until).max(machine.time / 4);
            machine.time = machine.time.max(4 * to);
            machine.advance(to);
            if machine.bus.reset {
                machine.reset();
                return self.start();
            }
            if to >= machine.until {
                return Ok(());
            }
            move_bytes(&mut self.unicorn);
        }
        let pc = self.pc();
        self.unicorn.reg_write(Reg::PC, u64::from((pc + 2) | 1))?;
        Ok(())
    }

    /// Puts bytes on the wire to the chip.
    pub fn send(&mut self, bytes: &[u8]) {
        let machine = self.machine_mut();
        let now = machine.time / 4;
        let Bus { link, words, .. } = &mut machine.bus;
        link.put(now, words, bytes);
        machine.settle();
    }

    /// That something did not come.
    pub fn late(&self, what: &str, cycles: u64) -> ChipError {
        ChipError::Late { what: what.into(), cycles, pc: self.pc(), active: self.machine().nvic.active.clone() }
    }

    /// The core cycle that it is.
    pub fn now(&self) -> u64 {
        self.machine().time / 4
    }
}
