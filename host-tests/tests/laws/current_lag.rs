//! The lag of the current sensor: the equation of a low-pass, integrated for itself, and that it loses no charge.

use host_tests::excitation::{SeededRng, voltages};
use model_core::effects::active::Effects;
use model_core::effects::sensing::current_lag::WINDOW_S;
use model_core::plant::robot::Robot;
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, larger, plain, three, with_effect};
use crate::newton::runge_kutta;

const LAG: f64 = 0.002;

fn lagging<const N: usize>(robot: Robot<N, f64>) -> Run<N, f64> {
    Run::new(with_effect(robot, effect("current_lag"), None, &[LAG]))
}

#[test]
fn under_imposed_currents_a_row_begins_with_what_a_low_pass_makes_of_them() {
    let (mut run, mut rng) = (lagging(four::<f64>()), SeededRng::new(3));
    // from a current that has flowed for a while
    let mut smooth = [1.0, -2.0, 0.0, 0.5];
    run.step(&Input::Current(smooth), 1e-3);
    for dt in [1e-4, 0.02, 1e-3, 0.005, 3e-4, 0.01].into_iter().cycle().take(60) {
        let current = [(); 4].map(|()| rng.between(-3.0, 3.0));
        let read = run.step(&Input::Current(current), dt).current;
        for j in 0..4 {
            // (smoothed current, its integral), by steps of T/100: (1/100)⁴ over 120 of 6 A
            let over = |time: f64, mut x: [f64; 2]| {
                let steps = (100.0 * time / LAG).ceil() as u32;
                for _ in 0..steps {
                    x = runge_kutta(|[y, _]| [(current[j] - y) / LAG, y], x, time / f64::from(steps));
                }
                x
            };
            let [_, charge] = over(WINDOW_S, [smooth[j], 0.0]);
            let mean = charge / WINDOW_S;
            assert!((read[j] - mean).abs() < 1e-9, "{} against {mean} over {dt} s", read[j]);
            smooth[j] = over(dt, [smooth[j], 0.0])[0];
        }
    }
}

#[test]
fn finer_steps_read_the_same() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (mut long, mut short) = (lagging(robot), lagging(robot));
        let mut rng = SeededRng::new(5);
        for _ in 0..300 {
            let current = Input::Current([(); N].map(|()| rng.between(-3.0, 3.0)));
            let whole = long.step(&current, 4e-3).current;
            let first = short.step(&current, 1e-3).current;
            short.step(&current, 3e-3);
            assert!(gap(whole, first) < 1e-14);
        }
    }
    check(three());
    check(four());
}

#[test]
fn between_rest_and_rest_no_charge_is_lost() {
    fn check<const N: usize>(robot: Robot<N, f64>) {
        let (mut run, mut without) = (lagging(robot), Run::new(plain(robot)));
        let mut holds = voltages::<N>(7, 8, 9.0);
        holds.iter_mut().for_each(|hold| hold.milliseconds = 100);
        let (mut counted, mut flowed, mut most) = ([0.0; N], [0.0; N], 0.0_f64);
        for k in 0..16_000 {
            // at rest first, so that nothing is late then
            let u = if k < 1000 { [0.0; N] } else { holds.get(k / 1000 - 1).map_or([0.0; N], |hold| hold.u) };
            let (read, truth) = (run.drive(u, WINDOW_S).current, without.drive(u, WINDOW_S).current);
            for j in 0..N {
                counted[j] += WINDOW_S * read[j];
                flowed[j] += WINDOW_S * truth[j];
                most = larger(most, (counted[j] - flowed[j]).abs());
            }
            assert_eq!(run.twist(), without.twist());
        }
        assert_eq!(run.twist(), [0.0; 3]);
        // ∫(i − y) dt = T·(y_end − y_start): roundings of 16,000 sums
        assert!(gap(counted, flowed) < 1e-12, "{counted:?} of {flowed:?} A·s");
        assert!(most > 0.5 * LAG, "on the way {most} A·s are behind");
    }
    check(three());
    check(four());
}

#[test]
fn behind_a_sensor_of_wrong_gain_and_zero_the_lag_is_read_at_that_gain() {
    let mut effects = Effects::default();
    for (id, value) in [("current_lag", LAG), ("current_sensor_gain", 0.05), ("current_sensor_offset", -0.03)] {
        effects.add(effect(id), None, &[value]).expect("room");
    }
    let (mut all, mut alone) = (Run::new(Plant::new(three::<f64>(), effects)), lagging(three::<f64>()));
    for hold in voltages::<3>(5, 8, 9.0) {
        for _ in 0..hold.milliseconds {
            let (a, b) = (all.drive(hold.u, 1e-3).current, alone.drive(hold.u, 1e-3).current);
            assert!(gap(a, b.map(|i| 1.05 * i - 0.03)) < 1e-15);
        }
    }
}
