//! The voltage that experiments may ask of a robot, by the limits that its file states.
//!
//! ```text
//! |i| ≤ V/R          a motor held still; the scripts pass through rest before they turn the sign
//! v(V) = (a·V − C)/b  the speed along v and vn in the end; it rises evenly with V
//! ```

use model_core::plant::robot::Robot;

use super::floor::{Floor, floor_of};
use super::model::Model;
use super::script::{AXES, Plan, Script, final_speed, scripts};
use crate::log::RobotFile;

/// The largest voltage that is asked where the supply would give more [V]
pub const USUAL_VOLTAGE: f64 = 8.0;
/// The share of the supply that is asked of it.
const OF_THE_SUPPLY: f64 = 2.0 / 3.0;
/// The free floor that is counted on where the file states none: its side [m]
pub const USUAL_FIELD: f64 = 3.0;
/// By how much the voltage goes down at a time where a script would leave the floor.
pub(super) const LESS: f64 = 0.95;
/// The share of the voltage at which every axis must move.
const MUST_MOVE: f64 = 0.5;

/// What a limit of the robot file did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lowered {
    /// Key of the limit in the robot file.
    pub key: &'static str,
    /// Its value [A], [m/s] or [m], as the key says
    pub limit: f64,
    /// The voltage before [V]
    pub from: f64,
    /// The voltage after [V]
    pub to: f64,
}

/// Scripts that keep what the robot file allows.
#[derive(Clone, Debug, PartialEq)]
pub struct Allowed<const N: usize> {
    /// The scripts.
    pub scripts: Vec<Script<N>>,
    /// Where each takes the robot, in their order.
    pub floors: Vec<Floor>,
    /// The plan with the voltage that it came to.
    pub plan: Plan,
    /// The limits that made it less than was asked.
    pub lowered: Vec<Lowered>,
    /// Axes that half of the voltage does not move, by the numbers of the file.
    pub held: Vec<&'static str>,
}

/// The largest voltage where none is asked [V]: 8 V, or two thirds of the supply where that is less.
pub fn usual_voltage(file: &RobotFile) -> f64 {
    file.supply.map_or(USUAL_VOLTAGE, |supply| USUAL_VOLTAGE.min(OF_THE_SUPPLY * supply.voltage_v))
}

/// The scripts of the experiments that are wanted, at `plan`'s voltage or as much less as `[limits]` asks for.
pub fn allowed<const N: usize>(file: &RobotFile, plan: &Plan, wanted: impl Fn(&Script<N>) -> bool) -> Allowed<N> {
    let model = Model::<N>::nominal(file, plan.voltage);
    let robot = *model.robot();
    let mut plan = *plan;
    let mut lowered = lowered_by_motors(file, &robot, &mut plan.voltage);
    let play = |plan: &Plan| {
        let scripts: Vec<_> = scripts(&robot, plan).into_iter().filter(|s| wanted(s)).collect();
        let floors: Vec<Floor> = scripts.iter().map(|script| floor_of(&model, script)).collect();
        (scripts, floors)
    };
    let side = |floors: &[Floor]| floors.iter().map(|floor| floor.side()).fold(0.0, f64::max);
    let (mut all, mut floors) = play(&plan);
    let mut fits = plan;
    // a voltage that moves nothing fits every floor
    while side(&floors) > plan.field && fits.voltage > f64::MIN_POSITIVE {
        fits.voltage *= LESS;
        (all, floors) = play(&fits);
    }
    lower(&mut lowered, &mut plan.voltage, ("field_m", fits.field), fits.voltage);
    Allowed { scripts: all, floors, plan, lowered, held: held(&robot, plan.voltage) }
}

/// Lowers a voltage to what the limits of current and speed allow, and says which did so.
pub(super) fn lowered_by_motors<const N: usize>(
    file: &RobotFile,
    robot: &Robot<N, f64>,
    voltage: &mut f64,
) -> Vec<Lowered> {
    let limits = file.limits.unwrap_or_default();
    let mut lowered = Vec::new();
    if let Some(amps) = limits.current_a {
        lower(&mut lowered, voltage, ("current_A", amps), amps * robot.motor.resistance);
    }
    if let Some(fastest) = limits.speed_m_s {
        for axis in 0..2 {
            let [still, one] = [0.0, 1.0].map(|volts| final_speed(robot, axis, volts));
            lower(&mut lowered, voltage, ("speed_m_s", fastest), (fastest - still) / (one - still));
        }
    }
    lowered
}

/// Notes that a limit asks for a voltage, if that is less.
pub(super) fn lower(lowered: &mut Vec<Lowered>, voltage: &mut f64, (key, limit): (&'static str, f64), to: f64) {
    if to < *voltage {
        lowered.push(Lowered { key, limit, from: *voltage, to });
        *voltage = to;
    }
}

/// The axes that half of a voltage does not move.
pub(super) fn held<const N: usize>(robot: &Robot<N, f64>, voltage: f64) -> Vec<&'static str> {
    let moves = |axis: usize| final_speed(robot, axis, MUST_MOVE * voltage) > 0.0;
    (0..AXES.len()).filter(|axis| !moves(*axis)).map(|axis| AXES[axis]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::{Catalogue, LimitsFile, SupplyFile};
    use std::path::Path;

    fn file(limits: LimitsFile) -> RobotFile {
        let text = include_str!("../../robots/feup-4w/robot.toml");
        let file = RobotFile::parse(text, Path::new("robot.toml"), &Catalogue::default()).unwrap();
        RobotFile { limits: Some(limits), ..file }
    }

    const PLAN: Plan = Plan { rate: 50.0, voltage: 8.0, field: 3.0, repeats: 1, loads: 1 };

    fn of(limits: LimitsFile, field: f64) -> Allowed<4> {
        allowed(&file(limits), &Plan { field, ..PLAN }, |_| true)
    }

    #[test]
    fn without_limits_the_voltage_is_what_was_asked() {
        let all = of(LimitsFile::default(), 3.0);
        assert_eq!((all.plan.voltage, all.lowered.len(), all.held.len()), (8.0, 0, 0));
        assert_eq!(all.scripts.len(), all.floors.len());
    }

    #[test]
    fn each_limit_lowers_the_voltage_to_where_it_holds() {
        let current = of(LimitsFile { current_a: Some(1.0), ..LimitsFile::default() }, 3.0);
        assert!((current.plan.voltage - 4.3111).abs() < 1e-9 && current.lowered[0].key == "current_A");
        let speed = of(LimitsFile { speed_m_s: Some(0.8), ..LimitsFile::default() }, 3.0);
        let model = Model::<4>::nominal(&file(LimitsFile::default()), 12.0);
        let fastest = |volts| (0..2).map(|axis| final_speed(model.robot(), axis, volts)).fold(0.0, f64::max);
        assert!((fastest(speed.plan.voltage) - 0.8).abs() < 1e-9 && speed.lowered[0].key == "speed_m_s");
        let floor = of(LimitsFile::default(), 0.5);
        assert!(floor.floors.iter().all(|f| f.side() <= 0.5) && floor.plan.voltage < 8.0, "{:?}", floor.plan);
        assert_eq!(floor.lowered[0].key, "field_m");
    }

    #[test]
    fn a_voltage_too_low_to_move_is_told() {
        let all = of(LimitsFile { current_a: Some(0.05), ..LimitsFile::default() }, 3.0);
        assert_eq!(all.held, AXES);
    }

    #[test]
    fn the_usual_voltage_is_eight_or_two_thirds_of_the_supply() {
        let with = |voltage_v| RobotFile { supply: Some(SupplyFile { voltage_v }), ..file(LimitsFile::default()) };
        assert_eq!(usual_voltage(&with(12.0)), 8.0);
        assert!((usual_voltage(&with(7.2)) - 4.8).abs() < 1e-12);
        assert_eq!(usual_voltage(&RobotFile { supply: None, ..with(1.0) }), 8.0);
    }
}
