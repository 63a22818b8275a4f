//! # Thumb: what an instruction does to the flow and to the stack pointer
//!
//! Not a disassembler: of the Thumb-2 instructions only those are told apart that branch, call, return or move the
//! stack pointer. Every other one goes on to the next, and its length follows from its first five bits.
//!
//! Source: ARMv7-M Architecture Reference Manual (DDI 0403), A5.2–A5.3 and A7.7; encodings are quoted beside their
//! masks.

/// What an instruction does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Nothing that matters here
    GoesOn,
    /// Moves the stack pointer by so many bytes; negative takes room
    Stack(i32),
    /// Sets the stack pointer to what cannot be told from the instruction
    StackUnknown,
    /// The next so many instructions depend on a condition (IT)
    Conditions(u8),
    /// Goes to an address
    Jump {
        /// Where to
        to: u32,
        /// It may also go on
        conditional: bool,
    },
    /// Goes through a table of bytes or half words behind it
    Table {
        /// Half words
        wide: bool,
    },
    /// Goes through such a table at an address in a register
    TableAt {
        /// Half words
        wide: bool,
        /// The register
        register: u8,
    },
    /// Puts an address into a register
    Address {
        /// The register
        register: u8,
        /// What it then says
        address: u32,
    },
    /// Goes to the address that stands at an address
    JumpVia(u32),
    /// Goes to an address in a register or in memory
    JumpUnknown,
    /// Calls an address
    Call(u32),
    /// Calls an address in a register
    CallUnknown,
    /// Returns, after so many bytes were taken off the stack
    Return(i32),
    /// Ends the flow: an undefined instruction on purpose
    Trap,
}

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Its bytes: 2 or 4
    pub len: u32,
    /// What it does
    pub does: Action,
}

const SP: u16 = 13;
const PC: u16 = 15;

/// The instruction at an address, of code that begins there; `None` where the code ends within it.
pub fn decode(address: u32, code: &[u8]) -> Option<Instruction> {
    let half = |k: usize| Some(u16::from_le_bytes([*code.get(2 * k)?, *code.get(2 * k + 1)?]));
    let first = half(0)?;
    // 11101, 11110 and 11111 begin an instruction of two half words
    if first >> 11 >= 0b11101 {
        Some(Instruction { len: 4, does: long(address, first, half(1)?) })
    } else {
        Some(Instruction { len: 2, does: short(address, first) })
    }
}

/// `value` with its lowest `bits` read as a signed number.
fn signed(value: u32, bits: u32) -> i32 {
    (value << (32 - bits)) as i32 >> (32 - bits)
}

/// A target `offset` bytes from the address that the program counter reads as.
fn target(address: u32, offset: i32) -> u32 {
    address.wrapping_add(4).wrapping_add_signed(offset)
}

fn short(address: u32, h: u16) -> Action {
    let registers = (h & 0xFF).count_ones() as i32;
    let seven = i32::from(h & 0x7F) * 4;
    match h {
        // PUSH 1011 010M; POP 1011 110P
        _ if h & 0xFE00 == 0xB400 => Action::Stack(-4 * (registers + i32::from(h >> 8 & 1))),
        _ if h & 0xFF00 == 0xBC00 => Action::Stack(4 * registers),
        _ if h & 0xFF00 == 0xBD00 => Action::Return(4 * (registers + 1)),
        // ADD SP, #imm7 1011 0000 0; SUB SP, #imm7 1011 0000 1
        _ if h & 0xFF80 == 0xB000 => Action::Stack(seven),
        _ if h & 0xFF80 == 0xB080 => Action::Stack(-seven),
        // ADD Rd, Rm 0100 0100; MOV Rd, Rm 0100 0110; d is split: bit 7 and bits 2 to 0
        _ if h & 0xFD00 == 0x4400 => match (h >> 4 & 8) | (h & 7) {
            SP => Action::StackUnknown,
            PC if h == 0x46F7 => Action::Return(0),
            PC => Action::JumpUnknown,
            _ => Action::GoesOn,
        },
        // ADR Rd, #imm8 1010 0ddd
        _ if h & 0xF800 == 0xA000 => address_behind(address, h >> 8 & 7, u32::from(h & 0xFF) * 4),
        // BX LR; BX Rm 0100 0111 0; BLX Rm 0100 0111 1
        0x4770 => Action::Return(0),
        _ if h & 0xFF80 == 0x4700 => Action::JumpUnknown,
        _ if h & 0xFF80 == 0x4780 => Action::CallUnknown,
        // CBZ, CBNZ 1011 x0i1 imm5
        _ if h & 0xF500 == 0xB100 => {
            let offset = (h >> 3 & 0x40) | (h >> 2 & 0x3E);
            Action::Jump { to: target(address, i32::from(offset)), conditional: true }
        }
        // IT 1011 1111, a mask that is not zero: its lowest one says how many follow
        _ if h & 0xFF00 == 0xBF00 && h & 0xF != 0 => Action::Conditions(4 - (h & 0xF).trailing_zeros() as u8),
        // UDF 1101 1110, SVC 1101 1111, B<c> 1101 cccc imm8
        _ if h & 0xFF00 == 0xDE00 => Action::Trap,
        _ if h & 0xFF00 == 0xDF00 => Action::GoesOn,
        _ if h & 0xF000 == 0xD000 => {
            Action::Jump { to: target(address, signed(u32::from(h & 0xFF) << 1, 9)), conditional: true }
        }
        // B 11100 imm11
        _ if h & 0xF800 == 0xE000 => {
            Action::Jump { to: target(address, signed(u32::from(h & 0x7FF) << 1, 12)), conditional: false }
        }
        _ => Action::GoesOn,
    }
}

fn long(address: u32, h: u16, g: u16) -> Action {
    let base = h & 0xF;
    match h >> 9 {
        // 1110 100: load and store, multiple, dual, exclusive, table branch
        0b111_0100 if h & 0x40 == 0 => multiple(h, g, base),
        0b111_0100 => dual(h, g, base),
        // 1110 101: data processing with a shifted register; d is g<11:8>
        0b111_0101 if g >> 8 & 0xF == SP => Action::StackUnknown,
        // 1110 110: coprocessor load and store, among them VPUSH and VPOP
        0b111_0110 if base == SP && h & 0x20 != 0 && g & 0x0E00 == 0x0A00 => {
            let bytes = 4 * i32::from(g & 0xFF);
            Action::Stack(if h & 0x80 != 0 { bytes } else { -bytes })
        }
        // 1111 0: branches and control with g<15>, otherwise data processing with a constant
        0b111_1000..=0b111_1011 if g & 0x8000 != 0 => branch(address, h, g),
        0b111_1000..=0b111_1011 if g >> 8 & 0xF == SP => constant(h, g, base),
        // ADR Rd, #i:imm3:imm8 1111 0i10 0000 1111 0mmm dddd; what counts downwards is no table behind it
        _ if h & 0xFBFF == 0xF20F => {
            let offset = u32::from(h >> 10 & 1) << 11 | u32::from(g >> 12 & 7) << 8 | u32::from(g & 0xFF);
            address_behind(address, g >> 8 & 0xF, offset)
        }
        // 1111 100: load and store of one register
        0b111_1100 => single(address, h, g, base),
        _ => Action::GoesOn,
    }
}

/// The address so many bytes behind what the program counter reads as, rounded down to a word.
fn address_behind(address: u32, register: u16, offset: u32) -> Action {
    Action::Address { register: register as u8, address: (address.wrapping_add(4) & !3).wrapping_add(offset) }
}

/// LDM, STM: 1110 100o o0WL nnnn, o = 01 upwards, 10 downwards.
fn multiple(h: u16, g: u16, base: u16) -> Action {
    let (load, write_back) = (h & 0x10 != 0, h & 0x20 != 0);
    let loads_pc = load && g & 0x8000 != 0;
    match (base == SP, loads_pc) {
        (true, true) => Action::Return(4 * g.count_ones() as i32),
        (false, true) => Action::JumpUnknown,
        (true, false) if write_back => {
            let bytes = 4 * g.count_ones() as i32;
            Action::Stack(if h & 0x80 != 0 { bytes } else { -bytes })
        }
        _ => Action::GoesOn,
    }
}

/// LDRD, STRD: 1110 100P U1WL nnnn, P or W; TBB, TBH: 1110 1000 1101 nnnn 1111 0000 000H.
fn dual(h: u16, g: u16, base: u16) -> Action {
    if h & 0xFFF0 == 0xE8D0 && g & 0xFFE0 == 0xF000 {
        let wide = g & 0x10 != 0;
        return if base == PC { Action::Table { wide } } else { Action::TableAt { wide, register: base as u8 } };
    }
    if base == SP && h & 0x20 != 0 {
        let bytes = 4 * i32::from(g & 0xFF);
        return Action::Stack(if h & 0x80 != 0 { bytes } else { -bytes });
    }
    Action::GoesOn
}

/// LDR, STR and their kin: 1111 100S Uss L nnnn; with an 8-bit offset g = tttt 1PUW imm8.
fn single(address: u32, h: u16, g: u16, base: u16) -> Action {
    // 1111 1010 and 1011 are data processing
    if h & 0xFE00 != 0xF800 {
        return Action::GoesOn;
    }
    let wide_offset = h & 0x80 != 0;
    let load_word = h & 0x0170 == 0x0050;
    if load_word && g >> 12 == PC {
        return match base {
            // LDR PC, [SP], #imm8
            SP => Action::Return(i32::from(g & 0xFF)),
            PC => {
                let offset = i32::from(g & 0xFFF) * if wide_offset { 1 } else { -1 };
                Action::JumpVia((address.wrapping_add(4) & !3).wrapping_add_signed(offset))
            }
            _ => Action::JumpUnknown,
        };
    }
    // 1PUW with W: the base is written back
    if base == SP && !wide_offset && g & 0x0900 == 0x0900 {
        let bytes = i32::from(g & 0xFF);
        return Action::Stack(if g & 0x0200 != 0 { bytes } else { -bytes });
    }
    if load_word && g >> 12 == SP { Action::StackUnknown } else { Action::GoesOn }
}

/// B, BL, B<c> and what lies between them: 1111 0S…, g = 1xJxJ….
fn branch(address: u32, h: u16, g: u16) -> Action {
    let (h, g) = (u32::from(h), u32::from(g));
    let (s, j1, j2) = (h >> 10 & 1, g >> 13 & 1, g >> 11 & 1);
    // I1 = NOT(J1 EOR S), I2 = NOT(J2 EOR S); offset S:I1:I2:imm10:imm11:0
    let far = s << 24 | (j1 ^ s ^ 1) << 23 | (j2 ^ s ^ 1) << 22 | (h & 0x3FF) << 12 | (g & 0x7FF) << 1;
    match g & 0xD000 {
        0xD000 => Action::Call(target(address, signed(far, 25))),
        0x9000 => Action::Jump { to: target(address, signed(far, 25)), conditional: false },
        // B<c> has a condition below 1110: offset S:J2:J1:imm6:imm11:0
        0x8000 if h >> 7 & 7 != 7 => {
            let near = s << 20 | j2 << 19 | j1 << 18 | (h & 0x3F) << 12 | (g & 0x7FF) << 1;
            Action::Jump { to: target(address, signed(near, 21)), conditional: true }
        }
        // UDF 1111 0111 1111 nnnn 1010
        0x8000 if h & 0xFFF0 == 0xF7F0 && g & 0xF000 == 0xA000 => Action::Trap,
        _ => Action::GoesOn,
    }
}

/// Data processing with a constant whose result is the stack pointer.
fn constant(h: u16, g: u16, base: u16) -> Action {
    let (i, imm3, imm8) = (u32::from(h >> 10 & 1), u32::from(g >> 12 & 7), u32::from(g & 0xFF));
    let twelve = i << 11 | imm3 << 8 | imm8;
    if base != SP {
        return Action::StackUnknown;
    }
    match h & 0xFBE0 {
        // ADD.W 11110i 0 1000S, SUB.W 11110i 0 1101S: a modified constant; ADDW 11110i 1 00000, SUBW 11110i 1 01010:
        // plain
        0xF100 => Action::Stack(expanded(twelve)),
        0xF1A0 => Action::Stack(-expanded(twelve)),
        0xF200 => Action::Stack(twelve as i32),
        0xF2A0 => Action::Stack(-(twelve as i32)),
        _ => Action::StackUnknown,
    }
}

/// ThumbExpandImm.
pub(super) fn expanded(twelve: u32) -> i32 {
    let byte = twelve & 0xFF;
    let value = match twelve >> 8 {
        0 => byte,
        1 => byte << 16 | byte,
        2 => byte << 24 | byte << 8,
        3 => byte << 24 | byte << 16 | byte << 8 | byte,
        _ => (0x80 | twelve & 0x7F).rotate_right(twelve >> 7),
    };
    value as i32
}

#[cfg(test)]
#[path = "thumb_tests.rs"]
mod tests;
