//! # Scenarios: the image drives a robot, is let down, and fails
//!
//! The robot is the virtual board of the other runs; its codes come out of the modelled converters, and the duties are what
//! stands in the compare registers.

use std::collections::BTreeMap;

use host_tests::emulator::RunError;
use host_tests::in_loop::{ClosedLoopRun, robots};
use host_tests::virtual_board::motion_sensors::{GyroErrors, scales};
use host_tests::virtual_board::{BoardSetup, InjectedFault, VirtualBoard};
use model_core::effects::active::Effects;
use model_core::geometry::frames::BodyTwist;
use model_core::link::block::{Block, MAX_BYTES, Parameters, checksum};
use model_core::link::events::Event;
use model_core::link::faults::Fault;
use model_core::link::record::OperatingState;
use model_core::link::sensor_codes::SensorCodes;
use model_core::plant::paper::four_wheels;

use crate::board::ChipBoard;
use crate::core::profile::Spent;
use crate::core::{Chip, ChipError, Pace};
use crate::image::{Coverage, Image};
use crate::order::{self, Instant};
use crate::peripherals::bus::Written;

/// What was promised, and what came of it.
#[derive(Clone, Debug)]
pub struct Promise {
    /// What is promised
    pub what: String,
    /// It was kept
    pub kept: bool,
}

/// What the runs came to.
#[derive(Debug, Default)]
pub struct Seen {
    /// What was promised
    pub promises: Vec<Promise>,
    /// The instants of a period
    pub instants: Vec<Instant>,
    /// How long each exception took at the most, by its number, with the manuals' longest instructions
    pub longest: BTreeMap<u16, Spent>,
    /// Lines that were executed
    pub coverage: Coverage,
    /// Every word that was written
    pub written: Vec<Written>,
    /// What the program did that the manual forbids
    pub forbidden: Vec<String>,
}

impl Seen {
    fn promise(&mut self, what: &str, kept: bool) {
        self.promises.push(Promise { what: what.into(), kept });
    }

    /// Takes what a chip has seen.
    fn take(&mut self, image: &Image, chip: &Chip) {
        let machine = chip.machine();
        self.coverage.merge(&image.coverage(&machine.executed));
        self.written.extend(machine.bus.written.keys());
        self.written.sort_unstable();
        self.written.dedup();
        for what in &machine.bus.log.forbidden {
            if !self.forbidden.contains(what) {
                self.forbidden.push(what.clone());
            }
        }
    }
}

type Run = ClosedLoopRun<ChipBoard, 4>;

/// How long a sector takes to be erased here [core cycles]: 50 ms, that the core stands still is what matters.
const ERASE: u64 = 8_400_000;

/// From a block on its way to a robot that knows its zeros and has stored the block [s]
const STORED: f64 = 0.3;

/// Cycles within which a failing program opens the bridges: 3 µs.
const OPENS_WITHIN: u64 = 500;

/// The robot's parameters.
fn parameters() -> Parameters {
    Parameters::Four(robots::block(four_wheels()))
}

/// A robot that has its parameters and has measured its zeros.
fn ready(image: &Image) -> Result<Run, Failed> {
    ready_at(image, Pace::USUAL)
}

/// The same with a core of another pace.
fn ready_at(image: &Image, pace: Pace) -> Result<Run, Failed> {
    let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 1));
    let mut chip = Chip::new(&image.bytes, pace)?;
    chip.machine_mut().bus.flash.erase = ERASE;
    let mut run = ClosedLoopRun::new(ChipBoard::new(chip), board);
    run.send_block(&parameters());
    // its zeros, and then a sector is erased for the parameters
    run.wait(STORED)?;
    Ok(run)
}

/// Why a run could not be made.
#[derive(Debug, thiserror::Error)]
pub enum Failed {
    /// The chip
    #[error(transparent)]
    Chip(#[from] ChipError),
    /// The run
    #[error("{0}")]
    Run(String),
}

impl From<RunError> for Failed {
    fn from(why: RunError) -> Self {
        Self::Run(why.to_string())
    }
}

fn state(run: &Run) -> Option<OperatingState> {
    run.log.records.last().map(|record| record.state)
}

fn has_fault(run: &Run, fault: Fault) -> bool {
    run.log.records.last().is_some_and(|record| record.faults.iter().any(|kept| kept == fault))
}

fn forward(run: &mut Run, seconds: f64) -> Result<(), Failed> {
    Ok(run.follow(seconds, |_| BodyTwist { v: 0.5, vn: 0.0, w: 0.0 })?)
}

/// Everything that the board's image is asked to do.
///
/// # Errors
/// [`Failed`] where a run could not be made.
pub fn play(image: &Image) -> Result<Seen, Failed> {
    let mut seen = Seen::default();
    drives(image, &mut seen)?;
    takes_its_time(image, &mut seen)?;
    senses(image, &mut seen)?;
    for failure in Failure::ALL {
        fails(image, failure, &mut seen)?;
    }
    Ok(seen)
}

/// A drive with other parameters on the way and a wheel that is lost, every instruction as long as it can be.
fn takes_its_time(image: &Image, seen: &mut Seen) -> Result<(), Failed> {
    let mut run = ready_at(image, Pace::manual())?;
    forward(&mut run, 0.3)?;
    let softer = Block { feedback: 0.2, ..robots::block(four_wheels()) };
    run.send_block(&Parameters::Four(softer));
    forward(&mut run, 0.2)?;
    let taken = run.log.replies.iter().filter(|reply| reply.taken).count() == 2;
    run.lockstep.board.inject(InjectedFault::Halls { motor: 1, code: 7 });
    forward(&mut run, 0.2)?;
    let in_time = !has_fault(&run, Fault::TurnOverrun) && state(&run) == Some(OperatingState::Driving);
    seen.promise(
        "with every instruction as long as the manuals say at most, other parameters and a wheel lost on the way: no turn is late",
        taken && in_time,
    );
    let machine = run.lockstep.program.chip.machine();
    seen.longest = machine.profile.longest.clone();
    Ok(())
}

fn drives(image: &Image, seen: &mut Seen) -> Result<(), Failed> {
    let mut run = ready(image)?;
    let opened = run.log.truth.iter().all(|moment| moment.enabled == 0);
    seen.promise(
        "with its parameters, sent over USART3 and its DMA, it measures its zeros and is ready, all four enables low",
        opened && state(&run) == Some(OperatingState::Open),
    );
    // while the flash is erased nothing is in time
    run.lockstep.program.chip.machine_mut().bus.log.events.clear();
    forward(&mut run, 0.3)?;
    let speed = run.log.truth.last().map_or(0.0, |moment| moment.twist.v);
    seen.promise("a command closes the bridges: all four enables are high", run.lockstep.program.enabled() == 0b1111);
    seen.promise("told 0.5 m/s, the robot has it to 0.05 m/s after 0.3 s", (speed - 0.5).abs() < 0.05);

    let events = &run.lockstep.program.chip.machine().bus.log.events;
    seen.instants = order::instants(events);
    let latch = order::latch(events);
    seen.promise(
        "compare registers are written after the latch is due and before TIM1 triggers, 7980 to 8256 cycles after its top",
        latch.written[0] >= 7980 && latch.written[1] <= 8256,
    );
    seen.promise("every timer takes its compare counts at tops", latch.taken_at_tops.iter().all(|count| *count > 100));
    seen.promise("no timer ever takes one at a bottom", latch.taken_at_bottoms == [0; 4]);

    run.wait(1.0)?;
    seen.promise("a host that is silent: it brakes and opens the bridges, without a fault", {
        run.lockstep.program.enabled() == 0
            && run.log.records.last().is_some_and(|record| record.faults.iter().count() == 0)
    });
    forward(&mut run, 0.1)?;
    let closed = run.lockstep.program.enabled() == 0b1111;
    run.lockstep.board.inject(InjectedFault::DriverLine);
    // the code of this period is that of the injected fault; the turn that reads it opens them
    run.period()?;
    run.period()?;
    let open = run.lockstep.program.enabled() == 0;
    run.wait(0.01)?;
    seen.promise("the fault line goes low: the turn that reads it opens the bridges, and the record names it", {
        closed && open && has_fault(&run, Fault::DriverLine)
    });
    seen.take(image, &run.lockstep.program.chip);
    Ok(())
}

/// From a block with sensors to a gyro and encoders that were begun with [s]
const BEGUN: f64 = 0.15;

/// The same with a gyro and four encoders, at first without one of them.
fn senses(image: &Image, seen: &mut Seen) -> Result<(), Failed> {
    let sensors = scales(four_wheels::<f32>().motor.gear_ratio);
    let block = Parameters::Four(Block { sensors, ..robots::block(four_wheels()) });
    let quiet = GyroErrors { bias: 0.0, noise: 0.0, scale: 0.0 };
    let setup =
        BoardSetup { gyro: Some(quiet), encoders: true, ..BoardSetup::new(four_wheels(), Effects::default(), 1) };
    let mut chip = Chip::new(&image.bytes, Pace::manual())?;
    chip.machine_mut().bus.flash.erase = ERASE;
    let mut run = ClosedLoopRun::new(ChipBoard::new(chip), VirtualBoard::new(setup));
    run.lockstep.program.unplugged = true;
    run.send_block(&block);
    run.wait(STORED)?;
    let said = |run: &Run| run.log.records.last().and_then(|record| record.sensors);
    seen.promise("a gyro and encoders that do not answer: every record says so, and nothing else happens", {
        said(&run) == Some(SensorCodes::default()) && !has_fault(&run, Fault::TurnOverrun)
    });
    let tells = |run: &Run| run.log.records.last().is_some_and(|record| record.events.has(Event::SensorSilent));
    let told = tells(&run);
    run.lockstep.program.unplugged = false;
    run.wait(BEGUN)?;
    seen.promise("an event tells of sensors that are silent, until they answer", told && !tells(&run));
    let before = run.lockstep.program.chip.machine().bus.spi.transfers;
    run.follow(0.3, |_| BodyTwist { v: 0.3, vn: 0.0, w: 2.0 })?;
    let after = run.lockstep.program.chip.machine().bus.spi.transfers;
    let truth = run.log.truth.iter().rev().nth(2).map_or(0.0, |moment| moment.twist.w);
    let told = said(&run).and_then(|codes| sensors.yaw_rate(&codes)).map_or(0.0, f64::from);
    seen.promise(
        "begun with within 0.15 s, the gyro's rate stands in every record, to 0.02 rad/s that of the robot",
        (told - truth).abs() < 0.02 && truth > 1.5,
    );
    let speed = |wheel: usize| {
        let [last, before] =
            [0, 20].map(|back| run.log.records.iter().rev().nth(back).and_then(|r| r.sensors?.angle(wheel)));
        let counts = i32::from(last?) - i32::from(before?);
        Some(f64::from(sensors.encoder) * f64::from((counts + 8192).rem_euclid(16_384) - 8192) / 0.02)
    };
    let wheels = run.lockstep.board.wheel_speeds();
    seen.promise(
        "and so do the angles of all four encoders: over 20 ms their speeds are those of the wheels to 2 %",
        (0..4).all(|j| speed(j).is_some_and(|told| (told - wheels[j]).abs() < 0.02 * wheels[j].abs() + 0.02)),
    );
    // the last record is one of a drive; the first of it are 0.3 s before
    let drive = run.log.records.iter().rev().take(290).filter_map(|record| record.sensors);
    let whole = drive.filter(|codes| codes.yaw().is_some() && (0..4).all(|j| codes.angle(j).is_some())).count();
    seen.promise(
        "none of the last 290 records lacks a reading: all five are read in time for the motion turn",
        whole == 290,
    );
    seen.promise("each of 300 motion turns has one transfer of the gyro and two of each encoder, none is late", {
        let [gyro, encoders] = [0, 1].map(|k| after[k] - before[k]);
        gyro.abs_diff(300) <= 1 && encoders.abs_diff(8 * 300) <= 8 && !has_fault(&run, Fault::TurnOverrun)
    });
    let machine = run.lockstep.program.chip.machine();
    // the other tasks' longest are those of a robot without sensors, but for this one
    seen.longest.extend(machine.profile.longest.get(&SENSE).map(|spent| (SENSE, *spent)));
    seen.take(image, &run.lockstep.program.chip);
    Ok(())
}

/// The task that reads the sensors, by its number in the vector table: EXTI3.
const SENSE: u16 = 25;

/// How a program fails while it drives.
#[derive(Clone, Copy, Debug)]
enum Failure {
    Astray,
    Stack,
    Unbound,
    Crystal,
}

impl Failure {
    const ALL: [Failure; 4] = [Failure::Astray, Failure::Stack, Failure::Unbound, Failure::Crystal];

    fn text(self) -> &'static str {
        match self {
            Failure::Astray => "it goes on where there is no memory (hard fault)",
            Failure::Stack => "the same with a stack pointer that leads nowhere",
            Failure::Unbound => "an interrupt comes that nothing is bound to",
            Failure::Crystal => "the crystal stops (non-maskable interrupt of the clock security system)",
        }
    }

    fn happen(self, chip: &mut Chip) -> Result<(), ChipError> {
        match self {
            Failure::Astray => chip.go_astray(0x6000_0000),
            Failure::Stack => chip.lose_stack().and_then(|()| chip.go_astray(0x6000_0000)),
            Failure::Unbound => {
                chip.machine_mut().nvic.interrupt(50);
                Ok(())
            }
            Failure::Crystal => {
                chip.machine_mut().bus.stop_crystal();
                Ok(())
            }
        }
    }
}

fn fails(image: &Image, failure: Failure, seen: &mut Seen) -> Result<(), Failed> {
    let mut run = ready(image)?;
    forward(&mut run, 0.05)?;
    let closed = run.lockstep.program.enabled() == 0b1111;
    let program = &mut run.lockstep.program;
    failure.happen(&mut program.chip)?;
    program.chip.run_to(program.chip.now() + OPENS_WITHIN)?;
    let open = program.enabled() == 0;
    let outputs_off = [0x4001_0044, 0x4001_0444].iter().all(|bdtr| !program.chip.machine().bus.words.bit(*bdtr, 15));
    seen.promise(
        &format!(
            "{}: within 500 cycles the four enables are low, and the outputs of TIM1 and TIM8 off",
            failure.text()
        ),
        closed && open && outputs_off,
    );
    let (began, hellos) = (program.chip.now(), run.log.hellos.len());
    run.period()?;
    let waited = run.lockstep.program.chip.now() - began;
    run.wait(0.1)?;
    seen.promise("then: the watchdog resets the chip within 20 ms, and the program that starts anew names it", {
        waited < 20 * 168_000 && has_fault(&run, Fault::Watchdog) && run.lockstep.program.enabled() == 0
    });
    let mut block = [0; MAX_BYTES];
    let stored = parameters().encode(&mut block).ok().and_then(|length| checksum(&block[..length]));
    seen.promise("and with the parameters that it stored before", {
        run.log.hellos[hellos..].last().map(|hello| hello.block_check) == stored
    });
    seen.take(image, &run.lockstep.program.chip);
    Ok(())
}

/// The tests that are written for the board, run here: which passed.
///
/// # Errors
/// [`Failed`] where one could not be run.
pub fn board_tests(image: &Image, seen: &mut Seen) -> Result<(), Failed> {
    for (name, address) in &image.tests {
        let mut chip = Chip::new(&image.bytes, Pace::USUAL)?;
        chip.machine_mut().command_line = format!("run_addr {address}");
        chip.machine_mut().bus.log.keep = false;
        // the longest erases two sectors, 4 s each
        chip.run_to(12 * 168_000_000)?;
        seen.promise(&format!("`hil`: {}", name.replace('_', " ")), chip.machine().ended == Some(true));
        seen.coverage.merge(&image.coverage(&chip.machine().executed));
        seen.written.extend(chip.machine().bus.written.keys());
    }
    seen.written.sort_unstable();
    seen.written.dedup();
    Ok(())
}
