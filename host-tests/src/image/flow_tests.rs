//! Small functions by hand, their encodings as LLVM's assembler makes them.

use super::*;

const AT: u32 = 0x0800_0100;

fn function(halves: &[u16]) -> Function {
    let bytes = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
    Function { address: AT, bytes, names: vec!["f".into()], data: Vec::new() }
}

fn of(halves: &[u16]) -> Flow {
    flow(&function(halves))
}

fn calls(of: &[(u32, u32)]) -> BTreeMap<u32, u32> {
    of.iter().copied().collect()
}

#[test]
fn a_frame_is_all_that_was_pushed_and_it_weighs_on_calls() {
    // push {r4, r5, r7, lr}; sub sp, #16; bl +0; add sp, #16; pop {r4, r5, r7, pc}
    let flow = of(&[0xB5B0, 0xB084, 0xF000, 0xF804, 0xB004, 0xBDB0]);
    assert_eq!((flow.deepest, flow.unbounded, flow.unknown.len()), (32, None, 0));
    assert_eq!(flow.calls, calls(&[(AT + 8 + 8, 32)]));
}

#[test]
fn a_frame_of_one_way_does_not_weigh_on_the_other() {
    // cbz r0, 1f; push {r4, r5, r7, lr}; bl far; pop {r4, r5, r7, pc}; 1: b.w far
    let flow = of(&[0xB118, 0xB5B0, 0xF000, 0xFFFE, 0xBDB0, 0xF000, 0xBFFE]);
    assert_eq!(flow.calls, calls(&[(AT + 8 + 0xFFC, 16), (AT + 14 + 0xFFC, 0)]));
    assert_eq!(flow.deepest, 16);
}

#[test]
fn a_conditional_return_may_go_on() {
    // it eq; bxeq lr; push {r4, lr}; pop {r4, pc}
    assert_eq!(of(&[0xBF08, 0x4770, 0xB510, 0xBD10]).deepest, 8);
    // without the condition what follows is never reached
    assert_eq!(of(&[0x4770, 0xB510, 0xBD10]).deepest, 0);
}

#[test]
fn a_circle_that_keeps_its_depth_ends_and_one_that_digs_is_refused() {
    // 1: sub sp, #16; add sp, #16; bne 1b; bx lr
    let keeps = of(&[0xB084, 0xB004, 0xD1FC, 0x4770]);
    assert_eq!((keeps.deepest, keeps.unbounded), (16, None));
    // 1: sub sp, #508; b 1b
    assert!(of(&[0xB0FF, 0xE7FD]).unbounded.is_some_and(|why| why.contains("circle")));
    // push {r4, lr}; bx lr
    assert!(of(&[0xB510, 0x4770]).unbounded.is_some_and(|why| why.contains("with 8 bytes taken")));
    // mov sp, r4
    assert!(of(&[0x46A5, 0x4770]).unbounded.is_some_and(|why| why.contains("register")));
}

#[test]
fn a_table_leads_to_each_of_its_targets() {
    // tbb [pc, r0]; table 2, 3, 3 and a byte to fill up; two: bx lr; three: push {r4, lr}; blx r3; pop {r4, pc}
    let mut f = function(&[0xE8DF, 0xF000, 0x0302, 0x0003, 0x4770, 0xB510, 0x4798, 0xBD10]);
    f.data = vec![(4, 8)];
    let with = flow(&f);
    assert_eq!((with.deepest, &with.unbounded), (8, &None));
    assert_eq!(with.unknown, calls(&[(AT + 12, 8)]));
    f.data.clear();
    assert!(flow(&f).unbounded.is_some(), "a table of unknown length");
}

#[test]
fn a_table_may_stand_behind_a_word_of_data() {
    // adr r2, #8; tbh [r2, r1, lsl #1]; a word; table 6, 5; two words further: bx lr; push {r4, lr}; blx r3; pop {r4, pc}
    let mut f =
        function(&[0xA202, 0xBF00, 0xE8D2, 0xF011, 0x1234, 0x5678, 0x0005, 0x0004, 0x4770, 0xB510, 0x4798, 0xBD10]);
    f.data = vec![(8, 16)];
    let with = flow(&f);
    assert_eq!((with.deepest, &with.unbounded), (8, &None));
    assert_eq!(with.unknown, calls(&[(AT + 20, 8)]));
    // without the address
    let mut f = function(&[0xBF00, 0xBF00, 0xE8D2, 0xF011, 0x1234, 0x5678, 0x0005, 0x0004, 0x4770]);
    f.data = vec![(8, 16)];
    assert!(flow(&f).unbounded.is_some(), "a table that may stand anywhere");
}

#[test]
fn a_veneer_leads_to_where_its_word_says() {
    // ldr.w pc, [pc]; .word 0x08004321
    let mut f = function(&[0xF85F, 0xF000, 0x4321, 0x0800]);
    f.data = vec![(4, 8)];
    assert_eq!(flow(&f).calls, calls(&[(0x0800_4320, 0)]));
}

#[test]
fn what_stands_behind_the_last_call_is_not_code() {
    // push {r7, lr}; bl far; a literal that would read as a push
    let mut f = function(&[0xB580, 0xF000, 0xFFFE, 0xB5F0, 0xB5F0]);
    f.data = vec![(6, 10)];
    let flow = flow(&f);
    assert_eq!((flow.deepest, flow.calls.len()), (8, 1));
}
