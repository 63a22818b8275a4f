//! # Findings: all that an engine says of a robot's recordings
//!
//! Plain and owned: no number of wheels in its type, no matrix, nothing that borrows. A report, its pictures and the
//! corrected robot file are made of [`Findings`] alone, and whoever compares many robots can keep them in files.

mod cause;
mod changes;
mod confusion;
mod considered;
mod design;
mod equations;
mod gap;
mod noise;
mod place;
mod selftest;
mod traces;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use cause::{Corrected, Estimate, NextExperiment, Which};
pub use changes::{EffectChange, FileChanges, NumberChange};
pub use confusion::{ConfusedCause, Confusion};
pub use considered::{ConsideredCause, EstimatedBy, EstimatedNumber};
pub use design::{Aim, ChosenScript, Design, DesignSuspect, Measure, Question};
pub use equations::{Direction, SessionEquations};
pub use gap::{Gap, HorizonError, Shrink, SignalGap};
pub use noise::ChannelNoise;
pub use place::{Regime, Where};
pub use selftest::{Imitating, Rival, SeenCause, SelfTest, ShownThere, VerifiedSize, WithSensor};
pub use traces::{SignalTrace, Traces};

pub use crate::localise::shape::{Feature, Form, Line, Quantity, Shape, ShapeBin};

use super::knobs::Knobs;
use crate::vocabulary::Verdict;

/// Which engine found it, and with which thresholds.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct EngineRecord {
    /// The engine's name.
    pub name: String,
    /// Its version.
    pub version: u32,
    /// Its thresholds.
    pub knobs: Knobs,
}

/// What an engine found.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Findings {
    /// Who found it; none where no engine was asked.
    pub engine: Option<EngineRecord>,
    /// The answer in one word.
    pub verdict: Verdict,
    /// Causes that the corrected model contains, the one that explains most first; none where they explain too little.
    pub causes: Vec<String>,
    /// Every cause considered, most probable first; probabilities sum to 1.
    pub which: Vec<Which>,
    /// The same causes at every place and in every round of the search, each with the estimate of its numbers.
    pub considered: Vec<ConsideredCause>,
    /// What the recordings say of small changes of the corrected model: what adds up over many robots; none where
    /// [`Knobs::equations`] does not ask for it.
    #[serde(default)]
    pub equations: Option<SessionEquations>,
    /// Where the gap lies; shares sum to 1.
    #[serde(rename = "where")]
    pub where_: Vec<Where>,
    /// The error of the free runs, per signal group and per horizon.
    pub gap: Gap,
    /// The shapes of the residual that show the causes, or the gap that none explains, the plainest first.
    pub evidence: Vec<Shape>,
    /// How far the causes close the gap.
    pub shrink: Shrink,
    /// The noise of each sensor that was compared, as stated and as found.
    pub noise: Vec<ChannelNoise>,
    /// Numbers of the robot file and of its effects, before and after.
    pub parameters: Vec<Corrected>,
    /// What these recordings could not have shown, each with its reason.
    pub not_seen: Vec<String>,
    /// The run that would settle what is open.
    pub next_experiment: Option<NextExperiment>,
    /// What the causes change in the robot file; nothing where no cause is named.
    pub corrected: FileChanges,
    /// What a fit within the stated uncertainty alone would change in the robot file.
    pub refitted: FileChanges,
    /// The signals of a held-out run; none where no model was fitted.
    pub traces: Option<Traces>,
}

impl Findings {
    /// What is found in recordings that cannot be used: nothing.
    pub fn unfit() -> Self {
        Self {
            engine: None,
            verdict: Verdict::UnfitData,
            causes: Vec::new(),
            which: Vec::new(),
            considered: Vec::new(),
            equations: None,
            where_: Vec::new(),
            gap: Gap::default(),
            evidence: Vec::new(),
            shrink: Shrink { reason: Some("the recordings cannot be used".to_owned()), ..Shrink::default() },
            noise: Vec::new(),
            parameters: Vec::new(),
            not_seen: Vec::new(),
            next_experiment: None,
            corrected: FileChanges::default(),
            refitted: FileChanges::default(),
            traces: None,
        }
    }
}
