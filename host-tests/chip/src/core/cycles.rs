//! # Cycles: how long an instruction takes at most
//!
//! | instruction | cycles |
//! |---|---|
//! | load, store of one register | 2 |
//! | load, store of N registers, push, pop; of the floating-point unit too | 1 + N |
//! | integer division | 12 |
//! | reading or writing a special register, changing the masks | 2 |
//! | floating point: multiply-accumulate | 3 |
//! | floating point: division, root | 14 |
//! | any other | 1 |
//! | a branch that is taken, or a load of the program counter | 3 more |
//! | arithmetic of floating point, whose result the next instruction may wait for | 1 more |
//!
//! Where the manual has a range the largest number stands here: a load behind a load often takes one cycle, a division often
//! less than twelve, a refill of the pipeline often one.
//!
//! Source: Arm Cortex-M4 Processor Technical Reference Manual (100166), tables 3-1 and 7-1, cycles with zero wait states.

/// Cycles that a refill of the pipeline adds: the manual's P is 1 to 3.
pub const REFILL: u32 = 3;

/// Cycles of an instruction whose half words these are (the second one counts for long ones alone), its branch not taken.
pub fn cycles(first: u16, second: u16) -> u32 {
    if is_long(first) { long(first, second) } else { short(first) }
}

/// True for an instruction of two half words.
pub const fn is_long(first: u16) -> bool {
    // 11101, 11110 and 11111 begin one
    first >> 11 >= 0b11101
}

fn short(h: u16) -> u32 {
    let registers = (h & 0xFF).count_ones();
    match h {
        // LDR from behind the code, and all loads and stores of one register: 01001, 0101 to 1001
        _ if matches!(h >> 11, 0b01001..=0b10011) => 2,
        // PUSH 1011 010M, POP 1011 110P
        _ if matches!(h & 0xFE00, 0xB400 | 0xBC00) => 1 + registers + u32::from(h >> 8 & 1),
        // STM, LDM 1100
        _ if h & 0xF000 == 0xC000 => 1 + registers,
        // CPS 1011 0110 011
        _ if h & 0xFFE0 == 0xB660 => 2,
        _ => 1,
    }
}

fn long(h: u16, g: u16) -> u32 {
    match h >> 9 {
        // 1110 100 with bit 6: dual 3, exclusive 2, table branch 2; without: multiple
        0b111_0100 if h & 0x40 == 0 => 1 + g.count_ones(),
        0b111_0100 if h & 0xFFE0 == 0xE8C0 => 2,
        0b111_0100 => 3,
        // 1110 110: load and store of the floating-point unit, or two registers at once
        0b111_0110 if h & 0xFFE0 == 0xEC40 => 2,
        // VLDR, VSTR 1101 U.0L: two half words of immediate mean one word or two
        0b111_0110 if h & 0xFF20 == 0xED00 => 2 + u32::from(g & 0x0100 != 0),
        0b111_0110 => 1 + u32::from(g & 0xFF),
        0b111_0111 => floating_point(h, g),
        // MSR 1111 0011 100, MRS 1111 0011 111
        _ if matches!(h & 0xFFE0, 0xF380 | 0xF3E0) && g & 0xD000 == 0x8000 => 2,
        // 1111 100: load and store of one register
        0b111_1100 => 2,
        // SDIV 1111 1011 1001, UDIV 1111 1011 1011
        _ if matches!(h & 0xFFF0, 0xFB90 | 0xFBB0) => 12,
        _ => 1,
    }
}

/// 1110 1110: data processing and moves; the kind is in bits 7, 5 and 4 of the first half word.
fn floating_point(h: u16, g: u16) -> u32 {
    /// The next instruction waits for the result
    const AWAITED: u32 = 1;
    // bit 4 of the second: a move between the units
    if g & 0x10 != 0 {
        return 1;
    }
    match h & 0x00B0 {
        // VMLA, VMLS; VNMLA, VNMLS; VFNMA, VFNMS; VFMA, VFMS
        0x00 | 0x10 | 0x90 | 0xA0 => 3 + AWAITED,
        0x80 => 14 + AWAITED,
        // VSQRT: opcode 0001, 11
        0xB0 if h & 0xF == 1 && g & 0xC0 == 0xC0 => 14 + AWAITED,
        _ => 1 + AWAITED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What an assembler makes of them, and what the manual's tables say.
    const KNOWN: [(&str, u16, u16, u32); 30] = [
        ("adds r0, r1, r2", 0x1888, 0, 1),
        ("ldr r0, [pc, #4]", 0x4801, 0, 2),
        ("ldr r0, [r1]", 0x6808, 0, 2),
        ("strh r0, [r1, #2]", 0x8048, 0, 2),
        ("str r0, [sp, #4]", 0x9001, 0, 2),
        ("add r0, sp, #4", 0xA801, 0, 1),
        ("push {r4-r7, lr}", 0xB5F0, 0, 6),
        ("pop {r4-r7, pc}", 0xBDF0, 0, 6),
        ("stmia r0!, {r1, r2}", 0xC006, 0, 3),
        ("cpsid i", 0xB672, 0, 2),
        ("bx lr", 0x4770, 0, 1),
        ("push.w {r4-r11, lr}", 0xE92D, 0x4FF0, 10),
        ("ldrd r0, r1, [r2]", 0xE9D2, 0x0100, 3),
        ("tbb [pc, r0], its branch not counted", 0xE8DF, 0xF000, 2),
        ("ldr.w r0, [r1, #4]", 0xF8D1, 0x0004, 2),
        ("msr basepri, r0", 0xF380, 0x8811, 2),
        ("mrs r0, basepri", 0xF3EF, 0x8011, 2),
        ("udiv r0, r1, r2", 0xFBB1, 0xF0F2, 12),
        ("vldr s0, [r0]", 0xED90, 0x0A00, 2),
        ("vpush {d8-d11}", 0xED2D, 0x8B08, 9),
        ("vmla.f32 s0, s1, s2", 0xEE00, 0x0A81, 4),
        ("vadd.f32 s0, s1, s2", 0xEE30, 0x0A81, 2),
        ("vdiv.f32 s0, s1, s2", 0xEE80, 0x0A81, 15),
        ("vmov s0, r0", 0xEE00, 0x0A10, 1),
        ("vsqrt.f32 s0, s1", 0xEEB1, 0x0AE0, 15),
        ("vabs.f32 s0, s1", 0xEEB0, 0x0AE0, 2),
        ("vldr d0, [r0]", 0xED90, 0x0B00, 3),
        ("vmov r0, r1, d0", 0xEC51, 0x0B10, 2),
        ("ldrexb r0, [r2]", 0xE8D2, 0x0F4F, 2),
        ("bl, its branch not counted", 0xF000, 0xF800, 1),
    ];

    #[test]
    fn instructions_take_what_the_manual_says() {
        for (text, first, second, most) in KNOWN {
            assert_eq!(cycles(first, second), most, "{text}");
        }
    }
}
