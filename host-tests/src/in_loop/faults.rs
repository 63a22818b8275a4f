//! # Faults: everything that can go wrong, done to the robot's program while it drives
//!
//! ```text
//! drive ─ inject ─ seen ─ bridges open ─ commands go on ─ CLEAR while it lasts ─ mend ─ still latched? ─ CLEAR ─ drive
//! ```
//!
//! - [`case`]: what is done, and what it is to be called;
//! - [`bench`]: the robots that it is done to;
//! - [`play`]: one case, from the start to the robot driving again;
//! - [`three`]: a robot of four wheels that goes on with three;
//! - [`dog`]: the tasks starved;
//! - [`mod@page`]: the table that a person judges, and the promises that it must keep.
//!
//! Times are counted in periods as the board sees them, so they are exact and the same in every run: an event belongs to
//! the period in whose codes or bytes it is whole for the first time.

pub mod bench;
pub mod case;
pub mod dog;
pub mod page;
pub mod play;
pub mod three;

pub use page::{broken, page};

use rayon::prelude::*;

use crate::emulator::{Brain, Trouble};

/// All that was found.
#[derive(Clone, Debug)]
pub struct Results {
    /// The cases, in order
    pub played: Vec<(case::Case, play::Played)>,
    /// Four wheels that go on with three
    pub three: Vec<(three::Loss, three::Gone)>,
    /// The tasks starved
    pub dog: dog::Bitten,
}

/// Plays everything with this word in its title; `start` starts the program anew.
///
/// # Errors
/// [`Trouble`] says what became of it.
pub fn results<B: Brain>(word: &str, start: impl Fn() -> Result<B, Trouble> + Sync) -> Result<Results, Trouble> {
    let played = case::CASES
        .into_par_iter()
        .filter(|case| case.title.contains(word))
        .map(|case| Ok((case, play::play(&case, start()?)?)));
    let three = three::LOSSES
        .into_par_iter()
        .filter(|loss| loss.title.contains(word))
        .map(|loss| Ok((loss, three::go_on(&loss, start()?)?)));
    Ok(Results {
        played: played.collect::<Result<_, Trouble>>()?,
        three: three.collect::<Result<_, Trouble>>()?,
        dog: dog::starve(start()?)?,
    })
}
