//! Encodings as LLVM's assembler makes them from the text beside them.

use super::*;

/// Where the instruction under test stands.
const AT: u32 = 0x0800_1000;

fn at(address: u32, halves: &[u16]) -> Instruction {
    let code: Vec<u8> = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
    decode(address, &code).expect("a whole instruction")
}

#[test]
fn what_moves_the_stack_pointer_moves_it_by_so_much() {
    for (text, halves, bytes) in [
        ("push {r4, r5, r7, lr}", &[0xB5B0][..], -16),
        ("pop {r4, r5}", &[0xBC30], 8),
        ("sub sp, #16", &[0xB084], -16),
        ("add sp, #508", &[0xB07F], 508),
        ("sub.w sp, sp, #1024", &[0xF5AD, 0x6D80], -1024),
        ("add.w sp, sp, #4096", &[0xF50D, 0x5D80], 4096),
        ("subw sp, sp, #1025", &[0xF2AD, 0x4D01], -1025),
        ("addw sp, sp, #4095", &[0xF60D, 0x7DFF], 4095),
        ("push.w {r4-r11, lr}", &[0xE92D, 0x4FF0], -36),
        ("pop.w {r4-r11, lr}", &[0xE8BD, 0x4FF0], 36),
        ("str lr, [sp, #-4]!", &[0xF84D, 0xED04], -4),
        ("str lr, [sp, #-8]!", &[0xF84D, 0xED08], -8),
        ("ldr lr, [sp], #4", &[0xF85D, 0xEB04], 4),
        ("strd r4, r5, [sp, #-16]!", &[0xE96D, 0x4504], -16),
        ("ldrd r4, r5, [sp], #16", &[0xE8FD, 0x4504], 16),
        ("vpush {d8, d9}", &[0xED2D, 0x8B04], -16),
        ("vpush {s16}", &[0xED2D, 0x8A01], -4),
        ("vpush {s17, s18, s19}", &[0xED6D, 0x8A03], -12),
        ("vpop {d8, d9}", &[0xECBD, 0x8B04], 16),
        ("ldrsb r0, [sp, #-4]!", &[0xF91D, 0x0D04], -4),
        ("ldrb r1, [sp], #1", &[0xF81D, 0x1B01], 1),
    ] {
        assert_eq!(at(AT, halves), Instruction { len: 2 * halves.len() as u32, does: Action::Stack(bytes) }, "{text}");
    }
    for (text, halves) in [
        ("mov sp, r4", &[0x46A5][..]),
        ("add sp, r0", &[0x4485]),
        ("sub.w sp, sp, r0", &[0xEBAD, 0x0D00]),
        ("sub.w sp, r7, #8, by hand", &[0xF1A7, 0x0D08]),
    ] {
        assert_eq!(at(AT, halves).does, Action::StackUnknown, "{text}");
    }
}

#[test]
fn what_returns_or_ends_does() {
    for (text, halves, does) in [
        ("pop {r4, r5, r7, pc}", &[0xBDB0][..], Action::Return(16)),
        ("pop.w {r4-r11, pc}", &[0xE8BD, 0x8FF0], Action::Return(36)),
        ("ldr pc, [sp], #4", &[0xF85D, 0xFB04], Action::Return(4)),
        ("bx lr", &[0x4770], Action::Return(0)),
        ("mov pc, lr", &[0x46F7], Action::Return(0)),
        ("udf #0xfe", &[0xDEFE], Action::Trap),
        ("udf.w #1", &[0xF7F0, 0xA001], Action::Trap),
    ] {
        assert_eq!(at(AT, halves).does, does, "{text}");
    }
}

#[test]
fn jumps_and_calls_go_where_they_say() {
    let jump = |to: u32, conditional| Action::Jump { to, conditional };
    // the address at which each stood when it was assembled, with its target then
    for (text, address, halves, does) in [
        ("cbz r0, 0x3a", 0x2A, &[0xB130][..], jump(0x3A, true)),
        ("cbnz r7, 0x3a", 0x2C, &[0xB92F], jump(0x3A, true)),
        ("beq 0x3a", 0x46, &[0xD0F8], jump(0x3A, true)),
        ("bne.w 0", 0x48, &[0xF47F, 0xAFDA], jump(0, true)),
        ("b 0x3a", 0x4C, &[0xE7F5], jump(0x3A, false)),
        ("b.w 0", 0x4E, &[0xF7FF, 0xBFD7], jump(0, false)),
        ("bl 0", 0x52, &[0xF7FF, 0xFFD5], Action::Call(0)),
        ("ldr.w pc, [pc, #8]", 0x7E, &[0xF8DF, 0xF008], Action::JumpVia(0x88)),
        ("ldr.w pc, [pc, #-4]", 0x82, &[0xF85F, 0xF004], Action::JumpVia(0x80)),
    ] {
        assert_eq!(at(address, halves).does, does, "{text}");
    }
    // far: bl +0x400000 and −0x1000000, the ends of its range halved and whole
    assert_eq!(at(AT, &[0xF000, 0xF800]).does, Action::Call(AT + 4));
    assert_eq!(at(0x0100_0000, &[0xF400, 0xD000]).does, Action::Call(4));
    for (text, halves, does) in [
        ("mov pc, r3", &[0x469F][..], Action::JumpUnknown),
        ("bx r3", &[0x4718], Action::JumpUnknown),
        ("ldm.w r0, {r1, pc}", &[0xE890, 0x8002], Action::JumpUnknown),
        ("ldr.w pc, [r1, r2, lsl #2]", &[0xF851, 0xF022], Action::JumpUnknown),
        ("ldr.w pc, [r1]", &[0xF8D1, 0xF000], Action::JumpUnknown),
        ("blx r3", &[0x4798], Action::CallUnknown),
        ("tbb [pc, r0]", &[0xE8DF, 0xF000], Action::Table { wide: false }),
        ("tbh [pc, r0, lsl #1]", &[0xE8DF, 0xF010], Action::Table { wide: true }),
        ("tbh [r2, r1, lsl #1]", &[0xE8D2, 0xF011], Action::TableAt { wide: true, register: 2 }),
        ("adr.w r2, #12", &[0xF20F, 0x020C], Action::Address { register: 2, address: ((AT + 4) & !3) + 12 }),
        ("adr r3, #8", &[0xA302], Action::Address { register: 3, address: ((AT + 4) & !3) + 8 }),
        ("it eq", &[0xBF08], Action::Conditions(1)),
        ("itte ne", &[0xBF1A], Action::Conditions(3)),
    ] {
        assert_eq!(at(AT, halves).does, does, "{text}");
    }
}

#[test]
fn what_only_looks_like_it_goes_on() {
    for (text, halves) in [
        ("mov r4, sp", &[0x466C][..]),
        ("add r7, sp, #8", &[0xAF02]),
        ("add r0, sp, r0", &[0x4468]),
        ("nop", &[0xBF00]),
        ("svc #3", &[0xDF03]),
        ("bkpt #0xab", &[0xBEAB]),
        ("ldm.w r0, {r1, r2, r3}", &[0xE890, 0x000E]),
        ("stm.w r0!, {r1, r2, r3}", &[0xE8A0, 0x000E]),
        ("ldr r1, [sp, #-4]", &[0xF85D, 0x1C04]),
        ("ldr.w r1, [sp, #256]", &[0xF8DD, 0x1100]),
        ("strd r4, r5, [sp, #16]", &[0xE9CD, 0x4504]),
        ("vldr s0, [sp, #4]", &[0xED9D, 0x0A01]),
        ("vstmia r0!, {s0, s1}", &[0xECA0, 0x0A02]),
        ("msr basepri, r0", &[0xF380, 0x8811]),
        ("mrs r0, basepri", &[0xF3EF, 0x8011]),
        ("dmb sy", &[0xF3BF, 0x8F5F]),
        ("cmp.w sp, #8", &[0xF1BD, 0x0F08]),
        ("tst.w r0, #8", &[0xF010, 0x0F08]),
        ("vadd.f32 s0, s1, s2", &[0xEE30, 0x0A81]),
        ("ldrex r0, [r1]", &[0xE851, 0x0F00]),
        ("strex r0, r1, [r2]", &[0xE842, 0x1000]),
        ("clz r0, r1", &[0xFAB1, 0xF081]),
        ("umull r0, r1, r2, r3", &[0xFBA2, 0x0103]),
    ] {
        assert_eq!(at(AT, halves), Instruction { len: 2 * halves.len() as u32, does: Action::GoesOn }, "{text}");
    }
    assert_eq!(decode(AT, &[0xFF]), None);
    assert_eq!(decode(AT, &[0x2D, 0xE9, 0xF0]), None);
}

#[test]
fn constants_expand_as_the_manual_says() {
    // a byte, a byte twice, and 1bcdefgh turned right by 9 and by 27
    for (twelve, value) in [(0x0AB, 0xAB), (0x1AB, 0x00AB_00AB), (0x4FF, 0x7F80_0000), (0xD80, 0x1000)] {
        assert_eq!(expanded(twelve), value, "{twelve:#x}");
    }
}
