//! # The face for programs
//!
//! What the commands do, for programs: owned types in and out, free of how many wheels the robot has, that can be
//! serialised, sent to another thread and kept. A command parses its arguments, calls one of these, and writes the answer.
//!
//! | ask | answer |
//! |---|---|
//! | [`diagnose`], [`Diagnosis::of`] | [`Report`], [`Findings`]: where the gap lies, which cause it has, how far it shrinks |
//! | [`compare`](fn@compare) | [`ComparisonReport`](crate::report::comparison::ComparisonReport): which cause explains the difference between two sessions |
//! | [`next`](fn@next) | [`Designed`]: the script that would settle what is open, and what to measure in its place |
//! | [`identify`] | [`Identification`]: the robot file's numbers, fitted, and how sure they are |
//! | [`identify_by_experiment`] | [`Answer`](crate::identify::Answer): the same by the paper's experiments |
//! | [`validate`] | [`Validated`]: every run simulated over what was measured |
//! | [`predict`](fn@predict) | [`Run`]: what the model says of each measured column |
//! | [`simulate`](fn@simulate) | [`Run`]: what the robot of a file would have recorded |
//! | [`Plants`] | states and readings of robots that are stepped side by side |
//! | [`check`](fn@check) | [`Fault`]s of the recordings, each with a code and a mend |
//! | [`informativity`](fn@informativity) | [`Informativity`](crate::identify::Informativity): how well the recordings could tell each number of the robot file at best |
//! | [`experiments`], [`rehearse`] | [`PlannedExperiments`]: what to play so that a robot's numbers can be told |
//! | [`rich`], [`rehearse_rich`] | [`PlannedRich`]: what to play so that recordings show as many causes as they can |
//! | [`sensitivity`](fn@sensitivity) | [`Sensitivity`]: which numbers of a robot file its motion depends on |
//! | [`selftest`](fn@selftest) | [`SelfTest`]: which causes planned recordings could show, and from what size on |
//! | [`confusion`](fn@confusion) | [`Confusion`]: which cause would be taken for which in them, by the angles between them |
//! | [`effect_shown`] | [`EffectShown`]: what an effect of the catalogue does to a short drive |
//! | [`export`], [`record`](fn@record) | the parameter block of a robot file; a [`Run`] of what a robot sent, and its frames |
//! | [`wire::robot`](crate::wire::robot) | a robot at the other end of a line: how it is, parameters sent, driven, stopped, cleared |
//! | [`watch`](fn@watch) | [`Reading`](crate::watch::Reading)s: while a robot drives, whether the gap is at its floor, and at which stage it leaves it |
//!
//! Sessions come from files ([`Session::load`]) or from memory ([`Session::of_robot`], then [`Session::add_tables`]; the fields
//! are public too). What an answer was made of, file by file, is told by [`inputs`](fn@inputs). Whatever is wrong with
//! them is an [`Error`] that says where it stands and how to mend it; recordings that cannot be used are no error of
//! [`diagnose`] but its answer, `unfit_data`.

mod by_experiment;
mod compare;
mod experiment;
mod identify;
mod informativity;
mod inputs;
mod next;
mod plants;
mod predict;
mod record;
mod selftest;
mod simulate;
mod watch;

pub use crate::check::{Fault, check};
pub use crate::diagnosis::{Diagnosis, NamedSession, Options, diagnose};
pub use crate::engine::design::Designed;
pub use crate::engine::findings::{Confusion, Design, SelfTest};
pub use crate::engine::knobs::{DesignKnobs, SelftestKnobs};
pub use crate::engine::{Findings, Knobs};
pub use crate::error::Error;
pub use crate::known::known_effects;
pub use crate::localise::validation::{Validated, validate};
pub use crate::log::{RobotFile, Run, Session, Table};
pub use crate::report::Report;
pub use crate::simulate::{EffectShown, Sensitivity, StepPlan, effect_shown, sensitivity};
pub use crate::wire::block::{Exported, export};
pub use by_experiment::identify_by_experiment;
pub use compare::{ComparedSession, SessionsCompared, compare};
pub use experiment::{
    PlannedExperiments, PlannedRich, PlannedScript, RichScript, experiments, rehearse, rehearse_rich, rich,
};
pub use identify::{FitRemark, FittedEffectNumber, FittedNumber, Identification, identify};
pub use informativity::{check_and_informativity, informativity};
pub use inputs::inputs;
pub(crate) use inputs::sha256_of;
pub use next::{design_report, next};
pub use plants::{Plants, Reset};
pub use predict::{predict, with_blank_columns, with_columns_of_its_header};
pub use record::{Recorded, Recording, record, record_kept};
pub use selftest::{Driven, PlannedRuns, confusion, selftest, verify};
pub use simulate::simulate;
pub use watch::{News, WatchFeed, Watched, Watching, watch};
