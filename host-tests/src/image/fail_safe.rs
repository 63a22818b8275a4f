//! # Fail-safe: from a handler's first instruction to the last enable that goes low
//!
//! Constants are followed through the registers from the entry on, and every store whose address and value are known is
//! noted with the number of its instruction. The way must be straight: what branches on a condition, returns, or is no
//! instruction that is known here ends the walk with a reason, and the way counts as not made. It ends well where it comes
//! to a place where it was before: there the handler waits. Stack may be taken once the stack pointer has been set to a
//! constant in RAM: what it was before may be what has failed.
//!
//! Sources: ARMv7-M Architecture Reference Manual (DDI 0403), A7.7, encodings beside their masks; RM0090, memory map,
//! GPIO, advanced-control timers, independent watchdog.

use std::collections::BTreeSet;

use firmware::registers::pins::{Job, PINS};

use super::elf::Image;
use super::thumb::{Action, decode, expanded};

/// Instructions up to the last enable, at most.
pub const MOST: u32 = 40;

/// Where a stack may begin: it grows down from there.
const RAM: std::ops::RangeInclusive<u32> = 0x2000_1000..=0x2002_0000;

/// Longer than this no way is followed [instructions].
const LONGEST: u32 = 1_000;

/// A store with a known address and value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Store {
    /// The number of its instruction, from 1
    pub instruction: u32,
    /// Where it goes
    pub address: u32,
    /// What it writes
    pub value: u32,
}

/// A straight way to a place where the handler waits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Way {
    /// What it writes, in order
    pub stores: Vec<Store>,
    /// The number of the first instruction that takes stack which was there before, if any does
    pub stack: Option<u32>,
}

/// What a board's peripherals must have been told by then.
struct Demand {
    what: &'static str,
    address: u32,
    /// Bits of the value that matter, and what they are to be
    mask: u32,
    bits: u32,
}

/// All demands: enables first.
fn demands() -> Vec<Demand> {
    let enables = PINS.iter().filter(|pin| matches!(pin.job, Job::Enable { .. }));
    let mut all: Vec<Demand> = enables
        .map(|pin| Demand {
            what: "an enable that goes low",
            // GPIOA at 0x4002_0000, a port every 0x400; BSRR at 0x18: bit 16 + n resets pin n, bit n sets it
            address: 0x4002_0000 + 0x400 * (u32::from(pin.port) - u32::from('A')) + 0x18,
            mask: 1 << (16 + pin.number) | 1 << pin.number,
            bits: 1 << (16 + pin.number),
        })
        .collect();
    // BDTR of TIM1 and TIM8 at 0x44: MOE is bit 15; KR of the watchdog: the key that starts it
    all.push(Demand { what: "TIM1's outputs off", address: 0x4001_0044, mask: 1 << 15, bits: 0 });
    all.push(Demand { what: "TIM8's outputs off", address: 0x4001_0444, mask: 1 << 15, bits: 0 });
    all.push(Demand { what: "the watchdog started", address: 0x4000_3000, mask: 0xFFFF, bits: 0xCCCC });
    all
}

/// Instructions from an entry to the last enable that goes low; `by_core` where the core has entered there, which a fault
/// of the stack may have made it do.
///
/// # Errors
/// What is missing on that way, or why it cannot be followed.
pub fn instructions_to_open(image: &Image, entry: u32, by_core: bool) -> Result<u32, String> {
    let way = walk(image, entry)?;
    let mut last = 0;
    for demand in demands() {
        let meets = |store: &&Store| store.address == demand.address && store.value & demand.mask == demand.bits;
        let Some(store) = way.stores.iter().find(meets) else { return Err(format!("{} is missing", demand.what)) };
        if demand.what == "an enable that goes low" {
            last = last.max(store.instruction);
        }
    }
    match way.stack {
        Some(at) if by_core && at <= last => Err(format!("instruction {at} needs the stack")),
        _ => Ok(last),
    }
}

/// Follows a way.
fn walk(image: &Image, entry: u32) -> Result<Way, String> {
    let (mut way, mut registers, mut been) = (Way::default(), [None; 16], BTreeSet::new());
    let mut fresh = false;
    let mut at = entry;
    for instruction in 1..=LONGEST {
        if !been.insert(at) {
            return Ok(way);
        }
        let function = image.function_at(at).ok_or(format!("no code at {at:#x}"))?;
        let code = function.bytes.get((at - function.address) as usize..).unwrap_or_default();
        let next = decode(at, code).ok_or(format!("no instruction at {at:#x}"))?;
        let [low, high] =
            [0, 2].map(|k| u16::from_le_bytes([code[k.min(code.len() - 2)], code[k.min(code.len() - 2) + 1]]));
        match next.does {
            Action::GoesOn => {
                let word = |address: u32| {
                    let from = address.checked_sub(function.address)? as usize;
                    Some(u32::from_le_bytes(function.bytes.get(from..from + 4)?.try_into().ok()?))
                };
                let done = if next.len == 2 {
                    short(at, low, &mut registers, word)
                } else {
                    long(at, [low, high], &mut registers, word)
                };
                match done.ok_or(format!("an unknown instruction at {at:#x}: {low:04x} {high:04x}"))? {
                    Effect::Nothing => {}
                    Effect::Store(Some(address), Some(value)) => way.stores.push(Store { instruction, address, value }),
                    Effect::Store(..) => return Err(format!("a store at {at:#x} to what is not known")),
                }
            }
            Action::Stack(_) if fresh => {}
            Action::Stack(_) => {
                way.stack.get_or_insert(instruction);
            }
            // MOV SP, Rm
            Action::StackUnknown if low & 0xFF87 == 0x4685 => {
                fresh = registers[usize::from(low >> 3 & 15)].is_some_and(|top| RAM.contains(&top));
            }
            Action::Jump { to, conditional: false } => {
                at = to;
                continue;
            }
            Action::Call(to) => {
                at = to;
                continue;
            }
            other => return Err(format!("the way is not straight at {at:#x}: {other:?}")),
        }
        at += next.len;
    }
    Err("it does not end".to_owned())
}

/// What an instruction does besides setting registers.
enum Effect {
    Nothing,
    /// Address and value, as far as they are known
    Store(Option<u32>, Option<u32>),
}

type Registers = [Option<u32>; 16];

/// An instruction of one half word; none where it is not known here.
fn short(at: u32, h: u16, registers: &mut Registers, word: impl Fn(u32) -> Option<u32>) -> Option<Effect> {
    let (low, middle, five) = (usize::from(h & 7), usize::from(h >> 3 & 7), u32::from(h >> 6 & 31));
    let (eight, eighth) = (u32::from(h & 0xFF), usize::from(h >> 8 & 7));
    match h {
        // NOP and hints 1011 1111 xxxx 0000; CPS 1011 0110 011
        _ if h & 0xFF0F == 0xBF00 || h & 0xFFE0 == 0xB660 => {}
        // LSL Rd, Rm, #imm5 00000
        _ if h & 0xF800 == 0x0000 => registers[low] = registers[middle].map(|value| value << five),
        // ADD, SUB Rd, Rn, #imm3 0001 110, 0001 111
        _ if h & 0xFE00 == 0x1C00 => registers[low] = registers[middle].map(|value| value.wrapping_add(five & 7)),
        _ if h & 0xFE00 == 0x1E00 => registers[low] = registers[middle].map(|value| value.wrapping_sub(five & 7)),
        // MOV Rd, #imm8 00100; ADD, SUB Rd, #imm8 00110, 00111
        _ if h & 0xF800 == 0x2000 => registers[eighth] = Some(eight),
        _ if h & 0xF800 == 0x3000 => registers[eighth] = registers[eighth].map(|value| value.wrapping_add(eight)),
        _ if h & 0xF800 == 0x3800 => registers[eighth] = registers[eighth].map(|value| value.wrapping_sub(eight)),
        // MOV Rd, Rm 0100 0110; d is split
        _ if h & 0xFF00 == 0x4600 => {
            registers[usize::from(h >> 4 & 8) | low] = registers[usize::from(h >> 3 & 15)];
        }
        // LDR Rt, [PC, #imm8] 01001
        _ if h & 0xF800 == 0x4800 => registers[eighth] = word((at.wrapping_add(4) & !3) + 4 * eight),
        // STR, STRH 0110 0, 1000 0; LDR, LDRB, LDRH 0110 1, 0111 1, 1000 1: from what is not followed
        _ if h & 0xF800 == 0x6000 => return Some(Effect::Store(offset(registers[middle], 4 * five), registers[low])),
        _ if h & 0xF800 == 0x8000 => return Some(Effect::Store(offset(registers[middle], 2 * five), registers[low])),
        _ if matches!(h & 0xF800, 0x6800 | 0x7800 | 0x8800) => registers[low] = None,
        _ => return None,
    }
    Some(Effect::Nothing)
}

/// An instruction of two half words; none where it is not known here.
fn long(at: u32, [h, g]: [u16; 2], registers: &mut Registers, word: impl Fn(u32) -> Option<u32>) -> Option<Effect> {
    let (base, to, target) = (usize::from(h & 15), usize::from(g >> 8 & 15), usize::from(g >> 12));
    let (i, three, eight) = (u32::from(h >> 10 & 1), u32::from(g >> 12 & 7), u32::from(g & 0xFF));
    let twelve = i << 11 | three << 8 | eight;
    match h {
        // barriers 1111 0011 1011
        0xF3BF => {}
        // MOVW 11110i 100100, MOVT 11110i 101100: imm4:i:imm3:imm8
        _ if h & 0xFBF0 == 0xF240 => registers[to] = Some(u32::from(h & 15) << 12 | twelve),
        _ if h & 0xFBF0 == 0xF2C0 => {
            let upper = (u32::from(h & 15) << 12 | twelve) << 16;
            registers[to] = registers[to].map(|value| value & 0xFFFF | upper);
        }
        // MOV.W 11110i 00010S 1111, ADD.W 11110i 01000S, SUB.W 11110i 01101S: a modified constant
        _ if h & 0xFBEF == 0xF04F => registers[to] = Some(expanded(twelve) as u32),
        _ if h & 0xFBE0 == 0xF100 => registers[to] = offset(registers[base], expanded(twelve) as u32),
        _ if h & 0xFBE0 == 0xF1A0 => {
            registers[to] = offset(registers[base], (expanded(twelve) as u32).wrapping_neg());
        }
        // LDR.W Rt, [PC, #imm12] 1111 1000 1101 1111; LDR.W Rt, [Rn, #imm12]: from what is not followed
        0xF8DF => registers[target] = word((at.wrapping_add(4) & !3) + u32::from(g & 0xFFF)),
        _ if h & 0xFFF0 == 0xF8D0 || h & 0xFFF0 == 0xF850 => registers[target] = None,
        // STR.W, STRH.W Rt, [Rn, #imm12] 1111 1000 1100, 1111 1000 1010
        _ if h & 0xFFF0 == 0xF8C0 || h & 0xFFF0 == 0xF8A0 => {
            return Some(Effect::Store(offset(registers[base], u32::from(g & 0xFFF)), registers[target]));
        }
        // STR.W Rt, [Rn, #−imm8] 1111 1000 0100, 1100
        _ if h & 0xFFF0 == 0xF840 && g & 0x0F00 == 0x0C00 => {
            return Some(Effect::Store(offset(registers[base], eight.wrapping_neg()), registers[target]));
        }
        _ => return None,
    }
    Some(Effect::Nothing)
}

fn offset(base: Option<u32>, by: u32) -> Option<u32> {
    base.map(|base| base.wrapping_add(by))
}

#[cfg(test)]
#[path = "fail_safe_tests.rs"]
mod tests;
