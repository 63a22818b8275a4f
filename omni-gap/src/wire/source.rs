//! Where a robot's bytes come from: a file of frames, a network address, a serial line.

use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::{Error, InputKind, Result};
use crate::log::records::capture::Progress;

/// A place that bytes come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A file of frames.
    File(PathBuf),
    /// A network address, `host:port`.
    Tcp(String),
    /// A serial line.
    Serial(PathBuf),
}

/// How long a robot may be silent before a recording ends [s]
const PATIENCE: Duration = Duration::from_secs(5);

/// How long one look for bytes waits.
const LOOK: Duration = Duration::from_millis(100);

/// Bytes in both directions.
pub(crate) trait Stream: Read + Write + Send {}

impl<S: Read + Write + Send> Stream for S {}

/// Why no more bytes come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The file ended, or the other side closed the connection.
    Closed,
    /// No frame came for longer than anybody waits.
    Silent,
    /// Who took them had enough.
    Enough,
}

/// What one look for bytes found.
pub(super) enum Look {
    /// So many bytes.
    Bytes(usize),
    /// None yet.
    Nothing,
    /// The end of what there is: the other side closed the line, or a file ends here.
    End,
}

/// What helps where a line is broken.
pub(super) const CABLE: &str = "Check the cable, then start again";

/// How bytes are waited for.
struct Flow {
    /// What the end of what can be read means; none: more may come.
    end_of_file: Option<End>,
    /// How long no frame may come; none: for ever
    patience: Option<Duration>,
}

impl Source {
    /// What `--from` names: `tcp:HOST:PORT`, a serial device, or a file.
    pub fn named(text: &str) -> Source {
        match text.strip_prefix("tcp:") {
            Some(address) => Source::Tcp(address.to_owned()),
            None if is_device(Path::new(text)) => Source::Serial(text.into()),
            None => Source::File(text.into()),
        }
    }

    /// True if it never ends by itself.
    pub fn is_live(&self) -> bool {
        !matches!(self, Source::File(_))
    }

    /// The file that it is.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Source::File(path) => Some(path),
            _ => None,
        }
    }

    /// Its name for messages.
    pub fn place(&self) -> PathBuf {
        match self {
            Source::File(path) | Source::Serial(path) => path.clone(),
            Source::Tcp(address) => format!("tcp:{address}").into(),
        }
    }

    /// Hands all bytes to `take` until it has enough, the source ends, or no frame came for five seconds.
    ///
    /// # Errors
    /// Where it cannot be opened or read.
    pub fn read(&self, baud: u32, take: impl FnMut(&[u8]) -> Progress) -> Result<()> {
        let whole = Flow { end_of_file: Some(End::Closed), patience: self.is_live().then_some(PATIENCE) };
        self.flow(baud, &whole, take).map(|_| ())
    }

    /// The same of a file that grows too: its end is not the end before nothing came for as long as there is `patience`. Where
    /// nothing comes, `take` gets no bytes, ten times a second.
    ///
    /// # Errors
    /// As of [`Source::read`].
    pub fn follow(&self, baud: u32, patience: Duration, take: impl FnMut(&[u8]) -> Progress) -> Result<End> {
        let end_of_file = self.is_live().then_some(End::Closed);
        self.flow(baud, &Flow { end_of_file, patience: Some(patience) }, take)
    }

    fn flow(&self, baud: u32, flow: &Flow, mut take: impl FnMut(&[u8]) -> Progress) -> Result<End> {
        let mut open = self.open(baud)?;
        let mut bytes = [0; 1 << 14];
        let mut heard = Instant::now();
        loop {
            let progress = match self.look(&mut *open, &mut bytes)? {
                Look::End => match flow.end_of_file {
                    Some(end) => return Ok(end),
                    None => {
                        std::thread::sleep(LOOK);
                        take(&[])
                    }
                },
                Look::Bytes(count) => take(bytes.get(..count).unwrap_or_default()),
                Look::Nothing => take(&[]),
            };
            match progress {
                Progress::Enough => return Ok(End::Enough),
                Progress::Frames => heard = Instant::now(),
                Progress::Nothing if flow.patience.is_some_and(|patience| heard.elapsed() > patience) => {
                    return Ok(End::Silent);
                }
                Progress::Nothing => {}
            }
        }
    }

    /// Looks once for bytes of this source.
    ///
    /// # Errors
    /// Where the line is broken.
    pub(super) fn look(&self, stream: &mut (impl Read + ?Sized), bytes: &mut [u8]) -> Result<Look> {
        match stream.read(bytes) {
            Ok(0) => Ok(Look::End),
            Ok(count) => Ok(Look::Bytes(count)),
            Err(why) if matches!(why.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted) => {
                Ok(Look::Nothing)
            }
            Err(why) if self.was_closed(&why) => Ok(Look::End),
            Err(why) => Err(self.error(why.to_string(), CABLE)),
        }
    }

    /// True where a network tells so that the other side closed the line: one that does with bytes unread resets it.
    pub(super) fn was_closed(&self, why: &std::io::Error) -> bool {
        let kinds = [ErrorKind::ConnectionReset, ErrorKind::ConnectionAborted, ErrorKind::BrokenPipe];
        matches!(self, Source::Tcp(_)) && kinds.contains(&why.kind())
    }

    fn open(&self, baud: u32) -> Result<Box<dyn Read>> {
        match self {
            Source::File(path) if path.is_dir() => {
                Err(self.error("this is a folder, expected a file of frames", "Name a file inside it"))
            }
            Source::File(path) => match File::open(path) {
                Ok(file) => Ok(Box::new(file)),
                Err(why) if why.kind() == ErrorKind::NotFound => Err(self
                    .error("no such file, expected a file of frames", "Check the path, or the device's name")
                    .of_kind(InputKind::NotFound)),
                Err(why) => Err(self.error(why.to_string(), "Check the file's permissions")),
            },
            Source::Tcp(_) | Source::Serial(_) => Ok(Box::new(self.connect(baud)?)),
        }
    }

    /// Opens both directions; a file has only one. A look for bytes waits a tenth of a second.
    pub(super) fn connect(&self, baud: u32) -> Result<Box<dyn Stream>> {
        match self {
            Source::File(path) if path.exists() => {
                Err(self.error("this is a file, expected a robot", "Name its device, or tcp:HOST:PORT"))
            }
            Source::File(_) => Err(self
                .error("no such device, expected a robot", "Check its name, or write tcp:HOST:PORT")
                .of_kind(InputKind::NotFound)),
            Source::Tcp(address) => {
                let fix = "Write tcp:HOST:PORT, and start what listens there first";
                let stream = TcpStream::connect(address).map_err(|why| self.error(why.to_string(), fix))?;
                stream.set_read_timeout(Some(LOOK)).map_err(|why| self.error(why.to_string(), fix))?;
                Ok(Box::new(stream))
            }
            Source::Serial(path) => {
                let port = serialport::new(path.to_string_lossy(), baud).timeout(LOOK).open();
                let fix = "Check the device's name, that you may use it, and --baud";
                Ok(Box::new(port.map_err(|why| self.error(why.to_string(), fix))?))
            }
        }
    }

    /// A mistake about this source.
    pub fn error(&self, problem: impl Into<String>, fix: impl Into<String>) -> Error {
        Error::input(&self.place(), problem, fix).of_kind(InputKind::Unreadable)
    }
}

#[cfg(unix)]
fn is_device(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    path.metadata().is_ok_and(|found| found.file_type().is_char_device())
}

#[cfg(not(unix))]
fn is_device(path: &Path) -> bool {
    let name = path.to_string_lossy();
    name.strip_prefix("COM").is_some_and(|number| number.parse::<u16>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use std::net::TcpListener;

    #[test]
    fn a_source_is_known_by_its_name() {
        assert_eq!(Source::named("tcp:robot:7000"), Source::Tcp("robot:7000".into()));
        assert_eq!(Source::named("frames.bin"), Source::File("frames.bin".into()));
        assert!(Source::named("tcp:robot:7000").is_live() && !Source::named("frames.bin").is_live());
    }

    #[test]
    fn bytes_come_over_the_network_until_there_are_enough() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let source = Source::named(&format!("tcp:{}", listener.local_addr().unwrap()));
        let robot = std::thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            while stream.write_all(&[7; 100]).is_ok() {}
        });
        let mut count = 0;
        let enough = |bytes: &[u8]| {
            count += bytes.len();
            if count > 1000 { Progress::Enough } else { Progress::Frames }
        };
        source.read(0, enough).unwrap();
        robot.join().unwrap();
        assert!(count > 1000);
    }

    #[test]
    fn a_line_whose_other_side_ends_with_bytes_unread_was_closed() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let source = Source::named(&format!("tcp:{}", listener.local_addr().unwrap()));
        let mut stream = source.connect(0).unwrap();
        let (robot, _) = listener.accept().unwrap();
        stream.write_all(&[1, 2, 3]).unwrap();
        // until the bytes are there
        robot.peek(&mut [0; 3]).unwrap();
        drop(robot);
        let found = std::iter::repeat_with(|| source.look(&mut *stream, &mut [0; 8]));
        let found = found.map(|look| look.unwrap()).find(|look| !matches!(look, Look::Nothing));
        assert!(matches!(found, Some(Look::End)));
    }

    #[test]
    fn a_file_that_grows_is_followed_until_nothing_comes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frames.rec");
        std::fs::write(&path, [1, 2]).unwrap();
        let source = Source::File(path.clone());
        let (mut taken, mut grown) = (Vec::new(), false);
        let end = source.follow(0, Duration::from_millis(300), |bytes| {
            taken.extend_from_slice(bytes);
            if bytes.is_empty() && !grown {
                grown = true;
                let mut file = std::fs::OpenOptions::new().append(true).open(&path).unwrap();
                file.write_all(&[3, 4]).unwrap();
            }
            if bytes.is_empty() { Progress::Nothing } else { Progress::Frames }
        });
        assert_eq!((end.unwrap(), taken), (End::Silent, vec![1, 2, 3, 4]));
        assert_eq!(source.follow(0, Duration::from_secs(9), |_| Progress::Enough).unwrap(), End::Enough);
    }

    #[test]
    fn what_is_not_there_is_told() {
        let told = |name: &str| Source::named(name).read(0, |_| Progress::Nothing).unwrap_err().to_string();
        assert!(told("no/such/frames.bin").contains("no such file, expected a file of frames"));
        assert!(told("tcp:127.0.0.1:1").contains("tcp:127.0.0.1:1: "));
        assert!(told(".").contains("this is a folder"));
    }
}
