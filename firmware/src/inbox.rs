//! # Inbox: what the link has brought for the motion turn

use model_core::control::interpolator::Interpolator;
use model_core::link::command::Reply;
use model_core::link::probe::Probe;

use crate::command_receiver::ReceivedCommand;
use crate::configured_robot::ConfiguredRobot;

/// What has come and was not taken yet.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inbox {
    /// The motion that was commanded last, from its turn on
    pub wanted: Interpolator,
    /// How many commands have come; wraps
    pub commands: u32,
    /// The number of the last one
    pub sequence: Option<u16>,
    /// A voltage for one motor
    pub probe: Option<Probe>,
    /// The number of the last one
    pub probe_sequence: Option<u16>,
    /// True: open the bridges
    pub open: bool,
    /// True: forget latched faults
    pub clear: bool,
    /// A command came that cannot be followed
    pub bad_command: bool,
    /// A parameter block came that cannot be taken
    pub bad_block: bool,
    /// Parameters that are in use, or about to be, are not stored
    pub unsaved: bool,
    /// Other parameters
    pub parameters: Option<ConfiguredRobot>,
    /// An answer to what came last
    pub reply: Option<Reply>,
}

impl Inbox {
    /// Something was heard.
    pub fn put(&mut self, command: ReceivedCommand) {
        match command {
            // the same command once more, from a relay that has lost its host, keeps no robot going
            ReceivedCommand::Drive { sequence, .. } if self.sequence == Some(sequence) => {}
            ReceivedCommand::Drive { sequence, ramp } => {
                self.sequence = Some(sequence);
                self.wanted = Interpolator::new(ramp);
                self.open = false;
                self.commands = self.commands.wrapping_add(1);
            }
            ReceivedCommand::Probe(probe) if self.probe_sequence == Some(probe.sequence) => {}
            ReceivedCommand::Probe(probe) => {
                self.probe_sequence = Some(probe.sequence);
                self.probe = Some(probe);
                self.open = false;
            }
            ReceivedCommand::Open => {
                self.open = true;
                self.probe = None;
            }
            ReceivedCommand::Clear(reply) => {
                self.clear = true;
                self.reply = Some(reply);
            }
            ReceivedCommand::Parameters(robot, reply) => {
                self.parameters = Some(robot);
                // those without a reply come from the flash
                self.unsaved = reply.is_some();
                self.reply = reply;
            }
            ReceivedCommand::BadCommand(reply) => {
                self.bad_command = true;
                self.reply = Some(reply);
            }
            ReceivedCommand::BadBlock(reply) => {
                self.bad_block = true;
                self.reply = Some(reply);
            }
        }
    }
}
