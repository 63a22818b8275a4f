//! What SSL-Vision sees of the robot, recorded beside it.

use std::net::SocketAddrV4;

use omni_gap::wire::vision::{Heard, USUAL_ADDRESS, Watched, address, robot};

/// What a robot's own records are called beside those of the cameras.
pub const RECORDS: &str = "robot.rec";

/// What the packets of SSL-Vision are called.
pub const PACKETS: &str = "vision.log.gz";

/// Where the cameras' packets come from, and whose they are.
#[derive(Debug, clap::Args)]
pub struct Vision {
    /// Record what SSL-Vision sees of the robot too: the packets that are sent to this address
    #[arg(long, value_name = "GROUP:PORT", num_args = 0..=1, default_missing_value = USUAL_ADDRESS,
          value_parser = address, requires = "vision_robot")]
    vision: Option<SocketAddrV4>,

    /// Which robot it is there: its team's colour, and the number of its pattern
    #[arg(long, value_name = "yellow/3", value_parser = robot, requires = "vision")]
    vision_robot: Option<String>,
}

impl Vision {
    /// What is to be listened for, if anything is.
    pub fn watched(&self) -> Option<Watched> {
        Some(Watched { address: self.vision?, robot: self.vision_robot.clone()? })
    }
}

/// The mapping of a session whose runs have both.
pub fn columns(robot: &str) -> String {
    format!(
        "# how the files of a run are read, and how their clocks lie (`omni-gap explain columns`)\n\
         [[file]]\n\
         name = \"{RECORDS}\"\n\n\
         [[file]]\n\
         name = \"{PACKETS}\"\n\
         topic = \"{robot}\"\n\
         offset_s = \"estimate\"         # or a number (s): the cameras' time + offset_s = the robot's time\n\n\
         [file.columns]\n\
         x_m       = {{ from = \"x\", unit = \"mm\" }}\n\
         y_m       = {{ from = \"y\", unit = \"mm\" }}\n\
         theta_rad = {{ from = \"orientation\" }}\n"
    )
}

/// What was heard, in sentences.
pub fn told(heard: &Heard, watched: &Watched) -> Vec<String> {
    let packets = heard.packets.len();
    let mut lines = vec![format!("{packets} packets of SSL-Vision show robot {}", watched.robot)];
    if let Some(why) = &heard.broken {
        lines.push(format!("listening to SSL-Vision ended before the robot's recording did: {why}"));
    }
    lines
}
