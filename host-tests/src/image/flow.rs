//! # Flow: one function, every way through it
//!
//! The stack that a function has taken is followed along every branch from its first instruction; where ways meet, the
//! deeper one goes on. So a frame that only one way needs does not weigh on the calls of another, and a way that takes
//! room in a circle is found out.

use std::collections::BTreeMap;

use super::elf::Function;
use super::thumb::{Action, Instruction, decode};

/// Deeper than this nothing on this chip can be [bytes].
const BOTTOMLESS: i64 = 1 << 20;

/// What a function does to others, and the stack that it takes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Flow {
    /// The deepest that it goes itself [bytes]
    pub deepest: u32,
    /// Functions that it calls or goes on to, each with the stack taken at that moment [bytes]
    pub calls: BTreeMap<u32, u32>,
    /// Where it calls or goes to what a register says, with the stack taken at that moment [bytes]
    pub unknown: BTreeMap<u32, u32>,
    /// Why its stack cannot be told
    pub unbounded: Option<String>,
}

/// An instruction and whether it is carried out only if a condition holds.
type Step = (Instruction, bool);

/// Follows a function.
pub fn flow(function: &Function) -> Flow {
    let steps = steps(function);
    let mut flow = Flow::default();
    let mut depth: BTreeMap<u32, i64> = BTreeMap::new();
    let mut waiting = vec![(function.address, 0)];
    while let Some((at, taken)) = waiting.pop() {
        let Some((instruction, conditional)) = steps.get(&at) else { continue };
        if depth.get(&at).is_some_and(|known| *known >= taken) {
            continue;
        }
        depth.insert(at, taken);
        if taken > BOTTOMLESS {
            flow.unbounded = Some(format!("it takes stack in a circle at {at:#x}"));
            break;
        }
        let next = at + instruction.len;
        let here = u32::try_from(taken).unwrap_or(0);
        flow.deepest = flow.deepest.max(here);
        let goes_on = |waiting: &mut Vec<(u32, i64)>| {
            if steps.contains_key(&next) {
                waiting.push((next, taken));
            }
        };
        match instruction.does {
            Action::GoesOn | Action::Conditions(_) | Action::Address { .. } => goes_on(&mut waiting),
            Action::Stack(by) => {
                let after = taken - i64::from(by);
                waiting.push((next, if *conditional { after.max(taken) } else { after }));
                flow.deepest = flow.deepest.max(u32::try_from(after).unwrap_or(0));
            }
            Action::StackUnknown => {
                flow.unbounded = Some(format!("its stack pointer comes from a register at {at:#x}"));
                goes_on(&mut waiting);
            }
            Action::Jump { to, conditional: branches } => {
                if steps.contains_key(&to) {
                    waiting.push((to, taken));
                } else {
                    note(&mut flow.calls, to, here);
                }
                if branches || *conditional {
                    goes_on(&mut waiting);
                }
            }
            Action::Table { .. } | Action::TableAt { .. } => {
                let targets = targets(function, &steps, at);
                if targets.is_empty() {
                    flow.unbounded = Some(format!("the table behind {at:#x} cannot be told from code"));
                }
                waiting.extend(targets.into_iter().map(|to| (to, taken)));
            }
            Action::JumpVia(place) => {
                match word(function, place) {
                    Some(to) => note(&mut flow.calls, to & !1, here),
                    None => note(&mut flow.unknown, at, here),
                }
                if *conditional {
                    goes_on(&mut waiting);
                }
            }
            Action::JumpUnknown => {
                note(&mut flow.unknown, at, here);
                if *conditional {
                    goes_on(&mut waiting);
                }
            }
            Action::Call(to) => {
                note(&mut flow.calls, to, here);
                goes_on(&mut waiting);
            }
            Action::CallUnknown => {
                note(&mut flow.unknown, at, here);
                goes_on(&mut waiting);
            }
            Action::Return(by) => {
                if taken != i64::from(by) {
                    // where this is seen, an instruction has been misread
                    flow.unbounded = Some(format!("it returns at {at:#x} with {} bytes taken", taken - i64::from(by)));
                }
                if *conditional {
                    goes_on(&mut waiting);
                }
            }
            Action::Trap => {}
        }
    }
    flow
}

fn note(known: &mut BTreeMap<u32, u32>, to: u32, taken: u32) {
    let most = known.entry(to).or_default();
    *most = taken.max(*most);
}

/// Every instruction of a function by its address; data is passed over.
fn steps(function: &Function) -> BTreeMap<u32, Step> {
    let mut steps = BTreeMap::new();
    let (mut at, mut conditions) = (0_u32, 0_u8);
    while (at as usize) < function.bytes.len() {
        if let Some((_, end)) = function.data.iter().find(|(from, end)| (*from..*end).contains(&at)) {
            at = end.next_multiple_of(2);
            continue;
        }
        let Some(instruction) = decode(function.address + at, &function.bytes[at as usize..]) else { break };
        steps.insert(function.address + at, (instruction, conditions > 0));
        conditions = match instruction.does {
            Action::Conditions(count) => count,
            _ => conditions.saturating_sub(1),
        };
        at += instruction.len;
    }
    steps
}

/// Where a table branch may go; none if that cannot be told.
fn targets(function: &Function, steps: &BTreeMap<u32, Step>, at: u32) -> Vec<u32> {
    let behind = at + 4;
    match steps.get(&at).map(|step| step.0.does) {
        Some(Action::Table { wide }) => table(function, behind, behind, wide),
        Some(Action::TableAt { wide, register }) => {
            // the address that was put into the register last
            let put = steps.range(..at).rev().find_map(|(_, step)| match step.0.does {
                Action::Address { register: to, address } if to == register => Some(address),
                _ => None,
            });
            put.map_or(Vec::new(), |begin| table(function, begin, behind, wide))
        }
        _ => Vec::new(),
    }
}

/// Targets, counted from `base`, of a table that begins at an address; none if the mapping symbols do not say how long it is.
fn table(function: &Function, begin: u32, base: u32, wide: bool) -> Vec<u32> {
    let Some(begin) = begin.checked_sub(function.address) else { return Vec::new() };
    let Some((_, end)) = function.data.iter().find(|(from, end)| (*from..*end).contains(&begin)) else {
        return Vec::new();
    };
    let entries = &function.bytes[begin as usize..*end as usize];
    let offsets: Vec<u32> = if wide {
        entries.as_chunks::<2>().0.iter().map(|half| u32::from(u16::from_le_bytes(*half))).collect()
    } else {
        entries.iter().map(|byte| u32::from(*byte)).collect()
    };
    // what fills up a table is zero, which would lead into the table itself
    offsets.into_iter().filter(|offset| *offset != 0).map(|offset| base + 2 * offset).collect()
}

/// The word of a function's data at an address.
fn word(function: &Function, address: u32) -> Option<u32> {
    let at = address.checked_sub(function.address)? as usize;
    Some(u32::from_le_bytes(function.bytes.get(at..at + 4)?.try_into().ok()?))
}

#[cfg(test)]
#[path = "flow_tests.rs"]
mod tests;
