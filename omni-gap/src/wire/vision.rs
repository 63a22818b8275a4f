//! SSL-Vision on the network: its packets, each with the time at which it was received.

use std::collections::BTreeSet;
use std::io::{self, ErrorKind};
use std::net::{Ipv4Addr, SocketAddrV4, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use socket2::{Domain, Protocol, Socket, Type};

use crate::error::{Error, InputKind, Result};
use crate::log::source::{self, write_game_log};
use crate::log::write_whole_with;

pub use crate::log::source::Packet;

/// Where SSL-Vision sends to if nobody has set it otherwise.
pub const USUAL_ADDRESS: &str = "224.5.23.2:10006";

/// How long a robot may be out of the cameras' sight before a recording begins.
const PATIENCE: Duration = Duration::from_secs(3);

/// How long one look for packets waits.
const LOOK: Duration = Duration::from_millis(100);

/// The longest packet of UDP [bytes]
const LONGEST: usize = 1 << 16;

/// What is listened for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Watched {
    /// Where SSL-Vision sends to: a multicast group, or an address of this computer.
    pub address: SocketAddrV4,
    /// The robot, as topics of game logs name it: `yellow/3`.
    pub robot: String,
}

/// What was heard.
#[derive(Clone, Debug, Default)]
pub struct Heard {
    /// The packets in which the robot was seen.
    pub packets: Vec<Packet>,
    /// Why it ended before it was asked to.
    pub broken: Option<String>,
}

impl Heard {
    /// Writes it as a game log, `NAME.log.gz`.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        write_whole_with(path, |out| write_game_log(out, &self.packets))
    }
}

/// A thread that listens until [`finish`](Listener::finish), or until this goes away.
#[derive(Debug)]
pub struct Listener {
    wanted: Arc<()>,
    thread: JoinHandle<Heard>,
}

/// An address that `--vision` may name.
///
/// # Errors
/// Where it is none.
pub fn address(text: &str) -> std::result::Result<SocketAddrV4, String> {
    text.parse().map_err(|_| format!("expected GROUP:PORT, such as {USUAL_ADDRESS}"))
}

/// A robot that `--vision-robot` may name.
///
/// # Errors
/// Where it is none.
pub fn robot(text: &str) -> std::result::Result<String, String> {
    let named = source::is_robot(text).then(|| text.to_owned());
    named.ok_or_else(|| "expected the team's colour and the pattern's number, such as yellow/3 or blue/0".to_owned())
}

impl Watched {
    /// Listens, once the robot has been seen.
    ///
    /// # Errors
    /// Where the address cannot be listened at, or the robot is not seen within three seconds.
    pub fn listen(&self) -> Result<Listener> {
        let fix = "Write --vision GROUP:PORT, and connect this computer to the network of SSL-Vision";
        let socket = open(self.address).map_err(|why| self.error(format!("cannot be listened at: {why}"), fix))?;
        let first = self.first_sight(&socket)?;
        let wanted = Arc::new(());
        let (until, robot) = (Arc::downgrade(&wanted), self.robot.clone());
        let thread = std::thread::spawn(move || heard(&socket, &robot, first, &until));
        Ok(Listener { wanted, thread })
    }

    /// The first packet in which the robot is.
    fn first_sight(&self, socket: &UdpSocket) -> Result<Packet> {
        let mut bytes = vec![0; LONGEST];
        let mut packets = 0;
        let mut others = BTreeSet::new();
        let began = Instant::now();
        while began.elapsed() < PATIENCE {
            let fix = "Check the network, then record again";
            let Some(packet) = next(socket, &mut bytes).map_err(|why| self.error(why.to_string(), fix))? else {
                continue;
            };
            let robots = source::robots_in(&packet.bytes);
            if robots.contains(&self.robot) {
                return Ok(packet);
            }
            packets += 1;
            others.extend(robots);
        }
        let (robot, seconds) = (&self.robot, PATIENCE.as_secs());
        let others = others.iter().map(|other| format!("`{other}`")).collect::<Vec<_>>().join(", ");
        let (problem, fix) = match (packets, others.as_str()) {
            (0, _) => (
                format!("no packet came within {seconds} s, expected those of SSL-Vision"),
                "Start SSL-Vision, and check its address and the network",
            ),
            (_, "") => (
                format!("{packets} packets came within {seconds} s, and none shows a robot, expected `{robot}`"),
                "Check that SSL-Vision sends to this address, and put the robot into the cameras' sight",
            ),
            _ => (
                format!("robot `{robot}` was not seen within {seconds} s; seen were {others}"),
                "Correct --vision-robot, or put the robot into the cameras' sight",
            ),
        };
        Err(self.error(problem, fix))
    }

    fn error(&self, problem: impl Into<String>, fix: &str) -> Error {
        let place = PathBuf::from(format!("udp:{}", self.address));
        Error::input(&place, problem, fix).of_kind(InputKind::Unreadable)
    }
}

impl Listener {
    /// Ends, and hands over what was heard.
    pub fn finish(self) -> Heard {
        drop(self.wanted);
        let broken = Some("the listening thread failed".to_owned());
        self.thread.join().unwrap_or(Heard { packets: Vec::new(), broken })
    }
}

/// A socket that hears what is sent to an address, beside other programs that do.
fn open(address: SocketAddrV4) -> io::Result<UdpSocket> {
    let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
    let group = *address.ip();
    if group.is_multicast() {
        socket.set_reuse_address(true)?;
        socket.bind(&SocketAddrV4::new(Ipv4Addr::UNSPECIFIED, address.port()).into())?;
        // a simulator may send from this computer without any network
        let joined = [Ipv4Addr::UNSPECIFIED, Ipv4Addr::LOCALHOST].map(|card| socket.join_multicast_v4(&group, &card));
        let [network, this_computer] = joined;
        network.or(this_computer)?;
    } else {
        socket.bind(&address.into())?;
    }
    let socket = UdpSocket::from(socket);
    socket.set_read_timeout(Some(LOOK))?;
    Ok(socket)
}

/// The next packet, if one comes soon.
fn next(socket: &UdpSocket, bytes: &mut [u8]) -> io::Result<Option<Packet>> {
    match socket.recv(bytes) {
        Ok(count) => {
            let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
            let received_ns = i64::try_from(since_1970.as_nanos()).unwrap_or(i64::MAX);
            Ok(Some(Packet { received_ns, bytes: bytes.get(..count).unwrap_or_default().to_vec() }))
        }
        Err(why) if matches!(why.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted) => {
            Ok(None)
        }
        Err(why) => Err(why),
    }
}

/// The packets in which a robot is, for as long as they are wanted.
fn heard(socket: &UdpSocket, robot: &str, first: Packet, wanted: &Weak<()>) -> Heard {
    let mut heard = Heard { packets: vec![first], broken: None };
    let mut bytes = vec![0; LONGEST];
    while wanted.strong_count() > 0 {
        match next(socket, &mut bytes) {
            Ok(Some(packet)) if source::robots_in(&packet.bytes).iter().any(|other| other == robot) => {
                heard.packets.push(packet);
            }
            Ok(_) => {}
            Err(why) => {
                heard.broken = Some(why.to_string());
                break;
            }
        }
    }
    heard
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A packet of one frame, in which one yellow robot is.
    fn packet(robot: u8) -> Vec<u8> {
        let seen = [[0x10, robot].as_slice(), &[0x1d], &0.5f32.to_le_bytes()].concat();
        let time = [[0x11].as_slice(), &1.0f64.to_le_bytes()].concat();
        let frame = [time.as_slice(), &[0x32, seen.len() as u8], &seen].concat();
        [[0x0a, frame.len() as u8].as_slice(), &frame].concat()
    }

    #[test]
    fn a_group_is_heard_beside_other_programs_and_only_the_robot_is_kept() {
        let address = SocketAddrV4::new(Ipv4Addr::new(224, 5, 23, 2), 10_406);
        let other_program = open(address).unwrap();
        let watched = Watched { address, robot: "yellow/3".to_owned() };
        let sender = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP)).unwrap();
        sender.set_multicast_if_v4(&Ipv4Addr::LOCALHOST).unwrap();
        let send = |robot| sender.send_to(&packet(robot), &address.into()).unwrap();
        let listener = std::thread::scope(|scope| {
            let listener = scope.spawn(|| watched.listen());
            while !listener.is_finished() {
                send(3);
                std::thread::sleep(Duration::from_millis(5));
            }
            listener.join().unwrap().unwrap()
        });
        for robot in [4, 3, 4] {
            send(robot);
        }
        std::thread::sleep(2 * LOOK);
        let heard = listener.finish();
        assert!(heard.broken.is_none() && heard.packets.len() >= 2, "{heard:?}");
        assert!(heard.packets.iter().all(|heard| heard.bytes == packet(3)), "{heard:?}");
        assert!(heard.packets.is_sorted_by_key(|heard| heard.received_ns));
        assert!(next(&other_program, &mut vec![0; LONGEST]).unwrap().is_some());
    }

    #[test]
    fn addresses_and_robots_are_told_from_other_texts() {
        assert_eq!(address(USUAL_ADDRESS).unwrap().port(), 10_006);
        for text in ["224.5.23.2", "vision:10006", "224.5.23.2:99999"] {
            assert!(address(text).unwrap_err().contains("GROUP:PORT"), "{text}");
        }
        assert_eq!(robot("blue/11"), Ok("blue/11".to_owned()));
        assert!(robot("3").unwrap_err().contains("yellow/3"));
    }
}
