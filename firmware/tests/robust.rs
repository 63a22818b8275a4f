//! Whatever comes over the link, and whatever converters and halls say: no panic, no duty that is none, no bridge closed
//! that must be open ([`program::Program::period`] looks at each).

mod program;

use firmware::codes::{Codes, MOTORS};
use model_core::control::calibration::AdcCode;
use model_core::control::halls::HallCode;
use model_core::link::block::Parameters;
use model_core::link::command::Command;
use model_core::link::framing::{MAX_FRAME, MAX_PAYLOAD, encode_frame};
use model_core::plant::paper::{four_wheels, three_wheels};
use program::{Program, block, bytes, still};

/// Numbers that look drawn: xorshift of 64 bits.
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: u64) -> u64 {
        (self.throw() >> 11) % end
    }

    fn byte(&mut self) -> u8 {
        self.throw() as u8
    }

    /// Codes as nothing sane makes them.
    fn mad(&mut self) -> Codes {
        Codes {
            phases: [(); MOTORS].map(|()| [(); 3].map(|()| AdcCode(self.throw() as u16))),
            bus: AdcCode(self.throw() as u16),
            halls: [(); MOTORS].map(|()| HallCode(self.byte())),
            driver_fault: self.below(1000) == 0,
        }
    }

    /// A frame that is whole, of a kind and length that commands have more often than by chance.
    fn frame(&mut self) -> Vec<u8> {
        let payload: Vec<u8> = (0..self.below(1 + MAX_PAYLOAD as u64)).map(|_| self.byte()).collect();
        let length = [0, 2, 14, payload.len(), payload.len()][self.below(5) as usize].min(payload.len());
        let mut room = [0; MAX_FRAME];
        encode_frame(self.byte() % 10, &payload[..length], &mut room).expect("it fits").to_vec()
    }
}

#[test]
fn bytes_without_sense_do_nothing() {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15);
    let mut program = Program::new();
    for _ in 0..40_000 {
        let noise: Vec<u8> = (0..dice.below(11)).map(|_| dice.byte()).collect();
        program.receive(&noise);
        program.period(&still());
    }
    assert!(program.output.config.is_none() && program.output.setpoints.enabled == 0);
}

#[test]
fn whole_frames_without_sense_do_no_harm() {
    let mut dice = Dice(0x2545_f491_4f6c_dd1d);
    let mut program = Program::new();
    for _ in 0..40_000 {
        let frame = dice.frame();
        program.receive(&frame);
        let codes = if dice.below(2) == 0 { still() } else { dice.mad() };
        program.period(&codes);
    }
}

#[test]
fn codes_without_sense_do_no_harm_to_a_robot_that_is_cleared_and_driven_on() {
    for (seed, parameters) in
        [(7, Parameters::Four(block(four_wheels()))), (8, Parameters::Three(block(three_wheels())))]
    {
        let mut dice = Dice(0x9e37_79b9 + seed);
        let mut program = Program::driving(&parameters);
        let mut closed = 0;
        for k in 0..40_000_u32 {
            match k % 200 {
                0 => program.drive(),
                50 => program.command(&Command::Clear),
                100 if dice.below(20) == 0 => program.send_block(&bytes(&parameters)),
                150 if dice.below(5) == 0 => {
                    let frame = dice.frame();
                    program.receive(&frame);
                }
                _ => {}
            }
            let codes = if dice.below(300) == 0 { dice.mad() } else { still() };
            closed += u32::from(program.period(&codes).enabled != 0);
        }
        // it was not the bridges' being open that kept it from harm
        assert!(closed > 4_000, "{closed}");
    }
}
