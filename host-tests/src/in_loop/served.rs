//! # Served: a robot at the other end of a connection, no faster than a real one
//!
//! A program in lockstep with a virtual board, its serial line a connection: what drives a robot over TCP or a serial device
//! drives this one.

use std::io::{self, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::emulator::{BoardProgram, Lockstep, RunError};
use crate::virtual_board::VirtualBoard;
use crate::virtual_board::board::PERIOD;

/// Periods from one look at the connection to the next: a motion turn.
const PERIODS: u32 = 20;

/// Bytes that may wait for somebody who reads; as on a serial line, more than that are lost.
const MOST_WAITING: usize = 1 << 13;

/// Why a robot is served no longer.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The program failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The connection broke.
    #[error("the connection: {0}")]
    Connection(#[from] io::Error),
}

/// A connection that is never waited for.
///
/// # Errors
/// Where it is broken.
pub fn unwaiting(connection: TcpStream) -> io::Result<TcpStream> {
    connection.set_nonblocking(true)?;
    connection.set_nodelay(true)?;
    Ok(connection)
}

/// Serves a robot until the other side goes away, and shows its board to `turn` before every motion turn. The connection is not
/// waited for: where nothing has come it says so at once.
///
/// # Errors
/// [`ServeError`] where the program fails or the connection breaks.
pub fn serve<B: BoardProgram, const N: usize>(
    robot: &mut Lockstep<B, N>,
    connection: &mut (impl Read + Write),
    mut turn: impl FnMut(&mut VirtualBoard<N>),
) -> Result<(), ServeError> {
    let length = Duration::from_secs_f64(f64::from(PERIODS) * PERIOD);
    let mut due = Instant::now();
    let mut bytes = [0; 1 << 12];
    let mut waiting: Vec<u8> = Vec::new();
    loop {
        match connection.read(&mut bytes) {
            Ok(0) => return Ok(()),
            Ok(count) => robot.link.send(&bytes[..count]),
            Err(why) if matches!(why.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(why) if why.kind() == ErrorKind::ConnectionReset => return Ok(()),
            Err(why) => return Err(why.into()),
        }
        turn(&mut robot.board);
        robot.run(PERIODS, |_, _| {})?;
        waiting.extend(robot.link.take_received());
        if waiting.len() > MOST_WAITING {
            waiting.clear();
        }
        match connection.write(&waiting) {
            Ok(count) => drop(waiting.drain(..count)),
            Err(why) if matches!(why.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(why) if matches!(why.kind(), ErrorKind::BrokenPipe | ErrorKind::ConnectionReset) => return Ok(()),
            Err(why) => return Err(why.into()),
        }
        // where the machine is slower than the robot, the robot's time is slower too
        due = (due + length).max(Instant::now());
        std::thread::sleep(due - Instant::now());
    }
}
