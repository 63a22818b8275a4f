//! # Lost commands: which telegrams a recording shows as lost
//!
//! A motor's current, sampled just after a command, answers to it at once. Where it still answers to the command before,
//! the telegram was lost. What else the model has wrong is much the same on rows that follow each other, and is taken off:
//!
//! ```text
//! h: what was heard last, d = (u − h)/R, r: what was left over on the rows before, smoothed
//! f = Σ d·(i + l·K_v·ω/R − h/R − r) / Σ d²          0: lost, 1: heard, each ± √v
//! v = (1 + α/(2 − α))/(Σ d²/σ²) + v_model
//! ρ = e^(−f²/2v) / (e^(−(f − 1)²/2v) + ε)            odds of a loss, before the share of losses is known
//! ```
//!
//! Where drives control the wheels' speeds, the speed takes the current's place.

use std::ops::Range;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::aligned_run::AlignedRun;
use super::losses::{DrawnLosses, Losses, Odds, ShownLosses, most_likely_share};
use crate::log::{Chain, RobotFile};

/// α, what the last row counts for in what is left over [1]: half, since a model's error wanders.
const LAST_ROW: f64 = 0.5;
/// √v_model, how far a model misses a change of current, relatively [1]: resistance and supply are known to some per cent.
const MODEL_ERROR: f64 = 0.15;
/// ε, how likely an answer is that fits neither, over one that fits [1]
const NEITHER: f64 = 1e-4;
/// No telegram was heard more surely than by these odds [1].
const LEAST_ODDS: f64 = 1e-30;
/// Odds from which on a telegram was lost rather than heard, if one of some thirty is [1].
const LIKELY_LOST: f32 = 30.0;
/// More telegrams that follow each other are not lost: something else keeps the current from following.
const MOST_IN_A_ROW: usize = 5;
/// A change below this tells nothing [σ]: of smaller ones, what else the model has wrong moves as much from row to row.
const TELLS: f64 = 7.0;

/// Finds which telegrams runs of one robot lose: the share is that of all of them together.
pub fn find_losses<'a, const N: usize>(runs: impl IntoIterator<Item = &'a mut AlignedRun<N>>, robot: &RobotFile) {
    let mut runs: Vec<&mut AlignedRun<N>> = runs.into_iter().collect();
    let mut shown: Vec<ShownLosses<N>> = runs.iter().map(|run| shown(run, robot)).collect();
    let all = most_likely_share(shown.iter().map(|run| &run.all));
    let each: [f64; N] = std::array::from_fn(|j| most_likely_share(shown.iter().map(|run| &run.each[j])));
    for run in &mut shown {
        run.all.settle(all);
        run.each.iter_mut().zip(each).for_each(|(odds, share)| odds.settle(share));
    }
    runs.iter_mut().zip(shown).for_each(|(run, shown)| run.losses = Losses::Shown(shown));
}

/// What a run shows, the share not known yet.
fn shown<const N: usize>(run: &AlignedRun<N>, robot: &RobotFile) -> ShownLosses<N> {
    let Some(answers) = Answers::new(run, robot) else { return ShownLosses::default() };
    let odds = |wheels| Odds { of_row: answers.odds(wheels), share: 0.0 };
    ShownLosses { all: odds(0..N), each: std::array::from_fn(|j| odds(j..j + 1)) }
}

impl<const N: usize> AlignedRun<N> {
    /// The same, with the telegrams' fate drawn: what recordings of this robot that are yet to be made could show.
    #[must_use]
    pub fn with_drawn_losses(self, robot: &RobotFile, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let chances = (0..self.rows()).map(|_| random.random()).collect();
        let would_show = shown(&self, robot);
        Self { losses: Losses::Drawn(DrawnLosses { chances, would_show }), ..self }
    }
}

/// What answers to commands at once.
struct Answers<'a, const N: usize> {
    run: &'a AlignedRun<N>,
    /// The first wheel's channel.
    channel: usize,
    /// The answer over the command [1/Ω], or 1 where a speed answers to a speed
    per_command: f64,
    /// The answer that a wheel's speed takes away, over the speed [A·s], or nothing
    per_speed: f64,
}

impl<'a, const N: usize> Answers<'a, N> {
    fn new(run: &'a AlignedRun<N>, robot: &RobotFile) -> Option<Self> {
        let channels = AlignedRun::<N>::channels();
        match run.chain {
            Chain::Voltage if !run.unsigned_current => {
                let motor = &robot.motor;
                let per_command = 1.0 / motor.resistance_ohm;
                let per_speed = motor.gear_ratio * motor.emf_constant_v_s * per_command;
                Some(Self { run, channel: channels.current(0), per_command, per_speed })
            }
            Chain::SetSpeed => Some(Self { run, channel: channels.wheel_speed(0), per_command: 1.0, per_speed: 0.0 }),
            _ => None,
        }
    }

    /// What a wheel answers beyond what its speed takes away; none where that is not known.
    fn answer(&self, row: usize, wheel: usize) -> Option<f64> {
        let (run, speed) = (self.run, AlignedRun::<N>::channels().wheel_speed(wheel));
        if !run.saw(row, self.channel + wheel) || run.open[row][wheel] {
            return None;
        }
        let turning = if run.saw(row, speed) { run.measured[row][speed] } else { 0.0 };
        Some(run.measured[row][self.channel + wheel] + self.per_speed * turning)
    }

    /// Variance of that answer's noise.
    fn variance(&self, row: usize, wheel: usize) -> f64 {
        let (run, speed) = (self.run, AlignedRun::<N>::channels().wheel_speed(wheel));
        let of_speed = if run.saw(row, speed) { self.per_speed * run.sigma[speed] } else { 0.0 };
        run.sigma[self.channel + wheel].powi(2) + of_speed * of_speed
    }

    /// Follows what these wheels hear: ρ of every row.
    fn odds(&self, wheels: Range<usize>) -> Vec<f32> {
        let Self { run, per_command, .. } = *self;
        let (mut heard, mut left_over, mut in_a_row) = ([0.0; N], [None::<f64>; N], Vec::new());
        let mut odds = vec![0.0; run.rows()];
        for row in (0..run.rows()).filter(|row| run.driven[*row]) {
            let (sent, mut answers) = (run.input[row], [None; N]);
            wheels.clone().for_each(|j| answers[j] = self.answer(row, j));
            // Σ d²/σ² and Σ d·(…)/σ²
            let (mut size, mut followed) = (0.0, 0.0);
            for j in wheels.clone() {
                let Some((answer, before)) = answers[j].zip(left_over[j]) else { continue };
                let change = per_command * (sent[j] - heard[j]);
                let variance = self.variance(row, j);
                size += change * change / variance;
                followed += change * (answer - per_command * heard[j] - before) / variance;
            }
            if size >= TELLS * TELLS {
                odds[row] = odds_of_loss(followed / size, size).max(LEAST_ODDS) as f32;
            }
            if odds[row] > LIKELY_LOST {
                in_a_row.push(row);
            } else {
                in_a_row.clear();
            }
            if in_a_row.len() > MOST_IN_A_ROW {
                in_a_row.drain(..).for_each(|row: usize| odds[row] = 0.0);
            }
            if in_a_row.is_empty() {
                heard = sent;
            }
            for j in wheels.clone() {
                let now = answers[j].map(|answer| answer - per_command * heard[j]);
                left_over[j] = match (left_over[j], now) {
                    (Some(before), Some(now)) => Some(before + LAST_ROW * (now - before)),
                    (before, now) => now.or(before),
                };
            }
        }
        odds
    }
}

/// ρ, of a change of this size [σ²] that was followed to the share f.
fn odds_of_loss(f: f64, size: f64) -> f64 {
    // v = (1 + α/(2 − α))/(Σ d²/σ²) + v_model
    let v = (1.0 + LAST_ROW / (2.0 - LAST_ROW)) / size + MODEL_ERROR * MODEL_ERROR;
    let likelihood = |off: f64| (-0.5 * off * off / v).exp();
    // ρ = e^(−f²/2v) / (e^(−(f − 1)²/2v) + ε)
    likelihood(f) / (likelihood(f - 1.0) + NEITHER)
}

#[cfg(test)]
mod tests {
    use model_core::effects::EffectKind;
    use model_core::effects::telegram::Delivery;
    use model_core::plant::Input;

    use super::super::excite::{Excitation, excite};
    use super::super::model::{EffectInstance, Model};
    use super::super::record::{SensorSetup, record};
    use super::*;
    use crate::log::{Catalogue, Run};

    const RATE: f64 = 200.0;

    fn robot() -> RobotFile {
        let text = include_str!("../../robots/feup-3w/robot.toml");
        RobotFile::parse(text, std::path::Path::new("robot.toml"), &Catalogue::default()).unwrap()
    }

    /// Runs of ten seconds of a robot with an effect of this size, and what it was sent.
    fn recorded(effect: Option<(EffectKind, f64)>) -> Vec<(Run, Vec<[f64; 3]>)> {
        let mut model = Model::<3>::nominal(&robot(), 12.0);
        if let Some((kind, size)) = effect {
            let mut effect = EffectInstance::typical(kind.card(), None);
            effect.params[0] = size;
            model.add_effect(effect);
        }
        let plant = model.plant();
        let wish = Excitation { duration: 10.0, rate: RATE, voltage: 8.0 };
        let one = |seed: u64| {
            let sent = excite(&plant.robot().wheels, &wish, seed);
            let t: Vec<f64> = (0..sent.len()).map(|row| row as f64 / RATE).collect();
            let input: Vec<_> = sent.iter().copied().map(Input::Voltage).collect();
            let how = SensorSetup { sensors: robot().sensors, ..SensorSetup::default() };
            (record(&plant, "run", &t, &input, &how, seed), sent)
        };
        (0..6).map(one).collect()
    }

    fn pooled(runs: &[(Run, Vec<[f64; 3]>)]) -> Vec<AlignedRun<3>> {
        let mut aligned: Vec<_> = runs.iter().map(|(run, _)| AlignedRun::new(run, &robot()).unwrap()).collect();
        find_losses(&mut aligned, &robot());
        aligned
    }

    fn evidence(run: &AlignedRun<3>, row: usize) -> f64 {
        match run.telegram(row).map(|telegram| telegram.all) {
            Some(Delivery::Shown(evidence)) => evidence,
            other => panic!("{other:?}"),
        }
    }

    /// The rows at which a record says that a change by more than so many volts on some wheel was lost, and all such rows.
    fn lost_at(run: &AlignedRun<3>, sent: &[[f64; 3]], volts: f64) -> (Vec<usize>, Vec<usize>) {
        let changes = |row: &usize| (0..3).any(|j| (sent[*row][j] - sent[row - 1][j]).abs() > volts);
        let changes: Vec<usize> = (1..sent.len()).filter(changes).collect();
        (changes.iter().copied().filter(|row| evidence(run, *row) > 1.0).collect(), changes)
    }

    #[test]
    fn changes_that_the_current_did_not_follow_were_lost_and_all_others_were_heard() {
        let share = 0.1;
        let runs = recorded(Some((EffectKind::CommandLoss, share)));
        let (mut lost_in_all, mut changes_in_all) = (0, 0);
        for (aligned, (run, sent)) in pooled(&runs).iter().zip(&runs) {
            let current = &run.i.as_ref().unwrap().channels;
            let (lost, changes) = lost_at(aligned, sent, 1.5);
            for row in &changes {
                // what the currents jumped by, over what the voltages did
                let jump = |j: usize| (sent[*row][j] - sent[row - 1][j]) / robot().motor.resistance_ohm;
                let moved = |j: usize| current[j].get(*row).unwrap() - current[j].get(row - 1).unwrap();
                let (size, followed) =
                    (0..3).fold((0.0, 0.0), |(a, b), j| (a + jump(j) * jump(j), b + jump(j) * moved(j)));
                assert_eq!(lost.contains(row), followed < 0.5 * size, "row {row}: {}", followed / size);
            }
            (lost_in_all, changes_in_all) = (lost_in_all + lost.len(), changes_in_all + changes.len());
        }
        let expected = share * changes_in_all as f64;
        assert!((lost_in_all as f64 - expected).abs() < 3.0 * expected.sqrt(), "{lost_in_all} of {changes_in_all}");
    }

    #[test]
    fn the_share_is_that_of_all_runs_together() {
        let runs = recorded(Some((EffectKind::CommandLoss, 0.1)));
        let shares = pooled(&runs).into_iter().map(|run| match run.losses {
            Losses::Shown(shown) => shown.all.share,
            Losses::Drawn(_) => f64::NAN,
        });
        let shares: Vec<f64> = shares.collect();
        assert!(shares.iter().all(|share| *share == shares[0]));
        // some hundred changes tell, a tenth of them lost: known to an eighth
        assert!((shares[0] / 0.1 - 1.0).abs() < 0.3, "{}", shares[0]);
    }

    #[test]
    fn nothing_is_lost_where_every_change_is_heard_or_every_change_is_late() {
        let late =
            [(EffectKind::ActuationDelay, 0.01), (EffectKind::CurrentLag, 0.005), (EffectKind::CurrentLimit, 1.5)];
        for effect in [None].into_iter().chain(late.map(Some)) {
            let runs = recorded(effect);
            let rows = |run: &AlignedRun<3>| (0..run.rows()).filter(|row| evidence(run, *row) > 0.0).count();
            let lost: usize = pooled(&runs).iter().map(rows).sum();
            assert_eq!(lost, 0, "{effect:?}");
        }
    }

    #[test]
    fn a_part_of_a_run_keeps_what_it_lost() {
        let runs = recorded(Some((EffectKind::CommandLoss, 0.1)));
        let whole = &pooled(&runs)[0];
        let half = whole.rows() / 2;
        let second = whole.part(half..whole.rows());
        assert!((0..second.rows()).all(|row| evidence(&second, row) == evidence(whole, half + row)));
    }
}
