//! # Report: sentences, tables and pictures of one diagnosis
//!
//! A [`Report`] is the diagnosis as data: `report.json` is that struct and nothing else. [`terminal()`] says it in about
//! ten lines, [`html()`] draws it on one page that needs no network, and [`write()`] puts the files into a folder so that
//! none is ever half-written. [`sensitivity_html()`] is a page of its own; [`validation`] does the same for a model laid
//! over its recordings, [`comparison`] for two sessions beside each other, [`design`] for what to record next; [`effect_picture()`] shows what an effect of the catalogue does, and [`shown_in()`] says
//! where. Neither prose nor page computes anything: every sentence traces to a number in the report.

mod columns;
pub mod comparison;
mod decimate;
pub mod design;
mod effect_picture;
mod evidence;
mod figure;
pub mod fleet;
mod floor_picture;
mod horizons;
mod html;
mod identified;
mod informativity;
mod instructions;
mod markup;
mod model;
mod number;
mod phrases;
mod picture;
mod rich_instructions;
mod robot_picture;
#[cfg(test)]
mod sample;
#[cfg(test)]
mod sample_evidence;
mod scale;
mod selftest;
mod sensitivity;
mod shown_in;
mod terminal;
mod validate;
pub mod validation;
mod write;

pub use effect_picture::effect_picture;
pub use html::html;
pub use identified::identified_terminal;
pub use informativity::informativity_terminal;
pub use instructions::{Instructions, ScriptSaid, instructions};
pub use model::{About, Fault, Input, Report, SCHEMA};
pub use number::{estimate, num, percent};
pub use phrases::settled;
pub use picture::{MEASURED, Panel, Pictures, Series};
pub use rich_instructions::{RichInstructions, rich_instructions};
pub use selftest::{selftest_html, selftest_json, selftest_terminal, write_selftest};
pub use sensitivity::{sensitivity_html, sensitivity_terminal, write_sensitivity};
pub use shown_in::shown_in;
pub use terminal::terminal;
pub use write::{Beside, Written, write};

pub use crate::engine::findings::{
    Corrected, Estimate, Gap, HorizonError, NextExperiment, Regime, Shrink, SignalGap, Where, Which,
};
pub use crate::vocabulary::{Axis, Kind, Stage, Verdict};
