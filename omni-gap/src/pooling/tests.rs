//! Robots that are drawn from the model itself, and what pooling says of them.

use model_core::plant::robot::Nominal;
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::answer::Pooled;
use super::evidence::SessionEvidence;
use super::knobs::PoolingKnobs;
use super::place::Place;
use super::pool::pooled;
use super::population::{Population, Stated};
use super::quadratic::Quadratic;
use super::robots::random_effects;
use crate::engine::findings::{Direction, SessionEquations};

const NUMBERS: usize = Nominal::COUNT;

/// One relative standard error of every number of the file [1]
const STATED: f64 = 0.05;

/// The size of an effect that one session shows with one standard error, about.
const WEAK: f64 = 0.1;

struct Drawn {
    random: ChaCha8Rng,
}

impl Drawn {
    fn new(seed: u64) -> Self {
        Self { random: ChaCha8Rng::seed_from_u64(seed) }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.random)
    }

    /// 200 measured numbers of a session: their slopes, and their errors of one sigma.
    fn seen(&mut self, effects: usize) -> (DMatrix<f64>, DVector<f64>) {
        let width = effects + NUMBERS;
        let slope = |k: usize| if k < effects { 1.0 } else { 3.0 };
        let slopes = DMatrix::from_fn(200, width, |_, k| slope(k) * self.normal());
        (slopes, DVector::from_fn(200, |_, _| self.normal()))
    }

    /// A session whose true effects and numbers are these.
    fn session(&mut self, robot: usize, date: &str, effects: &[f64], numbers: &[f64]) -> SessionEvidence {
        let (slopes, errors) = self.seen(effects.len());
        let truth = DVector::from_iterator(slopes.ncols(), effects.iter().chain(numbers).copied());
        let (hess, toward) = (slopes.tr_mul(&slopes), slopes.tr_mul(&(&slopes * truth + errors)));
        let n = effects.len();
        let row = |k: usize| hess.row(k).columns(n, NUMBERS).iter().copied().collect::<Vec<f64>>();
        let direction = |k: usize| Direction {
            id: ["dead_time", "creep", "coriolis"][k % 3].to_owned(),
            wheel: (k >= 3).then(|| k / 3 - 1),
            key: "size".to_owned(),
            unit: "1".to_owned(),
            absent: 0.0,
            typical: 1.0,
            either_way: false,
            carried: false,
            size: hess[(k, k)],
            toward: toward[k],
            with_numbers: row(k),
        };
        let equations = SessionEquations {
            numbers: (n..n + NUMBERS).map(row).collect(),
            toward: toward.rows(n, NUMBERS).iter().copied().collect(),
            stated: (0..NUMBERS)
                .map(|r| (0..NUMBERS).map(|c| if r == c { STATED.powi(-2) } else { 0.0 }).collect())
                .collect(),
            directions: (0..n).map(direction).collect(),
        };
        SessionEvidence {
            session: format!("r{robot:02}/{date}"),
            robot: format!("r{robot:02}"),
            date: date.to_owned(),
            equations: Some(equations),
            ..SessionEvidence::default()
        }
    }

    /// Thirty robots whose numbers are off together and each on its own.
    fn fleet(&mut self, effects: &[f64], in_common: f64) -> Vec<SessionEvidence> {
        let common: Vec<f64> = (0..NUMBERS).map(|_| STATED * in_common.sqrt() * self.normal()).collect();
        let robot = |robot: usize| {
            let own = STATED * (1.0 - in_common).sqrt();
            let numbers: Vec<f64> = common.iter().map(|common| common + own * self.normal()).collect();
            self.session(robot, "2026-11-03", effects, &numbers)
        };
        (0..30).map(robot).collect()
    }
}

fn asked(sessions: &[SessionEvidence]) -> Pooled {
    pooled(&sessions.iter().collect::<Vec<_>>(), &PoolingKnobs::default())
}

#[test]
fn a_weak_effect_that_all_share_is_found_and_sized() {
    let mut found = 0;
    for seed in 0..20 {
        let answer = asked(&Drawn::new(seed).fleet(&[WEAK, 0.0, 0.0, 0.0], 0.5));
        let first = answer.common.first().filter(|cause| cause.of.id == "dead_time" && cause.of.wheel.is_none());
        found += usize::from(first.is_some_and(|cause| cause.probability > 0.9));
        if let Some(cause) = first {
            assert!((cause.value - WEAK).abs() < 4.0 * cause.std, "{cause:?}");
        }
    }
    assert!(found >= 19, "{found} of 20");
}

#[test]
fn robots_that_share_nothing_are_told_so() {
    for (seed, in_common) in (0..30).map(|seed| (seed, [0.0, 0.5, 1.0][seed as usize % 3])) {
        let answer = asked(&Drawn::new(100 + seed).fleet(&[0.0; 6], in_common));
        let most = answer.common.first().map_or(0.0, |cause| cause.probability);
        assert!(most < 0.5, "{:?}", answer.common);
        assert!(answer.estimates.iter().filter(|estimate| estimate.stands_out).count() <= 1);
    }
}

#[test]
fn how_much_of_what_is_stated_robots_have_in_common_is_told() {
    let told = |in_common: f64| {
        let told: f64 = (0..5).filter_map(|seed| asked(&Drawn::new(seed).fleet(&[0.0], in_common)).in_common).sum();
        told / 5.0
    };
    let [none, half, all] = [0.0, 0.5, 1.0].map(told);
    assert!(none < 0.15 && (0.25..0.75).contains(&half) && all > 0.85, "{none} {half} {all}");
}

/// All robots' own numbers kept as unknowns of one large system, in place of their being integrated out.
#[test]
fn what_is_common_is_what_one_large_system_of_all_robots_says() {
    let mut drawn = Drawn::new(7);
    let sessions = drawn.fleet(&[WEAK], 0.5);
    let place = &Place::all(&sessions.iter().collect::<Vec<_>>())[0];
    let robots: Vec<Quadratic> = sessions.iter().filter_map(|session| place.seen_in(session)).collect();
    let diagonal = |of: f64| DMatrix::from_diagonal_element(NUMBERS, NUMBERS, of);
    let (precision, covariance) = (diagonal(STATED.powi(-2)), diagonal(STATED.powi(2)));
    let stated = Stated { precision, covariance, in_common: 0.4 };
    let tau = 0.05;
    let population = Population::of(&robots, &stated.spread(place, tau), &stated.of_common(place).unwrap()).unwrap();
    let (value, std) = population.common.estimate(0).unwrap();

    let n = 1 + NUMBERS;
    let all = n * (1 + robots.len());
    let (mut hess, mut toward) = (DMatrix::<f64>::zeros(all, all), DVector::<f64>::zeros(all));
    let own = |k: usize| if k == 0 { tau.powi(-2) } else { STATED.powi(-2) / 0.6 };
    (1..n).for_each(|k| hess[(k, k)] += STATED.powi(-2) / 0.4);
    for (r, robot) in robots.iter().enumerate() {
        let at = n * (1 + r);
        for row in 0..n {
            hess[(at + row, at + row)] += own(row);
            for (from, column) in [(0, 0), (0, at), (at, 0), (at, at)] {
                for k in 0..n {
                    hess[(from + row, column + k)] += robot.hess[(row, k)];
                }
            }
            toward[row] += robot.toward[row];
            toward[at + row] += robot.toward[row];
        }
    }
    let inverse = hess.cholesky().unwrap().inverse();
    let expected: f64 = inverse.row(0).transpose().dot(&toward);
    assert!((value - expected).abs() < 1e-6 * std, "{value} {expected} ± {std}");
    assert!((std - inverse[(0, 0)].sqrt()).abs() < 1e-6 * std);
}

#[test]
fn a_robot_that_is_otherwise_stands_out_and_no_other() {
    let mut drawn = Drawn::new(3);
    let mut sessions = drawn.fleet(&[0.0, 0.0], 0.5);
    let numbers: Vec<f64> = (0..NUMBERS).map(|_| STATED * drawn.normal()).collect();
    sessions[11] = drawn.session(11, "2026-11-03", &[0.0, 1.0], &numbers);
    let answer = asked(&sessions);
    let out: Vec<(&str, &str)> =
        answer.estimates.iter().filter(|e| e.stands_out).map(|e| (e.robot.as_str(), e.of.id.as_str())).collect();
    assert_eq!(out, [("r11", "creep")]);
    assert!(answer.common.iter().all(|cause| cause.probability < 0.5), "{:?}", answer.common);
}

#[test]
fn a_change_is_dated_and_a_firmware_is_named_for_what_came_with_it() {
    let mut drawn = Drawn::new(5);
    let mut sessions = Vec::new();
    for robot in 0..6 {
        let numbers: Vec<f64> = (0..NUMBERS).map(|_| STATED * drawn.normal()).collect();
        for day in 1..=8 {
            // robot 2 changes on the fifth day; with the second firmware all robots do
            let own = if robot == 2 && day >= 5 { 0.8 } else { 0.0 };
            let firmware = if day % 2 == 0 { "2" } else { "1" };
            let with_it = if firmware == "2" { 0.3 } else { 0.0 };
            let session = drawn.session(robot, &format!("2026-11-{day:02}"), &[own, with_it], &numbers);
            sessions.push(SessionEvidence { firmware: Some(firmware.to_owned()), ..session });
        }
    }
    let answer = asked(&sessions);
    let changes: Vec<(&str, &str, &str, &str)> = answer
        .changes
        .iter()
        .map(|c| (c.robot.as_str(), c.of.id.as_str(), c.last_before.as_str(), c.since.as_str()))
        .collect();
    assert_eq!(changes, [("r02", "dead_time", "2026-11-04", "2026-11-05")]);
    assert!((answer.changes[0].by - 0.8).abs() < 4.0 * answer.changes[0].std);
    let contrasts: Vec<&str> = answer.contrasts.iter().map(|contrast| contrast.of.id.as_str()).collect();
    assert_eq!(contrasts, ["creep"]);
    assert!((answer.contrasts[0].by - 0.3).abs() < 4.0 * answer.contrasts[0].std, "{:?}", answer.contrasts);
}

#[test]
fn an_effect_that_was_found_completes_the_numbers_equations() {
    let plain = Drawn::new(9).session(0, "2026-11-03", &[0.7], &[0.0; NUMBERS]);
    let equations = plain.equations.clone().unwrap();
    let mut carried = equations.clone();
    let direction = &mut carried.directions[0];
    direction.carried = true;
    for r in 0..NUMBERS {
        let shared = direction.with_numbers[r] / direction.size;
        carried.toward[r] -= shared * direction.toward;
        for c in 0..NUMBERS {
            carried.numbers[r][c] -= shared * direction.with_numbers[c];
        }
    }
    let place = &Place::all(&[&plain])[0];
    let seen = place.seen_in(&plain).unwrap();
    let again = place.seen_in(&SessionEvidence { equations: Some(carried), ..plain.clone() }).unwrap();
    assert!((&seen.hess - &again.hess).abs().max() < 1e-9 * seen.hess.abs().max());
    assert!((&seen.toward - &again.toward).abs().max() < 1e-9 * seen.toward.abs().max());
}

/// Two estimates, 0 and 2 with one standard error each: by hand Q = 2, τ² = (2 − 1)/(2 − 1), σ² = (1 + 1)/2.
#[test]
fn random_effects_are_those_worked_out_by_hand() {
    assert_eq!(random_effects(&[(0.0, 1.0), (2.0, 1.0)]), Some((1.0, 1.0, 1.0)));
    let (mean, error, variance) = random_effects(&[(1.0, 1.0), (1.5, 1.0)]).unwrap();
    assert_eq!((mean, variance), (1.25, 0.0));
    assert!((error - 0.5_f64.sqrt()).abs() < 1e-12);
}
