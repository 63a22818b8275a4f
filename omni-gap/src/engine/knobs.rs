//! # Knobs: every threshold of the engine, in one place
//!
//! Each field says what it is, in which unit, and why it has the value that [`Knobs::default`] gives it. A report carries
//! the knobs that it was made with, so that an answer can be made again, and a benchmark can say what each one is worth.
//! "By trial" as a reason means: the counts of the benchmark were reached with it, and no better reason is known.

mod design;
mod excerpt;
mod outcome;
mod probability;
mod selftest;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use design::DesignKnobs;
pub use excerpt::ExcerptKnobs;
pub use outcome::OutcomeKnobs;
pub use probability::{CalibrationKnobs, LogitLine, ProbabilityKnobs, logit};
pub use selftest::SelftestKnobs;

use crate::identify::{FitSettings, WINDOW_S};
use crate::localise::flexible::FlexibleSettings;
use crate::localise::shape::ShapeSettings;
use crate::localise::{HORIZONS_S, RegimeSettings};
use crate::simulate::HORIZON_S;

/// The version of the knobs' names and meanings that this program writes; a new value of a knob is no new version.
pub const KNOBS_VERSION: u32 = 2;

/// All thresholds.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct Knobs {
    /// Version of the names and meanings below.
    pub version: u32,
    /// Whether the findings keep the equations that many robots are pooled by. Costs one more screen where causes were found, and
    /// changes no answer.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub equations: bool,
    /// How recordings are laid out into runs to fit on and runs to judge by.
    pub layout: LayoutKnobs,
    /// How models are fitted.
    pub fit: FitSettings,
    /// Which causes are worth a fit.
    pub screen: ScreenKnobs,
    /// Which causes a corrected model takes up, and which cannot be told apart.
    pub search: SearchKnobs,
    /// What noise is believed where the recordings show another than is stated.
    pub noise: NoiseKnobs,
    /// When causes explain a gap, and when there is none.
    pub outcome: OutcomeKnobs,
    /// How scores become probabilities.
    pub probability: ProbabilityKnobs,
    /// How the gap is measured.
    pub measure: MeasureKnobs,
    /// Where the gap is said to lie.
    pub places: PlacesKnobs,
    /// Which shapes of the residual are shown as evidence.
    pub evidence: ShapeSettings,
    /// How flexible the model is that tells how much could be explained at all.
    pub flexible: FlexibleSettings,
}

/// How recordings are laid out.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct LayoutKnobs {
    /// One run of this many is held out where the session holds out none [runs]: a third to judge by, two thirds to fit.
    pub hold_out_every: usize,
    /// Parts into which each run is cut where there are fewer than `hold_out_every` [1]: as many, so that one is held out.
    pub parts_of_a_lone_run: usize,
    /// Which rows stand for recordings that are too long to be weighed whole.
    pub excerpt: ExcerptKnobs,
    /// Length of a shooting window [s]: the gap's own horizon, so that what is fitted is what is measured.
    pub window_s: f64,
}

/// Which causes are worth a fit.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct ScreenKnobs {
    /// Runs that the screen looks at, at the most where they are long enough [runs]: four tell candidates apart, and more only
    /// take time.
    pub runs: usize,
    /// How long these last together, at least, where there are more runs [s]: 24 windows. Of short runs it looks at more.
    pub least_s: f64,
    /// Of these it looks at this long, at the most [s]: what tells candidates apart shows in a minute.
    pub most_s: f64,
    /// And at so many rows, at the most [rows]: the matrices of every window are kept.
    pub most_rows: usize,
    /// Causes that are left out, by their ids: for whoever asks what an answer rests on.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub without: Vec<String>,
    /// A promise below this is not worth a fit [σ²]: three sigma of one number.
    pub promising: f64,
    /// The same of a number of the robot file [1]: what the search asks of it at the least.
    pub promising_number: f64,
    /// Beyond the best `always_fitted`, a promise below this share of the best is not worth a fit [1]. By trial.
    pub worth_a_fit: f64,
    /// Share of a promise that is worth a fit below which, at its typical size, an effect is not looked at more closely, at
    /// other sizes and shapes [1]: there it would have to promise ten times as much.
    pub closer_look: f64,
    /// Effects that are fitted however far behind the best they are, if they are promising [effects]: a rival at least.
    pub always_fitted: usize,
    /// Effects that are fitted, at the most [effects]: a limit of time.
    pub fitted_effects: usize,
    /// Places on single wheels at which one effect is fitted, at the most [wheels]: the best and its rival.
    pub fitted_wheels: usize,
    /// Parameter causes that are fitted, at the most [causes]: a limit of time.
    pub fitted_parameters: usize,
    /// What a single wheel has to promise of what all wheels together do [1]: one of three or four that does the whole
    /// promises nearly all of it, and its fair share is less than a half.
    pub single_wheel_share: f64,
    /// What a look-alike of a cause that leaves nothing has to promise of what that cause did [1]. By trial.
    pub alike_share: f64,
    /// Multiples of an effect's typical size at which it is tried beside the typical one [1]: half and twice.
    pub size_multiples: Vec<f64>,
    /// Multiples of a shape's typical value at which it is tried [1]: a third, twice and four times.
    pub shape_multiples: Vec<f64>,
    /// Shares of its range by which a shape that can have both signs (an angle) is turned [1]: quarter turns.
    pub shape_turns: Vec<f64>,
    /// Share of its range by which a shape that is an effect of its own (a ratio) is moved from its typical value [1].
    pub shape_away: f64,
    /// The least and the largest multiple of a trial at which a fit starts [1]: a screen is linear, and a start far from
    /// the trial is not to be believed.
    pub start_between: (f64, f64),
    /// Share of a signature's own size that has to be left once starts and parameters have taken theirs [1]: below it the
    /// quotient is rounding.
    pub least_left: f64,
    /// The same without the signature's own size [σ²]: a signature of nothing.
    pub least_size: f64,
    /// A typical effect below this many sigma of the whole recording could not have been seen [σ]: beyond chance however
    /// many effects are tried.
    pub visible: f64,
}

/// Which causes a corrected model takes up.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct SearchKnobs {
    /// Effects that one corrected model may need, at the most [effects]: a limit of time. More than 3 counts as 3: a model has
    /// no room for more beside the effects of its robot file.
    pub most_causes: usize,
    /// Wrong numbers of the robot file beside them, at the most [numbers]: six of fifteen is another robot's file.
    pub most_numbers: usize,
    /// What each free number of a cause costs in the score [1]: as in Akaike's criterion.
    pub price_of_freedom: f64,
    /// Σ error² per number below which nothing relevant can be left [σ²]: the relevant further effect takes more.
    pub enough: f64,
    /// A cause has to better the score by this [1], …
    pub convincing: f64,
    /// … and by as much again for each free number or statement that it adds [1]; one number: a chance of 1 in 2,000 when
    /// nothing is there.
    pub convincing_each: f64,
    /// The same as `convincing` of a number of the robot file [1]: with what each costs, 2.75 stated sigmas. One of fifteen numbers
    /// of a file that states its own errors rightly is that far off in one robot of eleven.
    pub convincing_number: f64,
    /// The same where another number is known to be wrong [1]: 2.5 stated sigmas; then one in four is believed to be of such a file.
    pub convincing_further_number: f64,
    /// An effect has to take this share off Σ error² of one channel [1]: a significant but tiny improvement explains nothing.
    /// Of one channel, since what shows in the poses alone, or on one wheel, is not made smaller by what else was logged. What a
    /// record shows event by event need not: it was counted.
    pub relevant: f64,
    /// Where no effect is known, one that takes so much off what the robot's numbers cost by what is stated of them is as
    /// relevant [σ²]: without it they predict as well, but one would be 5 of its stated sigmas off. An effect beside
    /// which they still cost so much may stand for several of them that are wrong together.
    pub unbelievable: f64,
    /// A further effect has to take this share off what the first causes left of one channel [1]. By trial.
    pub relevant_further: f64,
    /// Score within which two causes are not told apart [1]: a likelihood ratio of e⁴ at the most. No window counts for more.
    pub tie: f64,
    /// Standard errors of a difference of scores that count as none [1]: 95 %.
    pub tie_errors: f64,
    /// Standard errors by which an effect's size has to be away from absent [1]: 99.7 %.
    pub size_errors: f64,
}

/// What noise is believed.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct NoiseKnobs {
    /// Noise that differs from what is stated by less than this factor is as stated [1]: a fit's own errors are as large.
    pub as_stated: f64,
    /// The share of the windows, those in which least is left over, that the noise of a sensor is taken from which would be beyond
    /// belief [1]. By trial on the benchmark's tuning split.
    pub quiet: f64,
    /// Of the stated sigma, the most and the least that are believed [1]: what is larger is a gap. Data sheets, and people
    /// who look at a robot at rest, are wrong by two or three times.
    pub most: f64,
    /// The same for wheel speeds [1]: coarse counts of an encoder make more.
    pub most_of_speeds: f64,
    /// The least [1].
    pub least: f64,
    /// The longest that noise is believed to remember itself [s]: filters of sensors are faster than robots.
    pub longest_s: f64,
    /// A memory of less than this many samples' time is none [1].
    pub shortest_rows: f64,
}

/// How the gap is measured.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct MeasureKnobs {
    /// Time between restarts of the free runs [s]: long enough for a wrong force to show, short enough that a wheel that
    /// slipped once does not spoil a run.
    pub horizon_s: f64,
    /// Horizons of the curves [s].
    pub horizons_s: Vec<f64>,
    /// A gap smaller than this is not divided by [σ]: the quotient would be noise.
    pub smallest_room_sigma: f64,
    /// Resamplings of the windows for the interval of what is closed [1]: the ends are then known to a few per cent.
    pub resamplings: usize,
    /// Seed of these resamplings.
    pub resampling_seed: u64,
    /// The two ends of the interval, as shares of the resamplings [1]: 95 % between them.
    pub interval: (f64, f64),
    /// What is kept of a run's signals for pictures [s]: eight restarts, as much as a page shows.
    pub shown_s: f64,
}

/// Where the gap is said to lie.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(default)]
pub struct PlacesKnobs {
    /// A wheel that holds this many times its fair share of the error is named [1]: nearly two wheels' share.
    pub wheel_stands_out: f64,
    /// An axis that holds this share of the error is named [1]: twice its fair share.
    pub axis_holds: f64,
    /// Stages with a smaller share are left out [1]: they would be written as zero.
    pub negligible: f64,
    /// What every stage weighs before any cause speaks for it [score]: a grain, so that a link that no cause speaks of
    /// still has somewhere to go.
    pub grain: f64,
    /// Regimes of the motion.
    pub regime: RegimeSettings,
}

impl Default for Knobs {
    fn default() -> Self {
        Self {
            version: KNOBS_VERSION,
            equations: false,
            layout: LayoutKnobs::default(),
            fit: FitSettings::default(),
            screen: ScreenKnobs::default(),
            search: SearchKnobs::default(),
            noise: NoiseKnobs::default(),
            outcome: OutcomeKnobs::default(),
            probability: ProbabilityKnobs::default(),
            measure: MeasureKnobs::default(),
            places: PlacesKnobs::default(),
            evidence: ShapeSettings::default(),
            flexible: FlexibleSettings::default(),
        }
    }
}

impl Default for LayoutKnobs {
    fn default() -> Self {
        Self { hold_out_every: 3, parts_of_a_lone_run: 3, excerpt: ExcerptKnobs::default(), window_s: WINDOW_S }
    }
}

impl Default for ScreenKnobs {
    fn default() -> Self {
        Self {
            runs: ExcerptKnobs::default().few_runs,
            least_s: 12.0,
            most_s: 80.0,
            most_rows: 20_000,
            without: Vec::new(),
            promising: 9.0,
            promising_number: 6.0,
            worth_a_fit: 0.25,
            closer_look: 0.1,
            always_fitted: 2,
            fitted_effects: 6,
            fitted_wheels: 2,
            fitted_parameters: 4,
            single_wheel_share: 0.6,
            alike_share: 0.5,
            size_multiples: vec![0.03, 0.5, 2.0],
            shape_multiples: vec![0.33, 2.0, 4.0],
            shape_turns: vec![0.25, 0.5, 0.75],
            shape_away: 0.05,
            start_between: (0.5, 1.5),
            least_left: 1e-6,
            least_size: 1e-9,
            visible: 5.0,
        }
    }
}

impl Default for SearchKnobs {
    fn default() -> Self {
        Self {
            most_causes: 3,
            most_numbers: 6,
            price_of_freedom: 2.0,
            enough: 1.03,
            convincing: 8.0,
            convincing_each: 2.0,
            convincing_number: 3.6,
            convincing_further_number: 2.3,
            relevant: 0.01,
            unbelievable: 25.0,
            relevant_further: 0.05,
            tie: 8.0,
            tie_errors: 2.0,
            size_errors: 3.0,
        }
    }
}

impl Default for NoiseKnobs {
    fn default() -> Self {
        Self {
            as_stated: 1.2,
            quiet: 0.3,
            most: 3.0,
            most_of_speeds: 4.5,
            least: 1.0 / 3.0,
            longest_s: 0.06,
            shortest_rows: 0.5,
        }
    }
}

impl Default for MeasureKnobs {
    fn default() -> Self {
        Self {
            horizon_s: HORIZON_S,
            horizons_s: HORIZONS_S.to_vec(),
            smallest_room_sigma: 0.1,
            resamplings: 400,
            resampling_seed: 1,
            interval: (0.025, 0.975),
            shown_s: 4.0,
        }
    }
}

impl Default for PlacesKnobs {
    fn default() -> Self {
        Self {
            wheel_stands_out: 1.8,
            axis_holds: 0.7,
            negligible: 0.005,
            grain: 1e-6,
            regime: RegimeSettings::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knobs_come_back_from_their_file_bit_for_bit() {
        let knobs = Knobs::default();
        let text = serde_json::to_string(&knobs).unwrap();
        assert_eq!(serde_json::from_str::<Knobs>(&text).unwrap(), knobs);
    }

    #[test]
    fn a_file_that_turns_one_knob_leaves_the_others_where_they_are() {
        let turned: Knobs = serde_json::from_str(r#"{ "search": { "tie": 4.0 } }"#).unwrap();
        let usual = Knobs::default();
        assert_eq!(turned.search, SearchKnobs { tie: 4.0, ..usual.search.clone() });
        assert_eq!(Knobs { search: usual.search.clone(), ..turned }, usual);
    }
}
