//! Ways written instruction by instruction, good ones and such as must not pass.

use super::*;
use crate::image::elf::Function;

/// MOVW or MOVT of a half word into a register.
fn half(top: bool, register: u16, value: u16) -> [u16; 2] {
    let (four, i, three, eight) = (value >> 12, value >> 11 & 1, value >> 8 & 7, value & 0xFF);
    [if top { 0xF2C0 } else { 0xF240 } | i << 10 | four, three << 12 | register << 8 | eight]
}

/// Five instructions: an address into r0, a value into r1, and str r1, [r0].
fn store(address: u32, value: u32) -> Vec<u16> {
    let mut code = Vec::new();
    for (register, word) in [(0, address), (1, value)] {
        code.extend(half(false, register, word as u16));
        code.extend(half(true, register, (word >> 16) as u16));
    }
    code.push(0x6001);
    code
}

/// What the board must be told, in the order in which RM0090's addresses grow within each kind.
const WANTED: [(u32, u32); 5] = [
    (0x4002_0018, 1 << 27 | 1 << 28), // PA11, PA12
    (0x4002_0418, 1 << 26 | 1 << 27), // PB10, PB11
    (0x4001_0044, 0x0C00),
    (0x4001_0444, 0x0C00),
    (0x4000_3000, 0xCCCC),
];

/// b to itself.
const WAITS: u16 = 0xE7FE;

fn found(halves: &[u16]) -> Result<u32, String> {
    let bytes = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
    let mut image = Image::default();
    let function = Function { address: 0x100, bytes, names: vec!["handler".into()], data: Vec::new() };
    image.functions.insert(0x100, function);
    instructions_to_open(&image, 0x100, true)
}

fn code(stores: &[(u32, u32)]) -> Vec<u16> {
    stores.iter().flat_map(|(address, value)| store(*address, *value)).chain([WAITS]).collect()
}

#[test]
fn a_straight_way_is_counted_up_to_the_last_enable() {
    assert_eq!(found(&code(&WANTED)), Ok(10));
    // cpsid i in front, and the enables at the end
    let late: Vec<u16> =
        [0xB672].into_iter().chain(code(&[WANTED[2], WANTED[3], WANTED[4], WANTED[0], WANTED[1]])).collect();
    assert_eq!(found(&late), Ok(26));
    let padded: Vec<u16> = std::iter::repeat_n(0xBF00, 60).chain(code(&WANTED)).collect();
    assert_eq!(found(&padded), Ok(70), "which is more than {MOST}");
}

#[test]
fn what_is_missing_is_told() {
    for k in 0..WANTED.len() {
        let mut some = WANTED.to_vec();
        some.remove(k);
        let why = found(&code(&some)).expect_err("one is missing");
        assert!(why.ends_with("is missing"), "{why}");
    }
    // an enable that is set, or set and reset at once, is not low: a set bit wins (RM0090)
    for value in [1 << 11 | 1 << 12, 1 << 27 | 1 << 28 | 1 << 11] {
        let mut wrong = WANTED;
        wrong[0].1 = value;
        assert!(found(&code(&wrong)).is_err(), "{value:#x}");
    }
}

#[test]
fn a_way_that_is_not_straight_or_needs_the_stack_does_not_pass() {
    let with = |first: &[u16]| found(&first.iter().copied().chain(code(&WANTED)).collect::<Vec<_>>());
    for (what, first) in [
        ("beq", &[0xD000][..]),
        ("push {r4, lr}", &[0xB510]),
        ("bx lr", &[0x4770]),
        ("blx r3", &[0x4798]),
        ("ldrex, which nobody knows here", &[0xE850, 0x1F00]),
        ("udf", &[0xDE00]),
    ] {
        assert!(with(first).is_err(), "{what}");
    }
    // what comes after the enables may take stack
    let [a, b, rest @ ..] = WANTED;
    let pushes: Vec<u16> = [store(a.0, a.1), store(b.0, b.1), vec![0xB510], code(&rest)].concat();
    assert_eq!(found(&pushes), Ok(10));
    // and what comes after the stack begins anew: movs r0, #0; movt r0, #0x2002; mov sp, r0; push
    let top = [vec![0x2000], half(true, 0, 0x2002).to_vec(), vec![0x4685, 0xB510]].concat();
    assert_eq!(with(&top), Ok(10 + 4));
    // mov sp, r3, which nobody knows, does not begin it
    assert!(with(&[0x469D, 0xB510]).is_err());
    // an end that never comes
    let endless = code(&WANTED);
    assert!(found(&endless[..endless.len() - 1]).is_err());
}

#[test]
fn constants_are_followed_through_every_form_that_a_compiler_uses() {
    // movs r2, #3; lsls r2, r2, #27: 0x1800_0000; ldr r0, [pc, #…] from behind the loop; str.w r2, [r0, #0x18]
    let mut halves = vec![0x2203, 0x06D2, 0x4801, 0xF8C0, 0x2018, WAITS, 0x0000, 0x4002];
    let bytes = halves.iter().flat_map(|half: &u16| half.to_le_bytes()).collect();
    let mut image = Image::default();
    let function = |bytes| Function { address: 0x100, bytes, names: vec!["handler".into()], data: vec![(12, 16)] };
    image.functions.insert(0x100, function(bytes));
    let way = walk(&image, 0x100).expect("a straight way");
    assert_eq!(way.stores, [Store { instruction: 4, address: 0x4002_0018, value: 0x1800_0000 }]);
    // mov.w r1, #0x18000000; sub.w r4, r1, #0x25: as the compiler makes one address of another
    halves = vec![0xF04F, 0x51C0, 0xF1A1, 0x0425, 0x6021, WAITS];
    let bytes = halves.iter().flat_map(|half: &u16| half.to_le_bytes()).collect();
    image.functions.insert(0x100, function(bytes));
    let stores = walk(&image, 0x100).expect("a straight way").stores;
    assert_eq!(stores, [Store { instruction: 3, address: 0x1800_0000 - 0x25, value: 0x1800_0000 }]);
    // mov.w r1, #0x18000000, and a store to what is not known
    halves = vec![0xF04F, 0x51C0, 0x6019, WAITS];
    let bytes = halves.iter().flat_map(|half: &u16| half.to_le_bytes()).collect();
    image.functions.insert(0x100, function(bytes));
    assert!(walk(&image, 0x100).expect_err("r3 is not known").contains("not known"));
}
