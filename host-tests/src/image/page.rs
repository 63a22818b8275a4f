//! # Page: what the image is held to, and what was measured
//!
//! [`ImageMeasurement`] is all figures of one image, [`ImageMeasurement::promises`] what they must keep, [`page`] both
//! for a person.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::calls::{EXCEPTION_FRAME, Graph, Reach, nested};
use super::elf::{Image, Section};
use super::fail_safe::{MOST, instructions_to_open};
use super::names::{allocates, double_precision, panics};
use crate::golden;

/// Flash that the image may fill [bytes]: sectors 0 to 5 of the ten before the store. Less would force code compiled for
/// speed, and the effects that are undone, back to code compiled for size.
pub const MOST_FLASH: u64 = 256 * 1024;

/// RAM that the image may take before it runs [bytes].
pub const MOST_RAM: u64 = 16 * 1024;

/// RAM of the chip that every bus master reaches, static data and stack together [bytes].
pub const CHIP_RAM: u64 = 128 * 1024;

/// The tasks by the interrupts that they are bound to, with their priorities; a test compares them with `main.rs`.
pub const TASKS: [(&str, u8); 5] = [("ADC", 4), ("EXTI0", 3), ("EXTI3", 2), ("EXTI1", 2), ("EXTI2", 1)];

/// Priorities from here on are the control path.
pub const CONTROL: u8 = 3;

/// Handlers of a board that come in above every task, where an image has them: the emulated period, the latch of
/// duties.
const ABOVE: [(&str, u8); 2] = [("SysTick", u8::MAX), ("TIM8_CC", u8::MAX)];

/// Handlers after which nothing else runs.
const LAST: [&str; 3] = ["HardFault", "NonMaskableInt", "DefaultHandler"];

/// A handler, and what can be reached from it.
#[derive(Clone, Debug)]
pub struct Handler {
    /// Its name
    pub name: String,
    /// Its priority; the program itself has 0
    pub priority: u8,
    /// What it reaches
    pub reach: Reach,
    /// The shortest way to a panic, by name; empty if there is none
    pub panics: Vec<String>,
    /// Functions among that which call what a register says
    pub indirect: Vec<String>,
    /// The deepest way, by name
    pub deepest: Vec<String>,
}

/// What a panic's way is called.
const PANIC: &str = "panic";

/// All figures of an image.
#[derive(Clone, Debug)]
pub struct ImageMeasurement {
    /// Bytes of flash
    pub flash: u64,
    /// Bytes of RAM that are taken before the program runs
    pub ram: u64,
    /// What these are made of
    pub sections: Vec<Section>,
    /// Routines of double precision anywhere in the image
    pub double_precision: Vec<String>,
    /// Allocations anywhere in the image
    pub allocations: Vec<String>,
    /// The program, then the tasks, the least urgent first
    pub handlers: Vec<Handler>,
    /// Handlers that no priority is known of
    pub strangers: Vec<String>,
    /// Tasks that the image does not have
    pub missing: Vec<&'static str>,
    /// Stack of all at once [bytes]
    pub stack: u32,
    /// Handlers after which nothing else runs and the panic's, each with its instructions up to open bridges, or why there
    /// is no such way
    pub fail_safe: Vec<(String, Result<u32, String>)>,
}

/// A promise about the image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Promise {
    /// What is promised
    pub what: &'static str,
    /// What is found
    pub found: String,
    /// It is kept
    pub kept: bool,
}

impl ImageMeasurement {
    /// The figures of an image.
    pub fn of(image: &Image) -> Self {
        let graph = Graph::new(image);
        let handler = |name: &str, priority: u8, address: u32| {
            let reach = graph.reach(address);
            Handler {
                name: name.to_owned(),
                priority,
                panics: graph.way(address, panics),
                indirect: graph.indirect(&reach.functions),
                deepest: reach.deepest.iter().map(|address| graph.name(*address)).collect(),
                reach,
            }
        };
        let (mut handlers, mut strangers) = (Vec::new(), BTreeSet::new());
        let mut last: BTreeSet<(&str, u32)> = BTreeSet::new();
        for (number, address) in &image.vectors {
            let names = image.functions.get(address).map_or(&[][..], |function| &function.names);
            let one_of = |known: &[(&'static str, u8)]| {
                known.iter().copied().find(|(known, _)| names.iter().any(|name| name == known))
            };
            if *number == 1 {
                handlers.push(handler("the program", 0, *address));
            } else if let Some(name) = LAST.iter().find(|last| names.iter().any(|name| name == **last)) {
                // what has no handler of its own shares one, and its names
                last.insert((if *number == 2 { LAST[1] } else { name }, *address));
            } else if let Some((name, priority)) = one_of(&TASKS).or(one_of(&ABOVE)) {
                handlers.push(handler(name, priority, *address));
            } else {
                strangers.insert(graph.name(*address));
            }
        }
        handlers.sort_by_key(|handler| handler.priority);
        let missing = TASKS.map(|(task, _)| task).into_iter().filter(|task| !handlers.iter().any(|h| h.name == *task));
        let urgent = handlers.iter().filter(|h| h.priority > 0).map(|h| (h.priority, h.reach.stack));
        let program = handlers.iter().find(|h| h.priority == 0).map_or(0, |h| h.reach.stack);
        let panics = image.functions.values().filter(|function| function.name().ends_with("rust_begin_unwind"));
        last.extend(panics.map(|function| (PANIC, function.address)));
        let way = |(name, entry): &(&str, u32)| {
            ((*name).to_owned(), instructions_to_open(image, *entry, LAST.contains(name)))
        };
        let fail_safe = last.iter().map(way);
        let named = |is: fn(&str) -> bool| {
            let symbols = image.symbols.iter().filter(|name| is(&format!("{:#}", rustc_demangle::demangle(name))));
            symbols.cloned().collect::<Vec<_>>()
        };
        Self {
            flash: image.flash(),
            ram: image.ram(),
            sections: image.sections.clone(),
            double_precision: named(double_precision),
            allocations: named(allocates),
            missing: missing.collect(),
            stack: nested(program, urgent),
            strangers: strangers.into_iter().collect(),
            fail_safe: fail_safe.collect(),
            handlers,
        }
    }

    /// What the image must keep.
    pub fn promises(&self) -> Vec<Promise> {
        let none = |what, found: Vec<String>| Promise {
            what,
            kept: found.is_empty(),
            found: if found.is_empty() { "none".into() } else { found.join(", ") },
        };
        let control = || self.handlers.iter().filter(|handler| handler.priority >= CONTROL);
        let indirect: BTreeSet<String> = control().flat_map(|handler| &handler.indirect).cloned().collect();
        let told = |way: &Vec<String>| way.iter().map(|name| short(name)).collect::<Vec<_>>().join(" → ");
        let panics = control().map(|handler| &handler.panics).filter(|way| !way.is_empty()).map(told);
        let tasks = || self.handlers.iter().filter(|handler| handler.priority > 0);
        let doubts: BTreeSet<String> = tasks().flat_map(|handler| &handler.reach.doubts).cloned().collect();
        let mut odd: Vec<String> = self.strangers.clone();
        odd.extend(self.missing.iter().map(|task| format!("{task} is missing")));
        let room = CHIP_RAM.saturating_sub(self.ram);
        vec![
            Promise {
                what: "flash, at most 262,144 bytes",
                found: grouped(self.flash),
                kept: self.flash <= MOST_FLASH,
            },
            Promise { what: "static RAM, at most 16,384 bytes", found: grouped(self.ram), kept: self.ram <= MOST_RAM },
            Promise {
                what: "deepest stack fits the RAM that is left",
                found: format!("{} of {}", grouped(self.stack.into()), grouped(room)),
                kept: u64::from(self.stack) <= room,
            },
            none("double precision anywhere", self.double_precision.clone()),
            none("allocation anywhere", self.allocations.clone()),
            none("panic within reach of the control path", panics.collect()),
            none("calls by register within reach of the control path", indirect.into_iter().collect()),
            none("doubts about the stack of a task", doubts.into_iter().collect()),
            none("interrupts that are no task's, tasks without an interrupt", odd),
            self.fail_safe_promise(),
        ]
    }

    /// Every fault, every unknown interrupt and a panic open the bridges, and do so soon.
    fn fail_safe_promise(&self) -> Promise {
        let found = |(name, way): &(String, Result<u32, String>)| match way {
            Ok(count) => format!("{name} {count}"),
            Err(why) => format!("{name}: {why}"),
        };
        let all = LAST.into_iter().chain([PANIC]).all(|name| self.fail_safe.iter().any(|(has, _)| has == name));
        let soon = self.fail_safe.iter().all(|(_, way)| way.as_ref().is_ok_and(|count| *count <= MOST));
        Promise {
            what: "instructions from a fault or a panic to open bridges, on a stack of its own, at most 40",
            found: self.fail_safe.iter().map(found).collect::<Vec<_>>().join(", "),
            kept: all && soon,
        }
    }
}

/// The page.
pub fn page(measured: &ImageMeasurement) -> String {
    let mut page = String::from(
        "# The image of the firmware\n\n\
         Measured from the ELF alone by `cargo run --release -p host-tests --bin image -- ELF`: sizes from its sections,\n\
         the rest from the call graph of its machine code. The control path is the tasks of priority 3 and above.\n\n\
         | promise | found | kept |\n|---|---|---|\n",
    );
    for promise in measured.promises() {
        let kept = if promise.kept { "yes" } else { "**no**" };
        let _ = writeln!(page, "| {} | {} | {kept} |", promise.what, promise.found);
    }
    page.push_str("\n## Sections\n\n| section | bytes | flash | RAM |\n|---|---|---|---|\n");
    for section in &measured.sections {
        let mark = |counts| if counts { "x" } else { "" };
        let (name, size) = (&section.name, grouped(section.size));
        let _ = writeln!(page, "| `{name}` | {size} | {} | {} |", mark(section.flash), mark(section.ram));
    }
    let _ = write!(
        page,
        "\n## Stack\n\n\
         Every priority may come in once over all below it: to each the frame of an exception with floating-point\n\
         registers is added, {EXCEPTION_FRAME} bytes. Of the program's own figure calls by register are left out.\n\n\
         | handler | priority | stack | functions in reach | deepest way |\n|---|---|---|---|---|\n",
    );
    for handler in &measured.handlers {
        let way: Vec<String> = handler.deepest.iter().map(|name| format!("`{}`", short(name))).collect();
        let (stack, reach) = (grouped(handler.reach.stack.into()), handler.reach.functions.len());
        let priority = if handler.priority == u8::MAX { "all".into() } else { handler.priority.to_string() };
        let _ = writeln!(page, "| {} | {priority} | {stack} | {reach} | {} |", handler.name, way.join(" → "));
    }
    page
}

/// The last two parts of a path, without what it is generic over.
fn short(name: &str) -> String {
    let mut depth = 0_i32;
    let plain: String = name
        .chars()
        .filter(|c| {
            depth += i32::from(*c == '<') - i32::from(*c == '>');
            depth == 0 && *c != '>'
        })
        .collect();
    let parts: Vec<&str> = plain.split("::").filter(|part| !part.is_empty()).collect();
    parts[parts.len().saturating_sub(2)..].join("::")
}

/// A number with its thousands apart.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits.as_bytes().rchunks(3).rev().map(|g| std::str::from_utf8(g).unwrap_or("")).collect();
    groups.join(",")
}

/// Where a page differs from the one that was blessed: lines with other words, and numbers off by more than a share.
pub fn differences(blessed: &str, now: &str, share: f64) -> Vec<String> {
    golden::lines(blessed, now, |old, new| {
        let ((words, before), (other_words, after)) = (taken_apart(old), taken_apart(new));
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= share * a.abs();
        words == other_words && before.iter().zip(&after).all(near)
    })
}

/// The words of a line with its numbers left out, and the numbers.
fn taken_apart(line: &str) -> (String, Vec<f64>) {
    let (mut words, mut numbers, mut digits) = (String::new(), Vec::new(), String::new());
    for c in line.chars().chain(['\n']) {
        if c.is_ascii_digit() {
            digits.push(c);
        } else if c != ',' || digits.is_empty() {
            if let Ok(number) = digits.parse() {
                numbers.push(number);
                words.push('#');
            }
            digits.clear();
            words.push(c);
        }
    }
    (words, numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped_and_names_cut() {
        assert_eq!([0, 999, 1000, 65_536, 1_234_567].map(grouped), ["0", "999", "1,000", "65,536", "1,234,567"]);
        assert_eq!(
            short("model_core::control::current_loop::CurrentLoop<f32>::field_oriented"),
            "CurrentLoop::field_oriented"
        );
        assert_eq!(short("<firmware::windings::Windings as core::fmt::Debug>::fmt"), "fmt");
        assert_eq!(short("ADC"), "ADC");
    }

    #[test]
    fn a_page_may_move_a_little_and_say_nothing_else() {
        let blessed = "| flash | 40,000 | yes |\n| none |";
        assert_eq!(differences(blessed, "| flash | 41,000 | yes |\n| none |", 0.05), [""; 0]);
        assert_eq!(differences(blessed, "| flash | 43,000 | yes |\n| none |", 0.05).len(), 1);
        assert_eq!(differences(blessed, "| flash | 40,000 | **no** |\n| panic_fmt |", 0.05).len(), 2);
        assert_eq!(differences(blessed, "| flash | 40,000 | yes |\n| none |\nmore", 0.05).len(), 1);
    }
}
