//! # A fleet: every session below some folders, diagnosed once
//!
//! ```text
//! FOLDER/ROBOT/…/SESSION/{robot.toml, runs/}   →   STORE/{sessions, causes, equations}/robot=…/date=…/part.parquet
//! ```
//!
//! A session is one task (`find`) with one answer (`answer`); on each core one is worked at (`run`), and whoever has machines
//! enough works at one on each of those. Its rows (`rows`) go into Parquet files, one of each table for each robot and day
//! (`store`), in a folder or elsewhere (`storage`). A row has the hash of all that its answer rests on (`key`): asked again, only what is
//! new or changed is done. A session that cannot be read is a row with its reason. `report` pools what the store holds.

mod answer;
mod cells;
mod find;
mod key;
mod labels;
mod partition;
mod report;
mod rows;
mod run;
mod storage;
mod store;
#[cfg(test)]
mod tests;

pub use answer::{SessionAnswer, answer_session};
pub use find::{FoundSession, find};
pub use report::fleet_report;
pub use rows::{CauseRow, EquationRow, SessionRow};
pub use run::{FleetOptions, FleetTally, diagnose_fleet};
pub use storage::{Folder, Storage};
pub use store::Store;
