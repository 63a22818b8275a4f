//! Derivatives by dual numbers are those that differences of whole runs show.
//!
//! The runs are chosen so that nothing switches: all axes, wheels and (where they matter) currents keep their signs
//! for half a second, and currents stay above the ripple where dead time bends; the test checks it. At a switch the instant itself depends on the parameter, which a dual number leaves out by its
//! nature (see the page of `dual`), and differences straddle a kink. For the same reason the two delays are taken a
//! little longer than typical: at a whole number of steps they have a kink.

use model_core::effects::EffectKind;
use model_core::effects::active::Effects;
use model_core::effects::card::{Role, Seam};
use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::number::dual::Dual;
use model_core::number::scalar::Real;
use model_core::plant::robot::{Nominal, Robot};
use model_core::plant::{Input, Plant, Reading};

use crate::fixture::{Run, core_robot, four, plain, three, typical, usual_placement};

type D = Dual<8>;

/// A motion that turns nothing round, and the voltages that the plain model needs for it.
struct Drive<const N: usize> {
    start: [f64; 3],
    voltage: Vec<[f64; N]>,
}

impl<const N: usize> Drive<N> {
    fn along(robot: &Robot<N, f64>, mean: [f64; 3]) -> Self {
        let wanted = |t: f64| [0, 1, 2].map(|k| mean[k] * (1.0 + 0.05 * (4.0 * t + k as f64).sin()));
        let voltage = (0..500).map(|k| {
            let (a, b) = (wanted(f64::from(k) * 1e-3), wanted(f64::from(k + 1) * 1e-3));
            let rate = std::array::from_fn(|axis| (b[axis] - a[axis]) / 1e-3);
            robot.inverse_dynamics(BodyTwist::from_array(a), BodyTwist::from_array(rate)).voltage
        });
        Self { start: wanted(0.0), voltage: voltage.collect() }
    }

    /// All that can be seen of the end of a run.
    fn end<T: Real>(&self, plant: Plant<N, T>) -> Vec<T> {
        let mut run = Run::from(plant, [0.0; 3], self.start);
        run.plant.restart(&run.state, &mut run.memory);
        let mut last: Option<Reading<N, T>> = None;
        let mut signs: Option<Vec<T>> = None;
        for (k, u) in self.voltage.iter().enumerate() {
            let read = run.drive(*u, 1e-3);
            let mut now: Vec<T> = run.state.twist.to_array().into_iter().map(Real::sign).collect();
            // the first steps start the delays
            if k > 20 {
                // dead time bends at 0.05 A
                let bends = !run.plant.effects().none_at(Seam::Bridge);
                let least = if bends { T::lit(0.052) } else { T::zero() };
                let driven = run.plant.effects().none_at(Seam::SpeedDrive);
                assert!(!driven || read.current.iter().all(|i| i.abs() > least), "too near a bend: {:?}", read.current);
                now.extend(read.wheel_speed.map(Real::sign));
                // only the bridge and the gear ask for the sign of a current
                let effects = run.plant.effects();
                if !effects.none_at(Seam::Bridge) || !effects.none_at(Seam::Gear) {
                    now.extend(read.current.map(Real::sign));
                }
                assert!(signs.as_ref().is_none_or(|old| *old == now), "something turns round: {now:?}");
                signs = Some(now);
            }
            last = Some(read);
        }
        let read = last.expect("a step");
        let mut all = run.state.twist.to_array().to_vec();
        all.extend([run.state.pose.x, run.state.pose.y, run.state.pose.theta]);
        all.extend([read.pose.x, read.pose.y, read.pose.theta, read.gyro]);
        all.extend(read.current.iter().chain(&read.wheel_speed));
        all
    }
}

/// Compares derivatives by up to eight numbers about `at`, each varied by a part of `size`.
fn agree<const N: usize>(
    what: &str,
    drive: &Drive<N>,
    at: &[f64],
    size: &[f64],
    dual: impl Fn(&[D]) -> Plant<N, D>,
    number: impl Fn(&[f64]) -> Plant<N, f64>,
) {
    let variables: Vec<D> = at.iter().enumerate().map(|(k, x)| D::variable(*x, k)).collect();
    let exact = drive.end(dual(&variables));
    let value = drive.end(number(at));
    for (row, (d, x)) in exact.iter().zip(&value).enumerate() {
        assert!(d.re.to_bits() == x.to_bits(), "{what}: a dual number's value differs in output {row}: {} {x}", d.re);
    }
    for k in 0..at.len() {
        let h = 1e-5 * size[k];
        let shifted = |by: f64| {
            let mut at = at.to_vec();
            at[k] += by;
            drive.end(number(&at))
        };
        let (up, down) = (shifted(h), shifted(-h));
        for (row, d) in exact.iter().enumerate() {
            let (by_dual, by_difference) = (d.eps[k] * size[k], (up[row] - down[row]) / (2.0 * h) * size[k]);
            // differences over 1e-5 of a size: h²·f‴/6 = 1e-10, and rounding of numbers up to 40 after 500 steps over
            // 2e-5: 1e-9
            let within = 1e-6 * (1.0 + by_dual.abs());
            assert!(
                (by_dual - by_difference).abs() < within,
                "{what}, parameter {k}, output {row}: {by_dual} against {by_difference}"
            );
        }
    }
}

fn nominal<const N: usize>(robot: (Robot<N, f64>, Robot<N, D>), mean: [f64; 3]) {
    let drive = Drive::along(&robot.0, mean);
    for batch in (0..Nominal::COUNT).collect::<Vec<_>>().chunks(8) {
        let dual = |x: &[D]| {
            let mut factor = [D::one(); Nominal::COUNT];
            batch.iter().zip(x).for_each(|(k, x)| factor[*k] = *x);
            plain(robot.1.scaled(&factor))
        };
        let number = |x: &[f64]| {
            let mut factor = [1.0; Nominal::COUNT];
            batch.iter().zip(x).for_each(|(k, x)| factor[*k] = *x);
            plain(robot.0.scaled(&factor))
        };
        let ones = vec![1.0; batch.len()];
        agree(&format!("nominal {batch:?}"), &drive, &ones, &ones, dual, number);
    }
}

/// Three wheels and four, each along a motion on which no wheel turns round.
const MEAN: ([f64; 3], [f64; 3]) = ([0.8, -0.5, 1.0], [1.2, 0.9, 1.5]);

#[test]
fn derivatives_by_nominal_values_are_those_of_differences() {
    nominal((three(), three()), MEAN.0);
    nominal((four(), four()), MEAN.1);
}

fn effects<const N: usize>(robot: (Robot<N, f64>, Robot<N, D>), mean: [f64; 3]) {
    let drive = Drive::along(&robot.0, mean);
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let placement = usual_placement(card);
        let mut params = typical(card);
        // a time that is a whole number of steps stands at a corner
        for (value, _) in params.iter_mut().zip(card.params).filter(|(_, p)| p.unit == "s") {
            *value += 0.3e-3;
        }
        let free: Vec<usize> = (0..params.len()).filter(|k| card.params[*k].role != Role::Fixed).collect();
        let at: Vec<f64> = free.iter().map(|k| params[*k]).collect();
        // one that is typically nothing is varied by a part of its bound
        let size = |k: &usize| if params[*k] == 0.0 { card.params[*k].within.1 } else { params[*k] };
        let size: Vec<f64> = free.iter().map(size).collect();
        let dual = |x: &[D]| {
            let mut all: Vec<D> = params.iter().map(|p| D::constant(*p)).collect();
            free.iter().zip(x).for_each(|(k, x)| all[*k] = *x);
            let mut set = Effects::default();
            set.add(*effect, placement, &all).expect("a placement that the card allows");
            Plant::new(robot.1, set)
        };
        let number = |x: &[f64]| {
            let mut all = params.clone();
            free.iter().zip(x).for_each(|(k, x)| all[*k] = *x);
            let mut set = Effects::default();
            set.add(*effect, placement, &all).expect("a placement that the card allows");
            Plant::new(robot.0, set)
        };
        agree(card.id, &drive, &at, &size, dual, number);
    }
}

#[test]
fn derivatives_by_effects_parameters_are_those_of_differences() {
    effects((three(), three()), MEAN.0);
    effects((four(), four()), MEAN.1);
}

#[test]
fn derivatives_at_the_absent_value_are_those_of_differences_to_the_side() {
    let drive = Drive::along(&four(), MEAN.1);
    for effect in &EffectKind::ALL {
        let card = effect.card();
        for (k, p) in card.params.iter().enumerate().filter(|(_, p)| p.role == Role::Size) {
            if card.physics.corner_at_absent {
                continue;
            }
            let absent = crate::fixture::absent(card);
            let mut variables: Vec<D> = absent.iter().map(|p| D::constant(*p)).collect();
            variables[k] = D::variable(absent[k], 0);
            let mut set = Effects::default();
            set.add(*effect, usual_placement(card), &variables).expect("a placement that the card allows");
            let exact = drive.end(Plant::new(four(), set));
            let near = |part: f64| {
                let mut params = absent.clone();
                params[k] += part * (p.typical - p.absent);
                drive.end(crate::fixture::with_effect(four::<f64>(), *effect, usual_placement(card), &params))
            };
            let (none, little) = (near(0.0), near(1e-6));
            for (row, d) in exact.iter().enumerate() {
                let by_dual = d.eps[0] * (p.typical - p.absent);
                let by_difference = (little[row] - none[row]) / 1e-6;
                // to one side: h·f″/2 with h of 1e-6 of the typical size, and rounding of 1e-14/1e-6
                let within = 1e-4 * (1.0 + by_dual.abs());
                let what = format!("{}, output {row}: {by_dual} against {by_difference}", card.id);
                assert!((by_dual - by_difference).abs() < within, "{what}");
            }
        }
    }
}

#[test]
fn an_inertia_of_nothing_has_its_derivative_where_wheels_slip_too() {
    fn plant<T: Real>(inertia: T) -> Plant<4, T> {
        let mut set = Effects::default();
        let slip = EffectKind::find("wheel_slip").expect("an effect of the catalogue");
        set.add(slip, None, &[0.35, 30.0, 1.0, 0.0, 0.0].map(T::lit)).expect("it sits on all wheels");
        let rotor = EffectKind::find("rotor_inertia").expect("an effect of the catalogue");
        set.add(rotor, None, &[inertia]).expect("it sits on all wheels");
        Plant::new(four(), set)
    }
    fn step<T: Real>(plant: &Plant<4, T>) -> [T; 3] {
        let mut state = plant.start(T::zero(), Pose::default(), BodyTwist::from_array([0.3, -0.2, 1.0].map(T::lit)));
        let volts = [6.0, -3.0, -6.0, 2.0].map(T::lit);
        plant.step(&mut state, &mut [], &Input::Voltage(volts), T::lit(1e-3));
        state.twist.to_array()
    }
    // one step: without inertia wheels jump to their speed, with a little of it they are as good as there
    let exact = step(&plant(D::variable(0.0, 0)));
    let [none, half, little] = [0.0, 0.5e-9, 1e-9].map(|inertia| step(&plant(inertia)));
    for (row, d) in exact.iter().enumerate() {
        // to one side, of second order
        let difference = (4.0 * half[row] - little[row] - 3.0 * none[row]) / 1e-9;
        assert!(d.eps[0] != 0.0 && (d.eps[0] - difference).abs() < 1e-3 * difference.abs(), "{d:?}: {difference}");
    }
}

#[test]
fn a_robot_of_dual_numbers_has_the_values_of_the_robot() {
    let rig = host_tests::excitation::random_robot::<4>(&mut host_tests::excitation::SeededRng::new(1));
    let (number, dual) = (core_robot::<4, f64>(&rig), core_robot::<4, D>(&rig));
    for (row, d) in number.wheels.rows().iter().flatten().zip(dual.wheels.rows().iter().flatten()) {
        assert_eq!(row.to_bits(), d.re.to_bits());
    }
}
