//! How a suspect of typical size stands among the others.

use model_core::effects::nominal;

use super::left::Left;
use super::sizing::Sizing;
use super::suspects::Suspect;
use crate::engine::findings::{ConfusedCause, Imitating, Rival, SeenCause};
use crate::engine::knobs::SelftestKnobs;
use crate::engine::stepwise::Cause;
use crate::identify::Prior;
use crate::log::RobotFile;

/// How a suspect of typical size stands in the channels of one set.
pub(super) struct Standing {
    /// |s⊥|² [σ²]
    pub size: f64,
    /// What the engine would ask of it [σ²]
    pub needed: f64,
    /// The power of its multiple of the typical size with which |s⊥|² grows, as a straight line.
    grows: f64,
    /// The numbers that imitate it, the one first whose exact value would show most.
    imitated_by: Vec<Imitating>,
    /// Every other cause, the nearest first, each where it is nearest.
    others: Vec<Rival>,
}

impl Standing {
    /// Of all of them; `enough` says of a suspect that shows event by event from which multiple of its size on it does so
    /// often enough.
    pub fn of_all(
        suspects: &[Suspect],
        left: &Left,
        file: &RobotFile,
        knobs: &SelftestKnobs,
        enough: impl Fn(&Suspect) -> Option<f64>,
    ) -> Vec<Self> {
        let prior = Prior::stated(file);
        suspects.iter().map(|s| Self::of((s, enough(s)), suspects, left, &prior, knobs)).collect()
    }

    fn of(
        (suspect, enough): (&Suspect, Option<f64>),
        all: &[Suspect],
        left: &Left,
        prior: &Prior,
        knobs: &SelftestKnobs,
    ) -> Self {
        let freedom = suspect.cause.freedom(prior);
        let search = &knobs.engine.search;
        let counts = left.counts(suspect.typical, 1.0 / knobs.engine.layout.hold_out_every as f64);
        let gain = search.convincing + (search.convincing_each + search.price_of_freedom) * freedom as f64;
        let size = left.size_of(suspect.typical);
        let relevant = match (&suspect.cause, enough) {
            (_, Some(times)) => size * times,
            // by the channel where it shows most
            (Cause::Effect(..), None) => search.relevant * size / left.most_in_a_channel(suspect.typical),
            (Cause::Parameter(_), None) => 0.0,
        };
        // events are as many more, and each is what it was
        let grows = if enough.is_some() { 1.0 } else { 2.0 };
        let rival = |rival: &Suspect| {
            let beside = left.beside(suspect, rival, knobs.regular);
            // what leaves nothing is not told from anything
            let angle_rad = if size > 0.0 { (beside / size).sqrt().clamp(0.0, 1.0).asin() } else { 0.0 };
            let told_times =
                (angle_rad > knobs.same_angle_rad).then(|| (search.tie / (counts * beside)).powf(1.0 / grows));
            Rival { cause: rival.cause.id(), axis: rival.cause.axis(), angle_rad, told_times }
        };
        let mut others: Vec<Rival> = all.iter().filter(|r| !r.cause.same_id(&suspect.cause)).map(rival).collect();
        others.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad));
        let mut ids: Vec<&str> = Vec::new();
        others.retain(|other| {
            let new = !ids.contains(&other.cause);
            ids.push(other.cause);
            new
        });
        let needed = (gain / counts).max(relevant);
        let imitated_by = imitating(suspect.typical, left, prior, (needed, knobs));
        Self { size, needed, grows, imitated_by, others }
    }

    /// The multiple of its size from which on it is seen, as a straight line.
    pub fn seen(&self) -> f64 {
        (self.needed / self.size).powf(1.0 / self.grows)
    }

    pub fn is_seen(&self) -> bool {
        self.size >= self.needed
    }

    pub fn is_named(&self) -> bool {
        self.is_seen() && self.others.iter().all(Rival::is_told)
    }

    /// The multiple of its size from which on it is told from the rival that is hardest to tell from it.
    fn told(&self) -> f64 {
        self.others.iter().map(|other| other.told_times.unwrap_or(f64::INFINITY)).fold(0.0, f64::max)
    }

    /// The same as an answer, seen from this multiple on.
    pub fn as_seen(&self, suspect: &Suspect, seen_times: Option<f64>, imitated: f64, wrong: f64) -> SeenCause {
        let sizing = Sizing::of(&suspect.cause, wrong);
        // a coefficient of friction shows the more the smaller it is
        let shows_below = self.is_seen() && seen_times.is_some_and(|times| times > 1.0);
        let more = (self.told() / self.seen()).max(1.0);
        let named_times = seen_times.map(|times| if shows_below { times / more } else { times * more });
        let named_times = named_times.filter(|times| times.is_finite() && *times > 0.0);
        let rivals = self.others.iter().filter(|other| self.is_seen() && !other.is_told());
        SeenCause {
            cause: suspect.cause.id(),
            kind: suspect.cause.kind(),
            wheel: suspect.cause.wheel(),
            axis: suspect.cause.axis(),
            parameter: sizing.key,
            unit: sizing.unit,
            typical: sizing.typical,
            sigma: self.size.sqrt(),
            imitated,
            imitated_by: self.imitated_by.clone(),
            shows_below,
            seen_from: seen_times.and_then(|times| sizing.at(times)),
            seen_times,
            named_from: named_times.and_then(|times| sizing.at(times)),
            named_times,
            verified: None,
            rivals: rivals.cloned().collect(),
        }
    }

    /// The same with every other cause.
    pub fn as_confused(&self, suspect: &Suspect) -> ConfusedCause {
        ConfusedCause {
            cause: suspect.cause.id(),
            kind: suspect.cause.kind(),
            wheel: suspect.cause.wheel(),
            axis: suspect.cause.axis(),
            sigma: self.size.sqrt(),
            seen: self.is_seen(),
            others: self.others.clone(),
        }
    }
}

/// The numbers of the robot file that imitate a column, where they do so in large part; those that hardly move are left out.
fn imitating(column: usize, left: &Left, prior: &Prior, (needed, knobs): (f64, &SelftestKnobs)) -> Vec<Imitating> {
    if left.share_taken(column) < knobs.look_twice {
        return Vec::new();
    }
    let statements = nominal::numbers().zip(&prior.rows).zip(left.violated(column)).enumerate();
    let mut all: Vec<Imitating> = statements
        .map(|(at, ((number, row), violated))| {
            let exact = left.size_if_exact(column, at);
            // a violation is the logarithm of the factor, over its sigma
            let by = (row.sigma * violated).exp_m1();
            Imitating { number: number.key, by, sigma_if_exact: exact.sqrt(), then_seen: exact >= needed }
        })
        .collect();
    let most = all.iter().map(|number| number.by.abs()).fold(0.0, f64::max);
    all.retain(|number| number.by.abs() > knobs.hardly_moved * most);
    all.sort_by(|a, b| b.sigma_if_exact.total_cmp(&a.sigma_if_exact));
    all
}
