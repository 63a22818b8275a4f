//! What is left in question once the recommended script was played, and once random motion as long was.

use omni_gap::api::{Design, Findings};
use omni_gap::error::Result;
use omni_gap::log::Run;
use omni_gap::{Diagnosis, NamedSession, Options, Session};

use super::open::{OpenCase, in_question};

/// What is left in question, after either.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// How often the script was played.
    pub plays: usize,
    /// After the script.
    pub by_script: Vec<String>,
    /// After random motion as often and as long.
    pub by_random: Vec<String>,
    /// By how much the scores of the hidden cause and of its nearest rival were foretold to differ after the script [1]
    pub foretold: f64,
    /// By how much they did; none where no rival was fitted any more.
    pub found: Option<f64>,
}

impl Settled {
    /// True if less is left after the script than after random motion, or nothing more to settle after either.
    pub fn is_no_worse(&self) -> bool {
        self.by_script.len() <= self.by_random.len()
    }
}

/// Plays the script, and random motion as long; none where no script is recommended.
///
/// # Errors
/// Where no folder can be written or read.
pub fn settled(case: &OpenCase) -> Result<Option<Settled>> {
    let Some((script, design)) = case.designed.as_ref().and_then(|d| Some((d.to_play()?, &d.design))) else {
        return Ok(None);
    };
    let plays = design.plays().unwrap_or(1);
    let by_script = case.hidden.played(plays, &rows(script), design.script.rate)?;
    let by_random = case.hidden.moved_at_random(plays, design.script.seconds)?;
    let (script, random) = (together(case, by_script), together(case, by_random));
    Ok(Some(Settled {
        plays,
        by_script: in_question(&script.report),
        by_random: in_question(&random.report),
        foretold: foretold(case, design, plays),
        found: found(case, &script.findings),
    }))
}

/// The answer to a case with a further session beside it.
fn together(case: &OpenCase, session: Session) -> Diagnosis {
    let also = [NamedSession { name: "further".to_owned(), session }];
    Diagnosis::of(&case.session, &Options { also: &also, ..Options::default() })
}

/// The least difference of scores between the hidden cause and a rival that a script played so often was foretold to make.
fn foretold(case: &OpenCase, design: &Design, plays: usize) -> f64 {
    let id = case.hidden.cause.id;
    let about = design.questions.iter().filter(|q| q.cause == id || q.rival.as_deref() == Some(id));
    about.map(|q| q.now + plays as f64 * (q.then - q.now)).fold(f64::INFINITY, f64::min)
}

/// The same as it was found, among the causes that were in question.
fn found(case: &OpenCase, findings: &Findings) -> Option<f64> {
    let score = |id: &str| {
        let tried = findings.considered.iter().filter(|c| c.id == id && c.round == 0);
        tried.filter_map(|c| c.score).min_by(f64::total_cmp)
    };
    let truth = score(case.hidden.cause.id)?;
    let rivals = case.in_question.iter().filter(|id| *id != case.hidden.cause.id);
    rivals.filter_map(|id| Some(score(id)? - truth)).min_by(f64::total_cmp)
}

/// The volts of a script, row by row.
fn rows(script: &Run) -> Vec<Vec<f64>> {
    let channels = script.u.iter().flat_map(|group| &group.channels);
    let channels: Vec<Vec<f64>> =
        channels.map(|channel| (0..script.rows()).map(|row| channel.get(row).unwrap_or(0.0)).collect()).collect();
    (0..script.rows()).map(|row| channels.iter().map(|channel| channel[row]).collect()).collect()
}
