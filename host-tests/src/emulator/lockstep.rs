//! # Lockstep: a program and a virtual board, period by period
//!
//! ```text
//! up(k): outputs of turn k − 1, bytes of the link       →  they hold over period k
//! down(k): codes of period k, bytes                     →  turn k
//! ```

use firmware::exchange::{Crash, DownFrame, UpFrame};

use super::host_link::HostLink;
use super::program::{BoardProgram, RunError};
use crate::virtual_board::{Outputs, VirtualBoard};

/// A program that drives a board.
#[derive(Debug)]
pub struct Lockstep<B, const N: usize> {
    /// The board with its robot
    pub board: VirtualBoard<N>,
    /// The host's end of the serial line
    pub link: HostLink,
    /// The program
    pub program: B,
    /// What the program is to fail by in the next current turn
    pub crash: Option<Crash>,
    /// Idle instructions to put into the next current turn, in units of 64
    pub burn_current: u16,
    /// The same for the next motion turn
    pub burn_motion: u16,
    period: Option<u32>,
    last: Option<DownFrame>,
}

impl<B: BoardProgram, const N: usize> Lockstep<B, N> {
    /// Connects the two.
    pub fn new(program: B, board: VirtualBoard<N>) -> Self {
        let link = HostLink::default();
        Self { board, link, program, crash: None, burn_current: 0, burn_motion: 0, period: None, last: None }
    }

    /// One period; what the program asked of it.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn period(&mut self) -> Result<UpFrame, RunError> {
        let up = self.program.up()?;
        let due = self.period.map_or(up.period, |last| last.wrapping_add(1));
        if up.period != due {
            return Err(RunError::Period { due, came: up.period });
        }
        self.period = Some(up.period);
        self.link.receive(&up.link);
        let codes = self.board.period(&Outputs { compare: up.compare, enabled: up.enabled });
        let down = DownFrame {
            codes,
            end: false,
            crash: self.crash.take(),
            burn_current: std::mem::take(&mut self.burn_current),
            burn_motion: std::mem::take(&mut self.burn_motion),
            link: self.link.transmit(),
            sensors: self.board.sensors(),
        };
        self.program.down(&down)?;
        self.last = Some(down);
        Ok(up)
    }

    /// So many periods; `see` is shown each, with the board after it.
    ///
    /// # Errors
    /// [`RunError`] says what became of the program.
    pub fn run(&mut self, periods: u32, mut see: impl FnMut(&UpFrame, &mut VirtualBoard<N>)) -> Result<(), RunError> {
        for _ in 0..periods {
            let up = self.period()?;
            see(&up, &mut self.board);
        }
        Ok(())
    }

    /// What was measured last.
    pub fn last(&self) -> Option<&DownFrame> {
        self.last.as_ref()
    }
}

#[cfg(target_os = "linux")]
impl<const N: usize> Lockstep<super::Qemu, N> {
    /// Ends the image as it ends by itself, and says if it does not.
    ///
    /// # Errors
    /// [`RunError`] says how it ended, or that it did not.
    pub fn end(mut self) -> Result<(), RunError> {
        let up = self.program.up()?;
        let codes = self.board.period(&Outputs { compare: up.compare, enabled: up.enabled });
        let link = self.link.transmit();
        let sensors = self.board.sensors();
        let last = DownFrame { codes, end: true, crash: None, burn_current: 0, burn_motion: 0, link, sensors };
        self.program.end(&last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::virtual_board::BoardSetup;
    use firmware::exchange::{LinkBytes, TOPS};
    use model_core::control::halls::HallCode;
    use model_core::effects::active::Effects;
    use model_core::plant::paper::four_wheels;

    /// Drives motor 0 by six steps without looking at currents, and sends back what comes over the link.
    #[derive(Debug, Default)]
    struct Simple {
        period: u32,
        halls: HallCode,
        back: LinkBytes,
        skips: bool,
    }

    impl BoardProgram for Simple {
        fn up(&mut self) -> Result<UpFrame, RunError> {
            let middle = TOPS[0] / 2;
            let (high, low) = (middle + 700, middle - 700);
            // the phase that pulls the magnet on from each sector: forward torque is current into b, out of c, at θ = 0
            let compare = match self.halls.0 {
                1 => [middle, high, low],
                3 => [low, high, middle],
                2 => [low, middle, high],
                6 => [middle, low, high],
                4 => [high, low, middle],
                _ => [high, middle, low],
            };
            let mut up = UpFrame { period: self.period, enabled: 1, link: self.back, ..UpFrame::default() };
            up.compare[0] = compare;
            self.period += if self.skips { 2 } else { 1 };
            Ok(up)
        }

        fn down(&mut self, down: &DownFrame) -> Result<(), RunError> {
            self.halls = down.codes.halls[0];
            self.back = down.link;
            Ok(())
        }
    }

    fn lockstep(skips: bool) -> Lockstep<Simple, 4> {
        let board = VirtualBoard::new(BoardSetup::new(four_wheels(), Effects::default(), 4));
        Lockstep::new(Simple { skips, ..Simple::default() }, board)
    }

    #[test]
    fn six_steps_by_the_halls_turn_a_wheel_forward_and_bytes_go_round() {
        let mut run = lockstep(false);
        run.link.send(&[1, 2, 3]);
        let mut periods = 0;
        run.run(10_000, |up, _| periods = up.period).expect("a brain without trouble");
        assert_eq!(periods, 9_999);
        assert!(run.board.wheel_speeds()[0] > 3.0, "{:?}", run.board.wheel_speeds());
        assert_eq!(run.link.received(), [1, 2, 3]);
        assert!(run.last().is_some_and(|down| down.codes == DownFrame { ..*down }.codes));
    }

    #[test]
    fn a_period_left_out_is_an_error() {
        let mut run = lockstep(true);
        assert!(run.period().is_ok());
        let trouble = run.period().expect_err("the second is missing");
        assert_eq!(trouble.to_string(), "period 2 came where 1 was due");
    }
}
