//! A robot without a board: the firmware and a virtual board on a network address or a serial device, for `omni-gap robot`,
//! `record` and `watch`.
//!
//! `robot [path/to/firmware.elf] [HOST:PORT | pty]`: the image in QEMU, or the same program on the host where none is named. The robot is
//! the paper's, its wheels, motors and friction a little off from `examples/feup-4w/robot.toml`; its battery sags, and its gears lose a
//! fifth of the torque, of which that file knows nothing. Enter pulls the plug of the motors' supply for half a second.

use std::net::TcpListener;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use host_tests::emulator::{BoardProgram, Lockstep, Qemu};
use host_tests::in_loop::served::{serve, unwaiting};
use host_tests::in_loop::supply_plug::SupplyPlug;
use host_tests::in_loop::{HostProgram, robots};
use host_tests::virtual_board::{BoardSetup, VirtualBoard};
use model_core::effects::EffectKind;
use model_core::plant::paper::four_wheels;
use serialport::{SerialPort, TTYPort};

/// Where it listens if it is not said.
const ADDRESS: &str = "127.0.0.1:7000";
/// In place of an address: a serial device of its own.
const PTY: &str = "pty";
/// The draw of what is off.
const SEED: u64 = 1;
/// The share of the torque that the gears leave.
const GEAR_EFFICIENCY: f64 = 0.8;
/// How long the emulator may think about one period.
const PATIENCE: Duration = Duration::from_secs(20);

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let image = arguments.iter().find(|argument| Path::new(argument).is_file());
    let address = arguments.iter().find(|argument| Some(*argument) != image).map_or(ADDRESS, String::as_str);
    let served = match image {
        Some(image) => Qemu::start(Path::new(image), PATIENCE)
            .map_err(|why| format!("{image}: {why}"))
            .and_then(|program| listen(address, program)),
        None => listen(address, HostProgram::default()),
    };
    match served {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("robot: {why}");
            ExitCode::FAILURE
        }
    }
}

/// One robot for everybody who connects, one after another; in between its time stands still.
fn listen<B: BoardProgram>(address: &str, program: B) -> Result<(), String> {
    let mut robot = Lockstep::new(program, VirtualBoard::new(board()));
    let mut plug = pulled_by_enter();
    if address == PTY {
        let (mut line, device) = TTYPort::pair().map_err(|why| format!("a serial device: {why}"))?;
        line.set_timeout(Duration::ZERO).map_err(|why| why.to_string())?;
        println!("a robot listens at {}{HINT}", device.name().unwrap_or_default());
        return serve(&mut robot, &mut line, |board| plug.turn(board)).map_err(|why| why.to_string());
    }
    let listener = TcpListener::bind(address).map_err(|why| format!("{address}: {why}"))?;
    println!("a robot listens at tcp:{address}{HINT}");
    for connection in listener.incoming() {
        let mut connection = connection.and_then(unwaiting).map_err(|why| why.to_string())?;
        serve(&mut robot, &mut connection, |board| plug.turn(board)).map_err(|why| why.to_string())?;
    }
    Ok(())
}

/// What a person can do to it.
const HINT: &str = "; Enter pulls the plug of its motors for half a second, Ctrl-C switches it off";

/// The robot as it is.
fn board() -> BoardSetup<4> {
    let mut board = robots::board(&four_wheels(), SEED);
    board.effects.add(EffectKind::GearEfficiency, None, &[GEAR_EFFICIENCY]).expect("room for it");
    board
}

/// A plug that every line of the standard input pulls.
fn pulled_by_enter() -> SupplyPlug {
    let plug = SupplyPlug::default();
    let handle = plug.handle();
    std::thread::spawn(move || {
        for _ in std::io::stdin().lines().map_while(Result::ok) {
            handle.store(true, Ordering::Relaxed);
        }
    });
    plug
}
