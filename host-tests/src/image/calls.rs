//! # Calls: what can be reached from a handler, and how deep it goes
//!
//! ```text
//! stack(f) = max(own(f), max over calls c of f: taken(c) + stack(c))
//! total    = stack(main) + Σ over priorities: frame + max over handlers of that priority: stack(handler)
//! ```
//!
//! An exception frame with the floating-point registers is 26 words; one more keeps the stack on eight bytes.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::elf::Image;
use super::flow::{Flow, flow};

/// What the processor puts on the stack when a handler comes in between [bytes].
pub const EXCEPTION_FRAME: u32 = 4 * (26 + 1);

/// The call graph of an image.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    flows: BTreeMap<u32, Flow>,
    names: BTreeMap<u32, Vec<String>>,
}

/// What a handler may come to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reach {
    /// Functions that it can reach, itself among them
    pub functions: BTreeSet<u32>,
    /// The most stack that it takes [bytes]
    pub stack: u32,
    /// The way down there
    pub deepest: Vec<u32>,
    /// What stands against the figure: functions whose stack or calls cannot be told, recursion
    pub doubts: Vec<String>,
}

/// What is known of a function while the graph is walked.
#[derive(Clone)]
enum Visit {
    /// It is on the way that is being walked
    OnTheWay,
    /// Its stack, and which of its calls goes there
    Stack(u32, Option<u32>),
}

impl Graph {
    /// The graph of an image. A call into the middle of a function counts as one of the function.
    pub fn new(image: &Image) -> Self {
        let mut graph = Self::default();
        for (address, function) in &image.functions {
            let mut flow = flow(function);
            let calls = std::mem::take(&mut flow.calls);
            for (to, taken) in calls {
                let home = image.function_at(to).map_or(to, |function| function.address);
                let most = flow.calls.entry(home).or_default();
                *most = taken.max(*most);
            }
            graph.flows.insert(*address, flow);
            graph.names.insert(*address, function.names.clone());
        }
        graph
    }

    /// A function's name.
    pub fn name(&self, address: u32) -> String {
        self.names.get(&address).and_then(|names| names.first()).map_or(format!("{address:#x}"), Clone::clone)
    }

    /// Functions among these one of whose names is so.
    pub fn named(&self, among: &BTreeSet<u32>, is: impl Fn(&str) -> bool) -> Vec<String> {
        let names = among.iter().filter_map(|address| self.names.get(address)).flatten();
        names.filter(|name| is(name)).cloned().collect()
    }

    /// Functions among these that call, or go to, what cannot be told from the code.
    pub fn indirect(&self, among: &BTreeSet<u32>) -> Vec<String> {
        let known = |address: &u32| self.flows.get(address).is_some_and(|flow| flow.unknown.is_empty());
        among.iter().filter(|address| !known(address)).map(|address| self.name(*address)).collect()
    }

    /// The shortest way from a function to one whose name is so, by name; empty if there is none.
    pub fn way(&self, root: u32, is: impl Fn(&str) -> bool) -> Vec<String> {
        let found = |address: &u32| self.names.get(address).is_some_and(|names| names.iter().any(|name| is(name)));
        let mut from = BTreeMap::from([(root, root)]);
        let mut waiting = VecDeque::from([root]);
        while let Some(address) = waiting.pop_front() {
            if found(&address) {
                let step = |at: &u32| from.get(at).copied().filter(|before| before != at);
                let mut way: Vec<_> = std::iter::successors(Some(address), step).map(|at| self.name(at)).collect();
                way.reverse();
                return way;
            }
            for to in self.flows.get(&address).into_iter().flat_map(|flow| flow.calls.keys()) {
                if !from.contains_key(to) {
                    from.insert(*to, address);
                    waiting.push_back(*to);
                }
            }
        }
        Vec::new()
    }

    /// What can be reached from a function.
    pub fn reach(&self, root: u32) -> Reach {
        let (mut known, mut reach) = (BTreeMap::new(), Reach::default());
        reach.stack = self.descend(root, &mut known, &mut reach.doubts);
        reach.functions = known.keys().copied().collect();
        let mut at = Some(root);
        while let Some(address) = at {
            reach.deepest.push(address);
            at = match known.get(&address) {
                Some(Visit::Stack(_, next)) => *next,
                _ => None,
            };
        }
        reach
    }

    fn descend(&self, address: u32, known: &mut BTreeMap<u32, Visit>, doubts: &mut Vec<String>) -> u32 {
        match known.get(&address) {
            Some(Visit::Stack(stack, _)) => return *stack,
            Some(Visit::OnTheWay) => {
                doubts.push(format!("{} calls itself, perhaps through others", self.name(address)));
                return 0;
            }
            None => {}
        }
        known.insert(address, Visit::OnTheWay);
        let Some(flow) = self.flows.get(&address) else {
            doubts.push(format!("there is no function at {address:#x}"));
            known.insert(address, Visit::Stack(0, None));
            return 0;
        };
        if let Some(why) = &flow.unbounded {
            doubts.push(format!("{}: {why}", self.name(address)));
        }
        if !flow.unknown.is_empty() {
            doubts.push(format!("{} calls what a register says", self.name(address)));
        }
        let (mut stack, mut next) = (flow.deepest, None);
        for (to, taken) in &flow.calls {
            let through = taken + self.descend(*to, known, doubts);
            if through > stack {
                (stack, next) = (through, Some(*to));
            }
        }
        known.insert(address, Visit::Stack(stack, next));
        stack
    }
}

/// Stack of everything at once [bytes]: the program, and over it one handler of every priority, the deepest of each.
pub fn nested(program: u32, handlers: impl IntoIterator<Item = (u8, u32)>) -> u32 {
    let mut deepest = BTreeMap::new();
    for (priority, stack) in handlers {
        let most: &mut u32 = deepest.entry(priority).or_default();
        *most = stack.max(*most);
    }
    program + deepest.values().map(|stack| EXCEPTION_FRAME + stack).sum::<u32>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::elf::Function;

    /// An image of functions that stand 0x100 apart, named a, b, c…
    fn image(functions: &[&[u16]]) -> Image {
        let mut image = Image::default();
        for (k, halves) in functions.iter().enumerate() {
            let address = 0x100 * k as u32;
            let bytes = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
            let name = char::from(b'a' + k as u8).to_string();
            image.functions.insert(address, Function { address, bytes, names: vec![name], data: Vec::new() });
        }
        image
    }

    /// bl from an offset in function `from` to function `to`.
    fn bl(from: u32, offset: u32, to: u32) -> [u16; 2] {
        let distance = (0x100 * to).wrapping_sub(0x100 * from + offset + 4) as i32;
        let (s, half) = ((distance < 0) as u16, (distance >> 1) as u32);
        // near enough that J1 = J2 = 1
        [0xF000 | s << 10 | (half >> 11 & 0x3FF) as u16, 0xF800 | (half & 0x7FF) as u16]
    }

    #[test]
    fn the_deepest_way_is_found_and_told() {
        let [b0, b1] = bl(0, 2, 1);
        let [c0, c1] = bl(0, 6, 2);
        let [d0, d1] = bl(1, 4, 3);
        let image = image(&[
            &[0xB510, b0, b1, c0, c1, 0xBD10],         // a: push {r4, lr}; bl b; bl c; pop
            &[0xB510, 0xB084, d0, d1, 0xB004, 0xBD10], // b: push; sub sp, #16; bl d; …
            &[0xB510, 0xB08F, 0xB00F, 0xBD10],         // c: push; sub sp, #60; …
            &[0xB5F0, 0xB094, 0xB014, 0xBDF0],         // d: push {r4-r7, lr}; sub sp, #80; …
        ]);
        let graph = Graph::new(&image);
        let reach = graph.reach(0);
        assert_eq!(reach.stack, 8 + 24 + 100);
        let way: Vec<String> = reach.deepest.iter().map(|address| graph.name(*address)).collect();
        assert_eq!(way, ["a", "b", "d"]);
        assert_eq!((reach.functions.len(), reach.doubts.len()), (4, 0));
        assert_eq!(graph.named(&reach.functions, |name| name == "d"), ["d"]);
        assert_eq!(graph.way(0, |name| name == "d"), ["a", "b", "d"]);
        assert_eq!(graph.way(0x200, |name| name == "d"), [""; 0]);
        assert_eq!(graph.reach(0x200).stack, 68);
    }

    #[test]
    fn recursion_and_calls_by_register_stand_against_the_figure() {
        let [b0, b1] = bl(0, 2, 1);
        let [a0, a1] = bl(1, 2, 0);
        let graph =
            Graph::new(&image(&[&[0xB510, b0, b1, 0xBD10], &[0xB510, a0, a1, 0xBD10], &[0xB510, 0x4798, 0xBD10]]));
        let reach = graph.reach(0);
        assert_eq!(reach.doubts, ["a calls itself, perhaps through others"]);
        let reach = graph.reach(0x200);
        assert_eq!(reach.doubts, ["c calls what a register says"]);
        assert_eq!(graph.indirect(&reach.functions), ["c"]);
    }

    #[test]
    fn of_a_priority_the_deepest_counts_and_every_priority_comes_in_between_once() {
        assert_eq!(nested(100, [(4, 50), (3, 20), (3, 70), (1, 10)]), 100 + 3 * EXCEPTION_FRAME + 50 + 70 + 10);
        assert_eq!(nested(100, []), 100);
    }
}
