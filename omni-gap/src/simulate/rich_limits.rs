//! The rich scripts, within the limits that a robot file states.

use super::floor::{Floor, floor_of};
use super::limits::{LESS, Lowered, held, lower, lowered_by_motors};
use super::model::Model;
use super::rich::{RichPlan, rich_scripts};
use super::script::Script;
use super::tried_path::Bounds;
use crate::log::RobotFile;

/// Share of its rows for which every script must drive: on less floor there is no piece that keeps to it.
const MUST_DRIVE: f64 = 0.5;

/// Rich scripts that keep what the robot file allows.
#[derive(Clone, Debug, PartialEq)]
pub struct RichAllowed<const N: usize> {
    /// The scripts.
    pub scripts: Vec<Script<N>>,
    /// Where each takes the robot, in their order.
    pub floors: Vec<Floor>,
    /// The plan with the voltage that it came to.
    pub plan: RichPlan,
    /// The limits that made it less than was asked.
    pub lowered: Vec<Lowered>,
    /// Axes that half of the voltage does not move, by the numbers of the file.
    pub held: Vec<&'static str>,
}

/// Rich scripts for the robot of a file, at `plan`'s voltage or as much less as `[limits]` asks for.
///
/// The current is kept to in every row, a reversal at speed among them, and so is the speed; a field on which no script
/// finds a way at that voltage lowers it.
pub fn rich_allowed<const N: usize>(file: &RobotFile, plan: &RichPlan) -> RichAllowed<N> {
    let model = Model::<N>::nominal(file, plan.voltage);
    let limits = file.limits.unwrap_or_default();
    let mut plan = *plan;
    let mut lowered = lowered_by_motors(file, model.robot(), &mut plan.voltage);
    let written = |plan: &RichPlan| {
        let bounds = Bounds {
            voltage: plan.voltage,
            current: limits.current_a.unwrap_or(f64::INFINITY),
            speed: limits.speed_m_s.unwrap_or(f64::INFINITY),
            out: f64::INFINITY,
        };
        rich_scripts(&model, plan, bounds)
    };
    let drives = |script: &Script<N>| {
        let driven = script.volts.iter().flatten().filter(|u| **u != [0.0; N]).count();
        driven as f64 >= MUST_DRIVE * script.volts.len() as f64
    };
    let (mut scripts, mut fits) = (written(&plan), plan);
    while !scripts.iter().all(drives) && held(model.robot(), fits.voltage).is_empty() {
        fits.voltage *= LESS;
        scripts = written(&fits);
    }
    lower(&mut lowered, &mut plan.voltage, ("field_m", plan.field), fits.voltage);
    let floors = scripts.iter().map(|script| floor_of(&model, script)).collect();
    RichAllowed { scripts, floors, held: held(model.robot(), plan.voltage), plan, lowered }
}
