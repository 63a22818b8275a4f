//! Which recordings are frozen: the reduced benchmark, and others that log less, or are laid out in another way.

use omni_gap::Session;
use omni_gap::error::Result;
use omni_gap::log::Run;
use omni_gap::simulate::EffectInstance;

use super::layouts::Layout;
use crate::catalogue::sessions::{BenchmarkCase, HiddenCause, Staging, WHEELS, short_cases};

/// The seed of the first recording that is not the reduced benchmark's; the others count up from it.
const FIRST_SEED: u64 = 5000;

/// What a session keeps of what was recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// All of it.
    Everything,
    /// No currents.
    NoCurrents,
    /// No wheel speeds.
    NoSpeeds,
    /// No pose.
    NoPose,
    /// Voltages and the pose.
    PoseAlone,
    /// No voltages: the currents drive the model.
    CurrentsDrive,
    /// Neither voltages nor currents: the measured wheel speeds drive the model.
    SpeedsDrive,
    /// Commanded wheel speeds and the pose.
    SetSpeedsDrive,
    /// All signals of one run.
    OneRun,
    /// All signals, and the last two runs stand in `heldout/`.
    HeldOut,
}

impl Kept {
    /// All but [`Kept::Everything`], each with an effect that it makes harder or impossible to see.
    const WITH: [(Kept, &'static str); 9] = [
        (Kept::NoCurrents, "gear_efficiency"),
        (Kept::NoSpeeds, "wheel_slip"),
        (Kept::NoPose, "dead_time"),
        (Kept::PoseAlone, "supply_sag"),
        (Kept::CurrentsDrive, "stribeck"),
        (Kept::SpeedsDrive, "creep"),
        (Kept::SetSpeedsDrive, "camera_latency"),
        (Kept::OneRun, "actuation_delay"),
        (Kept::HeldOut, "coriolis"),
    ];

    fn of(self, mut session: Session) -> Session {
        match self {
            Kept::OneRun => session.runs.truncate(1),
            Kept::HeldOut => session.heldout = session.runs.split_off(session.runs.len() - 2),
            _ => session.runs.iter_mut().for_each(|run| self.of_run(run)),
        }
        session
    }

    fn of_run(self, run: &mut Run) {
        if matches!(self, Kept::CurrentsDrive | Kept::SpeedsDrive | Kept::SetSpeedsDrive) {
            run.u = None;
        }
        if matches!(self, Kept::NoCurrents | Kept::PoseAlone | Kept::SpeedsDrive | Kept::SetSpeedsDrive) {
            run.i = None;
        }
        if self == Kept::SetSpeedsDrive {
            run.wset = run.w.clone();
        }
        if matches!(self, Kept::NoSpeeds | Kept::PoseAlone | Kept::SetSpeedsDrive) {
            run.w = None;
        }
        if self == Kept::NoPose {
            run.pose = None;
        }
    }
}

/// Where a recording comes from.
#[derive(Clone, Debug)]
enum Made {
    /// A session of the benchmark, and what of it is kept.
    Case(BenchmarkCase, Kept),
    /// A session with one more effect than its case hides.
    Pair(BenchmarkCase, EffectInstance),
    /// Files in the layout of a real robot's makers.
    Layout(Layout, u64),
}

/// A recording whose answer is frozen.
#[derive(Clone, Debug)]
pub struct FrozenCase {
    /// What it is called in the file.
    pub name: String,
    made: Made,
}

impl FrozenCase {
    /// Makes it.
    ///
    /// # Errors
    /// Where its robot file or a file in another layout is not sound.
    pub fn session(&self) -> Result<Session> {
        match &self.made {
            Made::Case(case, kept) => Ok(kept.of(case.session()?)),
            Made::Pair(case, second) => case.session_with(std::slice::from_ref(second)),
            Made::Layout(layout, seed) => layout.session(*seed),
        }
    }
}

/// All of them.
pub fn recordings() -> Vec<FrozenCase> {
    let mut seeds = FIRST_SEED..;
    let mut seed = || seeds.next().unwrap_or(FIRST_SEED);
    let mut all: Vec<FrozenCase> = short_cases().into_iter().map(reduced).collect();
    for (kept, id) in Kept::WITH {
        for wheels in WHEELS {
            let hidden = HiddenCause::Effect(EffectInstance::typical(card(id), None));
            let case = BenchmarkCase { seed: seed(), wheels, hidden, staging: Staging::Short };
            let name = format!("{:?}, `{id}` on {wheels} wheels", kept);
            all.push(FrozenCase { name, made: Made::Case(case, kept) });
        }
    }
    for wheels in WHEELS {
        let [first, second] = ["dead_time", "camera_latency"].map(|id| EffectInstance::typical(card(id), None));
        let case = BenchmarkCase { seed: seed(), wheels, hidden: HiddenCause::Effect(first), staging: Staging::Short };
        let name = format!("`dead_time` and `camera_latency` on {wheels} wheels");
        all.push(FrozenCase { name, made: Made::Pair(case, second) });
    }
    for layout in [Layout::Robotino, Layout::Ssl2018] {
        let name = format!("the layout of examples/{}", layout.example());
        all.push(FrozenCase { name, made: Made::Layout(layout, seed()) });
    }
    all
}

fn reduced(case: BenchmarkCase) -> FrozenCase {
    FrozenCase {
        name: format!("{} on {} wheels, {}", case.hidden, case.wheels, case.seed),
        made: Made::Case(case, Kept::Everything),
    }
}

fn card(id: &str) -> &'static model_core::effects::card::Card {
    model_core::effects::EffectKind::find(id).expect("the catalogue has it").card()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_many_and_each_has_a_name_of_its_own() {
        let all = recordings();
        assert!(all.len() >= 40, "{}", all.len());
        let mut names: Vec<&str> = all.iter().map(|r| r.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all.len());
    }
}
