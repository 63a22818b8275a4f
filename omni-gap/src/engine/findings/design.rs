//! What a further recording, or a measurement by hand, would settle.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::engine::findings::Estimate;
use crate::simulate::{Emphasis, Floor};
use crate::vocabulary::{Axis, Kind};

/// An experiment designed for what recordings have left open.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Design {
    /// Name of the robot, from its file.
    pub robot: String,
    /// What it is for.
    pub aim: Aim,
    /// The causes in question, the most probable first.
    pub suspects: Vec<DesignSuspect>,
    /// What is asked of recordings, and how far each way of going on answers it.
    pub questions: Vec<Question>,
    /// The script that answers most.
    pub script: ChosenScript,
    /// How many scripts it was chosen from.
    pub tried: usize,
    /// What is measured by hand or by a further sensor, the most useful first.
    pub measures: Vec<Measure>,
}

/// What an experiment is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// To tell apart causes that the recordings so far cannot.
    TellApart,
    /// To show effects that the recordings so far could not have shown at their typical size.
    Show,
}

/// A cause in question, as the recordings so far estimate it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct DesignSuspect {
    /// Id of the catalogue.
    pub cause: String,
    /// Effect or parameter.
    pub kind: Kind,
    /// The wheel that it sits on alone.
    pub wheel: Option<usize>,
    /// The body axis that it speaks of alone.
    pub axis: Option<Axis>,
    /// Its numbers, as fitted; those of its typical size where it is to be shown.
    pub parameters: BTreeMap<String, Estimate>,
}

/// One question: whether a cause is told from a rival, or shows at all.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Question {
    /// The cause.
    pub cause: String,
    /// The rival; none: whether it shows.
    pub rival: Option<String>,
    /// By how much scores have to differ in the mean, so that most recordings answer it [1]
    pub needed: f64,
    /// By how much they do in the recordings so far, by the models [1]
    pub now: f64,
    /// With a recording of random motion as long as the script [1]: of several, the median.
    pub random: f64,
    /// With a recording of the script [1]
    pub then: f64,
    /// How often the script has to be played for an answer; none where that is more than anybody does.
    pub plays: Option<usize>,
}

impl Question {
    /// True if such a difference of scores is an answer.
    pub fn is_answered(&self, difference: f64) -> bool {
        difference >= self.needed
    }
}

impl Measure {
    /// True of a sensor that is to be logged while the script is played.
    pub fn is_by_sensor(&self) -> bool {
        self.to.is_none()
    }
}

impl Design {
    /// How often the script is to be played, for all that it answers; none where it answers nothing that is open.
    pub fn plays(&self) -> Option<usize> {
        let open = self.questions.iter().filter(|question| !question.is_answered(question.now));
        open.filter_map(|question| question.plays).max()
    }
}

/// The script that was chosen.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct ChosenScript {
    /// What it does most.
    pub emphasis: Emphasis,
    /// How long it takes [s]
    pub seconds: f64,
    /// Rows a second [1/s]
    pub rate: f64,
    /// The largest voltage on any motor [V]
    #[serde(rename = "voltage_V")]
    pub voltage: f64,
    /// The floor that it needs, in metres [m]
    pub floor: Floor,
    /// True if the robot is told wheel speeds, not voltages.
    pub set_speed: bool,
}

/// Something to measure in place of another recording, or beside it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Measure {
    /// The number of the robot file, or the signal group to log.
    pub what: String,
    /// How, in a sentence.
    pub how: String,
    /// How well it has to be known, relatively; none for a sensor.
    pub to: Option<f64>,
    /// By how much scores would differ then, question by question [1]
    pub then: Vec<f64>,
}
