//! A robot, its recordings so far, and what is asked of further ones.

use super::candidates::Site;
use super::questions::Asked;
use crate::engine::knobs::DesignKnobs;
use crate::engine::selftest::{Laid, Look};
use crate::identify::Prior;
use crate::log::RobotFile;
use crate::simulate::AlignedRun;

/// A robot, its recordings so far, and what is asked of further ones.
pub(super) struct Bench<'a, const N: usize> {
    pub file: &'a RobotFile,
    pub asked: Asked<'a>,
    pub site: Site,
    /// The recordings so far.
    pub laid: Laid<'a, N>,
    pub before: Look,
    pub knobs: &'a DesignKnobs,
}

impl<const N: usize> Bench<'_, N> {
    /// How often something has to be played that brings a difference of scores from here to there, for what is needed.
    pub fn plays(&self, now: f64, then: f64, needed: f64) -> Option<usize> {
        let plays = if then >= needed { 1.0 } else { ((needed - now) / (then - now)).ceil() };
        (then > now && plays <= self.knobs.most_plays as f64).then_some(plays as usize)
    }

    /// By how much scores would differ with a further recording, question by question.
    pub fn with(&self, run: &AlignedRun<N>) -> Vec<f64> {
        self.with_channels(run, self.site.mask::<N>())
    }

    /// The same by the channels of a bit mask.
    pub fn with_channels(&self, run: &AlignedRun<N>, mask: u16) -> Vec<f64> {
        let runs = std::slice::from_ref(run);
        let laid = Laid::new(self.file, self.laid.model.clone(), runs, &self.knobs.selftest);
        let look = laid.look(&self.asked.columns, mask).times(&self.site.samples_a_row::<N>()).and(&self.before);
        self.differences(&look, laid.stated())
    }

    /// Of a look, with the numbers of the robot held by what is stated.
    pub fn differences(&self, look: &Look, stated: &Prior) -> Vec<f64> {
        self.asked.differences(&self.laid.left_of(look, stated))
    }
}
