//! The report as data. The field names are those of `report.json`; readers rely on them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::check;
use crate::engine::findings::{
    ChannelNoise, Corrected, EngineRecord, Findings, Gap, NextExperiment, Shape, Shrink, Where, Which,
};
use crate::vocabulary::Verdict;

/// The version of the form of `report.json` that this program writes.
pub const SCHEMA: u32 = 1;

/// One diagnosis.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
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
    /// The shapes of the residual that show the causes, or the gap that none explains, the plainest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub evidence: Vec<Shape>,
    /// How far the causes close the gap.
    pub shrink: Shrink,
    /// The noise of each sensor that was compared, as stated and as found.
    #[serde(default)]
    pub noise: Vec<ChannelNoise>,
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
    /// The files that it was made of, where it was made of files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<Input>,
    /// Which engine found all this, and with which thresholds; none where the recordings cannot be used.
    #[serde(default)]
    pub engine: Option<EngineRecord>,
}

/// What a report says beside the findings: of which recordings it speaks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// Name of the robot, from its file.
    pub robot: String,
    /// Name of the session folder.
    pub session: Option<String>,
    /// What is wrong with the log.
    pub faults: Vec<Fault>,
    /// What the reader should know but need not mend.
    pub notices: Vec<String>,
}

impl Report {
    /// The report of what was found.
    pub fn of(findings: &Findings, about: About) -> Report {
        let About { robot, session, faults, notices } = about;
        let found = findings.clone();
        Report {
            schema: SCHEMA,
            robot: Some(robot),
            session,
            verdict: found.verdict,
            gap: found.gap,
            where_: found.where_,
            which: found.which,
            causes: found.causes,
            evidence: found.evidence,
            shrink: found.shrink,
            noise: found.noise,
            parameters: found.parameters,
            not_seen: found.not_seen,
            next_experiment: found.next_experiment,
            faults,
            notices,
            inputs: Vec::new(),
            engine: found.engine,
        }
    }

    /// The text of `report.json`; the same report always gives the same bytes.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// The entries of [`Report::causes`] in [`Report::which`], in their order: of a cause at two places, each its own.
    pub fn named(&self) -> Vec<&Which> {
        let entry = |at: usize| {
            let id = &self.causes[at];
            let before = self.causes[..at].iter().filter(|other| *other == id).count();
            self.which.iter().filter(|entry| entry.cause == *id).nth(before)
        };
        (0..self.causes.len()).filter_map(entry).collect()
    }

    /// The first entry of a cause in [`Report::which`].
    pub fn cause(&self, id: &str) -> Option<&Which> {
        self.which.iter().find(|w| w.cause == id)
    }
}

/// A file that a report was made of.
#[derive(Clone, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
pub struct Input {
    /// Its path, as it was named.
    pub file: String,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

/// Something wrong with the log.
#[derive(Clone, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
pub struct Fault {
    /// Short name for programs.
    pub code: String,
    /// File, relative to the session.
    pub file: Option<String>,
    /// Column, as the contract names it.
    pub column: Option<String>,
    /// First and last line of the file concerned, counted from 1; rows, where the file is not text.
    pub rows: Option<[usize; 2]>,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    #[serde(rename = "mend")]
    pub fix: String,
}

impl Fault {
    /// The same, its file told with its session, where reports speak of several.
    #[must_use]
    pub fn of_session(self, name: &str) -> Self {
        Self { file: self.file.map(|file| format!("{name}: {file}")), ..self }
    }
}

impl From<&check::Fault> for Fault {
    fn from(fault: &check::Fault) -> Fault {
        Fault {
            code: fault.code.to_owned(),
            file: Some(fault.place()),
            column: (!fault.signal.is_empty()).then(|| fault.signal.clone()),
            rows: Some([fault.lines.0, fault.lines.1]),
            what: fault.sentence.trim_end_matches('.').to_owned(),
            fix: fault.fix.trim_end_matches('.').to_owned(),
        }
    }
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
