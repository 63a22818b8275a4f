//! The thresholds of the design of experiments.

use super::SelftestKnobs;

/// How the next experiment is chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignKnobs {
    /// How what recordings show is foretold; and the engine whose findings they are.
    pub selftest: SelftestKnobs,
    /// Length of the script [s]: long enough for all kinds of pieces.
    pub duration: f64,
    /// The largest voltage on a motor [V]; none: what the recordings so far have seen, or what experiments ask where that was not
    /// logged.
    pub voltage: Option<f64>,
    /// Side of the free floor [m]; none: that of the robot file, or what experiments count on.
    pub field: Option<f64>,
    /// Rows a second of a script, at the least and at the most, whatever the log's [1/s]: what it asks for lasts longer than a row,
    /// and more rows cost time.
    pub rates: (f64, f64),
    /// Seed of random motion, and of the noise of what would be recorded.
    pub seed: u64,
    /// Scripts that are drawn of each emphasis at each voltage [scripts]
    pub draws: usize,
    /// Shares of the largest voltage that scripts are written for [1]: what shows at low speed shows there alone.
    pub voltages: Vec<f64>,
    /// Random motions that the scripts are compared with [runs]; of these the median counts.
    pub random: usize,
    /// Rows of the recordings so far that are looked at, at the most [rows]; the rest is taken to be like them.
    pub most_rows: usize,
    /// Standard errors of a difference of scores by which it has to be above what is asked [1]: in four recordings of five it is.
    pub sure_errors: f64,
    /// A question counts no more than so many times what it needs [1]: beyond that the others matter more.
    pub enough_times: f64,
    /// A script that has to be played more often than this answers nothing [runs]: nobody would play it, and what it does each
    /// time is too little to be foretold.
    pub most_plays: usize,
    /// Where no cause is named, so many of those that came nearest are told apart [causes]
    pub nearest: usize,
    /// A measurement by hand is good to this share of a number, …
    pub by_hand: f64,
    /// … and not worth while unless it betters what is stated by this factor [1].
    pub betters: f64,
    /// Measurements that are told, at the most.
    pub measures: usize,
}

impl Default for DesignKnobs {
    fn default() -> Self {
        Self {
            selftest: SelftestKnobs::default(),
            duration: 10.0,
            voltage: None,
            field: None,
            rates: (20.0, 200.0),
            seed: 1,
            draws: 3,
            voltages: vec![1.0, 0.5],
            random: 3,
            most_rows: 20_000,
            sure_errors: 0.84,
            enough_times: 9.0,
            most_plays: 6,
            nearest: 3,
            by_hand: 0.01,
            betters: 2.0,
            measures: 4,
        }
    }
}
