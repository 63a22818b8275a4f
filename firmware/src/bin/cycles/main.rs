//! Prints what one call of each part of the control path costs, in instructions of the emulated core.
//!
//! What is called is not inlined and its arguments are hidden from the compiler; the loop around it is taken off. The
//! robot turns and drives, all its wheels at different speeds.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware::board::{self, Stopwatch};
use firmware::codes::Codes;
use firmware::motion::MotionOutput;
use firmware::offsets;
use firmware::tx_queue::TxStorage;
use firmware::winding_config::{MAX_DUTY, WindingConfig};
use firmware::winding_signals::MotorSetpoints;
use firmware::windings::{BridgeCommand, Windings};
use model_core::control::braking::BrakingBand;
use model_core::control::calibration::AdcCode;
use model_core::control::compensation::Compensation;
use model_core::control::current_loop::{
    CurrentLoop, CurrentMeasurement, CurrentMemory, CurrentOutput, CurrentSetpoint,
};
use model_core::control::halls::{HallCode, HallDecoder};
use model_core::control::motion_controller::{Controller, Demand, Measurement, Memory, Output, Settings};
use model_core::control::phases::Rotation;
use model_core::control::wiring::MotorWiring;
use model_core::effects::card::Scope;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, EFFECT_CODES, Limits, Parameters};
use model_core::plant::paper;
use model_core::plant::robot::Robot;
use panic_halt as _;

mod tasks;

#[entry]
fn main() -> ! {
    static mut ROOM: TxStorage = TxStorage::new();
    let mut watch = Stopwatch::take();
    motion(&mut watch);
    compensations(&mut watch);
    currents(&mut watch);
    halls(&mut watch);
    current_interrupt(&mut watch, "", None);
    let crossed =
        MotorWiring { outputs: [0, 2, 1], converters: [1, 2, 0], inverted: [true; 3], ..MotorWiring::default() };
    current_interrupt(&mut watch, ", commissioned", black_box(Some(crossed)));
    tasks::motion_turns(&mut watch);
    tasks::link(&mut watch, ROOM);
    board::end()
}

/// Prints a cost and its name.
fn say(name: &str, detail: &str, instructions: u32) {
    board::say(format_args!("{instructions}\t{name}{detail}\n"));
}

// The motion turn

#[inline(never)]
fn tick<const N: usize>(
    c: &Controller<N>,
    memory: &mut Memory,
    measured: &Measurement<N>,
    want: &BodyTwist,
) -> Output<N> {
    c.tick(memory, measured, *want)
}

#[inline(never)]
fn feedforward(c: &Controller<4>, twist: &BodyTwist, acceleration: &BodyTwist) -> Demand<4> {
    c.feedforward(*twist, *acceleration, 0.3)
}

const MOVING: BodyTwist = BodyTwist { v: 0.4, vn: -0.3, w: 1.5 };
const NEAR: BodyTwist = BodyTwist { v: 0.401, vn: -0.301, w: 1.505 };
const FAR: BodyTwist = BodyTwist { v: 1.4, vn: 0.6, w: -1.5 };

fn settings<const N: usize>(robot: Robot<N>, compensation: Compensation<N>) -> Settings<N> {
    Settings {
        robot,
        compensation,
        acceleration: [3.0, 3.0, 20.0],
        current_limit: 4.0,
        braking: BrakingBand::new(24.0, 12.0),
        max_duty: MAX_DUTY,
        feedback: 0.05,
        feedback_integral: 0.2,
        feedforward: true,
        working: [true; N],
        dt: 1.0e-3,
    }
}

fn tick_costs<const N: usize>(watch: &mut Stopwatch, settings: &Settings<N>, want: BodyTwist, bus: f32) -> u32 {
    let controller = Controller::new(settings);
    let start = Memory { reference: MOVING, heading: 0.3, integral: [0.1, -0.1, 0.01] };
    let measured = Measurement { wheel_speed: core::array::from_fn(|j| 8.0 - 5.0 * j as f32), bus };
    let (controller, measured, want) = (black_box(controller), black_box(measured), black_box(want));
    watch.cost(|| start, |memory| tick(&controller, memory, &measured, &want))
}

fn motion(watch: &mut Stopwatch) {
    let four = settings(paper::four_wheels(), Compensation::none());
    let three = settings(paper::three_wheels(), Compensation::none());
    say("motion tick, 4 wheels", "", tick_costs(watch, &four, NEAR, 12.0));
    say("motion tick, 4 wheels", ", acceleration at its limit", tick_costs(watch, &four, FAR, 12.0));
    say("motion tick, 4 wheels", ", no voltage for what is wanted", tick_costs(watch, &four, FAR, 3.0));
    say("motion tick, 3 wheels", "", tick_costs(watch, &three, NEAR, 12.0));
    let controller = black_box(Controller::new(&four));
    let cost = watch.cost(|| (MOVING, FAR), |(twist, change)| feedforward(&controller, twist, change));
    say("feedforward alone, 4 wheels", "", cost);
}

fn compensations(watch: &mut Stopwatch) {
    let mut short = 0;
    for known in EFFECT_CODES.iter().filter(|known| known.kind.undone()) {
        let wheel = (known.scope == Scope::OneWheel).then_some(1);
        let mut undo = Compensation::none();
        let effect = known.kind.with(black_box(known.typical()));
        if effect.is_none_or(|effect| undo.add(effect, black_box(wheel)).is_err()) {
            board::fail(format_args!("{} cannot be undone", known.id));
        }
        let settings = settings(paper::four_wheels(), undo);
        say("motion tick, 4 wheels, undoing ", known.id, tick_costs(watch, &settings, NEAR, 16.0));
        short = short.max(tick_costs(watch, &settings, FAR, 3.0));
    }
    say("motion tick, 4 wheels, the costliest of these", ", no voltage for what is wanted", short);
}

// The current turn

#[inline(never)]
fn field_oriented(
    l: &CurrentLoop,
    m: &mut CurrentMemory,
    s: &CurrentMeasurement,
    angle: u16,
    w: &CurrentSetpoint,
) -> CurrentOutput {
    l.field_oriented(m, s, Rotation::of_code(angle), w)
}

#[inline(never)]
fn six_step(
    l: &CurrentLoop,
    m: &mut CurrentMemory,
    s: &CurrentMeasurement,
    sector: u8,
    w: &CurrentSetpoint,
) -> CurrentOutput {
    l.six_step(m, s, sector, w)
}

fn currents(watch: &mut Stopwatch) {
    let current_loop = black_box(CurrentLoop::new(4.3, 0.6e-3, 0.0049, 2000.0, 50.0e-6, MAX_DUTY));
    let codes = [AdcCode(2100), AdcCode(2000), AdcCode(2044)];
    let offsets = [2048.0, 2047.5, 2049.1];
    let angle = black_box(20_861);
    let measured = black_box(CurrentMeasurement { codes, offsets, ahead: 0.1, bus: 12.0, per_bus: 1.0 / 12.0 });
    let wants = [
        ("", CurrentSetpoint { current: 0.3, voltage: 3.0, closed: true }),
        (", voltage at its limit", CurrentSetpoint { current: 2.0, voltage: 20.0, closed: true }),
        (", voltage alone", CurrentSetpoint { current: 0.0, voltage: 3.0, closed: false }),
    ];
    // integrals as they are found, so that the case stays what it is
    let found = || (CurrentMemory { d: 0.02, q: 0.5 }, 1_u8);
    for (detail, want) in wants {
        let cost = watch.cost(found, |(memory, _)| field_oriented(&current_loop, memory, &measured, angle, &want));
        say("field-oriented current tick", detail, cost);
    }
    for (detail, want) in wants {
        let cost = watch.cost(found, |(memory, sector)| six_step(&current_loop, memory, &measured, *sector, &want));
        say("six-step current tick", detail, cost);
    }
}

#[inline(never)]
fn hall_update(halls: &mut HallDecoder, code: HallCode) -> bool {
    halls.update(code).is_ok()
}

fn halls(watch: &mut Stopwatch) {
    let Ok(mut halls) = HallDecoder::new(HallCode::of_sector(0)) else {
        board::fail(format_args!("sector 0 is legal"))
    };
    let cost = watch.cost(|| HallCode::of_sector(0), |code| hall_update(&mut halls, *code));
    say("halls, no edge", "", cost);
    let mut sector = 0;
    let edge = || {
        sector = if sector == 5 { 0 } else { sector + 1 };
        HallCode::of_sector(black_box(sector))
    };
    say("halls, an edge", "", watch.cost(edge, |code| hall_update(&mut halls, *code)));
}

#[inline(never)]
fn windings_tick(windings: &mut Windings, codes: &Codes) -> BridgeCommand {
    windings.tick(codes)
}

/// The paper's robot, its motors wired so.
fn four_wheels(wiring: Option<MotorWiring>) -> Block<4> {
    Block {
        robot: paper::four_wheels(),
        inductance: 0.6e-3,
        pole_pairs: 8,
        limits: Limits {
            current: 4.0,
            speed: 2.0,
            acceleration: [3.0, 3.0, 20.0],
            under_voltage: 8.0,
            over_voltage: 16.0,
        },
        bandwidth: 2000.0,
        amps_per_count: 0.0049,
        bus_volts_per_count: 0.00886,
        linear_range: 9.4,
        continuous_current: 2.0,
        heating_time: 10.0,
        wiring: [wiring; 4],
        ..Block::default()
    }
}

/// The whole current interrupt but for the board: four motors that turn and are driven, an edge of every motor each eighth
/// period (2,600 rad/s electrical), wired as the table of pins says or otherwise.
fn current_interrupt(watch: &mut Stopwatch, detail: &str, wiring: Option<MotorWiring>) {
    let ask = MotorSetpoints { current: [0.3; 4], voltage: [3.0; 4], closed: true, enabled: 0b1111 };
    let mut windings = Windings::default();
    windings.apply(&MotionOutput {
        config: Some(WindingConfig::of(&Parameters::Four(four_wheels(wiring)))),
        setpoints: ask,
        ..MotionOutput::default()
    });
    let mut period = 0_u32;
    let mut codes = || {
        period = period.wrapping_add(1);
        let sector = (period / 8 % 6) as u8;
        let halls = [HallCode::of_sector(sector); 4];
        black_box(Codes { phases: [[AdcCode(2048); 3]; 4], bus: AdcCode(1354), halls, driver_fault: false })
    };
    for _ in 0..offsets::PERIODS + 100 {
        windings_tick(&mut windings, &codes());
    }
    let driven = windings_tick(&mut windings, &codes()).enabled;
    if driven != 0b1111 {
        board::fail(format_args!("the windings are not driven: {driven:04b}"));
    }
    let cost = watch.cost(&mut codes, |codes| windings_tick(&mut windings, codes));
    say("current turn, four motors, field-oriented", detail, cost);
}
