//! # The image: what the firmware's ELF says about itself
//!
//! Sizes, symbols, and the call graph of its machine code: what the control path can reach, and how much stack it can
//! take. Nothing but the file is needed, no tool of a compiler.
//!
//! - [`elf`]: sections, functions, vector table;
//! - [`thumb`]: what an instruction does to flow and stack;
//! - [`flow`]: one function, every way through it;
//! - [`calls`]: the graph, what is reached from where, the deepest way;
//! - [`fail_safe`]: the way from a fault or a panic to open bridges, instruction by instruction;
//! - [`names`]: which functions are panics, allocations, double precision;
//! - [`page`]: all of it as a page, and the promises that it must keep.

pub mod calls;
pub mod elf;
pub mod fail_safe;
pub mod flow;
pub mod names;
pub mod page;
pub mod thumb;
