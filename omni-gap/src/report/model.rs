//! The report as data. The field names are those of `report.json`; readers rely on them.

mod cause;
mod gap;
mod place;

use serde::{Deserialize, Serialize};

pub use cause::{Corrected, Estimate, NextExperiment, Which};
pub use gap::{Gap, HorizonError, Shrink, SignalGap};
pub use place::{Regime, Where};

use crate::vocabulary::Verdict;

/// The version of the form of `report.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// One diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Version of this form.
    pub schema: u32,
    /// Name of the robot, from its file.
    pub robot: Option<String>,
    /// Name of the session folder.
    pub session: Option<String>,
    /// The answer in one word.
    pub verdict: Verdict,
    /// The error of the free runs, per signal group and per horizon.
    pub gap: Gap,
    /// Where the gap lies; shares sum to 1.
    #[serde(rename = "where")]
    pub where_: Vec<Where>,
    /// Every cause considered, most probable first; probabilities sum to 1.
    pub which: Vec<Which>,
    /// Causes that the corrected model contains, the one that explains most first.
    pub causes: Vec<String>,
    /// How far the causes close the gap.
    pub shrink: Shrink,
    /// Parameters of the robot file, before and after.
    #[serde(default)]
    pub parameters: Vec<Corrected>,
    /// What this log could not have shown, each with its reason.
    pub not_seen: Vec<String>,
    /// The run that would settle what is open.
    pub next_experiment: Option<NextExperiment>,
    /// What is wrong with the log, and how to mend it.
    #[serde(default)]
    pub faults: Vec<Fault>,
    /// What the reader should know but need not mend.
    #[serde(default)]
    pub notices: Vec<String>,
}

impl Report {
    /// A report that says its verdict and nothing else yet.
    pub fn new(verdict: Verdict) -> Report {
        Report {
            schema: SCHEMA,
            robot: None,
            session: None,
            verdict,
            gap: Gap::default(),
            where_: Vec::new(),
            which: Vec::new(),
            causes: Vec::new(),
            shrink: Shrink::default(),
            parameters: Vec::new(),
            not_seen: Vec::new(),
            next_experiment: None,
            faults: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// The text of `report.json`; the same report always gives the same bytes.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// The entry of a cause in [`Report::which`].
    pub fn cause(&self, id: &str) -> Option<&Which> {
        self.which.iter().find(|w| w.cause == id)
    }
}

/// Something wrong with the log.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fault {
    /// Short name for programs.
    pub code: String,
    /// File, relative to the session.
    pub file: Option<String>,
    /// Column, as the contract names it.
    pub column: Option<String>,
    /// First and last line of the file concerned, counted from 1.
    pub rows: Option<[usize; 2]>,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub mend: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The contract's own example, with one choice taken where it lists several.
    const EXAMPLE: &str = include_str!("golden/contract.json");

    fn keys(of: &serde_json::Value, at: &str, into: &mut Vec<String>) {
        match of {
            serde_json::Value::Object(map) => map.iter().for_each(|(k, v)| {
                into.push(format!("{at}.{k}"));
                keys(v, &format!("{at}.{k}"), into);
            }),
            serde_json::Value::Array(list) => list.iter().for_each(|v| keys(v, &format!("{at}[]"), into)),
            _ => {}
        }
    }

    #[test]
    fn the_contracts_example_comes_back_as_it_went_in() {
        let report: Report = serde_json::from_str(EXAMPLE).unwrap();
        assert_eq!(report.verdict, Verdict::Effect);
        assert_eq!(report.which[0].parameters["friction_coefficient"].std, Some(0.02));
        let again: Report = serde_json::from_str(&report.to_json().unwrap()).unwrap();
        assert_eq!(report, again);
    }

    #[test]
    fn every_field_of_the_contract_is_written_under_its_name() {
        let mut asked = Vec::new();
        keys(&serde_json::from_str(EXAMPLE).unwrap(), "", &mut asked);
        let report: Report = serde_json::from_str(EXAMPLE).unwrap();
        let mut written = Vec::new();
        keys(&serde_json::to_value(&report).unwrap(), "", &mut written);
        for key in asked {
            assert!(written.contains(&key), "{key} is in the contract but not in report.json");
        }
    }

    #[test]
    fn the_same_report_gives_the_same_bytes() {
        let report = crate::report::sample::effect();
        assert_eq!(report.to_json().unwrap(), report.clone().to_json().unwrap());
    }
}
