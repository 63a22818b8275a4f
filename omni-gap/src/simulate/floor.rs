//! How much floor a script takes: where the robot of a file goes when it plays it.

use model_core::geometry::frames::{BodyTwist, Pose};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::model::Model;
use super::script::Script;
use super::step_lengths::LONGEST_OF_THE_QUICKEST_S;

/// The box around everywhere a robot goes, seen from where it starts and the way it looks then.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Floor {
    /// Along v, ahead [m]
    pub ahead: f64,
    /// Along v, behind [m]
    pub behind: f64,
    /// Along vn, to the left [m]
    pub left: f64,
    /// Along vn, to the right [m]
    pub right: f64,
}

impl Floor {
    /// The box around both.
    pub fn with(self, other: Self) -> Self {
        Self {
            ahead: self.ahead.max(other.ahead),
            behind: self.behind.max(other.behind),
            left: self.left.max(other.left),
            right: self.right.max(other.right),
        }
    }

    /// The longer side of the box [m]
    pub fn side(self) -> f64 {
        (self.ahead + self.behind).max(self.left + self.right)
    }
}

/// Where the centre of a robot goes that is just what its model says.
pub fn floor_of<const N: usize>(model: &Model<N>, script: &Script<N>) -> Floor {
    let plant = model.plant();
    let mut memory = plant.memory().collect::<Vec<_>>();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let mut floor = Floor::default();
    for (row, input) in script.inputs().enumerate() {
        let Some(length) = script.t.get(row + 1).map(|next| next - script.t[row]) else { break };
        let steps = (length / LONGEST_OF_THE_QUICKEST_S).ceil().max(1.0);
        for _ in 0..steps as usize {
            plant.step(&mut state, &mut memory, &input, length / steps);
        }
        let Pose { x, y, .. } = state.pose;
        floor = floor.with(Floor { ahead: x, behind: -x, left: y, right: -y });
    }
    floor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Catalogue, RobotFile};
    use crate::simulate::{Plan, scripts};
    use std::path::Path;

    #[test]
    fn a_step_ahead_takes_floor_ahead_and_a_spin_takes_none() {
        let text = include_str!("../../robots/feup-3w/robot.toml");
        let file = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        let model = Model::<3>::nominal(&file, 12.0);
        let plan = Plan { rate: 50.0, voltage: 8.0, field: 3.0, repeats: 1, loads: 1 };
        let all = scripts(model.robot(), &plan);
        let of = |name: &str| floor_of(&model, all.iter().find(|s| s.name == name).unwrap());
        let (step, side, spin) = (of("step-v-100-1"), of("step-vn-100-1"), of("spin-left"));
        assert!(step.ahead > 0.8 && step.side() < 3.0 && step.left.max(step.right) < 0.01, "{step:?}");
        assert!(side.left > 0.8 && side.side() < 3.0 && side.ahead.max(side.behind) < 0.01, "{side:?}");
        assert!(spin.side() < 0.01, "{spin:?}");
    }
}
