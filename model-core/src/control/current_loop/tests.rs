use super::*;
use core::f64::consts::{FRAC_PI_3, TAU};

mod machine;
use machine::Machine;

const BUS: f64 = 24.0;
const PERIOD: f64 = 50.0e-6;
const BANDWIDTH: f64 = 2000.0;
const MAX_DUTY: f64 = 0.94;
/// A converter of ±8 A.
const AMPS: f64 = 0.004;
const OFFSETS: [f64; 3] = [2048.0, 2040.5, 2061.25];

/// Tolerance: a few dozen roundings of numbers about 10.
const CLOSE: f64 = 1.0e-13;

fn regulator() -> CurrentLoop<f64> {
    CurrentLoop::new(machine::RESISTANCE, machine::INDUCTANCE, AMPS, BANDWIDTH, PERIOD, MAX_DUTY)
}

/// A number in −1 ..= 1 that looks random, the same in every run.
fn noise(seed: &mut u32) -> f64 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    f64::from(*seed >> 8) / f64::from(1_u32 << 23) - 1.0
}

fn measured(codes: [AdcCode; 3]) -> CurrentMeasurement<f64> {
    CurrentMeasurement { codes, offsets: OFFSETS, ahead: 0.0, bus: BUS, per_bus: 1.0 / BUS }
}

fn closed(current: f64, voltage: f64) -> CurrentSetpoint<f64> {
    CurrentSetpoint { current, voltage, closed: true }
}

fn open(voltage: f64) -> CurrentSetpoint<f64> {
    CurrentSetpoint { current: 0.0, voltage, closed: false }
}

/// Codes that three phase currents [A] read as.
fn codes(currents: [f64; 3]) -> [AdcCode; 3] {
    let mut offsets = OFFSETS.into_iter();
    currents.map(|i| AdcCode::nearest(offsets.next().unwrap_or_default() + i / AMPS))
}

/// Codes of a DC-equivalent current vector [A] at an angle [rad].
fn codes_of(d: f64, q: f64, angle: f64) -> [AdcCode; 3] {
    let vector = DirectQuadrature { d: phases::q_current(d), q: phases::q_current(q) };
    codes(Rotation::of_angle(angle).inverse_park(vector).inverse_clarke())
}

fn span([a, b, c]: [f64; 3]) -> f64 {
    a.max(b).max(c) - a.min(b).min(c)
}

fn assert_close<const M: usize>(got: [f64; M], setpoint: [f64; M], within: f64) {
    for (g, w) in got.into_iter().zip(setpoint) {
        assert!((g - w).abs() <= within, "{got:?} against {setpoint:?}");
    }
}

/// A loop on a machine, field-oriented. It is sampled when duties come into force; what it decides holds from the next
/// sample on, 1½ periods later in the middle.
struct Drive {
    regulator: CurrentLoop<f64>,
    memory: CurrentMemory<f64>,
    machine: Machine,
    duties: [f64; 3],
}

impl Drive {
    fn new(machine: Machine) -> Self {
        Self { regulator: regulator(), memory: CurrentMemory::default(), machine, duties: [0.5; 3] }
    }

    /// One period: sampled at its beginning, decided for the next. The DC-equivalent current that was there.
    fn turn(&mut self, setpoint: CurrentSetpoint<f64>) -> DirectQuadrature<f64> {
        let there = self.machine.current();
        let ahead = 1.5 * self.machine.speed * PERIOD;
        let measured = CurrentMeasurement { ahead, ..measured(codes(self.machine.phases())) };
        let rotor = Rotation::of_angle(self.machine.angle);
        let output = self.regulator.field_oriented(&mut self.memory, &measured, rotor, &setpoint);
        self.go_on(output.duties);
        there
    }

    /// The same in six steps.
    fn step(&mut self, setpoint: CurrentSetpoint<f64>) -> DirectQuadrature<f64> {
        let there = self.machine.current();
        let sector = libm::floor(self.machine.angle / FRAC_PI_3 + 0.5) as u8 % 6;
        let measured = measured(codes(self.machine.phases()));
        let output = self.regulator.six_step(&mut self.memory, &measured, sector, &setpoint);
        self.go_on(output.duties);
        there
    }

    /// This period with the old duties; the new ones wait for the next.
    fn go_on(&mut self, duties: [f64; 3]) {
        self.machine.run(self.duties, BUS, PERIOD);
        self.duties = duties;
    }
}

#[test]
fn a_step_of_the_current_closes_as_the_bandwidth_says_at_every_angle() {
    // with the winding's pole met: i⁺ = i + w·Δt·e⁻, a period's current being made by the duties decided before it
    for k in 0..12 {
        let mut drive = Drive::new(Machine::at_rest(f64::from(k) * 0.55));
        let (mut ideal, mut error, mut before) = (0.0, 4.0, 0.0);
        for n in 0..80 {
            let DirectQuadrature { d, q } = drive.turn(closed(4.0, 0.0));
            // the converter is coarse to 4 mA
            assert!((q - ideal).abs() < 0.008 && d.abs() < 0.008, "{k}, {n}: {d}, {q} against {ideal}");
            ideal += BANDWIDTH * PERIOD * before;
            (before, error) = (error, 4.0 - ideal);
        }
        // after 4 ms it is there, and it has never been beyond
        assert!((ideal - 4.0).abs() < 0.001, "{ideal}");
    }
    // and that is the exponential of the page, up to the delay
    let mut drive = Drive::new(Machine::at_rest(0.0));
    let time_constant = (1.0 / (BANDWIDTH * PERIOD)) as usize;
    let risen = (0..=time_constant).map(|_| drive.turn(closed(4.0, 0.0)).q).last().unwrap_or_default() / 4.0;
    assert!((risen - 0.632).abs() < 0.05, "{risen}");
}

#[test]
fn in_six_steps_the_same_step_closes_in_every_sector() {
    for sector in 0..6 {
        let mut drive = Drive::new(Machine::at_rest(f64::from(sector) * FRAC_PI_3));
        let mut field_oriented = Drive::new(Machine::at_rest(f64::from(sector) * FRAC_PI_3));
        for n in 0..80 {
            let (a, b) = (drive.step(closed(-4.0, 0.0)), field_oriented.turn(closed(-4.0, 0.0)));
            assert!((a.q - b.q).abs() < 0.01 && a.d.abs() < 0.01, "{sector}, {n}: {a:?} against {b:?}");
        }
    }
}

#[test]
fn a_turning_machine_gets_the_current_along_q_and_none_along_d() {
    for speed in [-2500.0, -600.0, 0.0, 600.0, 2500.0] {
        let mut drive = Drive::new(Machine::turning(speed));
        let emf = drive.machine.emf();
        let mut last = DirectQuadrature::default();
        for _ in 0..600 {
            last = drive.turn(closed(3.0, emf));
        }
        assert_close([last.d, last.q], [0.0, 3.0], 0.01);
    }
}

#[test]
fn a_voltage_alone_drives_the_dc_motor_of_the_model_at_every_speed() {
    for (speed, voltage) in [(2500.0, 13.0), (-2500.0, -13.0), (600.0, 4.0), (600.0, 2.0), (0.0, -1.0)] {
        let mut drive = Drive::new(Machine::turning(speed));
        let mut sum = 0.0;
        for n in 0..4000 {
            let i = drive.turn(open(voltage)).q;
            sum += if n < 2000 { 0.0 } else { i / 2000.0 };
        }
        // i = (u − K_v·ω_m)/R; the held voltage turns against the rotor by ω_e·Δt within a period, which loses 0.07 %
        // of it at most (1 − sin x/x with x = ω_e·Δt/2)
        let setpoint = (voltage - drive.machine.emf()) / machine::RESISTANCE;
        let lost = 1.0e-3 * voltage.abs() / machine::RESISTANCE;
        assert!((sum - setpoint).abs() < lost + 0.004, "{speed}, {voltage}: {sum} against {setpoint}");
    }
}

#[test]
fn after_a_saturation_the_loop_goes_on_at_once() {
    let mut drive = Drive::new(Machine::turning(4000.0));
    let emf = drive.machine.emf();
    for _ in 0..400 {
        drive.turn(closed(1.0, emf));
    }
    let before = drive.memory.q;
    for _ in 0..4000 {
        drive.turn(closed(6.0, emf));
    }
    // what is left of the bus is too little for what is wanted: 0.2 s of this error would be 1,500 V
    let reached = drive.machine.current().q;
    assert!((1.5..5.0).contains(&reached), "{reached}");
    assert!((drive.memory.q - before).abs() < 0.5 * emf, "{before} → {}", drive.memory.q);
    for n in 0..60 {
        let i = drive.turn(closed(1.0, emf)).q;
        let ideal = 1.0 + (reached - 1.0) * libm::exp(-BANDWIDTH * PERIOD * f64::from(n));
        // the delay, and what the integral worked on the way up and has to give back with L/R
        assert!((i - ideal).abs() < 0.3 * (reached - 1.0), "{n}: {i} against {ideal}");
    }
    for _ in 0..100 {
        drive.turn(closed(1.0, emf));
    }
    assert_close([drive.machine.current().q], [1.0], 0.03);
}

#[test]
fn a_feedforward_beyond_the_bus_does_not_lock_the_loop() {
    let mut drive = Drive::new(Machine::turning(4000.0));
    for _ in 0..3000 {
        drive.turn(closed(0.5, 100.0));
    }
    assert_close([drive.machine.current().q], [0.5], 0.01);
}

#[test]
fn both_senses_of_rotation_are_mirror_images() {
    let mut seed = 1;
    for k in 0..2000 {
        let angle = 0.01 * f64::from(k);
        let [a, b, c] = [(); 3].map(|()| 3.0 * noise(&mut seed));
        let (current, voltage) = (2.0 * noise(&mut seed), 20.0 * noise(&mut seed));
        let mut memory = CurrentMemory { d: noise(&mut seed), q: 10.0 * noise(&mut seed) };
        let mut mirrored = CurrentMemory { d: memory.d, q: -memory.q };
        let setpoint = CurrentSetpoint { current, voltage, closed: k % 2 == 0 };
        let against = CurrentSetpoint { current: -current, voltage: -voltage, ..setpoint };
        // phases b and c change places, and the rotor turns the other way
        let [o_a, o_b, o_c] = OFFSETS;
        let [a, b, c] = codes([a, b, c]);
        let here = CurrentMeasurement { ahead: 0.1, ..measured([a, b, c]) };
        let there = CurrentMeasurement { offsets: [o_a, o_c, o_b], ahead: -0.1, ..measured([a, c, b]) };
        let one = regulator().field_oriented(&mut memory, &here, Rotation::of_angle(angle), &setpoint);
        let other = regulator().field_oriented(&mut mirrored, &there, Rotation::of_angle(-angle), &against);
        let [x, y, z] = other.duties;
        assert_close(one.duties, [x, z, y], CLOSE);
        assert_close([one.current, one.voltage], [-other.current, -other.voltage], CLOSE * 10.0);
        assert_close([memory.d, memory.q], [mirrored.d, -mirrored.q], CLOSE);
    }
}

#[test]
fn naming_the_phases_onward_with_the_rotor_a_third_ahead_changes_nothing_else() {
    let mut seed = 2;
    for k in 0..2000 {
        let angle = 0.01 * f64::from(k);
        let [a, b, c] = codes([(); 3].map(|()| 3.0 * noise(&mut seed)));
        let [o_a, o_b, o_c] = OFFSETS;
        let setpoint = closed(noise(&mut seed), 20.0 * noise(&mut seed));
        let (mut one, mut other) = (CurrentMemory::default(), CurrentMemory::default());
        let here = regulator().field_oriented(&mut one, &measured([a, b, c]), Rotation::of_angle(angle), &setpoint);
        let there = CurrentMeasurement { offsets: [o_c, o_a, o_b], ..measured([c, a, b]) };
        let ahead = Rotation::of_angle(angle + TAU / 3.0);
        let there = regulator().field_oriented(&mut other, &there, ahead, &setpoint);
        let [x, y, z] = there.duties;
        assert_close(here.duties, [y, z, x], CLOSE);
        assert_close([here.current, here.voltage], [there.current, there.voltage], CLOSE * 10.0);
    }
}

#[test]
fn in_the_middle_of_a_sector_six_steps_decide_as_field_oriented_control() {
    for sector in 0..6_u8 {
        let angle = f64::from(sector) * FRAC_PI_3;
        for (current, setpoint) in
            [(2.8, closed(4.0, 5.0)), (-2.8, closed(-4.0, 0.0)), (1.2, open(9.0)), (0.0, open(99.0))]
        {
            // without quantisation along d: whole codes of the conducting pair
            let measured = CurrentMeasurement { offsets: [2048.0; 3], ..measured([AdcCode(2048); 3]) };
            let counts = libm::round(current / AMPS) as i32;
            let up_down = SIX_STEPS[usize::from(sector)].phases(counts, -counts, 0);
            let measured = CurrentMeasurement { codes: up_down.map(|n| AdcCode((2048 + n) as u16)), ..measured };
            let (mut one, mut other) = (CurrentMemory::default(), CurrentMemory::default());
            let field = regulator().field_oriented(&mut one, &measured, Rotation::of_angle(angle), &setpoint);
            let steps = regulator().six_step(&mut other, &measured, sector, &setpoint);
            assert_close(field.duties, steps.duties, CLOSE);
            assert_close([field.current, field.voltage], [steps.current, steps.voltage], CLOSE * 10.0);
            assert_close([steps.current], [current], CLOSE);
        }
    }
}

#[test]
fn duties_stay_within_their_bounds_whatever_is_seen() {
    let mut seed = 3;
    for k in 0..20_000_u32 {
        let codes = [(); 3].map(|()| AdcCode((2047.5 * (1.0 + noise(&mut seed))) as u16));
        let huge = [1.0, 10.0, 1.0e6, 1.0e30][k as usize % 4];
        let setpoint =
            CurrentSetpoint { current: huge * noise(&mut seed), voltage: huge * noise(&mut seed), closed: k % 5 != 0 };
        let mut memory = CurrentMemory { d: huge * noise(&mut seed), q: huge * noise(&mut seed) };
        let measured = CurrentMeasurement { ahead: 0.4 * noise(&mut seed), ..measured(codes) };
        let rotor = Rotation::of_angle(7.0 * noise(&mut seed));
        for _ in 0..3 {
            for output in [
                regulator().field_oriented(&mut memory, &measured, rotor, &setpoint),
                regulator().six_step(&mut memory, &measured, (k % 7) as u8, &setpoint),
            ] {
                let low = 0.5 - 0.5 * MAX_DUTY - CLOSE;
                assert!(output.duties.iter().all(|x| (low..=1.0 - low).contains(x)), "{output:?}");
                assert!(f64::is_finite(output.current) && f64::is_finite(output.voltage), "{output:?}");
                assert!(f64::is_finite(memory.d) && f64::is_finite(memory.q), "{memory:?}");
            }
        }
    }
}

#[test]
fn d_comes_first_and_q_gets_what_is_left_of_the_circle() {
    let bus_share = |share: f64| share * BUS;
    for k in 0..=100 {
        let d = bus_share(0.5 * MAX_DUTY * f64::from(k) / 100.0);
        for d in [d, -d] {
            let mut memory = CurrentMemory { d, q: 0.0 };
            let idle = CurrentMeasurement { offsets: [2048.0; 3], ..measured([AdcCode(2048); 3]) };
            let output = regulator().field_oriented(&mut memory, &idle, Rotation::of_angle(0.3), &closed(0.0, 1000.0));
            let circle = libm::sqrt(bus_share(MAX_DUTY) * bus_share(MAX_DUTY) - d * d);
            assert!(output.voltage <= circle * (1.0 + 1e-12), "{d}: {} of {circle}", output.voltage);
            assert!(output.voltage >= circle - 2.0e-4 * bus_share(MAX_DUTY), "{d}: {} of {circle}", output.voltage);
            assert!(span(output.duties) <= MAX_DUTY + CLOSE, "{output:?}");
        }
    }
    // beyond half of the bus d is held
    let mut memory = CurrentMemory { d: 1000.0, q: 0.0 };
    let output = regulator().field_oriented(
        &mut memory,
        &measured(codes_of(0.0, 0.0, 0.0)),
        Rotation::of_angle(0.0),
        &closed(0.0, 1000.0),
    );
    assert_close([output.voltage], [bus_share(MAX_DUTY) * libm::sqrt(0.75)], 1.0e-9 * BUS);
}

#[test]
fn an_open_loop_applies_its_voltage_and_remembers_nothing_of_q() {
    for angle in [0.0, 1.0, 4.0] {
        let idle = CurrentMeasurement { offsets: [2048.0; 3], ..measured([AdcCode(2048); 3]) };
        let mut memory = CurrentMemory { d: 0.0, q: 3.0 };
        let output = regulator().field_oriented(&mut memory, &idle, Rotation::of_angle(angle), &open(7.0));
        assert_eq!(memory.q, 0.0);
        assert_close([output.voltage], [7.0], CLOSE);
        // between the terminals: the vector of amplitude u/√3 at θ + 90°
        let u = Rotation::of_angle(angle).park(AlphaBeta::clarke(output.duties.map(|x| x * BUS)));
        assert_close([phases::dc_voltage(u.d), phases::dc_voltage(u.q)], [0.0, 7.0], CLOSE);
    }
}

#[test]
fn without_a_legal_sector_no_voltage_is_applied() {
    let mut memory = CurrentMemory { d: 1.0, q: 1.0 };
    let output = regulator().six_step(&mut memory, &measured([AdcCode(3000); 3]), 6, &closed(1.0, 1.0));
    assert_eq!((output.duties, output.voltage), ([0.5; 3], 0.0));
    assert_eq!(memory, CurrentMemory::default());
}

#[test]
fn the_gains_have_their_limits_without_inductance_and_without_resistance() {
    let gains = |r, l| {
        let regulator = CurrentLoop::new(r, l, AMPS, BANDWIDTH, PERIOD, MAX_DUTY);
        (regulator.proportional, regulator.integral)
    };
    // R·w·Δt for both, and L·w alone
    assert_eq!(gains(1.5, 0.0), (1.5 * BANDWIDTH * PERIOD, 1.5 * BANDWIDTH * PERIOD));
    assert_eq!(gains(0.0, 1.0e-3), (1.0e-3 * BANDWIDTH, 0.0));
    // no jump where the rule changes: x = 10⁻³, where the next term is x²/12
    let x = |share: f64| gains(share * 1.0e-3 * 1.0e-3 / PERIOD, 1.0e-3).0;
    assert!((x(1.000_001) / x(0.999_999) - 1.0).abs() < 2.0e-7);
    // a pole in the plant at e⁻ˣ is met by the zero 1 − k_i·Δt/k_p
    let (p, i) = gains(machine::RESISTANCE, machine::INDUCTANCE);
    assert!((1.0 - i / p - libm::exp(-machine::RESISTANCE * PERIOD / machine::INDUCTANCE)).abs() < 1e-14);
}

#[test]
fn the_robot_decides_as_double_precision_does_to_a_few_roundings() {
    let mut seed = 4;
    let single = CurrentLoop::<f32>::new(1.5, 0.6e-3, 0.004, 2000.0, 50.0e-6, 0.94);
    for k in 0..2000 {
        let angle = 0.003 * f64::from(k);
        let codes = codes_of(3.0 * noise(&mut seed), 3.0 * noise(&mut seed), angle);
        let (current, voltage) = (noise(&mut seed), 12.0 * noise(&mut seed));
        let double = regulator().field_oriented(
            &mut CurrentMemory::default(),
            &CurrentMeasurement { ahead: 0.1, ..measured(codes) },
            Rotation::of_angle(angle),
            &closed(current, voltage),
        );
        let measured = CurrentMeasurement {
            codes,
            offsets: OFFSETS.map(|x| x as f32),
            ahead: 0.1,
            bus: BUS as f32,
            per_bus: (1.0 / BUS) as f32,
        };
        let setpoint = CurrentSetpoint { current: current as f32, voltage: voltage as f32, closed: true };
        let robot = single.field_oriented(
            &mut CurrentMemory::default(),
            &measured,
            Rotation::of_angle(angle as f32),
            &setpoint,
        );
        // twenty roundings of 6·10⁻⁸ of numbers up to 1, 8 A and 24 V
        assert_close(robot.duties.map(f64::from), double.duties, 1.5e-6);
        assert_close([robot.current.into()], [double.current], 1.0e-5);
        assert_close([robot.voltage.into()], [double.voltage], 3.0e-5);
    }
}
