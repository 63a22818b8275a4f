//! What an effect does at once: a drive of a robot with it, beside the model without it that is restarted from the truth
//! again and again, so that nothing tells what was before.

use model_core::effects::telegram::Telegram;
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::{Input, Plant, Reading, State};

use super::channels::{Channels, Row};

/// A robot, and the model of it that lacks an effect.
pub(super) struct Beside<const N: usize> {
    /// The model.
    pub model: Plant<N, f64>,
    /// The robot.
    pub truth: Plant<N, f64>,
    /// Length of a plant step [s], and steps in a row
    pub steps: (f64, usize),
    /// Rows from one restart of the model to the next.
    pub restarted: usize,
}

/// One row of both.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowBeside<const N: usize> {
    /// What the sensors read of the robot less what the model says, channel by channel, in SI units.
    pub change: Row,
    /// What the model says, in the frame of the camera.
    pub model: Reading<N, f64>,
    /// The robot as it is when the row begins.
    pub truth: State<N, f64>,
}

/// A drive after which another goes, with all motion turned round.
pub(super) struct TurnedRound<'a, const N: usize> {
    /// Its rows.
    pub of: &'a [RowBeside<N>],
    /// Whether the other goes where this one does; else it goes the way that its own motion takes it.
    pub same_places: bool,
}

impl<const N: usize> Beside<N> {
    /// Drives both. Where one drive is turned round, the robot is put, at each restart, to the motion turned round.
    ///
    /// Poses count in the frame that the camera has when the drive begins: what only moves or turns its origin is not seen.
    pub fn drive(&self, input: &[Input<N, f64>], turned: Option<&TurnedRound<'_, N>>) -> Vec<RowBeside<N>> {
        let (dt, steps) = self.steps;
        let mut truth = self.truth.start(0.0, Pose::default(), BodyTwist::default());
        let mut memory = self.truth.memory().collect::<Vec<_>>();
        let (mut model, mut kept) = (truth, self.model.memory().collect::<Vec<_>>());
        let (mut first, mut lost) = (None, false);
        let mut rows = Vec::with_capacity(input.len());
        for (row, held) in input.iter().enumerate() {
            if row % self.restarted == 0 {
                truth = turned.map_or(truth, |turned| turned.state(row, &truth));
                model = self.model.start_from(&truth, truth.time, truth.pose, truth.twist);
                self.model.restart(&model, &mut kept);
            }
            let began = truth;
            // the robot loses every other change of command, if it ever loses any
            let changes = row > 0 && input[row - 1] != *held;
            lost ^= changes;
            let telegram = Telegram::drawn(if changes && lost { 0.0 } else { 1.0 });
            let arrived = self.truth.receive(&mut memory, held, Some(&telegram));
            let read = self.truth.step(&mut truth, &mut memory, &arrived, dt);
            let said = self.model.step(&mut model, &mut kept, held, dt);
            let frame = *first.get_or_insert((said.pose, read.pose));
            let said = Reading { pose: seen_in(frame, said.pose), ..said };
            rows.push(RowBeside { change: change(&read, &said, truth.bus - model.bus), model: said, truth: began });
            for _ in 1..steps {
                self.truth.step(&mut truth, &mut memory, &arrived, dt);
                self.model.step(&mut model, &mut kept, held, dt);
            }
        }
        rows
    }
}

impl<const N: usize> TurnedRound<'_, N> {
    /// The motion of a row turned round; what has no direction goes on.
    fn state(&self, row: usize, on: &State<N, f64>) -> State<N, f64> {
        let of = &self.of[row].truth;
        let BodyTwist { v, vn, w } = of.twist;
        State {
            pose: if self.same_places { of.pose } else { on.pose },
            twist: BodyTwist { v: -v, vn: -vn, w: -w },
            wheel_speed: of.wheel_speed.map(|x| -x),
            slip: of.slip.map(|x| -x),
            rotor_speed: of.rotor_speed.map(|x| -x),
            shaft_twist: of.shaft_twist.map(|x| -x),
            current: of.current.map(|x| -x),
            acceleration: of.acceleration.map(|x| -x),
            ..*on
        }
    }
}

/// One reading less another, in the order of the channels.
fn change<const N: usize>(read: &Reading<N, f64>, said: &Reading<N, f64>, bus: f64) -> Row {
    let channels = Channels { wheels: N };
    let mut change = Row::default();
    for j in 0..N {
        change[channels.current(j)] = read.current[j] - said.current[j];
        change[channels.wheel_speed(j)] = read.wheel_speed[j] - said.wheel_speed[j];
    }
    let of = |pose: &Pose<f64>| [pose.x, pose.y, pose.theta];
    for ((channel, read), said) in channels.pose().into_iter().zip(of(&read.pose)).zip(of(&said.pose)) {
        change[channel] = read - said;
    }
    change[channels.gyro()] = read.gyro - said.gyro;
    change[channels.battery()] = bus;
    change
}

/// A pose in the frame in which the first of two is the second.
fn seen_in((from, to): (Pose<f64>, Pose<f64>), pose: Pose<f64>) -> Pose<f64> {
    let turned = to.theta - from.theta;
    let (sin, cos) = turned.sin_cos();
    let (x, y) = (pose.x - from.x, pose.y - from.y);
    Pose { x: to.x + cos * x - sin * y, y: to.y + sin * x + cos * y, theta: pose.theta + turned }
}
