//! # Simulate: what a model says happens
//!
//! Pure: the same model, input and seed give the same run, bit for bit. A [`Model`] is what files describe; a
//! [`AlignedRun`] run is a recording laid out row by row for the plant; [`predict`] lets the one run freely beside the
//! other, restarted every horizon from a [`Start`] that no model had a part in; [`record`] makes a recording of a robot
//! that is not there, and [`excite`] or [`rich_allowed`] tells it what to do. [`sensitivity()`] says which numbers of a file
//! the motion depends on, [`effect_shown()`] what an effect of the catalogue does to a drive,
//! [`where_shown()`] where that shows.

mod aligned_run;
mod channels;
mod commanded;
mod cut;
mod drivable;
mod effect_shown;
mod effort;
mod excite;
mod floor;
mod free_run;
mod halls;
mod keys;
mod limits;
mod losses;
mod lost_commands;
mod lost_rows;
mod model;
mod open_circuit;
mod predict;
mod record;
mod regimes;
mod restart_rows;
mod restarted;
mod rich;
mod rich_limits;
mod ripple_order;
mod row_passed;
mod run_plan;
mod script;
mod sensing;
mod sensitivity;
mod start;
mod step_lengths;
mod terms;
mod tried_path;
mod where_shown;
mod white_noise;

pub use crate::log::Chain;
pub use aligned_run::{AlignedRun, supply_seen, within_half_turn};
pub use channels::{Channels, MAX_CHANNELS, PerGroup, Row, SignalGroup};
pub use commanded::commanded;
pub use cut::cut;
pub use drivable::drivable;
pub use effect_shown::{EffectShown, ShownSignal, effect_shown};
pub use effort::steps_taken;
pub use excite::{Excitation, excite};
pub use floor::{Floor, floor_of};
pub use free_run::{FreeRun, Hidden, free_run};
pub use keys::{NOMINAL_KEYS, NominalKey};
pub use limits::{Allowed, Lowered, USUAL_FIELD, allowed, usual_voltage};
pub use losses::Losses;
pub use lost_commands::find_losses;
pub use model::{EffectInstance, Model, ROOM_FOR_CAUSES, Slot, robot_of};
pub use predict::{HORIZON_S, Prediction, predict};
pub use record::{LOSSES, SensorSetup, SpeedSensor, record};
pub use rich::{Emphasis, RICH, RichPlan};
pub use rich_limits::{RichAllowed, rich_allowed};
pub use row_passed::RowPassed;
pub use run_plan::RunPlan;
pub use script::{AXES, Experiment, Plan, Script, along, scripts};
pub use sensing::Sensing;
pub use sensitivity::{AxisSensitivity, CurvePoint, Influence, PAPER_VOLTAGE, Sensitivity, StepPlan, sensitivity};
pub use start::{Start, start_at};
pub use terms::{Terms, terms};
pub use where_shown::{WhereShown, where_shown};
