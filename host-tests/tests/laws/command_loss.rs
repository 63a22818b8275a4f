//! The loss of commands, in the whole plant: against the same robot that is told by hand what it still heard, and against the
//! waiting time that chance alone makes.

use host_tests::excitation::{SeededRng, voltages};
use model_core::effects::telegram::{Delivery, Telegram};
use model_core::plant::{Input, Plant};

use crate::fixture::{Run, effect, four, gap, plain, with_effect};

const HEARD: Telegram<4> = Telegram { all: Delivery::Shown(0.0), each: [Delivery::Shown(0.0); 4] };

fn losing(share: f64, wheel: Option<usize>) -> Plant<4, f64> {
    with_effect(four(), effect("command_loss"), wheel, &[share])
}

#[test]
fn a_robot_that_hears_some_telegrams_goes_as_one_that_is_told_the_last_one_again() {
    let mut rng = SeededRng::new(5);
    let (mut by_loss, mut by_hand) = (Run::new(losing(0.2, None)), Run::new(plain(four::<f64>())));
    let mut last = [0.0; 4];
    for hold in voltages::<4>(3, 200, 9.0) {
        let chance = rng.between(0.0, 1.0);
        if chance >= 0.2 {
            last = hold.u;
        }
        let sent = Input::Voltage(hold.u);
        let arrived = by_loss.plant.receive(&mut by_loss.memory, &sent, Some(&Telegram::drawn(chance)));
        for _ in 0..5 {
            let (lost, told) = (by_loss.step(&arrived, 1e-3), by_hand.step(&Input::Voltage(last), 1e-3));
            // a plain robot's currents are rounded otherwise
            let apart = gap(lost.current, told.current).max(gap(lost.wheel_speed, told.wheel_speed));
            assert!(apart < 1e-11, "{apart:e}");
        }
    }
    assert!(gap(by_loss.pose(), by_hand.pose()) < 1e-11);
}

#[test]
fn a_change_waits_for_as_many_telegrams_as_a_geometric_law_says() {
    let (share, changes) = (0.2, 20_000);
    let plant = losing(share, None);
    let mut memory: Vec<_> = plant.memory().collect();
    let mut rng = SeededRng::new(8);
    let mut waited = 0_u32;
    for change in 1..=changes {
        let sent = Input::Voltage([f64::from(change); 4]);
        while plant.receive(&mut memory, &sent, Some(&Telegram::drawn(rng.between(0.0, 1.0)))) != sent {
            waited += 1;
        }
    }
    // Σ k·p^k·(1 − p) = p/(1 − p), with the variance p/(1 − p)²
    let mean = f64::from(waited) / f64::from(changes);
    let std = share.sqrt() / (1.0 - share) / f64::from(changes).sqrt();
    assert!((mean - share / (1.0 - share)).abs() < 4.0 * std, "{mean}");
}

#[test]
fn one_wheel_loses_its_part_alone_and_nobody_loses_what_is_no_command() {
    let plant = losing(0.2, Some(2));
    let mut memory: Vec<_> = plant.memory().collect();
    plant.receive(&mut memory, &Input::Voltage([1.0; 4]), Some(&HEARD));
    let lost = Telegram::drawn(0.0);
    let kept = plant.receive(&mut memory, &Input::Voltage([5.0; 4]), Some(&lost));
    assert_eq!(kept, Input::Voltage([5.0, 5.0, 1.0, 5.0]));
    let open = [Some(7.0), None, Some(7.0), None];
    assert_eq!(
        plant.receive(&mut memory, &Input::Bridges(open), Some(&lost)),
        Input::Bridges([Some(7.0), None, Some(1.0), None])
    );
    assert_eq!(
        plant.receive(&mut memory, &Input::SetSpeed([9.0; 4]), Some(&lost)),
        Input::SetSpeed([9.0, 9.0, 1.0, 9.0])
    );
    for imposed in [Input::Current([3.0; 4]), Input::Speed([3.0; 4])] {
        assert_eq!(plant.receive(&mut memory, &imposed, Some(&lost)), imposed);
    }
}
