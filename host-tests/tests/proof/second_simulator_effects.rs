//! Every effect that both simulators know moves the paper's robot alike, up to what their laws have of their own.

use ground_truth::causes::{CAUSES, Cause};
use ground_truth::reading::{Pace, Reading, apart, drive};
use ground_truth::robot_file::RobotFile;
use host_tests::excitation::voltages;
use model_core::effects::EffectKind;
use model_core::effects::card::Scope;

use crate::fixture::{Run, beside, four, typical};
use crate::second_simulator::as_read;

/// Rows, one each millisecond.
const ROWS: usize = 1500;
/// Steps of either simulator in a row.
const STEPS: u32 = 20;
/// The wheel of an effect that sits on one.
const WHEEL: usize = 0;
/// A difference below this is nothing [σ].
const NOTHING: f64 = 0.02;
/// What is left of an effect between two simulators with the same law, over what the effect does [1].
const ALIKE: f64 = 0.02;

/// Effects whose laws are not the same: what is left of them [1], and why.
const OWN_LAWS: &[(&str, f64, &str)] = &[
    ("dead_time", 0.1, "what is lost fades as i/√(i² + i₀²), not as a straight line up to i₀"),
    ("regeneration_asymmetry", 0.1, "the same"),
    ("winding_inductance", 0.1, "a current is read at an instant, not as the mean of a tenth of a millisecond"),
    ("current_lag", 0.15, "the same"),
    ("winding_heating", 0.3, "magnets warm with the housing, not with the winding"),
    ("friction_ellipse", 0.06, "friction points against any motion, however slow"),
    ("presliding", 0.3, "an elastic give up to the limit, not Dahl's curve"),
    ("creep", 0.07, "a wheel is read before the voltage changes, not after: without inertia it jumps"),
    ("shaft_elasticity", 0.2, "the wheels weigh something"),
    ("backlash", 0.2, "the same"),
];

/// What is commanded on each row [V].
fn commands() -> Vec<[f64; 4]> {
    let holds = voltages::<4>(5, 40, 9.0);
    holds.into_iter().flat_map(|hold| (0..hold.milliseconds).map(move |_| hold.u)).take(ROWS).collect()
}

fn by_core(effect: Option<EffectKind>, beside_of: EffectKind, wheel: Option<usize>) -> Vec<Reading> {
    let params = typical(beside_of.card());
    let mut run = Run::new(beside(four::<f64>(), beside_of, effect.map(|_| (wheel, params.as_slice()))));
    let row = |(row, u): (usize, [f64; 4])| {
        let mut first = None;
        for _ in 0..STEPS {
            let reading = run.drive(u, 1e-3 / f64::from(STEPS));
            first.get_or_insert(reading);
        }
        as_read(row, &u, &first.expect("a row has steps"))
    };
    commands().into_iter().enumerate().map(row).collect()
}

fn by_ground_truth(cause: &Cause, wheel: Option<usize>) -> Vec<Reading> {
    let mut setup = RobotFile::paper(0.0).setup();
    (cause.put)(&mut setup, wheel, 1.0);
    let (sent, pace) = (commands(), Pace { row: 1e-3, steps: STEPS as usize });
    drive(&setup, pace, ROWS, |row, _| sent[row].to_vec())
}

#[test]
fn what_both_know_moves_a_robot_alike() {
    let (mut wrong, noise) = (Vec::new(), RobotFile::paper(0.0).noise);
    for cause in CAUSES {
        let Some(effect) = EffectKind::find(cause.id) else { continue };
        let wheel = (cause.one_wheel && effect.card().scope != Scope::Robot).then_some(WHEEL);
        let (with, without) = (by_core(Some(effect), effect, wheel), by_core(None, effect, wheel));
        let second = by_ground_truth(cause, wheel);
        let (moves, left) = (apart(&with, &without, &noise), apart(&second, &with, &noise));
        let most = OWN_LAWS.iter().find(|(id, ..)| *id == cause.id).map_or(ALIKE, |(_, most, _)| *most);
        println!("{:24} moves {moves:8.3} σ, left {left:8.4} σ, {:.4}", cause.id, left / moves);
        if left > (most * moves).max(NOTHING) {
            wrong.push(cause.id);
        }
    }
    assert!(wrong.is_empty(), "otherwise in the two simulators: {wrong:?}");
    for (id, _, why) in OWN_LAWS {
        assert!(CAUSES.iter().any(|cause| cause.id == *id) && !why.is_empty(), "{id} is no cause");
    }
}
