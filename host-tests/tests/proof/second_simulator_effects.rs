//! Every effect that both simulators know moves the paper's robot alike, up to what their laws have of their own.

use ground_truth::causes::{CAUSES, Cause, Setup};
use ground_truth::paper::four_wheels;
use ground_truth::reading::{Pace, Reading, drive};
use ground_truth::sensors::Sensors;
use host_tests::excitation::voltages;
use model_core::effects::EffectKind;
use model_core::effects::card::Scope;

use crate::fixture::{Run, beside, four, typical};

/// Noise of the paper's robot's sensors: current [A], wheel speed [rad/s], position [m], heading [rad], yaw rate [rad/s].
const SIGMA: [f64; 5] = [0.02, 0.15, 0.003, 0.01, 0.005];

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
    ("wheel_slip", 0.15, "a spring and a limit, not Pacejka's curve, and the wheels weigh something"),
    ("shaft_elasticity", 0.2, "the wheels weigh something"),
    ("backlash", 0.2, "the same"),
];

/// What is commanded on each row [V].
fn commands() -> Vec<[f64; 4]> {
    let holds = voltages::<4>(5, 40, 9.0);
    holds.into_iter().flat_map(|hold| (0..hold.milliseconds).map(move |_| hold.u)).take(ROWS).collect()
}

/// One row: currents, wheel speeds, position, heading, yaw rate.
type Row = [Vec<f64>; 5];

fn by_core(effect: Option<EffectKind>, beside_of: EffectKind, wheel: Option<usize>) -> Vec<Row> {
    let params = typical(beside_of.card());
    let mut run = Run::new(beside(four::<f64>(), beside_of, effect.map(|_| (wheel, params.as_slice()))));
    let rows = commands().into_iter().map(|u| {
        let mut first = None;
        for _ in 0..STEPS {
            let reading = run.drive(u, 1e-3 / f64::from(STEPS));
            first.get_or_insert(reading);
        }
        let reading = first.expect("a row has steps");
        let (pose, [i, w]) = (reading.pose, [reading.current, reading.wheel_speed].map(|of| of.to_vec()));
        [i, w, vec![pose.x, pose.y], vec![pose.theta], vec![reading.gyro]]
    });
    rows.collect()
}

fn by_ground_truth(cause: &Cause, wheel: Option<usize>, times: f64) -> Vec<Row> {
    let mut setup = Setup { robot: four_wheels(), sensors: Sensors::true_to(4) };
    if times > 0.0 {
        (cause.put)(&mut setup, wheel, times);
    }
    let (sent, pace) = (commands(), Pace { row: 1e-3, steps: STEPS as usize });
    let rows = drive(&setup, pace, ROWS, |row, _| sent[row].to_vec()).into_iter();
    let row = |Reading { currents, wheel_speeds, pose: [x, y, theta], gyro, .. }: Reading| {
        [currents, wheel_speeds, vec![x, y], vec![theta], vec![gyro]]
    };
    rows.map(row).collect()
}

/// RMS difference of the group in which two drives differ most [σ].
fn apart(a: &[Row], b: &[Row]) -> f64 {
    let group = |group: usize| {
        let pairs = a.iter().zip(b).flat_map(|(a, b)| a[group].iter().zip(&b[group]));
        let (sum, count) = pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a - b).powi(2), n + 1.0));
        (sum / f64::max(count, 1.0)).sqrt() / SIGMA[group]
    };
    (0..SIGMA.len()).map(group).fold(0.0, f64::max)
}

#[test]
fn what_both_know_moves_a_robot_alike() {
    let mut wrong = Vec::new();
    for cause in CAUSES {
        let Some(effect) = EffectKind::find(cause.id) else { continue };
        let wheel = (cause.one_wheel && effect.card().scope != Scope::Robot).then_some(WHEEL);
        let (with, without) = (by_core(Some(effect), effect, wheel), by_core(None, effect, wheel));
        let second = by_ground_truth(cause, wheel, 1.0);
        let (moves, left) = (apart(&with, &without), apart(&second, &with));
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
