//! Evidence over the runs of a session: what is wrong in the cabling or the columns is wrong in every run.

/// What a relation says of some recordings.
pub(super) trait Evidence: Clone {
    /// A guess at what is wrong.
    type Guess: Clone;

    fn add(&mut self, other: &Self);

    /// The guess that explains these recordings much better than the log as it is, and well.
    ///
    /// `usual` is what remains in other runs of the session: a guess that brings the rest back to it may explain less.
    fn best(&self, usual: Option<f64>) -> Option<Self::Guess>;

    /// What remains with the log as it is, and with the guess, as shares of what is to be explained.
    fn rests(&self, guess: &Self::Guess) -> (f64, f64);

    /// What remains with the log as it is, over all wheels.
    fn rest_as_given(&self) -> f64;
}

/// A run in which neither the log nor the guess leaves more than this share does not object.
const SILENT: f64 = 0.02;
/// A single run must be this many times worse than the good runs of its session.
const WORSE: f64 = 4.0;

/// The guesses that hold, each with the runs that it holds for.
pub(super) fn guesses<E: Evidence>(runs: &[E]) -> Vec<(E::Guess, Vec<usize>)> {
    let Some(mut pooled) = runs.first().cloned() else {
        return Vec::new();
    };
    runs[1..].iter().for_each(|run| pooled.add(run));
    if let Some(guess) = pooled.best(None) {
        let better = |run: &E| {
            let (given, otherwise) = run.rests(&guess);
            given > 1.3 * otherwise || given.max(otherwise) < SILENT
        };
        if runs.iter().all(better) {
            return vec![(guess, (0..runs.len()).collect())];
        }
    }
    if runs.len() == 1 {
        return Vec::new();
    }
    let mut sorted: Vec<f64> = runs.iter().map(E::rest_as_given).collect();
    sorted.sort_by(f64::total_cmp);
    let good = sorted[sorted.len() / 4];
    let one = |(k, run): (usize, &E)| {
        let worse = run.rest_as_given() > WORSE * good;
        let guess = if worse { run.best(None).or_else(|| run.best(Some(good)))? } else { return None };
        Some((guess, vec![k]))
    };
    runs.iter().enumerate().filter_map(one).collect()
}

/// Which runs a guess holds for, as a sentence; nothing where there is only one.
pub(super) fn in_which(found: usize, runs: usize) -> String {
    match (found, runs) {
        (_, 1) => String::new(),
        (found, runs) if found == runs => format!(" So it is in all {runs} runs."),
        _ => " The other runs are not so.".into(),
    }
}
