//! # Rank: which cause, and never a name without its look-alikes
//!
//! Every effect of the catalogue, on every wheel where it can sit on one, and every nominal parameter is tried. A quick
//! [`screen`] asks how much of what the plain model leaves over each could explain once the parameters and the windows'
//! starts have taken their share. The best are fitted, and judged by how well they predict whole runs that no fit has
//! seen, plus what they cost by the robot file's own uncertainty and by their freedom ([`Scored`]).

mod candidate;
mod order;
mod screen;
mod verdict;

pub use candidate::{Candidate, Cause, candidates, releases};
pub use order::{Data, Ranked, Ranking, Scored, explain};
pub use screen::{Screened, parameter_gains, screen};
pub use verdict::{Found, LEAST_CLOSED, Outcome, Verdict, decide};
