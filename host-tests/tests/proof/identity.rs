//! Absent means absent: at its absent value an effect leaves a whole run bit for bit as it was without it.

use host_tests::excitation::voltages;
use model_core::effects::EffectKind;
use model_core::number::scalar::Real;
use model_core::plant::robot::Robot;
use model_core::plant::{Plant, Reading, State};

use crate::fixture::{Run, absent, beside, four, placements, plain, three, typical, with_effect};

/// A number with bits.
trait Bits: Real + Into<f64> {
    fn bits(self) -> u64;
}

impl Bits for f32 {
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl Bits for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// All that a step leaves behind. The wheels' angles are not kept up without effects, so they are left out.
fn bits<const N: usize, T: Bits>(state: &State<N, T>, reading: &Reading<N, T>) -> Vec<u64> {
    let pose = |p: model_core::geometry::frames::Pose<T>| [p.x, p.y, p.theta];
    let mut all = vec![state.time.bits(), state.bus.bits(), reading.gyro.bits()];
    all.extend(pose(state.pose).iter().chain(&pose(reading.pose)).chain(&state.twist.to_array()).map(|x| x.bits()));
    for wheels in [state.wheel_speed, state.current, reading.current, reading.wheel_speed] {
        all.extend(wheels.iter().map(|x| x.bits()));
    }
    all
}

/// A run over random holds: every step's bits.
fn run<const N: usize, T: Bits>(plant: Plant<N, T>) -> Vec<Vec<u64>> {
    let mut all = Vec::new();
    Run::from(plant, [0.1, -0.2, 0.3], [0.4, -0.3, 2.0]).play(&voltages::<N>(9, 12, 9.0), 1, |run, reading| {
        all.push(bits(&run.state, &reading));
    });
    all
}

/// Parameters at which there is no effect: all absent, and only those that size it, if any do, with the others typical.
fn ways_to_be_absent(card: &model_core::effects::card::Card) -> Vec<Vec<f64>> {
    use model_core::effects::card::Role;
    let shaped: Vec<f64> =
        card.params.iter().map(|p| if p.role == Role::Shape { p.typical } else { p.absent }).collect();
    let sized = card.params.iter().any(|p| p.role == Role::Size);
    std::iter::once(absent(card)).chain(sized.then_some(shaped)).collect()
}

/// The plain model as [`run`] drives one whose drives control the speed.
fn run_by_set_speed<const N: usize, T: Bits>(robot: Robot<N, T>) -> Vec<Vec<u64>> {
    let mut run = Run::from(plain(robot), [0.1, -0.2, 0.3], [0.4, -0.3, 2.0]);
    let voltages = voltages::<N>(9, 12, 9.0);
    let each_ms = voltages.iter().flat_map(|hold| std::iter::repeat_n(hold.u, hold.milliseconds as usize));
    each_ms
        .map(|u| {
            let reading = run.set_speed(u, 1e-3);
            bits(&run.state, &reading)
        })
        .collect()
}

fn every_effect_can_be_absent<const N: usize, T: Bits>(robot: Robot<N, T>) {
    let (by_voltage, by_set_speed) = (run(plain(robot)), run_by_set_speed(robot));
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let without = if card.of_speed_drive() { &by_set_speed } else { &by_voltage };
        for placement in placements(card, N) {
            for params in ways_to_be_absent(card) {
                let with = run(with_effect(robot, *effect, placement, &params));
                let at = without.iter().zip(&with).position(|(a, b)| a != b);
                assert!(at.is_none(), "{} on {placement:?} at {params:?} shows in step {at:?}", card.id);
            }
        }
    }
}

#[test]
fn absent_effects_leave_three_wheels_bit_for_bit() {
    every_effect_can_be_absent(three::<f64>());
    every_effect_can_be_absent(three::<f32>());
}

#[test]
fn absent_effects_leave_four_wheels_bit_for_bit() {
    every_effect_can_be_absent(four::<f64>());
    every_effect_can_be_absent(four::<f32>());
}

#[test]
fn absent_effects_leave_imposed_currents_and_speeds_bit_for_bit() {
    use model_core::plant::Input;
    let input = |k: u32| {
        let phase = f64::from(k) * 0.02;
        let wave: [f64; 4] = std::array::from_fn(|j| (phase * (1.0 + 0.3 * j as f64)).sin());
        if k < 150 { Input::Current(wave) } else { Input::Speed(wave.map(|w| 10.0 * w)) }
    };
    let run = |plant: Plant<4, f64>| {
        let mut run = Run::new(plant);
        let steps = 0..300;
        steps
            .map(|k| {
                let reading = run.step(&input(k), 1e-3);
                bits(&run.state, &reading)
            })
            .collect::<Vec<_>>()
    };
    let without = run(plain(four()));
    for effect in &EffectKind::ALL {
        let placement = crate::fixture::usual_placement(effect.card());
        let with = run(with_effect(four(), *effect, placement, &absent(effect.card())));
        assert!(with == without, "{}", effect.card().id);
    }
}

#[test]
fn typical_effects_are_seen() {
    let by_set_speed = run_by_set_speed(four::<f64>());
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let without =
            if card.of_speed_drive() { by_set_speed.clone() } else { run(beside(four::<f64>(), *effect, None)) };
        for placement in placements(card, 4) {
            let with = run(beside(four::<f64>(), *effect, Some((placement, &typical(card)))));
            assert!(with != without, "{} on {placement:?} changes nothing", card.id);
        }
    }
}
