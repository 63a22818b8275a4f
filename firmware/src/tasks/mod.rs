//! What the tasks do, one a file.

pub mod current;
pub mod event_log;
pub mod idle;
pub mod listen;
pub mod load;
pub mod motion;
pub mod record;
pub mod sense;
pub mod start;
