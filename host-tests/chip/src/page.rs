//! # Page: what the image did on the modelled chip

use std::collections::BTreeMap;
use std::fmt::Write;

use firmware::registers::timing;

use crate::core::profile::Spent;
use crate::pac::{Decoded, Pac};
use crate::peripherals::bus::{Bus, Written};
use crate::scenarios::{Promise, Seen};

/// Lines of the board that must have been executed [%].
const COVERED: usize = 90;
/// Words of a register that are shown; of more, the last one and how many.
const SHOWN: usize = 4;

/// A register and the words that were written into it.
struct Row {
    register: String,
    words: Vec<(u32, Decoded)>,
}

/// The words that were written, by register, and what of them no field holds.
fn words(seen: &Seen, pac: &Pac) -> (Vec<Row>, Vec<String>) {
    let reset = Bus::new();
    let mut rows: BTreeMap<u32, Row> = BTreeMap::new();
    let mut wrong = Vec::new();
    for Written { address, value } in &seen.written {
        let Some(decoded) = pac.decode(*address, *value) else {
            wrong.push(format!("{address:#010x} is no register"));
            continue;
        };
        // reserved bits are kept as the reset leaves them
        let outside = decoded.outside & (value ^ reset.words.get(*address));
        if outside != 0 || !decoded.nameless.is_empty() {
            wrong.push(format!(
                "{} = {value:#010x}: bits {outside:#x} outside, {:?}",
                decoded.register, decoded.nameless
            ));
        }
        let row = rows.entry(*address).or_insert_with(|| Row { register: decoded.register.clone(), words: Vec::new() });
        row.words.push((*value, decoded));
    }
    (rows.into_values().collect(), wrong)
}

/// All promises: those of the runs, the order, the lines and the words.
pub fn promises(seen: &Seen, pac: &Pac) -> Vec<Promise> {
    let mut all = seen.promises.clone();
    for instant in &seen.instants {
        let what = format!("{}: {} expected, {:?} seen", instant.what, instant.expected, instant.seen);
        all.push(Promise { what, kept: instant.kept() });
    }
    let (executed, lines) = seen.coverage.count();
    let what = format!("{executed} of {lines} lines of board/f405 executed");
    all.push(Promise { what, kept: 100 * executed >= COVERED * lines && lines > 150 });
    let (_, wrong) = words(seen, pac);
    all.extend(wrong.into_iter().map(|what| Promise { what, kept: false }));
    all.extend(seen.forbidden.iter().map(|what| Promise { what: what.clone(), kept: false }));
    all
}

/// The page.
pub fn page(seen: &Seen, pac: &Pac) -> String {
    let mut text = String::from(
        "# The board's image on a model of its chip\n\nMade by `BLESS=1 cargo xtask chip`. The ELF that is flashed runs on an emulated \
         Cortex-M4F (Unicorn, the translator of QEMU) with a register-level model of what it uses of the STM32F405 \
         (`host-tests/chip`), and drives the virtual board through it. An instruction takes 1.5 cycles there, whichever it is, unless something else is said. \
         Nothing here was seen on a board.\n",
    );
    text += "\n## Order within a period\n\nIn core cycles of 168 MHz from TIM1's top; one count of TIM3 and TIM4 is two. Worked out by \
             `firmware/src/registers/timing.rs`; seen in every period of a drive of 0.3 s, the earliest and the latest.\n\n\
             | what | worked out | seen | may be off | |\n|---|---|---|---|---|\n";
    for instant in &seen.instants {
        let [first, last] = instant.seen;
        let kept = if instant.kept() { "kept" } else { "NOT KEPT" };
        let _ = writeln!(
            text,
            "| {} | {} | {first} to {last} | {} | {kept} |",
            instant.what, instant.expected, instant.allowed
        );
    }
    text += "\n## What it does\n\n`hil` are the tests that are written for a board (`firmware/tests/hil.rs`), their own image run on the model.\n\n\
             | what | |\n|---|---|\n";
    for promise in &seen.promises {
        let _ = writeln!(text, "| {} | {} |", promise.what, if promise.kept { "kept" } else { "NOT KEPT" });
    }
    text += "\nWhat the reference manual forbids (a peripheral written without its clock, a converter triggered while it converts or \
             before it is stable, locked registers, a stream with old flags): ";
    text +=
        &if seen.forbidden.is_empty() { "nothing was seen.\n".to_owned() } else { seen.forbidden.join("; ") + "\n" };
    cycles(&mut text, seen);
    lines(&mut text, seen);
    registers(&mut text, seen, pac);
    text
}

/// Interrupts by their numbers in the vector table, and what they do.
const EXCEPTIONS: [(u16, &str); 6] = [
    (34, "`ADC`: the current turn"),
    (62, "`TIM8_CC`: the latch of duties"),
    (22, "`EXTI0`: the motion turn"),
    (23, "`EXTI1`: the link's bytes, a parameter block with them"),
    (24, "`EXTI2`: records"),
    (25, "`EXTI3`: gyro and four encoders"),
];

fn cycles(text: &mut String, seen: &Seen) {
    *text += "\n## Cycles at most\n\nA drive with other parameters and a wheel lost on the way, every instruction as long as the manuals say at most: \
             tables 3-1 and 7-1 of the Cortex-M4's technical reference manual with the largest number of each range, three cycles for every refill of the \
             pipeline, five for every line of the flash that its 64 + 8 lines do not hold and that was not prefetched, six and twelve for an access to APB2 \
             and APB1. The longest of each interrupt from entry to return, what interrupted it taken off.\n\n\
             | interrupt | instructions | cycles at most | cycles an instruction | of a period |\n|---|---|---|---|---|\n";
    for (number, what) in EXCEPTIONS {
        let Some(Spent { cycles, instructions }) = seen.longest.get(&number) else { continue };
        let (cycles, each) = (*cycles as f64, *cycles as f64 / *instructions as f64);
        let _ = writeln!(
            text,
            "| {what} | {instructions} | {cycles:.0} | {each:.2} | {:.1} % |",
            100.0 * cycles / f64::from(timing::PERIOD)
        );
    }
}

fn lines(text: &mut String, seen: &Seen) {
    let (executed, all) = seen.coverage.count();
    let _ = write!(
        text,
        "\n## Lines of `firmware/src/board/f405`\n\nA line has code where an instruction of the images comes from it, or is inlined into \
         what it calls, by DWARF; it was executed where one of these was. {executed} of {all} lines were, {:.1} %.\n\n\
         | file | executed | not |\n|---|---|---|\n",
        100.0 * executed as f64 / all.max(1) as f64
    );
    for (file, lines) in &seen.coverage.files {
        let not: Vec<String> = lines.iter().filter(|line| !line.1).map(|line| line.0.to_string()).collect();
        let _ = writeln!(text, "| `{file}` | {} of {} | {} |", lines.len() - not.len(), lines.len(), not.join(", "));
    }
}

fn registers(text: &mut String, seen: &Seen, pac: &Pac) {
    let (rows, wrong) = words(seen, pac);
    let _ = write!(
        text,
        "\n## Register words\n\nEvery word that was written, {} of them, beside the fields of the register access crate that the image is built \
         with (made from the chip's SVD): no bit outside a field but reserved ones as the reset leaves them, no value without a \
         name where a field has named ones. Not kept: {}. Of registers that had more than {SHOWN} words the last is shown; \
         those that hold counts and addresses are left out.\n\n| register | word | says |\n|---|---|---|\n",
        rows.iter().map(|row| if counts(&row.register) { 1 } else { row.words.len() }).sum::<usize>(),
        if wrong.is_empty() { "none".to_owned() } else { wrong.join("; ") },
    );
    for row in rows.iter().filter(|row| !counts(&row.register)) {
        let from = if row.words.len() > SHOWN { row.words.len() - 1 } else { 0 };
        for (word, decoded) in &row.words[from..] {
            let _ = writeln!(text, "| {} | `{word:#010x}` | {} |", row.register, decoded.fields.join(", "));
        }
    }
}

/// Registers whose words are counts or addresses, other ones in every build.
fn counts(register: &str) -> bool {
    let name = register.rsplit(' ').next().unwrap_or(register);
    matches!(name, "CCR1" | "CCR2" | "CCR3" | "NDTR" | "M0AR")
}
