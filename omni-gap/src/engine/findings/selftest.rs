//! What the self-test says: of each cause, from what size on it would be found and told from its rivals.

use schemars::JsonSchema;
use serde::Serialize;

use crate::vocabulary::{Axis, Kind};

/// What recordings of a robot could show.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct SelfTest {
    /// The robot's name.
    pub robot: String,
    /// The groups of signals that are logged.
    pub logged: Vec<&'static str>,
    /// How many numbers are measured.
    pub numbers: usize,
    /// Every cause, in the order of the catalogue; of effects on one wheel, that wheel where they show least.
    pub causes: Vec<SeenCause>,
    /// What one more sensor would bring.
    pub with_sensor: Vec<WithSensor>,
}

/// A cause, and how well recordings show it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct SeenCause {
    /// Its id.
    pub cause: &'static str,
    /// Effect or parameter.
    pub kind: Kind,
    /// The wheel that it sits on.
    pub wheel: Option<usize>,
    /// The body axis, of friction that is wrong on one alone.
    pub axis: Option<Axis>,
    /// The number that sizes it: of an effect the first, of a parameter its relative error.
    pub parameter: &'static str,
    /// That number's unit.
    pub unit: &'static str,
    /// The typical value of that number; of a parameter 10 %.
    pub typical: f64,
    /// How far the typical size moves the recordings beyond what starts and nominal numbers can imitate [σ], all numbers
    /// taken together.
    pub sigma: f64,
    /// The share of its signature, squared, that nominal numbers imitate [1].
    pub imitated: f64,
    /// The numbers that do, where they imitate half of it or more; the one first whose exact value would show most.
    pub imitated_by: Vec<Imitating>,
    /// True if it shows the more the smaller that number is, as a coefficient of friction; the sizes below are then the
    /// largest.
    pub shows_below: bool,
    /// The size from which on a diagnosis finds something; none where the number has no such value.
    pub seen_from: Option<f64>,
    /// The same as a multiple of the typical departure [1].
    pub seen_times: Option<f64>,
    /// The size from which on it also tells the cause from every other; none where the number has no such value.
    pub named_from: Option<f64>,
    /// The same as a multiple of the typical departure [1].
    pub named_times: Option<f64>,
    /// What simulated recordings say of the same; none where they were not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verified: Option<VerifiedSize>,
    /// Causes that it is not told from at its typical size, the nearest first.
    pub rivals: Vec<Rival>,
}

impl SeenCause {
    /// True if a diagnosis finds something at its typical size.
    pub fn is_seen(&self) -> bool {
        self.seen_times.is_some_and(|times| if self.shows_below { times >= 1.0 } else { times <= 1.0 })
    }
}

/// The size from which on simulated recordings of a robot that has a cause show it.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct VerifiedSize {
    /// The size, in the unit of the cause's own number; none where the number has no such value.
    pub from: Option<f64>,
    /// The same as a multiple of the typical departure [1]; none where no size within bounds is seen.
    pub times: Option<f64>,
    /// What recordings show at that size; none where there is none.
    pub there: Option<ShownThere>,
}

/// What simulated recordings show of a cause, without noise.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize)]
pub struct ShownThere {
    /// What the model with the cause betters the score by, its price aside [1].
    pub gain: f64,
    /// The part of that by what was stated of the robot's numbers [1].
    pub stated: f64,
    /// The share that it takes off Σ error² of one channel, noise among it, where it takes most [1].
    pub taken: f64,
    /// The share of the plain model's Σ error² that it leaves [1]: of a law for which the diagnosis's own time steps are too
    /// coarse.
    pub left: f64,
    /// Σ error² of the plain model in a run that is held out, over that in a run to fit on [1].
    pub held_out: f64,
}

/// A number of the robot file that helps to imitate a cause.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Imitating {
    /// Its key.
    pub number: &'static str,
    /// By how much it is wrong then, relatively [1]
    pub by: f64,
    /// How far the cause would move the recordings beyond imitation if this number were known just as it is stated [σ]
    pub sigma_if_exact: f64,
    /// True if a diagnosis would find something then.
    pub then_seen: bool,
}

/// A cause that another can be mistaken for.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Rival {
    /// Its id.
    pub cause: &'static str,
    /// Its body axis, of friction that is wrong on one alone.
    pub axis: Option<Axis>,
    /// The angle between what is left of both [rad]; 0: no recording of this kind tells them apart.
    pub angle_rad: f64,
    /// The multiple of the typical size from which on the two are told apart [1]; none where no size is enough.
    pub told_times: Option<f64>,
}

impl Rival {
    /// True if the two are told apart at the typical size.
    pub fn is_told(&self) -> bool {
        self.told_times.is_some_and(|times| times <= 1.0)
    }
}

/// What a sensor would bring.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct WithSensor {
    /// The group of signals, or what takes the place of one.
    pub sensor: &'static str,
    /// Causes that would then be seen at their typical size.
    pub seen: Vec<&'static str>,
    /// Causes that would then be told from all others at their typical size.
    pub named: Vec<&'static str>,
}
