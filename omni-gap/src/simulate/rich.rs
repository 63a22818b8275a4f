//! # An excitation worth recording
//!
//! What a diagnosis can find depends on what the robot did. Scripts here ask for all of it, as hard as the limits allow:
//!
//! ```text
//! dash     all motors at their limit across the floor, towards another side each time: high speeds, all of the floor
//! burst    a jump or a ramp to another combination of the three axes, held for 0.08 to 1.2 s: hard acceleration
//! reverse  what was, the other way
//! rest     zero volts until the robot stands, and a while longer
//! creep    from rest, each axis just above the voltage at which friction lets go of it; then the other way
//! ```
//!
//! Each piece is tried first on a robot that is just what its model says, and taken only where that robot could still brake
//! on the floor. What varies is drawn from fixed seeds: the same robot file gives the same scripts.

use std::f64::consts::TAU;

use model_core::plant::robot::Robot;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::model::Model;
use super::script::{Script, along};
use super::terms::terms;
use super::tried_path::{Bounds, TriedPath};

/// What to write.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RichPlan {
    /// Rows a second [1/s]
    pub rate: f64,
    /// Largest voltage on any motor [V]
    pub voltage: f64,
    /// Side of the free floor [m]; each script begins in its middle
    pub field: f64,
    /// Scripts.
    pub scripts: usize,
    /// Length of each [s]
    pub duration: f64,
    /// What they do most.
    pub emphasis: Emphasis,
}

/// What scripts do most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Emphasis {
    /// A bit of everything.
    #[default]
    Everything,
    /// Jumps and reversals at speed: hard acceleration.
    Reversals,
    /// Across the floor at the motors' limit: high speeds.
    Dashes,
    /// Rests, and creeping just above where friction lets go.
    Creeping,
}

impl Emphasis {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Everything, Self::Reversals, Self::Dashes, Self::Creeping];

    /// The pieces in their order, again and again; each script begins elsewhere in it.
    const fn round(self) -> &'static [Piece] {
        use Piece::{Burst, Creep, Dash, Rest, Reverse};
        match self {
            Self::Everything => {
                &[Dash, Reverse, Burst, Burst, Reverse, Rest, Creep, Burst, Reverse, Dash, Burst, Reverse]
            }
            Self::Reversals => &[Burst, Reverse, Burst, Reverse, Burst, Burst, Reverse],
            Self::Dashes => &[Dash, Dash, Reverse, Dash, Burst, Dash],
            Self::Creeping => &[Creep, Rest, Creep, Burst, Rest, Creep, Dash],
        }
    }
}

/// The word with which the scripts' names begin.
pub const RICH: &str = "rich";

/// Share of the free floor that a script may use: a real robot does not go just where its model goes.
const OF_THE_FIELD: f64 = 0.8;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Piece {
    Dash,
    Burst,
    Reverse,
    Rest,
    Creep,
}

/// By how many pieces each script begins later than the one before.
const LATER: usize = 5;

/// How long bursts and what reverses are held: the shortest and the longest [s]
const HOLD: (f64, f64) = (0.08, 1.2);
/// The longest hold of a dash [s]
const DASH: f64 = 1.6;
/// Directions that are tried for a piece.
const DIRECTIONS: usize = 12;
/// By how much a hold gets shorter that would leave the floor.
const SHORTER: f64 = 0.8;
/// The goal of a dash: how far out, as a share of what may be used, and how far round from the one before [rad]: the
/// golden angle, so that no side is gone to twice as often as another.
const GOAL: (f64, f64) = (1.1, 2.399_963);
/// Most of the share of turning in a dash, in a burst, and in one of a few bursts that hardly do anything else [1]
const TURN: (f64, f64, f64) = (0.3, 1.0, 3.0);
/// One burst in so many does little but turn; one piece in so many is a ramp.
const MOSTLY_TURNS: u32 = 4;
const RAMPED: u32 = 6;
/// Length of a ramp, shortest and longest [s]
const RAMP: (f64, f64) = (0.05, 0.3);
/// The wheels that do least of a motion are driven by up to so many times their share: more motors at their limit.
const FULLER: f64 = 6.0;
/// Rest before the first piece, and after the robot has come to a stand [s]
const REST: f64 = 0.3;
/// Voltage of a creep over that at which friction lets go [1], and its length [s], least and most
const CREEP: (f64, f64) = (1.05, 1.25);
const CREEP_S: (f64, f64) = (0.4, 0.8);
/// An axis whose file states no friction creeps at this share of the largest voltage.
const LEAST_CREEP: f64 = 0.02;

/// The scripts, by the model of the robot; `bounds` are those of its voltage, current and speed.
pub fn rich_scripts<const N: usize>(model: &Model<N>, plan: &RichPlan, bounds: Bounds) -> Vec<Script<N>> {
    let bounds = Bounds { out: 0.5 * OF_THE_FIELD * plan.field, ..bounds };
    (0..plan.scripts).map(|k| Writer::new(model, plan, bounds, k).written()).collect()
}

/// Writes one script.
struct Writer<'a, const N: usize> {
    robot: Robot<N, f64>,
    plan: &'a RichPlan,
    path: TriedPath<N>,
    draws: ChaCha8Rng,
    nth: usize,
    /// What is to be reversed [V]
    last: Option<[f64; N]>,
    /// Where the next dash goes to, seen from the middle of the floor [rad]
    goal: f64,
    /// The voltage at which friction lets go of each axis [V]
    lets_go: [f64; 3],
}

impl<'a, const N: usize> Writer<'a, N> {
    fn new(model: &Model<N>, plan: &'a RichPlan, bounds: Bounds, nth: usize) -> Self {
        let robot = *model.robot();
        let rows = (plan.duration * plan.rate).round() as usize;
        let lets_go = std::array::from_fn(|axis| {
            let one = terms(&robot, axis, along(&robot.wheels, axis, 1.0));
            let volts = if one.drive > 0.0 { one.coulomb / one.drive } else { 0.0 };
            volts.max(LEAST_CREEP * plan.voltage)
        });
        Self {
            robot,
            plan,
            path: TriedPath::new(model, bounds, plan.rate, rows),
            draws: ChaCha8Rng::seed_from_u64(nth as u64),
            nth,
            last: None,
            goal: nth as f64,
            lets_go,
        }
    }

    fn written(mut self) -> Script<N> {
        self.path.rest(REST);
        let (round, mut at) = (self.plan.emphasis.round(), LATER * self.nth);
        while !self.path.is_full() {
            match round[at % round.len()] {
                Piece::Dash => self.dash(),
                Piece::Reverse if self.last.is_some() => self.reverse(),
                Piece::Burst | Piece::Reverse => self.burst(),
                Piece::Rest => self.rest(),
                Piece::Creep => self.creep(),
            }
            at += 1;
        }
        let volts: Vec<_> = self.path.done().into_iter().map(Some).collect();
        let t = (0..volts.len()).map(|row| row as f64 / self.plan.rate).collect();
        Script { name: format!("{RICH}-{}", self.nth + 1), t, volts }
    }

    fn rest(&mut self) {
        self.path.rest(REST);
        self.last = None;
    }

    /// Of all directions, and of holds that keep to the floor, the one that ends nearest to the goal.
    fn dash(&mut self) {
        self.goal += GOAL.1;
        let (turn, fuller) = (self.draw((-TURN.0, TURN.0)), self.draw((1.0, FULLER)));
        let mut nearest: Option<([f64; N], f64, f64)> = None;
        for k in 0..DIRECTIONS {
            let volts = self.wish(TAU * k as f64 / DIRECTIONS as f64, turn, fuller);
            let mut hold = DASH;
            while hold > HOLD.0 {
                if let Some([x, y]) = self.path.end(volts, 0.0, hold) {
                    let goal = self.path.out() * GOAL.0;
                    let off = (x - goal * self.goal.cos()).hypot(y - goal * self.goal.sin());
                    if nearest.is_none_or(|(.., least)| off < least) {
                        nearest = Some((volts, hold, off));
                    }
                }
                hold *= SHORTER;
            }
        }
        match nearest {
            Some((volts, hold, _)) => self.put(volts, 0.0, hold),
            None => self.rest(),
        }
    }

    fn burst(&mut self) {
        let turn = if self.one_in(MOSTLY_TURNS) {
            if self.draws.random_bool(0.5) { TURN.2 } else { -TURN.2 }
        } else {
            self.draw((-TURN.1, TURN.1))
        };
        let (fuller, first, ramp) = (self.draw((1.0, FULLER)), self.draw((0.0, TAU)), self.ramp());
        let mut hold = self.hold();
        while hold > HOLD.0 * SHORTER {
            for k in 0..DIRECTIONS {
                let volts = self.wish(first + GOAL.1 * k as f64, turn, fuller);
                if self.path.end(volts, ramp, hold).is_some() {
                    return self.put(volts, ramp, hold);
                }
            }
            hold *= SHORTER;
        }
        self.rest();
    }

    fn reverse(&mut self) {
        let Some(back) = self.last.map(|volts| volts.map(|u| -u)) else { return };
        let (ramp, mut hold) = (self.ramp(), self.hold());
        while hold > HOLD.0 * SHORTER {
            if self.path.end(back, ramp, hold).is_some() {
                return self.put(back, ramp, hold);
            }
            hold *= SHORTER;
        }
        // what comes next is no reversal either
        self.last = None;
    }

    fn creep(&mut self) {
        let mut volts = [0.0; N];
        for axis in 0..3 {
            let sign = if self.draws.random_bool(0.5) { 1.0 } else { -1.0 };
            let level = sign * self.draw(CREEP) * self.lets_go[axis];
            for (sum, u) in volts.iter_mut().zip(along(&self.robot.wheels, axis, level)) {
                *sum += u;
            }
        }
        let hold = self.draw(CREEP_S);
        for volts in [volts, volts.map(|u| -u)] {
            if self.path.end(volts, 0.0, hold).is_some() {
                self.put(volts, 0.0, hold);
            }
        }
        self.last = None;
    }

    fn put(&mut self, volts: [f64; N], ramp: f64, hold: f64) {
        self.path.put(volts, ramp, hold);
        self.last = Some(volts);
    }

    /// The voltages of a motion into a direction with a share of turning, the largest at the limit.
    fn wish(&self, direction: f64, turn: f64, fuller: f64) -> [f64; N] {
        let rows = self.robot.wheels.rows();
        let arm = rows.iter().fold(f64::MIN_POSITIVE, |most, row| most.max(row[2].abs()));
        let wish = rows.map(|row| row[0] * direction.cos() + row[1] * direction.sin() + row[2] / arm * turn);
        let most = wish.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
        wish.map(|x| (fuller * x / most).clamp(-1.0, 1.0) * self.plan.voltage)
    }

    fn draw(&mut self, (least, most): (f64, f64)) -> f64 {
        self.draws.random_range(least..most)
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.draws.random_ratio(1, count)
    }

    /// As many short holds as long ones, in their logarithm [s].
    fn hold(&mut self) -> f64 {
        HOLD.0 * (HOLD.1 / HOLD.0).powf(self.draw((0.0, 1.0)))
    }

    fn ramp(&mut self) -> f64 {
        if self.one_in(RAMPED) { self.draw(RAMP) } else { 0.0 }
    }
}
